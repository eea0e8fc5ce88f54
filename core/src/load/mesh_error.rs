//! Why a mesh was refused.

use core::fmt;
use std::string::String;

/// Why a mesh file was refused.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum MeshError {
    /// The file breaks the rules of its format, or ends too early.
    Malformed {
        /// Line, where the format has lines.
        line: Option<usize>,
        /// What is wrong.
        what: String,
    },
    /// The header promises more than the file can hold.
    Count {
        /// Of what.
        element: String,
        /// How many it promises.
        count: u64,
        /// Size of the file (bytes).
        bytes: u64,
    },
    /// Something that a mesh needs is not there.
    Missing {
        /// What.
        what: &'static str,
    },
    /// A face refers to a vertex that does not exist.
    Index {
        /// The face, from 0.
        face: usize,
        /// The index.
        index: i64,
        /// Number of vertices.
        vertices: usize,
    },
    /// A face with fewer than three corners.
    Corners {
        /// The face, from 0.
        face: usize,
        /// Number of its corners.
        corners: usize,
    },
    /// A coordinate, of a place or of textures, is NaN or infinite, or becomes so by the transform.
    NotFinite {
        /// The vertex, from 0.
        vertex: usize,
    },
    /// No triangle has an area.
    Empty,
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Malformed { line: Some(line), what } => write!(f, "line {line}: {what}"),
            Self::Malformed { what, .. } => f.write_str(what),
            Self::Count { element, count, bytes } => {
                write!(f, "the header promises {count} × {element}, but the file has only {bytes} bytes")
            }
            Self::Missing { what } => write!(f, "{what} missing"),
            Self::Index { face, index, vertices } => {
                write!(f, "face {face} refers to vertex {index}, but there are {vertices} vertices")
            }
            Self::Corners { face, corners } => {
                write!(f, "face {face} has {corners} corners; it must have at least 3")
            }
            Self::NotFinite { vertex } => {
                write!(f, "vertex {vertex} is not finite, in the file or after the transform")
            }
            Self::Empty => write!(f, "no triangle has an area"),
        }
    }
}

impl core::error::Error for MeshError {}
