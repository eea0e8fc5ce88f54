//! The texels of a picture, in the form in which they take least room.

use super::srgb::srgb8_to_linear;
use crate::Rgb;

/// Texels, borrowed, row by row from `v = 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Texels<'a> {
    /// sRGB codes: colours for people, 3 bytes each.
    Srgb8(&'a [[u8; 3]]),
    /// Linear values, 0 to 1 in 255 steps, 3 bytes each.
    Linear8(&'a [[u8; 3]]),
    /// Linear values of any size, 12 bytes each.
    Float(&'a [Rgb]),
}

impl Texels<'_> {
    /// No texels.
    pub const NONE: Self = Self::Float(&[]);

    /// How many there are.
    #[inline]
    #[must_use]
    pub const fn len(&self) -> usize {
        match self {
            Self::Srgb8(codes) | Self::Linear8(codes) => codes.len(),
            Self::Float(values) => values.len(),
        }
    }

    /// True when there are none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The linear value of one of them; black beyond the last.
    #[inline]
    #[must_use]
    pub fn get(&self, index: usize) -> Rgb {
        match self {
            Self::Srgb8(codes) => codes.get(index).map(|c| Rgb::from(c.map(srgb8_to_linear))),
            Self::Linear8(codes) => codes.get(index).map(|c| Rgb::from(c.map(|c| f32::from(c) / 255.0))),
            Self::Float(values) => values.get(index).copied(),
        }
        .unwrap_or(Rgb::BLACK)
    }
}
