//! What is read, but not as written.

use crate::load::Warning;
use std::format;
use std::path::Path;
use std::string::String;
use std::vec::Vec;

/// The most warnings about one file that anyone reads.
const MOST: usize = 64;

/// The warnings so far; each text is kept once.
#[derive(Debug)]
pub(super) struct Log<'p> {
    path: &'p Path,
    warnings: Vec<Warning>,
    more: usize,
}

impl<'p> Log<'p> {
    pub(super) const fn new(path: &'p Path) -> Self {
        Self { path, warnings: Vec::new(), more: 0 }
    }

    /// Notes that something is not done as written.
    pub(super) fn warn(&mut self, item: &str, text: &str) {
        let warning = Warning { at: None, text: format!("{}: {item}: {text}", self.path.display()) };
        if self.warnings.contains(&warning) {
            return;
        }
        if self.warnings.len() < MOST {
            self.warnings.push(warning);
        } else {
            self.more += 1;
        }
    }

    /// Notes something about the call.
    pub(super) fn note(&mut self, text: String) {
        self.warnings.push(Warning { at: None, text });
    }

    pub(super) fn into_warnings(mut self) -> Vec<Warning> {
        if self.more > 0 {
            self.note(format!("{}: {} more warnings like these", self.path.display(), self.more));
        }
        self.warnings
    }
}
