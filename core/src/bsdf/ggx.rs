//! A rough metal.

use super::error::check_reflectance;
use super::fresnel::Conductor;
use super::microfacet::{Ggx, MIN_ALPHA};
use super::{Bsdf, BsdfError, BsdfSample};
use crate::Rgb;
use crate::num::PI;
use glam::Vec3;

/// A rough conductor with GGX microfacets: `f_r = R F D G1(ω_o) G1(ω_i) / (4 cos θ_o cos θ_i)`. Without
/// indices of refraction `F` is 1, as in Mitsuba's `roughconductor` with material `none`.
///
/// Source: Walter et al. 2007, *Microfacet Models for Refraction through Rough Surfaces*, EGSR,
/// equation 20; the facets are those of Mitsuba 3, with independent masking and shadowing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GgxConductor {
    reflectance: Rgb,
    facets: Ggx,
    metal: Option<Conductor>,
}

impl GgxConductor {
    /// The smoothest surface that there is.
    pub const MIN_ALPHA: f32 = MIN_ALPHA;

    /// From reflectance and roughness `α`, in `[1e-4, 1]`, the same in all directions.
    ///
    /// # Errors
    /// When a channel of the reflectance is outside `[0, 1]`, or `α` outside its range.
    pub fn new(reflectance: Rgb, alpha: f32) -> Result<Self, BsdfError> {
        Self::anisotropic(reflectance, [alpha; 2])
    }

    /// From reflectance and the roughnesses along the surface's tangent and across it, each in
    /// `[1e-4, 1]`.
    ///
    /// # Errors
    /// When a channel of the reflectance is outside `[0, 1]`, or a roughness outside its range.
    pub fn anisotropic(reflectance: Rgb, alpha: [f32; 2]) -> Result<Self, BsdfError> {
        let reflectance = check_reflectance("the specular reflectance", reflectance)?;
        Ok(Self { reflectance, facets: Ggx::new(alpha)?, metal: None })
    }

    /// The same with the Fresnel reflectance of a metal.
    ///
    /// * `eta` – refractive index, `k` – extinction coefficient, each in `[0, 10⁴]`, relative to what is
    ///   in front of the metal, for red, green and blue
    ///
    /// # Errors
    /// When a channel is outside its range.
    pub fn with_index(self, eta: Rgb, k: Rgb) -> Result<Self, BsdfError> {
        Ok(Self { metal: Some(Conductor::new(eta, k)?), ..self })
    }

    /// The same with another reflectance.
    ///
    /// # Errors
    /// When a channel is outside `[0, 1]`.
    pub fn with_reflectance(self, reflectance: Rgb) -> Result<Self, BsdfError> {
        Ok(Self { reflectance: check_reflectance("the specular reflectance", reflectance)?, ..self })
    }

    /// The same with other roughnesses along the surface's tangent and across it.
    ///
    /// # Errors
    /// When one is outside `[1e-4, 1]`.
    pub fn with_alpha(self, alpha: [f32; 2]) -> Result<Self, BsdfError> {
        Ok(Self { facets: Ggx::new(alpha)?, ..self })
    }

    /// Factor on the reflectance of the facets.
    #[must_use]
    pub const fn reflectance(&self) -> Rgb {
        self.reflectance
    }

    /// Roughness along the surface's tangent and across it.
    #[must_use]
    pub const fn alpha(&self) -> [f32; 2] {
        self.facets.alpha()
    }

    /// Refractive index and extinction coefficient; `None` for facets that reflect everything.
    #[must_use]
    pub fn index(&self) -> Option<(Rgb, Rgb)> {
        self.metal.map(|m| (m.eta, m.k))
    }

    /// A metal that was checked before: for constants; see [`crate::Scene::baked`].
    ///
    /// * `alpha` – roughnesses along the tangent and across it, `index` – refractive index and extinction
    ///   coefficient
    #[must_use]
    pub const fn baked(reflectance: Rgb, alpha: [f32; 2], index: Option<(Rgb, Rgb)>) -> Self {
        let metal = match index {
            Some((eta, k)) => Some(Conductor { eta, k }),
            None => None,
        };
        Self { reflectance, facets: Ggx::baked(alpha), metal }
    }
}

impl Bsdf for GgxConductor {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        let Some(h) = Ggx::half(wo, wi) else { return Rgb::BLACK };
        let f = self.reflectance * self.facets.reflection(wo, wi, h);
        match &self.metal {
            None => f,
            Some(metal) => f * metal.reflectance(Ggx::facet_cosine(wo, wi, h)),
        }
    }

    #[inline]
    fn sample(&self, wo: Vec3, u: [f32; 2], _u_lobe: f32) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let wi = self.facets.sample_reflection(wo, u)?;
        let pdf_solid_angle = self.pdf_solid_angle(wo, wi);
        (pdf_solid_angle > 0.0 && pdf_solid_angle.is_finite()).then_some(BsdfSample { wi, pdf_solid_angle })
    }

    /// `D G1 / (4 cos θ_o)` (sr⁻¹).
    #[inline]
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        Ggx::half(wo, wi).map_or(0.0, |h| self.facets.reflection_pdf(wo, h))
    }

    /// That which the microfacets' normals fill, `π αₓ αᵧ`. The directions fill four times as much, seen from
    /// above, and less at a slant.
    #[inline]
    fn lobe_solid_angle(&self) -> f32 {
        let [x, y] = self.alpha();
        PI * x * y
    }

    fn albedo(&self) -> Rgb {
        self.metal.map_or(self.reflectance, |m| self.reflectance * m.reflectance(1.0))
    }

    #[inline]
    fn needs_tangent(&self) -> bool {
        let [along, across] = self.alpha();
        along != across
    }

    fn check(&self) -> Result<(), BsdfError> {
        let made = Self::anisotropic(self.reflectance, self.alpha())?;
        self.index().map_or(Ok(made), |(eta, k)| made.with_index(eta, k)).map(drop)
    }
}
