//! Why a BSDF was refused.

use crate::Rgb;
use core::fmt;

/// Why a BSDF was refused.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum BsdfError {
    /// A reflectance is outside `[0, 1]`, or not a number.
    Reflectance {
        /// Which one.
        field: &'static str,
        /// Its value.
        value: Rgb,
    },
    /// Two reflectances together reflect more than arrives.
    EnergyGain {
        /// Their sum.
        sum: Rgb,
    },
    /// A share is outside `[0, 1]`, or not a number.
    Share {
        /// Of what.
        field: &'static str,
        /// Its value.
        value: f32,
    },
    /// The exponent is negative or not finite.
    Exponent(f32),
    /// The roughness is outside what the model supports.
    Roughness(f32),
    /// The index of refraction inside over that outside is outside what the model supports.
    RelativeIndex(f32),
    /// The refractive index or the extinction coefficient of a metal is outside `[0, 10⁴]`.
    ConductorIndex {
        /// Which one.
        field: &'static str,
        /// Its value.
        value: Rgb,
    },
    /// A number that follows from others does not.
    Derived {
        /// Which one.
        field: &'static str,
    },
}

impl fmt::Display for BsdfError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Reflectance { field, value: Rgb { r, g, b } } => {
                write!(f, "{field} is ({r}, {g}, {b}); each channel must be between 0 and 1")
            }
            Self::EnergyGain { sum: Rgb { r, g, b } } => write!(
                f,
                "diffuse and specular reflectance together are ({r}, {g}, {b}); they must not exceed 1"
            ),
            Self::Share { field, value } => write!(f, "{field} is {value}; it must be between 0 and 1"),
            Self::Exponent(value) => write!(f, "the exponent is {value}; it must be 0 or more"),
            Self::Roughness(value) => {
                write!(f, "the roughness is {value}; it must be between 1e-4 and 1")
            }
            Self::RelativeIndex(value) => write!(
                f,
                "the index of refraction inside is {value} times that outside; it must be between 1 and 4 times"
            ),
            Self::Derived { field } => write!(f, "{field} does not follow from the other numbers"),
            Self::ConductorIndex { field, value: Rgb { r, g, b } } => {
                write!(f, "{field} is ({r}, {g}, {b}); each channel must be between 0 and 10000")
            }
        }
    }
}

impl core::error::Error for BsdfError {}

/// Checks that a reflectance is one.
pub(super) fn check_reflectance(field: &'static str, value: Rgb) -> Result<Rgb, BsdfError> {
    if value.is_valid() && value.max_component() <= 1.0 {
        Ok(value)
    } else {
        Err(BsdfError::Reflectance { field, value })
    }
}
