//! Reflection: one file per model.
//!
//! Directions are unit vectors in the local frame of the surface (`z` is the shading normal, `x` its
//! tangent where [`Bsdf::needs_tangent`]) and point away from it. A model describes the side that `z` points to; [`TwoSided`] gives a surface
//! one on each side.

mod error;
mod fresnel;
mod ggx;
mod lambert;
mod matte_base;
mod metallic_roughness;
mod microfacet;
mod phong;
mod rough_plastic;
mod transmittance;
mod two_sided;

pub use error::BsdfError;
pub use ggx::GgxConductor;
pub use lambert::Lambert;
pub use metallic_roughness::MetallicRoughness;
pub use phong::Phong;
pub use rough_plastic::RoughPlastic;
pub use two_sided::TwoSided;

use crate::Rgb;
use glam::Vec3;

/// A direction drawn from a BSDF.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BsdfSample {
    /// Unit direction, local.
    pub wi: Vec3,
    /// Density with which it was drawn (sr⁻¹); finite and positive.
    pub pdf_solid_angle: f32,
}

/// A model of reflection.
///
/// The density of a sample is [`Bsdf::pdf_solid_angle`] of its direction: one function for both.
pub trait Bsdf: Copy {
    /// `f_r(wo, wi)` without the cosine (sr⁻¹); 0 when either direction is not above the surface.
    fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb;

    /// Draws `wi`; `None` when nothing is reflected.
    ///
    /// * `u` – two uniforms for the direction, `u_lobe` one for the choice among lobes; in `[0, 1)`
    fn sample(&self, wo: Vec3, u: [f32; 2], u_lobe: f32) -> Option<BsdfSample>;

    /// Density with which [`Bsdf::sample`] draws `wi` (sr⁻¹); 0 where it never does.
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32;

    /// Fraction of the light that is reflected, roughly: for images of albedo, not for transport.
    fn albedo(&self) -> Rgb;

    /// True when the same is reflected in all directions, so that drawing directions from the BSDF
    /// brings nothing that drawing them toward the lights does not.
    fn is_diffuse(&self) -> bool {
        false
    }

    /// Solid angle of its narrowest lobe, roughly (sr): within a light that fills less, the model hardly
    /// changes, and drawing directions toward that light is as good as drawing them from the model. 0 where
    /// nothing is known.
    fn lobe_solid_angle(&self) -> f32 {
        0.0
    }

    /// True when it matters how the local frame is turned about the normal: `x` must then be along the
    /// surface's tangent.
    #[inline]
    fn needs_tangent(&self) -> bool {
        false
    }

    /// True when nothing is reflected in any direction, so that no light need be sampled.
    fn is_black(&self) -> bool {
        self.albedo().is_black()
    }

    /// Checks a model that was made without checks, as those in a program's constants are.
    ///
    /// # Errors
    /// What the checking constructor says. A model without another constructor has nothing to check.
    fn check(&self) -> Result<(), BsdfError> {
        Ok(())
    }
}

/// A model that stays where it is kept.
impl<B: Bsdf> Bsdf for &B {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        B::eval(self, wo, wi)
    }

    #[inline]
    fn sample(&self, wo: Vec3, u: [f32; 2], u_lobe: f32) -> Option<BsdfSample> {
        B::sample(self, wo, u, u_lobe)
    }

    #[inline]
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        B::pdf_solid_angle(self, wo, wi)
    }

    #[inline]
    fn albedo(&self) -> Rgb {
        B::albedo(self)
    }

    #[inline]
    fn is_diffuse(&self) -> bool {
        B::is_diffuse(self)
    }

    #[inline]
    fn lobe_solid_angle(&self) -> f32 {
        B::lobe_solid_angle(self)
    }

    #[inline]
    fn needs_tangent(&self) -> bool {
        B::needs_tangent(self)
    }

    #[inline]
    fn is_black(&self) -> bool {
        B::is_black(self)
    }

    fn check(&self) -> Result<(), BsdfError> {
        B::check(self)
    }
}

/// Any of the models: what a frontend that reads arbitrary scenes uses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AnyBsdf {
    /// Matte.
    Lambert(Lambert),
    /// Matte with a glossy highlight.
    Phong(Phong),
    /// A rough metal.
    GgxConductor(GgxConductor),
    /// Matte under a rough coat.
    RoughPlastic(RoughPlastic),
    /// That of glTF.
    MetallicRoughness(MetallicRoughness),
}

/// The only list of variants; every method goes through it.
macro_rules! each_bsdf {
    ($bsdf:expr, $inner:ident => $body:expr) => {
        match $bsdf {
            AnyBsdf::Lambert($inner) => $body,
            AnyBsdf::Phong($inner) => $body,
            AnyBsdf::GgxConductor($inner) => $body,
            AnyBsdf::RoughPlastic($inner) => $body,
            AnyBsdf::MetallicRoughness($inner) => $body,
        }
    };
}

impl Bsdf for AnyBsdf {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        each_bsdf!(self, b => b.eval(wo, wi))
    }

    #[inline]
    fn sample(&self, wo: Vec3, u: [f32; 2], u_lobe: f32) -> Option<BsdfSample> {
        each_bsdf!(self, b => b.sample(wo, u, u_lobe))
    }

    #[inline]
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        each_bsdf!(self, b => b.pdf_solid_angle(wo, wi))
    }

    fn albedo(&self) -> Rgb {
        each_bsdf!(self, b => b.albedo())
    }

    #[inline]
    fn is_diffuse(&self) -> bool {
        each_bsdf!(self, b => b.is_diffuse())
    }

    #[inline]
    fn lobe_solid_angle(&self) -> f32 {
        each_bsdf!(self, b => b.lobe_solid_angle())
    }

    #[inline]
    fn needs_tangent(&self) -> bool {
        each_bsdf!(self, b => b.needs_tangent())
    }

    fn is_black(&self) -> bool {
        each_bsdf!(self, b => b.is_black())
    }

    fn check(&self) -> Result<(), BsdfError> {
        each_bsdf!(self, b => b.check())
    }
}
