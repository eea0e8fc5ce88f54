//! How a command ends, and what is said when it cannot do its work.

use crate::terminal;
use std::fmt::Display;
use std::process::ExitCode;

/// How a command that did its work ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Exit {
    /// All is well.
    Good,
    /// A check has failed.
    CheckFailed,
    /// The user has interrupted it.
    Interrupted,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Good => 0,
            Exit::CheckFailed => 1,
            Exit::Interrupted => INTERRUPTED,
        })
    }
}

/// Exit code after misuse or bad input.
const MISUSE: u8 = 2;

/// Exit code after an interrupt: 128 + SIGINT, as shells have it.
pub(crate) const INTERRUPTED: u8 = 130;

/// Why a command could not do its work: one message, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Failure {
    message: String,
    tip: Option<String>,
}

impl Failure {
    /// A failure with nothing to add.
    pub(crate) fn new(message: impl Display) -> Self {
        Self { message: message.to_string(), tip: None }
    }

    /// Adds what to do about it.
    pub(crate) fn tip(self, tip: impl Display) -> Self {
        Self { tip: Some(tip.to_string()), ..self }
    }

    /// Says what it is about, for example which file.
    pub(crate) fn about(self, what: &str) -> Self {
        Self { message: format!("{what}: {}", self.message), ..self }
    }

    /// Prints it as a warning: the work goes on.
    pub(crate) fn warn(&self) {
        terminal::warning(&self.message);
    }

    /// Prints it on stderr.
    pub(crate) fn report(&self) -> ExitCode {
        terminal::error(&self.message, self.tip.as_deref());
        ExitCode::from(MISUSE)
    }
}

/// Describes an I/O error without the number that Rust appends to the system's words.
pub(crate) fn io_reason(error: &std::io::Error) -> String {
    let text = without_numbers(&error.to_string());
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
}

/// Takes ` (os error 2)` and the like out of a message.
pub(crate) fn without_numbers(message: &str) -> String {
    let Some((before, rest)) = message.split_once(" (os error ") else { return message.to_owned() };
    match rest.split_once(')') {
        Some((number, after)) if number.bytes().all(|b| b.is_ascii_digit()) => format!("{before}{after}"),
        _ => message.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io;

    #[test]
    fn the_number_of_an_io_error_is_left_out() {
        let error = io::Error::from_raw_os_error(2);
        assert!(!io_reason(&error).contains("os error"));
        assert_eq!(io_reason(&io::Error::other("Broken")), "broken");
        assert_eq!(without_numbers("a: gone (os error 2); b"), "a: gone; b");
        assert_eq!(without_numbers("a (os error x)"), "a (os error x)");
    }
}
