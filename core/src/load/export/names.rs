//! Names that are safe as ids and as files.

use std::collections::BTreeSet;
use std::format;
use std::string::{String, ToString};

/// Longest part of a file name that comes from a name in the scene.
const LONGEST: usize = 64;

/// Names that have been given away.
#[derive(Debug, Default)]
pub(super) struct Names(BTreeSet<String>);

impl Names {
    /// The name itself, or with a number when it is taken; large and small letters count as equal,
    /// as they do in some file systems.
    pub(super) fn unique(&mut self, name: &str) -> String {
        let mut candidate = name.to_string();
        let mut number = 2;
        while !self.0.insert(candidate.to_lowercase()) {
            candidate = format!("{name}-{number}");
            number += 1;
        }
        candidate
    }
}

/// A name without what would leave its folder or be hidden in it: letters, digits, `-` and `_`.
pub(super) fn file_name(name: &str) -> String {
    let safe = |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '_' };
    let name: String = name.chars().take(LONGEST).map(safe).collect();
    if name.is_empty() { "unnamed".to_string() } else { name }
}

/// A name as an id: a dollar would start a parameter.
pub(super) fn id(name: &str) -> String {
    name.replace('$', "_").replace(char::is_control, " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn file_names_stay_in_their_folder() {
        assert_eq!(file_name("../../etc/passwd"), "______etc_passwd");
        assert_eq!(file_name("C:\\x"), "C__x");
        assert_eq!(file_name("…"), "_");
        assert_eq!(file_name(""), "unnamed");
        assert_eq!(file_name(&"a".repeat(1000)).len(), LONGEST);
    }

    #[test]
    fn taken_names_get_a_number() {
        let mut names = Names::default();
        assert_eq!(names.unique("a"), "a");
        assert_eq!(names.unique("A"), "A-2");
        assert_eq!(names.unique("a"), "a-3");
        assert_eq!(names.unique("a-2"), "a-2-2");
    }
}
