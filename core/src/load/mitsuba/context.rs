//! What is known while a document becomes a scene: ids, warnings, how strict to be.

use super::document::{Document, find};
use super::element::Element;
use crate::build::TexelBuffer;
use crate::load::{LoadError, Problem, Warning};
use std::borrow::ToOwned;
use std::collections::BTreeMap;
use std::format;
use std::path::PathBuf;
use std::string::String;
use std::sync::Arc;
use std::vec::Vec;

/// What is known while a document becomes a scene.
#[derive(Debug)]
pub(super) struct Context<'d> {
    pub(super) document: &'d Document,
    lenient: bool,
    warnings: Vec<Warning>,
    ids: BTreeMap<&'d str, &'d Element>,
    /// Pictures of textures, by file and encoding: each is read once.
    pub(super) pictures: BTreeMap<(PathBuf, bool), (u32, u32, Arc<TexelBuffer>)>,
}

impl<'d> Context<'d> {
    /// Collects the ids.
    pub(super) fn new(document: &'d Document, lenient: bool) -> Result<Self, LoadError> {
        let mut ids = BTreeMap::new();
        for child in &document.root.children {
            collect(child, &mut ids)?;
        }
        Ok(Self { document, lenient, warnings: Vec::new(), ids, pictures: BTreeMap::new() })
    }

    /// Notes that something is not done as written.
    pub(super) fn warn(&mut self, element: &Element, text: &str) {
        let text = format!("{}: {text}", element.label());
        self.warnings.push(Warning { at: Some(element.at.clone()), text });
    }

    /// When lenient: turns what can be left out into a warning and `None`.
    pub(super) fn tolerate<T>(&mut self, result: Result<T, LoadError>) -> Result<Option<T>, LoadError> {
        match result {
            Ok(value) => Ok(Some(value)),
            Err(LoadError::Element { at, element, problem }) if self.lenient && problem.can_be_left_out() => {
                let text = format!("{element}: {problem}; left out");
                self.warnings.push(Warning { at: Some(at), text });
                Ok(None)
            }
            Err(error) => Err(error),
        }
    }

    /// The element that a `<ref>` means.
    pub(super) fn referent(&self, reference: &Element) -> Result<&'d Element, LoadError> {
        reference.only_attributes(&["id", "name"])?;
        let id = reference.required("id")?;
        let mut target = id;
        // Each alias is followed at most once: a chain cannot be longer than their number.
        for _ in 0..self.document.aliases.len() {
            match self.document.aliases.iter().find(|(name, _)| name == target) {
                Some((_, next)) if !self.ids.contains_key(target) => target = next,
                _ => break,
            }
        }
        self.ids.get(target).copied().ok_or_else(|| {
            let aliases = self.document.aliases.iter().map(|(name, _)| name.as_str());
            let known: Vec<&str> = self.ids.keys().copied().chain(aliases).collect();
            reference.error(Problem::unknown("id", id, &known))
        })
    }

    /// The file that an element names.
    pub(super) fn find(&self, element: &Element, name: &str) -> PathBuf {
        find(&self.document.files, element, name, &self.document.search)
    }

    pub(super) fn into_warnings(self) -> Vec<Warning> {
        self.warnings
    }
}

/// Collects the ids of an element and what is inside of it.
fn collect<'d>(element: &'d Element, ids: &mut BTreeMap<&'d str, &'d Element>) -> Result<(), LoadError> {
    if element.tag != "ref"
        && let Some(id) = element.attribute("id")
        && let Some(first) = ids.insert(id, element)
    {
        let what: String = format!("the id \"{id}\" is used twice");
        return Err(element.error(Problem::Conflict { what, first: first.at.to_owned() }));
    }
    element.children.iter().try_for_each(|child| collect(child, ids))
}
