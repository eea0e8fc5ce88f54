//! What a surface is made of, place by place.
//!
//! A [`Material`] gives the BSDF of a place of a surface. A BSDF is the material of a surface that is
//! the same everywhere, so that a scene without textures links none. [`Textured`] takes parameters of
//! a BSDF from textures; [`AnyMaterial`] is either.

mod parameters;
mod textured;

pub use parameters::{Parameters, Parametric};
pub use textured::{ParameterTextures, Textured};

use crate::bsdf::{AnyBsdf, Bsdf, BsdfError, TwoSided};
use glam::Vec2;

/// Gives each place of a surface its BSDF.
pub trait Material: Copy {
    /// The model of reflection: of a material that is the same everywhere, where it is kept.
    type Bsdf<'m>: Bsdf
    where
        Self: 'm;

    /// The BSDF at a place.
    ///
    /// * `uv` – computes the place's texture coordinates; called only where they matter
    fn at(&self, uv: impl FnOnce() -> Vec2) -> Self::Bsdf<'_>;

    /// True when the BSDF may differ from place to place.
    fn is_textured(&self) -> bool {
        true
    }

    /// Checks the BSDFs that it gives, where textures do not change them.
    ///
    /// # Errors
    /// As [`Bsdf::check`].
    fn check_bsdfs(&self) -> Result<(), BsdfError>;
}

impl<B: Bsdf> Material for B {
    type Bsdf<'m>
        = &'m B
    where
        B: 'm;

    #[inline]
    fn at(&self, _uv: impl FnOnce() -> Vec2) -> &B {
        self
    }

    fn is_textured(&self) -> bool {
        false
    }

    fn check_bsdfs(&self) -> Result<(), BsdfError> {
        self.check()
    }
}

/// A material with one model on both sides, or different ones.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a scene has few materials, and no heap to put them on")]
pub enum Faces<'a> {
    /// The model of the front, which alone reflects.
    Front(Textured<'a, AnyBsdf>),
    /// One model for both sides.
    Both(Textured<'a, AnyBsdf>),
    /// The models of the front and of the back.
    Each([Textured<'a, AnyBsdf>; 2]),
}

/// Any of the materials: what a frontend that reads arbitrary scenes uses.
#[derive(Debug, Clone, Copy, PartialEq)]
#[expect(clippy::large_enum_variant, reason = "a scene has few materials, and no heap to put them on")]
pub enum AnyMaterial<'a> {
    /// The same everywhere.
    Plain(TwoSided<AnyBsdf>),
    /// With textures.
    Textured(Faces<'a>),
}

impl AnyMaterial<'_> {
    /// The models where no texture says otherwise.
    #[must_use]
    pub fn base(&self) -> TwoSided<AnyBsdf> {
        match self {
            Self::Plain(bsdf) => *bsdf,
            Self::Textured(Faces::Front(front)) => TwoSided::front_only(*front.base()),
            Self::Textured(Faces::Both(both)) => TwoSided::both(*both.base()),
            Self::Textured(Faces::Each([front, back])) => {
                TwoSided { front: *front.base(), back: Some(*back.base()) }
            }
        }
    }
}

impl Material for AnyMaterial<'_> {
    type Bsdf<'m>
        = TwoSided<AnyBsdf>
    where
        Self: 'm;

    #[inline]
    fn at(&self, uv: impl FnOnce() -> Vec2) -> TwoSided<AnyBsdf> {
        match self {
            Self::Plain(bsdf) => *bsdf,
            Self::Textured(faces) => faces.at(uv()),
        }
    }

    fn is_textured(&self) -> bool {
        matches!(self, Self::Textured(_))
    }

    fn check_bsdfs(&self) -> Result<(), BsdfError> {
        self.base().check()
    }
}

impl Faces<'_> {
    /// Out of line: a scene without textures stays small.
    #[inline(never)]
    fn at(&self, uv: Vec2) -> TwoSided<AnyBsdf> {
        match self {
            Self::Front(front) => TwoSided::front_only(front.at(|| uv)),
            Self::Both(both) => TwoSided::both(both.at(|| uv)),
            Self::Each([front, back]) => TwoSided { front: front.at(|| uv), back: Some(back.at(|| uv)) },
        }
    }
}
