//! The modified Phong model.

use super::error::check_reflectance;
use super::{Bsdf, BsdfError, BsdfSample, matte_base};
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

    /// Density of the lobe (sr⁻¹); `None` where nothing is reflected.
    #[inline]
    fn lobe_pdf(&self, wo: Vec3, wi: Vec3) -> Option<f32> {
        let is_above = !(wo.z <= 0.0 || wi.z <= 0.0);
        is_above.then(|| warp::power_cosine_pdf(Self::one_minus_cos_alpha(wo, wi), self.exponent))
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
        let mirror = Vec3::new(-wo.x, -wo.y, wo.z);
        let lobe = || Some(Frame::from_normal(mirror).to_world(warp::power_cosine(u, self.exponent)));
        matte_base::sample(self.specular_pmf, u, u_lobe, lobe, |wi| self.lobe_pdf(wo, wi))
    }

    #[inline]
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.lobe_pdf(wo, wi).map_or(0.0, |lobe| matte_base::pdf(self.specular_pmf, lobe, wi))
    }

    #[inline]
    fn lobe_solid_angle(&self) -> f32 {
        2.0 * PI / (self.exponent + 1.0)
    }

    fn albedo(&self) -> Rgb {
        self.diffuse + self.specular
    }

    fn check(&self) -> Result<(), BsdfError> {
        let made = Self::new(self.diffuse, self.specular, self.exponent)?;
        if made.specular_pmf == self.specular_pmf {
            Ok(())
        } else {
            Err(BsdfError::Derived { field: "specular_pmf" })
        }
    }
}
