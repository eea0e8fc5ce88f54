//! Why a texture was refused.

use crate::Rgb;
use core::fmt;

/// Why a texture was refused. Lookups cannot fail: what a constructor accepts works everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum TextureError {
    /// There is another number of texels than the size says.
    Count {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// How many there are.
        texels: usize,
    },
    /// A channel is negative, NaN or infinite.
    Value {
        /// Column and row of the texel; `None` for a colour of a pattern.
        place: Option<[u32; 2]>,
        /// The value.
        value: Rgb,
    },
    /// The values reflect more than arrives.
    TooBright {
        /// Which parameter.
        parameter: &'static str,
        /// The largest value of each channel.
        largest: Rgb,
    },
    /// The BSDF has no such parameter.
    NoParameter {
        /// Which parameter.
        parameter: &'static str,
    },
    /// A coefficient of the transform of coordinates is not finite.
    Transform,
}

impl fmt::Display for TextureError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count { width, height, texels } => {
                write!(f, "{texels} texels are not a picture of {width}×{height}")
            }
            Self::Value { place, value: Rgb { r, g, b } } => {
                match place {
                    Some([x, y]) => write!(f, "the texel in column {x}, row {y}")?,
                    None => write!(f, "a colour of the texture")?,
                }
                write!(f, " is ({r}, {g}, {b}); channels must be finite and 0 or more")
            }
            Self::TooBright { parameter, largest: Rgb { r, g, b } } => {
                write!(f, "{parameter} goes up to ({r}, {g}, {b}); it must not exceed 1")
            }
            Self::NoParameter { parameter } => {
                write!(f, "the material has no {parameter} that a texture could give")
            }
            Self::Transform => write!(f, "the transform of texture coordinates must have finite numbers"),
        }
    }
}

impl core::error::Error for TextureError {}
