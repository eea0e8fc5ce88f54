//! Why a light was refused.

use crate::Rgb;
use crate::shape::ShapeError;
use core::fmt;
use glam::Vec3;

/// Why a light was refused.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum LightError {
    /// A number is NaN or infinite.
    NotFinite {
        /// Which argument.
        field: &'static str,
    },
    /// A channel of the emission is below 0.
    NegativeEmission {
        /// The emission.
        emission: Rgb,
    },
    /// A map has another number of texels than its size says.
    TexelCount {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// How many there are.
        texels: usize,
    },
    /// A texel of a map is negative, NaN or infinite.
    Texel {
        /// Its column.
        x: u32,
        /// Its row.
        y: u32,
        /// What it says.
        radiance: Rgb,
    },
    /// A map's transform does more than to turn and to mirror.
    NotARotation,
    /// A map's table of densities was made for another map.
    Table {
        /// Columns of the map.
        width: u32,
        /// Rows of the map.
        height: u32,
    },
    /// The angular radius of a distant disk is not from 0 to 45°.
    AngularRadius {
        /// The radius (rad).
        radius: f32,
    },
    /// A direction has no length, or is not a unit vector where it must be.
    NoDirection,
    /// The surface of a light would be refused.
    Shape(ShapeError),
    /// The angles of a spot are not `0 ≤ beam ≤ cutoff ≤ π`, `cutoff > 0`.
    Angles {
        /// Half-angle of full intensity (rad).
        beam: f32,
        /// Half-angle beyond which nothing is sent (rad).
        cutoff: f32,
    },
}

impl fmt::Display for LightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotFinite { field } => write!(f, "{field} is not a finite number"),
            Self::NegativeEmission { emission: Rgb { r, g, b } } => {
                write!(f, "the emission ({r}, {g}, {b}) is negative; channels must be 0 or more")
            }
            Self::TexelCount { width, height, texels } => {
                write!(f, "{texels} texels are not a picture of {width}×{height}")
            }
            Self::Texel { x, y, radiance: Rgb { r, g, b } } => write!(
                f,
                "the texel in column {x}, row {y} is ({r}, {g}, {b}); channels must be finite and 0 or more"
            ),
            Self::NotARotation => {
                write!(f, "the environment can be turned and mirrored, but not scaled or sheared")
            }
            Self::Table { width, height } => {
                write!(f, "the table of densities was not made for a map of {width}×{height}")
            }
            Self::AngularRadius { radius } => write!(
                f,
                "the angular radius must be above 0 and at most 45 degrees; it is {}",
                radius.to_degrees()
            ),
            Self::NoDirection => write!(f, "the direction has no length"),
            Self::Shape(source) => write!(f, "{source}"),
            Self::Angles { beam, cutoff } => write!(
                f,
                "the spot's angles must satisfy 0 ≤ beam ≤ cutoff ≤ 180°, cutoff > 0; they are {} and {}",
                beam.to_degrees(),
                cutoff.to_degrees()
            ),
        }
    }
}

impl core::error::Error for LightError {}

/// Checks that a direction has length 1, to rounding.
pub(super) fn check_unit(direction: Vec3) -> Result<(), LightError> {
    let off = (direction.length_squared() - 1.0).abs();
    if off < 1e-5 { Ok(()) } else { Err(LightError::NoDirection) }
}

/// Checks what every light has: an emission.
pub(super) fn check_emission(field: &'static str, emission: Rgb) -> Result<Rgb, LightError> {
    if !emission.is_finite() {
        return Err(LightError::NotFinite { field });
    }
    if !emission.is_valid() {
        return Err(LightError::NegativeEmission { emission });
    }
    Ok(emission)
}
