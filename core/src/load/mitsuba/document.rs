//! From files to one tree: parameters put in, includes opened.

use super::element::Element;
use crate::load::{Files, LoadError, LoadOptions, Position, Problem, Warning};
use std::borrow::ToOwned;
use std::boxed::Box;
use std::collections::BTreeMap;
use std::format;
use std::path::{Path, PathBuf};
use std::string::{String, ToString};
use std::sync::Arc;
use std::vec::Vec;

/// How deeply files may include one another.
pub(in crate::load) const MAX_INCLUDE_DEPTH: usize = 32;
/// How deeply elements may be nested: a scene needs six levels, and recursion needs a bound.
const MAX_NESTING: usize = 64;
/// How many elements a scene may have: with its meshes in files of their own, none comes near.
const MAX_ELEMENTS: usize = 1 << 20;
/// How many files may be included: files that include others several times multiply.
const MAX_INCLUDES: usize = 1 << 12;

/// A value that can be put into attributes as `$name`.
#[derive(Debug)]
struct Parameter {
    value: String,
    /// Given from outside: the file's default does not count.
    given: bool,
    used: bool,
}

/// A whole scene as a tree.
#[derive(Debug)]
pub(super) struct Document {
    /// The root, with included files in place.
    pub(super) root: Element,
    /// Second names of ids: `(as, id)`.
    pub(super) aliases: Vec<(String, String)>,
    /// Folders in which files are looked for, besides that of the file that names them.
    pub(super) search: Vec<PathBuf>,
    /// Where they are looked for.
    pub(super) files: Files,
    parameters: BTreeMap<String, Parameter>,
}

impl Document {
    /// Reads a file and what it includes.
    pub(super) fn read(files: &Files, path: &Path, options: &LoadOptions) -> Result<Self, LoadError> {
        let mut reader = Reader {
            parameters: defines(options)?,
            aliases: Vec::new(),
            search: Vec::new(),
            files: files.clone(),
            open: Vec::new(),
            elements: 0,
            includes: 0,
        };
        let text =
            files.read(path).map_err(|source| LoadError::Unreadable { path: path.to_owned(), source })?;
        let root = reader.file(path, &text)?;
        if root.tag != "scene" {
            return Err(root.error(Problem::unknown("root element", &root.tag, &["scene"])));
        }
        let Reader { parameters, aliases, search, files, .. } = reader;
        Ok(Self { root, aliases, search, files, parameters })
    }

    /// One warning for each parameter from outside that no attribute uses.
    pub(super) fn unused_defines(&self) -> impl Iterator<Item = Warning> {
        self.parameters.iter().filter(|(_, p)| p.given && !p.used).map(|(name, _)| Warning {
            at: None,
            text: format!(
                "the parameter \"{name}\" is not used in the scene; write ${name} where it belongs"
            ),
        })
    }
}

/// The parameters given from outside.
fn defines(options: &LoadOptions) -> Result<BTreeMap<String, Parameter>, LoadError> {
    let mut parameters = BTreeMap::new();
    for (name, value) in &options.defines {
        if name.is_empty() || !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_' || c == '-') {
            return Err(LoadError::Define { name: name.clone(), twice: false });
        }
        let parameter = Parameter { value: value.clone(), given: true, used: false };
        if parameters.insert(name.clone(), parameter).is_some() {
            return Err(LoadError::Define { name: name.clone(), twice: true });
        }
    }
    Ok(parameters)
}

/// What is gathered while files are read.
struct Reader {
    parameters: BTreeMap<String, Parameter>,
    aliases: Vec<(String, String)>,
    search: Vec<PathBuf>,
    files: Files,
    /// Files being read, outermost first.
    open: Vec<PathBuf>,
    elements: usize,
    includes: usize,
}

/// A file's name and where its lines start.
struct Source {
    file: Arc<Path>,
    starts: Vec<usize>,
}

impl Source {
    fn new(path: &Path, text: &[u8]) -> Self {
        let newlines = text.iter().enumerate().filter(|(_, b)| **b == b'\n').map(|(i, _)| i + 1);
        Self { file: path.into(), starts: core::iter::once(0).chain(newlines).collect() }
    }

    fn position(&self, offset: usize) -> Position {
        let line = self.starts.partition_point(|s| *s <= offset).max(1);
        let column = offset - self.starts[line - 1] + 1;
        Position { file: self.file.clone(), line: line as u32, column: column as u32 }
    }
}

impl Reader {
    /// The root element of a file.
    fn file(&mut self, path: &Path, bytes: &[u8]) -> Result<Element, LoadError> {
        let source = Source::new(path, bytes);
        let text = core::str::from_utf8(bytes).map_err(|e| LoadError::Syntax {
            at: source.position(e.valid_up_to()),
            what: "the text is not UTF-8".to_owned(),
        })?;
        let options = roxmltree::ParsingOptions {
            nodes_limit: 4 * MAX_ELEMENTS as u32,
            ..roxmltree::ParsingOptions::default()
        };
        let tree = roxmltree::Document::parse_with_options(text, options).map_err(|e| {
            if let roxmltree::Error::UnexpectedEndOfStream | roxmltree::Error::UnclosedRootNode = e {
                return LoadError::Syntax {
                    at: source.position(bytes.len()),
                    what: "it ends here".to_owned(),
                };
            }
            let at = e.pos();
            LoadError::Syntax {
                at: Position { file: path.into(), line: at.row, column: at.col },
                what: e.to_string(),
            }
        })?;
        self.open.push(self.files.canonical(path).unwrap_or_else(|| path.to_owned()));
        let root = self.element(&source, tree.root_element(), 0)?;
        self.open.pop();
        check_version(&root)?;
        Ok(root)
    }

    /// An element with its children; parameters are put in on the way.
    fn element(
        &mut self,
        source: &Source,
        node: roxmltree::Node<'_, '_>,
        depth: usize,
    ) -> Result<Element, LoadError> {
        let mut element = Element {
            tag: node.tag_name().name().to_owned(),
            attributes: node.attributes().map(|a| (a.name().to_owned(), a.value().to_owned())).collect(),
            children: Vec::new(),
            at: source.position(node.range().start),
        };
        self.elements += 1;
        if self.elements > MAX_ELEMENTS {
            return Err(element.error(Problem::TooLarge { what: "elements", limit: MAX_ELEMENTS }));
        }
        if depth > MAX_NESTING {
            return Err(element.error(Problem::TooLarge { what: "nested elements", limit: MAX_NESTING }));
        }
        self.substitute(&mut element)?;
        for child in node.children() {
            self.child(source, child, &mut element, depth)?;
        }
        Ok(element)
    }

    /// Adds what a child node stands for to its parent.
    fn child(
        &mut self,
        source: &Source,
        node: roxmltree::Node<'_, '_>,
        parent: &mut Element,
        depth: usize,
    ) -> Result<(), LoadError> {
        if node.is_text() && node.text().is_some_and(|t| !t.trim().is_empty()) {
            let at = source.position(node.range().start);
            return Err(LoadError::Syntax { at, what: "text between elements".to_owned() });
        }
        if !node.is_element() {
            return Ok(());
        }
        let element = self.element(source, node, depth + 1)?;
        match element.tag.as_str() {
            "default" => self.default(&element)?,
            "alias" => self.alias(&element)?,
            "path" => self.path(&element)?,
            "include" => self.include(&element, parent)?,
            _ => parent.children.push(element),
        }
        Ok(())
    }

    /// Puts the parameters into the attributes.
    fn substitute(&mut self, element: &mut Element) -> Result<(), LoadError> {
        for i in 0..element.attributes.len() {
            let value = &element.attributes[i].1;
            if value.contains('$') {
                let value = self.expand(value).map_err(|name| {
                    let known: Vec<&str> = self.parameters.keys().map(String::as_str).collect();
                    element.error(Problem::unknown("parameter", &name, &known))
                })?;
                element.attributes[i].1 = value;
            }
        }
        Ok(())
    }

    /// A text with each `$name` replaced; the longest known name counts. `Err` is a name that is not
    /// known.
    fn expand(&mut self, text: &str) -> Result<String, String> {
        let mut parts = text.split('$');
        let mut expanded = parts.next().unwrap_or_default().to_owned();
        for part in parts {
            let names = self.parameters.iter_mut().filter(|(name, _)| part.starts_with(name.as_str()));
            let Some((name, parameter)) = names.max_by_key(|(name, _)| name.len()) else {
                let end = part.find(|c: char| !(c.is_alphanumeric() || c == '_')).unwrap_or(part.len());
                return Err(part[..end].to_owned());
            };
            parameter.used = true;
            expanded.push_str(&parameter.value);
            expanded.push_str(&part[name.len()..]);
        }
        Ok(expanded)
    }

    fn default(&mut self, element: &Element) -> Result<(), LoadError> {
        element.only_attributes(&["name", "value"])?;
        let name = element.required("name")?;
        let value = element.required("value")?.to_owned();
        if name.is_empty() {
            return Err(element.error(Problem::Missing { what: "the parameter's name".to_owned() }));
        }
        self.parameters.entry(name.to_owned()).or_insert(Parameter { value, given: false, used: false });
        Ok(())
    }

    fn alias(&mut self, element: &Element) -> Result<(), LoadError> {
        element.only_attributes(&["id", "as"])?;
        self.aliases.push((element.required("as")?.to_owned(), element.required("id")?.to_owned()));
        Ok(())
    }

    fn path(&mut self, element: &Element) -> Result<(), LoadError> {
        element.only_attributes(&["value"])?;
        let folder = beside(element, element.required("value")?);
        self.search.push(folder);
        Ok(())
    }

    /// Puts another file's root, or the children of a `<scene>`, into the parent.
    fn include(&mut self, element: &Element, parent: &mut Element) -> Result<(), LoadError> {
        element.only_attributes(&["filename"])?;
        self.includes += 1;
        if self.includes > MAX_INCLUDES {
            return Err(element.error(Problem::TooLarge { what: "included files", limit: MAX_INCLUDES }));
        }
        let path = find(&self.files, element, element.required("filename")?, &self.search);
        if self.open.len() > MAX_INCLUDE_DEPTH {
            return Err(element.error(Problem::Include { path, cycle: false }));
        }
        if self.files.canonical(&path).is_some_and(|p| self.open.contains(&p)) {
            return Err(element.error(Problem::Include { path, cycle: true }));
        }
        let text = self
            .files
            .read(&path)
            .map_err(|source| element.error(Problem::File { path: path.clone(), source }))?;
        let root = self.file(&path, &text)?;
        if root.tag == "scene" {
            parent.children.extend(root.children);
        } else {
            parent.children.push(root);
        }
        Ok(())
    }
}

/// Scenes of Mitsuba 0.x have other names for the same things.
fn check_version(root: &Element) -> Result<(), LoadError> {
    if root.tag != "scene" {
        return Ok(());
    }
    root.only_attributes(&["version", "id", "type"])?;
    let version = root.required("version")?;
    if matches!(version.split('.').next(), Some("2" | "3")) {
        return Ok(());
    }
    Err(LoadError::Element {
        at: root.at.clone(),
        element: root.label(),
        problem: Box::new(Problem::Value {
            attribute: "version".to_owned(),
            text: version.to_owned(),
            expected: "2.x or 3.x (convert older scenes to Mitsuba 3)",
        }),
    })
}

/// A file name relative to the file that names it.
fn beside(element: &Element, name: &str) -> PathBuf {
    element.at.file.parent().unwrap_or(Path::new("")).join(name)
}

/// The file meant by a name: beside the file that names it, or in one of the folders.
pub(super) fn find(files: &Files, element: &Element, name: &str, search: &[PathBuf]) -> PathBuf {
    let near = beside(element, name);
    if files.has(&near) {
        return near;
    }
    search.iter().map(|folder| folder.join(name)).find(|p| files.has(p)).unwrap_or(near)
}
