//! An XML element after parameters and includes have been resolved.

use crate::load::{LoadError, Position, Problem};
use std::boxed::Box;
use std::format;
use std::string::String;
use std::vec::Vec;

/// An element with its attributes, children and place.
#[derive(Debug, Clone)]
pub(super) struct Element {
    pub(super) tag: String,
    pub(super) attributes: Vec<(String, String)>,
    pub(super) children: Vec<Element>,
    pub(super) at: Position,
}

impl Element {
    /// An attribute, when it is there.
    pub(super) fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(n, _)| n == name).map(|(_, v)| v.as_str())
    }

    /// An attribute that must be there.
    pub(super) fn required(&self, name: &str) -> Result<&str, LoadError> {
        self.attribute(name)
            .ok_or_else(|| self.error(Problem::Missing { what: format!("the attribute \"{name}\"") }))
    }

    /// Refuses attributes that have no meaning here.
    pub(super) fn only_attributes(&self, known: &[&str]) -> Result<(), LoadError> {
        match self.attributes.iter().find(|(n, _)| !known.contains(&n.as_str())) {
            Some((name, _)) => Err(self.error(Problem::unknown("attribute", name, known))),
            None => Ok(()),
        }
    }

    /// Refuses children.
    pub(super) fn no_children(&self) -> Result<(), LoadError> {
        match self.children.first() {
            Some(child) => Err(child.error(Problem::NotSupported {
                what: format!("an element inside of <{}>", self.tag),
                instead: "move it out",
            })),
            None => Ok(()),
        }
    }

    /// The plugin's type, one of `supported`.
    pub(super) fn plugin<'n>(&self, what: &'static str, supported: &[&'n str]) -> Result<&'n str, LoadError> {
        self.only_attributes(&["type", "id", "name"])?;
        let kind = self.required("type")?;
        supported
            .iter()
            .find(|s| **s == kind)
            .copied()
            .ok_or_else(|| self.error(Problem::unknown(what, kind, supported)))
    }

    /// The id, or else the plugin's type: a name for people.
    pub(super) fn title(&self) -> &str {
        self.attribute("id").or_else(|| self.attribute("type")).unwrap_or(&self.tag)
    }

    /// An error about this element.
    pub(super) fn error(&self, problem: impl Into<Problem>) -> LoadError {
        LoadError::Element { at: self.at.clone(), element: self.label(), problem: Box::new(problem.into()) }
    }

    /// The tag as written, with the attributes by which it is recognised.
    pub(super) fn label(&self) -> String {
        let mut label = format!("<{}", self.tag);
        for key in ["type", "id", "name"] {
            if let Some(value) = self.attribute(key) {
                label.push_str(&format!(" {key}=\"{value}\""));
            }
        }
        label.push('>');
        label
    }
}
