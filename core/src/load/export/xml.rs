//! Text of XML, indented.

use crate::Rgb;
use std::format;
use std::string::String;

/// XML under construction.
#[derive(Debug)]
pub(super) struct Xml {
    text: String,
    depth: usize,
}

impl Xml {
    /// A scene.
    pub(super) fn new() -> Self {
        let mut xml = Self { text: String::new(), depth: 0 };
        xml.line("<scene version=\"3.0.0\">");
        xml.depth = 1;
        xml
    }

    /// What stands inside of an element of a scene.
    pub(super) fn nested() -> Self {
        Self { text: String::new(), depth: 2 }
    }

    fn line(&mut self, line: &str) {
        (0..self.depth).for_each(|_| self.text.push_str("  "));
        self.text.push_str(line);
        self.text.push('\n');
    }

    /// Text from [`Xml::nested`].
    pub(super) fn raw(&mut self, text: &str) {
        self.text.push_str(text);
    }

    /// A remark for people.
    pub(super) fn remark(&mut self, text: &str) {
        self.line(&format!("<!-- {text} -->"));
    }

    fn tag(tag: &str, attributes: &[(&str, &str)]) -> String {
        let attributes = attributes.iter().map(|(name, value)| format!(" {name}=\"{}\"", escape(value)));
        format!("<{tag}{}", attributes.collect::<String>())
    }

    /// An element without content.
    pub(super) fn empty(&mut self, tag: &str, attributes: &[(&str, &str)]) {
        self.line(&(Self::tag(tag, attributes) + "/>"));
    }

    /// The start of an element.
    pub(super) fn open(&mut self, tag: &str, attributes: &[(&str, &str)]) {
        self.line(&(Self::tag(tag, attributes) + ">"));
        self.depth += 1;
    }

    /// The start of a plugin.
    pub(super) fn open_plugin(&mut self, tag: &str, kind: &str, id: Option<&str>) {
        match id {
            Some(id) => self.open(tag, &[("type", kind), ("id", id)]),
            None => self.open(tag, &[("type", kind)]),
        }
    }

    /// The end of an element.
    pub(super) fn close(&mut self, tag: &str) {
        self.depth -= 1;
        self.line(&format!("</{tag}>"));
    }

    /// A property.
    pub(super) fn property(&mut self, tag: &str, name: &str, value: &str) {
        self.empty(tag, &[("name", name), ("value", value)]);
    }

    /// A number, in the fewest digits that give it back.
    pub(super) fn float(&mut self, name: &str, value: f32) {
        self.property("float", name, &format!("{value:?}"));
    }

    /// A whole number.
    pub(super) fn integer(&mut self, name: &str, value: u32) {
        self.property("integer", name, &format!("{value}"));
    }

    /// A colour.
    pub(super) fn rgb(&mut self, name: &str, Rgb { r, g, b }: Rgb) {
        self.property("rgb", name, &format!("{r:?}, {g:?}, {b:?}"));
    }

    /// The whole document.
    pub(super) fn finish(mut self) -> String {
        self.close("scene");
        self.text
    }

    /// What was written since [`Xml::nested`].
    pub(super) fn into_body(self) -> String {
        self.text
    }
}

/// A text as the value of an attribute.
fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
