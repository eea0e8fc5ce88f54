//! What is printed: results on stdout, everything else on stderr.

use crate::failure::{Failure, io_reason};
use clap::builder::styling::{AnsiColor, Style};
use serde_json::Value;
use std::fmt::Display;
use std::io::{self, ErrorKind, Write};

/// Style of the word that opens an error.
const ERROR: Style = AnsiColor::Red.on_default().bold();
/// Style of the word that opens a warning.
const WARNING: Style = AnsiColor::Yellow.on_default().bold();
/// Style of the word that opens a tip.
const TIP: Style = AnsiColor::Green.on_default();

/// Prints a result. A reader that has gone away has had enough: that is success.
///
/// # Errors
/// When stdout cannot be written for another reason, for example a full disk.
pub(crate) fn result(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match writeln!(stdout, "{}", text.trim_end_matches('\n')).and_then(|()| stdout.flush()) {
        Err(e) if e.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::new(format!("cannot write to standard output: {}", io_reason(&e))))
        }
        _ => Ok(()),
    }
}

/// Prints a result as JSON.
///
/// # Errors
/// As [`result`].
pub(crate) fn json(value: &Value) -> Result<(), Failure> {
    result(&format!("{value:#}"))
}

/// Prints an error and what to do about it.
pub(crate) fn error(message: &str, tip: Option<&str>) {
    note(ERROR, "error", message);
    if let Some(tip) = tip {
        note(TIP, "  tip", tip);
    }
}

/// Prints a warning.
pub(crate) fn warning(message: &str) {
    note(WARNING, "warning", message);
}

/// Prints a remark that is neither.
pub(crate) fn remark(message: impl Display) {
    let _ = writeln!(anstream::stderr(), "{message}");
}

/// `word: message` on stderr, in colour where the terminal and NO_COLOR allow it. That stderr cannot
/// be written is no reason to stop.
fn note(style: Style, word: &str, message: &str) {
    let _ = writeln!(anstream::stderr(), "{style}{word}:{style:#} {message}");
}
