//! Textures: values that vary over a surface, looked up by texture coordinates.
//!
//! They mean what they mean in Mitsuba 3: a picture's first row is at `v = 0`, its first column at
//! `u = 0`. Lookups are total: any coordinates, NaN and infinity included, give a value between the
//! smallest and the largest texel.
//!
//! [`Pattern`] says what is done with the coordinates and is small; [`Texels`] are borrowed.
//! [`Texture`] is the two together, checked once.

mod error;
mod object_space;
mod pattern;
mod srgb;
mod texels;
mod transform;

pub use error::TextureError;
pub use object_space::{ObjectSpace, SurfaceUvs};
pub use pattern::{Interpolation, Kind, Pattern, Wrap};
pub use texels::Texels;
pub use transform::UvTransform;

use crate::Rgb;
use glam::Vec2;

/// A texture with its texels, borrowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Texture<'a> {
    pattern: Pattern,
    texels: Texels<'a>,
}

impl<'a> Texture<'a> {
    /// A pattern with its texels; [`Texels::NONE`] when it is no picture.
    ///
    /// # Errors
    /// When the number of texels is not that of the pattern, or a channel is negative or not finite.
    pub fn new(pattern: Pattern, texels: Texels<'a>) -> Result<Self, TextureError> {
        let texture = Self { pattern, texels };
        if let Kind::Picture { width, height, .. } = pattern.kind() {
            let (count, texels) = (width as usize * height as usize, texels.len());
            if count == 0 || count != texels {
                return Err(TextureError::Count { width, height, texels });
            }
        }
        match texture.values().enumerate().find(|(_, value)| !value.is_valid()) {
            Some((index, value)) => Err(TextureError::Value { place: pattern.place(index), value }),
            None => Ok(texture),
        }
    }

    /// A picture that is repeated, with bilinear interpolation.
    ///
    /// * `texels` – `width × height` of them, row by row from `v = 0`
    ///
    /// # Errors
    /// As [`Texture::new`].
    pub fn picture(texels: Texels<'a>, width: u32, height: u32) -> Result<Self, TextureError> {
        Self::new(Pattern::picture(width, height), texels)
    }

    /// What is done with the coordinates.
    #[must_use]
    pub const fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// The value at the texture coordinates `uv`.
    #[inline]
    #[must_use]
    pub fn at(&self, uv: Vec2) -> Rgb {
        self.pattern.at(self.texels, uv)
    }

    /// The largest value of each channel.
    #[must_use]
    pub fn largest(&self) -> Rgb {
        self.values().fold(Rgb::BLACK, |a, b| Rgb::new(a.r.max(b.r), a.g.max(b.g), a.b.max(b.b)))
    }

    /// The smallest value of each channel.
    #[must_use]
    pub fn smallest(&self) -> Rgb {
        let all = Rgb::splat(f32::INFINITY);
        self.values().fold(all, |a, b| Rgb::new(a.r.min(b.r), a.g.min(b.g), a.b.min(b.b)))
    }

    /// Mean of the values, in double precision: over the whole plane of coordinates, when the texture
    /// is repeated.
    #[must_use]
    pub fn mean(&self) -> Rgb {
        let (mut sum, mut count) = ([0.0_f64; 3], 0.0_f64);
        for value in self.values() {
            sum = [sum[0] + f64::from(value.r), sum[1] + f64::from(value.g), sum[2] + f64::from(value.b)];
            count += 1.0;
        }
        Rgb::from(sum.map(|s| (s / count) as f32))
    }

    /// Everything that lookups are made of.
    fn values(&self) -> impl Iterator<Item = Rgb> + use<'a> {
        let (texels, own) = (self.texels, self.pattern.colours());
        let colours = own.into_iter().flatten();
        (0..texels.len()).map(move |i| texels.get(i)).chain(colours)
    }
}

#[cfg(test)]
mod tests;
