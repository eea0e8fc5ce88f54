//! What a surface emits, place by place.

use super::{LightError, SampledShape};
use crate::Rgb;
use crate::shape::Shape;
use crate::texture::{Pattern, SurfaceUvs, Texels, Texture};
use glam::Vec3;

/// Gives each place of a surface the radiance that it sends in all directions of its side.
pub trait SurfaceRadiance: Copy {
    /// Radiance at a point of the surface (W m⁻² sr⁻¹).
    fn at(&self, shape: &impl Shape, point: Vec3) -> Rgb;

    /// Mean over the surface, roughly; positive for what emits (W m⁻² sr⁻¹).
    fn mean(&self) -> Rgb;

    /// The radiance, when it is the same everywhere (W m⁻² sr⁻¹).
    fn uniform(&self) -> Option<Rgb> {
        None
    }
}

impl SurfaceRadiance for Rgb {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn at(&self, _: &impl Shape, _: Vec3) -> Rgb {
        *self
    }

    #[inline]
    fn mean(&self) -> Rgb {
        *self
    }

    #[inline]
    fn uniform(&self) -> Option<Rgb> {
        Some(*self)
    }
}

/// Places at which a texture is looked up along each side of a square of uniforms, for its mean over
/// a surface.
const LOOKS: u32 = 8;

/// The least share of the whole texture's mean that a surface's mean is taken for: looks may miss what
/// is bright.
const LEAST_SHARE: f32 = 1e-2;

/// How a texture is painted on a surface that emits: everything but the texels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Paint {
    pattern: Pattern,
    uvs: SurfaceUvs,
    factor: Rgb,
    mean: Rgb,
}

impl Paint {
    /// A texture on a shape.
    ///
    /// * `uvs` – where the shape's texture coordinates come from
    /// * `factor` – what the texture is multiplied with (W m⁻² sr⁻¹)
    ///
    /// # Errors
    /// When the factor is negative or not finite, or makes the texture so.
    pub fn new(
        shape: &impl SampledShape,
        texture: &Texture<'_>,
        uvs: SurfaceUvs,
        factor: Rgb,
    ) -> Result<Self, LightError> {
        Self::surveyed(shape, texture, uvs, factor, [texture.largest(), texture.mean()])
    }

    /// The same as [`Paint::new`] without looking at all texels, for many shapes with one texture.
    ///
    /// * `survey` – the texture's [`Texture::largest`] and [`Texture::mean`]
    ///
    /// # Errors
    /// As [`Paint::new`].
    pub fn surveyed(
        shape: &impl SampledShape,
        texture: &Texture<'_>,
        uvs: SurfaceUvs,
        factor: Rgb,
        survey: [Rgb; 2],
    ) -> Result<Self, LightError> {
        let [largest, mean] = survey;
        super::error::check_emission("the radiance", factor)?;
        super::error::check_emission("the radiance", largest * factor)?;
        let step = 1.0 / LOOKS as f32;
        let mut sum = Rgb::BLACK;
        for i in 0..LOOKS * LOOKS {
            let u = [((i / LOOKS) as f32 + 0.5) * step, ((i % LOOKS) as f32 + 0.5) * step];
            sum += texture.at(uvs.at(shape, shape.sample_area(u).point)) * (step * step);
        }
        let whole = mean * LEAST_SHARE;
        let mean = Rgb::new(sum.r.max(whole.r), sum.g.max(whole.g), sum.b.max(whole.b)) * factor;
        Ok(Self { pattern: *texture.pattern(), uvs, factor, mean })
    }

    /// The same with a mean radiance that is known better (W m⁻² sr⁻¹).
    #[must_use]
    pub const fn with_mean(self, mean: Rgb) -> Self {
        Self { mean, ..self }
    }

    /// The texture without its texels.
    #[must_use]
    pub const fn pattern(&self) -> &Pattern {
        &self.pattern
    }
}

/// The radiance of a texture, borrowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Painted<'a> {
    paint: &'a Paint,
    texels: Texels<'a>,
}

impl<'a> Painted<'a> {
    /// A paint with the texels of the texture that it was made from.
    #[must_use]
    pub const fn new(paint: &'a Paint, texels: Texels<'a>) -> Self {
        Self { paint, texels }
    }

    /// Texture coordinates of a point of the surface, after the pattern's transform.
    pub(super) fn place(&self, shape: &impl Shape, point: Vec3) -> glam::Vec2 {
        self.paint.pattern.transform().apply(self.paint.uvs.at(shape, point))
    }

    /// The paint.
    pub(super) const fn paint(&self) -> &'a Paint {
        self.paint
    }
}

impl SurfaceRadiance for Painted<'_> {
    #[inline]
    fn at(&self, shape: &impl Shape, point: Vec3) -> Rgb {
        let uv = self.paint.uvs.at(shape, point);
        self.paint.pattern.at(self.texels, uv) * self.paint.factor
    }

    fn mean(&self) -> Rgb {
        self.paint.mean
    }
}
