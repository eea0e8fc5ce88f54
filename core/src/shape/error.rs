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
    /// A polygon has too few or too many corners.
    CornerCount {
        /// How many.
        count: usize,
    },
    /// A polygon's corner is not in the plane of the others.
    NotPlanar {
        /// Which corner, counted from 0.
        corner: usize,
        /// How far it is off (m).
        off: f32,
    },
    /// A polygon has a corner on the outer side of one of its edges.
    NotConvex {
        /// At which corner the edge starts, counted from 0.
        corner: usize,
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
            Self::CornerCount { count } => {
                write!(f, "a polygon has 3 to 8 corners, not {count}; split a larger one")
            }
            Self::NotPlanar { corner, off } => {
                write!(
                    f,
                    "corner {corner} is {off} m off the plane of the polygon; use triangles for a bent one"
                )
            }
            Self::NotConvex { corner } => {
                write!(
                    f,
                    "the polygon is not convex at the edge from corner {corner}; split it, or reorder it"
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
