//! Ideal diffuse reflection.

use super::error::check_reflectance;
use super::{Bsdf, BsdfError, BsdfSample};
use crate::Rgb;
use crate::num::FRAC_1_PI;
use crate::warp;
use glam::Vec3;

/// Matte: `f_r = ρ / π`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lambert {
    reflectance: Rgb,
}

impl Lambert {
    /// A matte surface of the given reflectance, each channel in `[0, 1]`.
    ///
    /// # Errors
    /// When a channel is outside `[0, 1]` or NaN.
    pub fn new(reflectance: Rgb) -> Result<Self, BsdfError> {
        Ok(Self { reflectance: check_reflectance("the reflectance", reflectance)? })
    }

    /// Reflectance.
    #[must_use]
    pub const fn reflectance(&self) -> Rgb {
        self.reflectance
    }

    /// A matte surface that was checked before: for constants; see [`crate::Scene::baked`].
    #[must_use]
    pub const fn baked(reflectance: Rgb) -> Self {
        Self { reflectance }
    }
}

impl Bsdf for Lambert {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return Rgb::BLACK;
        }
        self.reflectance * FRAC_1_PI
    }

    /// Density `cos θ / π` (sr⁻¹).
    #[inline]
    fn sample(&self, wo: Vec3, u: [f32; 2], _u_lobe: f32) -> Option<BsdfSample> {
        let wi = warp::cosine_hemisphere(u);
        let pdf_solid_angle = self.pdf_solid_angle(wo, wi);
        (pdf_solid_angle > 0.0).then_some(BsdfSample { wi, pdf_solid_angle })
    }

    #[inline]
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        if wo.z <= 0.0 { 0.0 } else { warp::cosine_hemisphere_pdf(wi.z) }
    }

    fn albedo(&self) -> Rgb {
        self.reflectance
    }

    fn is_diffuse(&self) -> bool {
        true
    }

    fn check(&self) -> Result<(), BsdfError> {
        Self::new(self.reflectance).map(drop)
    }
}
