//! The surface of glTF: between a coated matte base and a metal.

use super::error::check_reflectance;
use super::microfacet::{Ggx, MIN_ALPHA};
use super::{Bsdf, BsdfError, BsdfSample};
use crate::Rgb;
use crate::num::{self, FRAC_1_PI, PI};
use glam::Vec3;

/// What a dielectric of index of refraction 1.5 reflects facing.
const DIELECTRIC_F0: f32 = 0.04;

/// Metallic-roughness: GGX facets with `α = roughness²` and Schlick's reflectance `F`, over a matte base
/// that is fainter the more the surface is a metal.
///
/// `f_r = F(f0, h) D G1 G1 / (4 cos θ_o cos θ_i) + (1 − m) ρ (1 − F(0.04, min cos θ)) / π`, with the base
/// colour `ρ`, the metalness `m` and `f0 = 0.04 (1 − m) + ρ m`.
///
/// Source: Khronos Group 2021, *glTF 2.0 Specification*, appendix B.2 and B.3. Differs: the base gets what
/// `F` leaves at the lower of the two directions instead of at the half vector, which is the same but
/// for low directions; there the appendix reflects up to 1.9 times what arrives. And a surface is not
/// smoother than roughness 0.01.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MetallicRoughness {
    base_color: Rgb,
    metallic: f32,
    roughness: f32,
}

impl MetallicRoughness {
    /// From the base colour, the metalness and the roughness, all in `[0, 1]`.
    ///
    /// # Errors
    /// When one is outside `[0, 1]`, or not a number.
    pub fn new(base_color: Rgb, metallic: f32, roughness: f32) -> Result<Self, BsdfError> {
        let base_color = check_reflectance("the base colour", base_color)?;
        for (field, value) in [("the metalness", metallic), ("the roughness", roughness)] {
            if !(0.0..=1.0).contains(&value) {
                return Err(BsdfError::Share { field, value });
            }
        }
        Ok(Self { base_color, metallic, roughness })
    }

    /// Colour of the matte base, or of what a metal reflects facing.
    #[must_use]
    pub const fn base_color(&self) -> Rgb {
        self.base_color
    }

    /// 0 for a dielectric, 1 for a metal.
    #[must_use]
    pub const fn metallic(&self) -> f32 {
        self.metallic
    }

    /// Root of the `α` of the facets.
    #[must_use]
    pub const fn roughness(&self) -> f32 {
        self.roughness
    }

    /// A surface that was checked before: for constants; see [`crate::Scene::baked`].
    #[must_use]
    pub const fn baked(base_color: Rgb, metallic: f32, roughness: f32) -> Self {
        Self { base_color, metallic, roughness }
    }

    #[inline]
    fn facets(&self) -> Ggx {
        let alpha = num::larger(self.roughness * self.roughness, MIN_ALPHA);
        Ggx::baked([alpha; 2])
    }

    /// What the facets reflect facing.
    #[inline]
    fn f0(&self) -> Rgb {
        self.base_color * self.metallic + Rgb::splat(DIELECTRIC_F0 * (1.0 - self.metallic))
    }

    /// What the base reflects when no light is lost at the facets.
    #[inline]
    fn diffuse(&self) -> Rgb {
        self.base_color * (1.0 - self.metallic)
    }

    /// Probability of sampling the facets, from what they and the base roughly reflect; 0.038 at least.
    #[inline]
    fn specular_pmf(&self, wo: Vec3) -> f32 {
        let base = self.diffuse().average() * base_share(wo.z);
        let facets = schlick(self.f0(), wo.z).average();
        if base > 0.0 { facets / (facets + base) } else { 1.0 }
    }
}

/// `(1 − cos θ)⁵`: how far a reflectance is on the way from facing to grazing, where it is 1.
///
/// Source: Schlick 1994, *An Inexpensive BRDF Model for Physically-based Rendering*, CGF 13(3), equation 15.
#[inline]
fn grazing(cos: f32) -> f32 {
    let x = num::clamp(1.0 - cos, 0.0, 1.0);
    let x2 = x * x;
    x2 * x2 * x
}

/// Reflectance of a facet that reflects `f0` facing.
#[inline]
fn schlick(f0: Rgb, cos: f32) -> Rgb {
    let t = grazing(cos);
    f0.map(|f0| f0 + (1.0 - f0) * t)
}

/// What a dielectric lets through.
#[inline]
fn base_share(cos: f32) -> f32 {
    (1.0 - DIELECTRIC_F0) * (1.0 - grazing(cos))
}

impl Bsdf for MetallicRoughness {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        let Some(h) = Ggx::half(wo, wi) else { return Rgb::BLACK };
        let fresnel = schlick(self.f0(), Ggx::facet_cosine(wo, wi, h));
        let lower = wo.z.min(wi.z);
        fresnel * self.facets().reflection(wo, wi, h) + self.diffuse() * (base_share(lower) * FRAC_1_PI)
    }

    /// Density: the mixture of the facets that `wo` sees and of `cos θ / π`.
    #[inline]
    fn sample(&self, wo: Vec3, u: [f32; 2], u_lobe: f32) -> Option<BsdfSample> {
        self.facets().sample_over_matte(self.specular_pmf(wo), wo, u, u_lobe)
    }

    #[inline]
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.facets().pdf_over_matte(self.specular_pmf(wo), wo, wi)
    }

    #[inline]
    fn lobe_solid_angle(&self) -> f32 {
        let [x, y] = self.facets().alpha();
        PI * x * y
    }

    /// What is reflected of light along the normal.
    fn albedo(&self) -> Rgb {
        self.f0() + self.diffuse() * (1.0 - DIELECTRIC_F0)
    }

    /// Never: at grazing angles even a black metal reflects.
    fn is_black(&self) -> bool {
        false
    }

    fn check(&self) -> Result<(), BsdfError> {
        Self::new(self.base_color, self.metallic, self.roughness).map(drop)
    }
}
