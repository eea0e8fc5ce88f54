//! What a surface is made of, place by place.
//!
//! A [`Material`] gives the BSDF of a place of a surface. A BSDF is the material of a surface that is
//! the same everywhere, so that a scene without textures links none.

use crate::bsdf::Bsdf;
use glam::Vec2;

/// Gives each place of a surface its BSDF.
pub trait Material: Copy {
    /// The model of reflection.
    type Bsdf: Bsdf;

    /// The BSDF at a place.
    ///
    /// * `uv` – computes the place's texture coordinates; called only where they matter
    fn at(&self, uv: impl FnOnce() -> Vec2) -> Self::Bsdf;
}

impl<B: Bsdf> Material for B {
    type Bsdf = B;

    #[inline]
    fn at(&self, _uv: impl FnOnce() -> Vec2) -> B {
        *self
    }
}
