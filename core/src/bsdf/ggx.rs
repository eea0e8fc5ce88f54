//! A rough metal.

use super::error::check_reflectance;
use super::{Bsdf, BsdfError, BsdfSample};
use crate::Rgb;
use crate::num::{self, FRAC_1_PI};
use glam::Vec3;

/// A rough conductor with GGX microfacets and a reflectance that does not depend on the angle
/// (Mitsuba's `roughconductor` with material `none`): `f_r = R D G1(ω_o) G1(ω_i) / (4 cos θ_o cos θ_i)`.
///
/// Source: Walter et al. 2007, *Microfacet Models for Refraction through Rough Surfaces*, EGSR,
/// equations 20, 23, 33 and 34. Masking and shadowing are taken as independent, as there and in
/// Mitsuba 3; the height-correlated form of Heitz 2014 is up to 10 % brighter at grazing angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GgxConductor {
    reflectance: Rgb,
    alpha: f32,
}

/// The smoothest surface that `f32` resolves: below it the lobe is narrower than the rounding of a
/// unit vector.
const MIN_ALPHA: f32 = 1e-4;

impl GgxConductor {
    /// From reflectance and roughness `α`, in `[1e-4, 1]`.
    ///
    /// # Errors
    /// When a channel of the reflectance is outside `[0, 1]`, or `α` outside its range.
    pub fn new(reflectance: Rgb, alpha: f32) -> Result<Self, BsdfError> {
        let reflectance = check_reflectance("the specular reflectance", reflectance)?;
        if !(MIN_ALPHA..=1.0).contains(&alpha) {
            return Err(BsdfError::Roughness(alpha));
        }
        Ok(Self { reflectance, alpha })
    }

    /// Reflectance of the facets.
    #[must_use]
    pub const fn reflectance(&self) -> Rgb {
        self.reflectance
    }

    /// Roughness.
    #[must_use]
    pub const fn alpha(&self) -> f32 {
        self.alpha
    }

    /// Distribution of facet normals `D(h)` (sr⁻¹). `cos² + sin²/α²` keeps its digits for small `α`.
    #[inline]
    fn distribution(&self, h: Vec3) -> f32 {
        let a2 = self.alpha * self.alpha;
        let sin2 = h.x * h.x + h.y * h.y;
        let e = h.z * h.z + sin2 / a2;
        FRAC_1_PI / (a2 * e * e)
    }

    /// `√(cos² + α² sin²)`: half of the masking denominator.
    #[inline]
    fn stretched(&self, w: Vec3) -> f32 {
        num::sqrt(w.z * w.z + self.alpha * self.alpha * (w.x * w.x + w.y * w.y))
    }

    /// Half vector of two directions above the surface.
    #[inline]
    fn half(wo: Vec3, wi: Vec3) -> Option<Vec3> {
        if wo.z <= 0.0 || wi.z <= 0.0 { None } else { crate::geom::unit(wo + wi) }
    }
}

impl Bsdf for GgxConductor {
    #[inline]
    fn eval(&self, wo: Vec3, wi: Vec3) -> Rgb {
        let Some(h) = Self::half(wo, wi) else { return Rgb::BLACK };
        // G1(w) = 2 cos / (cos + stretched), so that G1 G1 / (4 cos cos) is
        let masked = 1.0 / ((wo.z + self.stretched(wo)) * (wi.z + self.stretched(wi)));
        self.reflectance * (self.distribution(h) * masked)
    }

    /// Draws a facet that `wo` sees, and mirrors `wo` in it.
    ///
    /// Source: Dupuy and Benyoub 2023, *Sampling Visible GGX Normals with Spherical Caps*, CGF
    /// 42(8), listing 3.
    #[inline]
    fn sample(&self, wo: Vec3, u: [f32; 2], _u_lobe: f32) -> Option<BsdfSample> {
        if wo.z <= 0.0 {
            return None;
        }
        let a = self.alpha;
        let stretched = Vec3::new(a * wo.x, a * wo.y, wo.z);
        let std = stretched / self.stretched(wo);
        // A point of the cap z > −std.z around the mirror of the flat surface.
        let z = (1.0 - u[0]) * (1.0 + std.z) - std.z;
        let sin = num::sqrt((1.0 - z) * (1.0 + z));
        let (sin_phi, cos_phi) = num::sin_cos_turns(u[1]);
        let cap = Vec3::new(sin * cos_phi, sin * sin_phi, z) + std;
        let h = crate::geom::unit(Vec3::new(a * cap.x, a * cap.y, cap.z))?;
        let wi = h * (2.0 * wo.dot(h)) - wo;
        let pdf_solid_angle = self.pdf_solid_angle(wo, wi);
        (pdf_solid_angle > 0.0 && pdf_solid_angle.is_finite()).then_some(BsdfSample { wi, pdf_solid_angle })
    }

    /// `D G1 / (4 cos θ_o)` (sr⁻¹).
    #[inline]
    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        let Some(h) = Self::half(wo, wi) else { return 0.0 };
        self.distribution(h) * 0.5 / (wo.z + self.stretched(wo))
    }

    fn albedo(&self) -> Rgb {
        self.reflectance
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_integrate_to_one() {
        // ∫ D cos θ dω = 1, by quadrature in the tangent of θ, where D is broad for every α.
        for alpha in [1e-4_f32, 1e-2, 0.3, 1.0] {
            let b = GgxConductor::new(Rgb::WHITE, alpha).unwrap();
            let (n, mut sum) = (200_000, 0.0_f64);
            for i in 0..n {
                let x = (i as f64 + 0.5) / n as f64;
                let tan = f64::from(alpha) * x / (1.0 - x);
                let dtan = f64::from(alpha) / ((1.0 - x) * (1.0 - x)) / n as f64;
                let cos = 1.0 / (1.0 + tan * tan).sqrt();
                let d = b.distribution(Vec3::new((tan * cos) as f32, 0.0, cos as f32));
                // dω = 2π sin θ dθ, dθ = cos² dtan.
                sum += f64::from(d) * cos * 2.0 * core::f64::consts::PI * tan * cos * cos * cos * dtan;
            }
            assert!((sum - 1.0).abs() < 1e-4, "{alpha} {sum}");
        }
    }
}
