//! A surface with a model on its front and perhaps another on its back.

use super::{Bsdf, BsdfError, BsdfSample};
use crate::Rgb;
use glam::Vec3;

/// Gives a surface a model on each side. Without one on the back, the back reflects nothing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TwoSided<B> {
    /// The side that the normal points to.
    pub front: B,
    /// The other side.
    pub back: Option<B>,
}

impl<B: Bsdf> TwoSided<B> {
    /// The model on the front only.
    #[must_use]
    pub const fn front_only(front: B) -> Self {
        Self { front, back: None }
    }

    /// The same model on both sides.
    #[must_use]
    pub const fn both(side: B) -> Self {
        Self { front: side, back: Some(side) }
    }

    /// The model of the side that `wo` is on, and the sign that turns local directions to it.
    #[inline]
    fn side(&self, wo: Vec3) -> Option<(&B, f32)> {
        if wo.z > 0.0 { Some((&self.front, 1.0)) } else { self.back.as_ref().map(|b| (b, -1.0)) }
    }
}

/// Mirrors in the surface when `sign` is −1.
#[inline]
fn turned(w: Vec3, sign: f32) -> Vec3 {
    Vec3::new(w.x, w.y, w.z * sign)
}

impl<B: Bsdf> Bsdf for TwoSided<B> {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        self.side(wo).map_or(Rgb::BLACK, |(b, s)| b.eval(turned(wo, s), turned(wi, s)))
    }

    #[inline]
    fn sample(&self, wo: Vec3, u: [f32; 2], u_lobe: f32) -> Option<BsdfSample> {
        let (b, s) = self.side(wo)?;
        let sample = b.sample(turned(wo, s), u, u_lobe)?;
        Some(BsdfSample { wi: turned(sample.wi, s), ..sample })
    }

    #[inline]
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.side(wo).map_or(0.0, |(b, s)| b.pdf_solid_angle(turned(wo, s), turned(wi, s)))
    }

    fn albedo(&self) -> Rgb {
        self.front.albedo()
    }

    fn is_diffuse(&self) -> bool {
        self.front.is_diffuse() && self.back.as_ref().is_none_or(Bsdf::is_diffuse)
    }

    #[inline]
    fn lobe_solid_angle(&self) -> f32 {
        let front = self.front.lobe_solid_angle();
        self.back.as_ref().map_or(front, |back| front.min(back.lobe_solid_angle()))
    }

    #[inline]
    fn needs_tangent(&self) -> bool {
        self.front.needs_tangent() || self.back.as_ref().is_some_and(Bsdf::needs_tangent)
    }

    fn is_black(&self) -> bool {
        self.front.is_black() && self.back.as_ref().is_none_or(Bsdf::is_black)
    }

    fn check(&self) -> Result<(), BsdfError> {
        self.front.check()?;
        self.back.as_ref().map_or(Ok(()), Bsdf::check)
    }
}
