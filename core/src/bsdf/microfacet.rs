//! GGX microfacets, the same in all directions or stretched along two axes.

use super::BsdfError;
use crate::num::{self, FRAC_1_PI};
use glam::Vec3;

/// The smoothest surface that `f32` resolves: below it the lobe is narrower than the rounding of a
/// unit vector.
pub(super) const MIN_ALPHA: f32 = 1e-4;

/// A surface of GGX facets with Smith's masking.
///
/// Source: Walter et al. 2007, *Microfacet Models for Refraction through Rough Surfaces*, EGSR,
/// equations 33 and 34; with two roughnesses, Heitz 2014, *Understanding the Masking-Shadowing
/// Function in Microfacet-Based BRDFs*, JCGT 3(2), equations 85 and 86. Masking and shadowing are
/// taken as independent, as in Walter and in Mitsuba 3; the height-correlated form of Heitz 2014 is up
/// to 10 % brighter at grazing angles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Ggx {
    /// Roughness along `x` and `y`.
    alpha: [f32; 2],
}

impl Ggx {
    /// From the roughnesses along `x` and `y`, each in `[1e-4, 1]`.
    pub(super) fn new(alpha: [f32; 2]) -> Result<Self, BsdfError> {
        for a in alpha {
            if !(MIN_ALPHA..=1.0).contains(&a) {
                return Err(BsdfError::Roughness(a));
            }
        }
        Ok(Self { alpha })
    }

    /// What was checked before.
    pub(super) const fn baked(alpha: [f32; 2]) -> Self {
        Self { alpha }
    }

    /// Roughness along `x` and `y`.
    pub(super) const fn alpha(&self) -> [f32; 2] {
        self.alpha
    }

    /// Distribution of facet normals `D(h)` (sr⁻¹). `cos² + sin²/α²` keeps its digits for small `α`.
    #[inline]
    pub(super) fn distribution(&self, h: Vec3) -> f32 {
        let [au, av] = self.alpha;
        let (x, y) = (h.x / au, h.y / av);
        let e = h.z * h.z + (x * x + y * y);
        FRAC_1_PI / (au * av * e * e)
    }

    /// `√(cos² + α² sin²)`: half of the masking denominator. `G1 = 2 cos / (cos + stretched)`.
    #[inline]
    pub(super) fn stretched(&self, w: Vec3) -> f32 {
        let (x, y) = (self.alpha[0] * w.x, self.alpha[1] * w.y);
        num::sqrt(w.z * w.z + (x * x + y * y))
    }

    /// Half vector of two directions above the surface.
    #[inline]
    pub(super) fn half(wo: Vec3, wi: Vec3) -> Option<Vec3> {
        if wo.z <= 0.0 || wi.z <= 0.0 { None } else { crate::geom::unit(wo + wi) }
    }

    /// Cosine of either direction to their half vector: the same both ways to the last bit.
    #[inline]
    pub(super) fn facet_cosine(wo: Vec3, wi: Vec3, h: Vec3) -> f32 {
        num::clamp(0.5 * (wo + wi).dot(h), 0.0, 1.0)
    }

    /// `D G1 G1 / (4 cos θ_o cos θ_i)` (sr⁻¹): the reflection of facets that are mirrors.
    #[inline]
    pub(super) fn reflection(&self, wo: Vec3, wi: Vec3, h: Vec3) -> f32 {
        let masked = 1.0 / ((wo.z + self.stretched(wo)) * (wi.z + self.stretched(wi)));
        self.distribution(h) * masked
    }

    /// A facet that `wo`, above the surface, sees.
    ///
    /// Source: Dupuy and Benyoub 2023, *Sampling Visible GGX Normals with Spherical Caps*, CGF
    /// 42(8), listing 3.
    #[inline]
    pub(super) fn visible_normal(&self, wo: Vec3, u: [f32; 2]) -> Option<Vec3> {
        let [au, av] = self.alpha;
        let std = Vec3::new(au * wo.x, av * wo.y, wo.z) / self.stretched(wo);
        // A point of the cap z > −std.z around the mirror of the flat surface.
        let z = (1.0 - u[0]) * (1.0 + std.z) - std.z;
        let sin = num::sqrt((1.0 - z) * (1.0 + z));
        let (sin_phi, cos_phi) = num::sin_cos_turns(u[1]);
        let cap = Vec3::new(sin * cos_phi, sin * sin_phi, z) + std;
        crate::geom::unit(Vec3::new(au * cap.x, av * cap.y, cap.z))
    }

    /// Draws a facet that `wo` sees, and mirrors `wo` in it.
    #[inline]
    pub(super) fn sample_reflection(&self, wo: Vec3, u: [f32; 2]) -> Option<Vec3> {
        let h = self.visible_normal(wo, u)?;
        Some(h * (2.0 * wo.dot(h)) - wo)
    }

    /// Density of [`Ggx::sample_reflection`]: `D G1 / (4 cos θ_o)` (sr⁻¹).
    #[inline]
    pub(super) fn reflection_pdf(&self, wo: Vec3, h: Vec3) -> f32 {
        self.distribution(h) * 0.5 / (wo.z + self.stretched(wo))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROUGHNESSES: [[f32; 2]; 8] =
        [[1e-4; 2], [1e-3; 2], [1e-2; 2], [0.3; 2], [1.0; 2], [1e-4, 1e-3], [0.05, 0.5], [1.0, 0.1]];

    /// `∫ D(h) f(h) dω_h`, by the rule of midpoints in the radius and the angle of an ellipse of slopes,
    /// where `D` is broad for every roughness.
    fn over_facets(facets: &Ggx, n: i32, turns: i32, f: impl Fn(Vec3) -> f64) -> f64 {
        let [au, av] = facets.alpha.map(f64::from);
        let mut sum = 0.0_f64;
        for i in 0..n * turns {
            let x = (f64::from(i / turns) + 0.5) / f64::from(n);
            let phi = core::f64::consts::TAU * (f64::from(i % turns) + 0.5) / f64::from(turns);
            let r = x / (1.0 - x);
            let slope = [au * r * phi.cos(), av * r * phi.sin()];
            let cos = 1.0 / (1.0 + slope[0] * slope[0] + slope[1] * slope[1]).sqrt();
            let h = Vec3::new((slope[0] * cos) as f32, (slope[1] * cos) as f32, cos as f32);
            // dω = cos³ dslope, dslope = αu αv r dr dφ.
            let solid_angle = cos.powi(3) * au * av * r / ((1.0 - x) * (1.0 - x));
            sum += f64::from(facets.distribution(h)) * f(h) * solid_angle;
        }
        sum * core::f64::consts::TAU / f64::from(n * turns)
    }

    #[test]
    fn normals_integrate_to_one() {
        for alpha in ROUGHNESSES {
            let sum = over_facets(&Ggx::new(alpha).unwrap(), 20_000, 16, |h| f64::from(h.z));
            assert!((sum - 1.0).abs() < 1e-4, "{alpha:?} {sum}");
        }
    }

    #[test]
    fn the_facets_that_are_seen_fill_what_is_seen() {
        // ∫ D G1 max(0, ω·h) dω_h = cos θ: what Heitz 2014, section 6.3, calls the weak furnace.
        for alpha in ROUGHNESSES {
            let facets = Ggx::new(alpha).unwrap();
            for cos in [1.0, 0.8, 0.4, 0.1, 1e-3_f32] {
                let sin = ((1.0 - cos) * (1.0 + cos)).sqrt();
                let wo = Vec3::new(0.6 * sin, -0.8 * sin, cos);
                let masking = 2.0 / f64::from(wo.z + facets.stretched(wo));
                let sum = over_facets(&facets, 2000, 256, |h| f64::from(wo.dot(h).max(0.0)) * masking);
                assert!((sum - 1.0).abs() < 2e-3, "{alpha:?} {cos} {sum}");
            }
        }
    }
}
