//! A lobe over a matte base: for each direction one of the two is chosen, and the density is the mean of
//! both, weighted by how likely they were.
//!
//! Source: Veach 1997, *Robust Monte Carlo Methods for Light Transport Simulation*, section 9.2: the balance
//! heuristic.

use super::BsdfSample;
use super::microfacet::Ggx;
use crate::warp;
use glam::Vec3;

/// Draws a direction and works out its density; `None` where nothing is reflected.
///
/// * `specular` – probability of the lobe
/// * `u` – two uniforms in `[0, 1)`
/// * `u_lobe` – the one in `[0, 1)` that chooses
/// * `lobe` – draws from the lobe
/// * `lobe_pdf` – the lobe's density of a direction (sr⁻¹); `None` where the mixture has none
#[inline]
pub(super) fn sample(
    specular: f32,
    u: [f32; 2],
    u_lobe: f32,
    lobe: impl FnOnce() -> Option<Vec3>,
    lobe_pdf: impl FnOnce(Vec3) -> Option<f32>,
) -> Option<BsdfSample> {
    let wi = if u_lobe < specular { lobe()? } else { warp::cosine_hemisphere(u) };
    let pdf_solid_angle = pdf(specular, lobe_pdf(wi)?, wi);
    (pdf_solid_angle > 0.0 && pdf_solid_angle.is_finite()).then_some(BsdfSample { wi, pdf_solid_angle })
}

/// Density of a direction above the surface (sr⁻¹), by that of the lobe.
#[inline]
pub(super) fn pdf(specular: f32, lobe_pdf: f32, wi: Vec3) -> f32 {
    specular * lobe_pdf + (1.0 - specular) * warp::cosine_hemisphere_pdf(wi.z)
}

impl Ggx {
    /// [`sample`], where the lobe is the reflection of facets.
    #[cfg_attr(not(feature = "small"), inline)]
    #[cfg_attr(feature = "small", inline(never))]
    pub(super) fn sample_over_matte(
        &self,
        specular: f32,
        wo: Vec3,
        u: [f32; 2],
        u_lobe: f32,
    ) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let lobe_pdf = |wi| Self::half(wo, wi).map(|h| self.reflection_pdf(wo, h));
        sample(specular, u, u_lobe, || self.sample_reflection(wo, u), lobe_pdf)
    }

    /// [`pdf`] of that; 0 below the surface.
    #[cfg_attr(not(feature = "small"), inline)]
    #[cfg_attr(feature = "small", inline(never))]
    pub(super) fn pdf_over_matte(&self, specular: f32, wo: Vec3, wi: Vec3) -> f32 {
        let Some(h) = Self::half(wo, wi) else { return 0.0 };
        pdf(specular, self.reflection_pdf(wo, h), wi)
    }
}
