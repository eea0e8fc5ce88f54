//! The modified Phong model.

use super::error::check_reflectance;
use super::{Bsdf, BsdfError, BsdfSample};
use crate::Rgb;
use crate::geom::Frame;
use crate::num::{FRAC_1_PI, PI};
use crate::warp;
use glam::Vec3;

/// Matte with a highlight: `f_r = k_d / π + k_s (n + 2)/(2π) cosⁿ α`, α the angle to the mirror
/// direction. Reciprocal, and reflects at most what arrives while `k_d + k_s ≤ 1`.
///
/// Source: Lafortune and Willems 1994, *Using the Modified Phong Reflectance Model for Physically
/// Based Rendering*, equations 3 and 5. The same as `phong` of Mitsuba 0.6.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phong {
    diffuse: Rgb,
    specular: Rgb,
    exponent: f32,
    /// Probability of sampling the highlight.
    specular_pmf: f32,
}

impl Phong {
    /// From diffuse and specular reflectance and the exponent `n ≥ 0`.
    ///
    /// # Errors
    /// When a reflectance is outside `[0, 1]`, their sum exceeds 1, or the exponent is negative, NaN
    /// or infinite.
    pub fn new(diffuse: Rgb, specular: Rgb, exponent: f32) -> Result<Self, BsdfError> {
        let diffuse = check_reflectance("the diffuse reflectance", diffuse)?;
        let specular = check_reflectance("the specular reflectance", specular)?;
        let sum = diffuse + specular;
        if sum.max_component() > 1.0 + 4.0 * f32::EPSILON {
            return Err(BsdfError::EnergyGain { sum });
        }
        if !(0.0..f32::INFINITY).contains(&exponent) {
            return Err(BsdfError::Exponent(exponent));
        }
        let total = sum.average();
        let specular_pmf = if total > 0.0 { specular.average() / total } else { 0.0 };
        Ok(Self { diffuse, specular, exponent, specular_pmf })
    }

    /// Diffuse reflectance.
    #[must_use]
    pub const fn diffuse(&self) -> Rgb {
        self.diffuse
    }

    /// Specular reflectance.
    #[must_use]
    pub const fn specular(&self) -> Rgb {
        self.specular
    }

    /// Exponent of the highlight.
    #[must_use]
    pub const fn exponent(&self) -> f32 {
        self.exponent
    }

    /// `1 − cos α`, α the angle to the mirror direction, from the chord between the two.
    #[inline]
    fn one_minus_cos_alpha(wo: Vec3, wi: Vec3) -> f32 {
        0.5 * wi.distance_squared(Vec3::new(-wo.x, -wo.y, wo.z))
    }

    /// What was checked before: for constants; see [`crate::Scene::baked`].
    ///
    /// * `specular_pmf` – as [`Phong::specular_pmf`] said
    #[must_use]
    pub const fn baked(diffuse: Rgb, specular: Rgb, exponent: f32, specular_pmf: f32) -> Self {
        Self { diffuse, specular, exponent, specular_pmf }
    }

    /// Probability of sampling the highlight.
    #[must_use]
    pub const fn specular_pmf(&self) -> f32 {
        self.specular_pmf
    }
}

impl Bsdf for Phong {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return Rgb::BLACK;
        }
        let power = warp::power_of_cosine(Self::one_minus_cos_alpha(wo, wi), self.exponent);
        let lobe = (self.exponent + 2.0) * (0.5 * FRAC_1_PI) * power;
        self.diffuse * FRAC_1_PI + self.specular * lobe
    }

    /// Density: the mixture of `cos θ / π` and the lobe `(n + 1)/(2π) cosⁿ α`, in proportion to the
    /// two reflectances.
    #[inline]
    fn sample(&self, wo: Vec3, u: [f32; 2], u_lobe: f32) -> Option<BsdfSample> {
        let wi = if u_lobe < self.specular_pmf {
            let mirror = Vec3::new(-wo.x, -wo.y, wo.z);
            Frame::from_normal(mirror).to_world(warp::power_cosine(u, self.exponent))
        } else {
            warp::cosine_hemisphere(u)
        };
        let pdf_solid_angle = self.pdf_solid_angle(wo, wi);
        (pdf_solid_angle > 0.0 && pdf_solid_angle.is_finite()).then_some(BsdfSample { wi, pdf_solid_angle })
    }

    #[inline]
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        if wo.z <= 0.0 || wi.z <= 0.0 {
            return 0.0;
        }
        let lobe = warp::power_cosine_pdf(Self::one_minus_cos_alpha(wo, wi), self.exponent);
        self.specular_pmf * lobe + (1.0 - self.specular_pmf) * warp::cosine_hemisphere_pdf(wi.z)
    }

    /// That over which `cosⁿ α`, put together, is 1: `2π / (n + 1)`.
    #[inline]
    fn lobe_solid_angle(&self) -> f32 {
        2.0 * PI / (self.exponent + 1.0)
    }

    fn albedo(&self) -> Rgb {
        self.diffuse + self.specular
    }

    fn check(&self) -> Result<(), BsdfError> {
        let made = Self::new(self.diffuse, self.specular, self.exponent)?;
        if made == *self { Ok(()) } else { Err(BsdfError::Derived { field: "specular_pmf" }) }
    }
}
