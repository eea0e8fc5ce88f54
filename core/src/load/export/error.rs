//! Why a scene was not written.

use core::fmt;
use std::io;
use std::path::PathBuf;
use std::string::String;

/// Why a scene was not written.
#[derive(Debug)]
#[non_exhaustive]
pub enum ExportError {
    /// A file cannot be written.
    Unwritable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The path does not name a file.
    Path {
        /// The path.
        path: PathBuf,
    },
    /// An object refers to a material that does not exist.
    Material {
        /// Index of the object.
        object: usize,
    },
    /// The scene is none that can be rendered.
    Scene {
        /// What is wrong with it.
        message: String,
    },
    /// Something that is written neither as Rust source nor as bytes.
    NotBaked {
        /// What it is.
        what: &'static str,
        /// What to do instead.
        instead: &'static str,
    },
    /// A light in the list of lights has a surface; only objects may.
    SurfaceLight {
        /// Its kind.
        kind: &'static str,
    },
}

impl fmt::Display for ExportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unwritable { path, source } => write!(f, "{}: {source}", path.display()),
            Self::Path { path } => write!(f, "{}: not the name of a file", path.display()),
            Self::Material { object } => {
                write!(f, "object {object} refers to a material that does not exist")
            }
            Self::Scene { message } => write!(f, "{message}"),
            Self::NotBaked { what, instead } => {
                write!(f, "{what} is written neither as Rust nor as bytes; {instead}")
            }
            Self::SurfaceLight { kind } => {
                write!(f, "a {kind} is among the lights without a surface; make it an object that emits")
            }
        }
    }
}

impl core::error::Error for ExportError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Unwritable { source, .. } => Some(source),
            _ => None,
        }
    }
}
