//! Why a shape was refused.

use core::fmt;

/// Why a shape was refused. Intersection and sampling cannot fail: what a constructor accepts works.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum ShapeError {
    /// A coordinate is NaN or infinite.
    NotFinite {
        /// Which argument.
        field: &'static str,
    },
    /// The shape has no extent, or one that `f32` cannot hold.
    Degenerate {
        /// What was measured.
        what: &'static str,
        /// Its value.
        value: f32,
    },
    /// Two axes that must be at right angles are not.
    NotOrthogonal {
        /// Cosine of the angle between them.
        cosine: f32,
    },
}

impl fmt::Display for ShapeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { field } => write!(f, "{field} is not a finite number"),
            Self::Degenerate { what, value } => {
                write!(
                    f,
                    "the shape is degenerate: its {what} is {value}; give it an extent that f32 can hold"
                )
            }
            Self::NotOrthogonal { cosine } => {
                write!(
                    f,
                    "the axes are not at right angles (cosine {cosine}); use two triangles for a sheared shape"
                )
            }
        }
    }
}

impl core::error::Error for ShapeError {}
