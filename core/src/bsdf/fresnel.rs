//! What the surface of a transparent material or of a metal reflects.

use super::BsdfError;
use crate::Rgb;
use crate::num;

/// Reflectance of a smooth boundary for unpolarised light.
///
/// * `cos` – to the normal, on the side the light comes from; in `[0, 1]`
/// * `eta` – index of refraction of the far side over that of the near side, above 0
///
/// 1 where everything is reflected. Source: Born and Wolf 1999, *Principles of Optics*, 7th edition,
/// section 1.5.2, equations 21a and 21b. Differs: `g = η cos θ_t` is kept instead of `cos θ_t`, so that
/// nothing cancels but in the reflectances themselves.
#[inline]
pub(super) fn dielectric(cos: f32, eta: f32) -> f32 {
    let eta2 = eta * eta;
    let g2 = cos * cos + (eta2 - 1.0);
    if !(g2 > 0.0) {
        return 1.0;
    }
    let g = num::sqrt(g2);
    let s = (cos - g) / (cos + g);
    let p = (g - eta2 * cos) / (g + eta2 * cos);
    0.5 * (s * s + p * p)
}

/// The complex index of refraction of a metal, relative to what is in front of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Conductor {
    pub(super) eta: Rgb,
    pub(super) k: Rgb,
}

/// Squares of squares of it are still far from overflow; no metal comes near.
const MAX_INDEX: f32 = 1e4;

impl Conductor {
    /// From the refractive index and the extinction coefficient for red, green and blue.
    pub(super) fn new(eta: Rgb, k: Rgb) -> Result<Self, BsdfError> {
        for (field, value) in [("eta", eta), ("k", k)] {
            if !(value.is_valid() && value.max_component() <= MAX_INDEX) {
                return Err(BsdfError::ConductorIndex { field, value });
            }
        }
        Ok(Self { eta, k })
    }

    /// Reflectance for unpolarised light.
    ///
    /// * `cos` – to the normal, in `[0, 1]`
    #[inline]
    pub(super) fn reflectance(&self, cos: f32) -> Rgb {
        let Self { eta, k } = self;
        Rgb::new(conductor(cos, eta.r, k.r), conductor(cos, eta.g, k.g), conductor(cos, eta.b, k.b))
    }
}

/// Reflectance of a metal in one channel.
///
/// Source: Lagarde 2013, *Memo on Fresnel equations*, section "Conductor – dielectric". Differs: `sin²` is
/// kept out of `t`, and `√((a² + b² + t) / 2)` is by its conjugate where `t < 0`: less cancels.
#[inline]
fn conductor(cos: f32, eta: f32, k: f32) -> f32 {
    let cos2 = cos * cos;
    let sin2 = (1.0 - cos) * (1.0 + cos);
    let cross = 2.0 * eta * k;
    let t = (eta - 1.0) * (eta + 1.0) + cos2 - k * k;
    let sum = num::sqrt(t * t + cross * cross);
    let a = if t < 0.0 { cross * num::sqrt(0.5 / (sum - t)) } else { num::sqrt(0.5 * (sum + t)) };
    let ratio =
        |whole: f32, part: f32| if whole + part > 0.0 { (whole - part) / (whole + part) } else { 1.0 };
    let s = ratio(sum + cos2, 2.0 * cos * a);
    let p = s * ratio(sum * cos2 + sin2 * sin2, 2.0 * cos * a * sin2);
    0.5 * (s + p)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dielectric_reflects_the_textbook_share() {
        // Facing: ((η − 1)/(η + 1))². At Brewster's angle tan θ = η, one polarisation vanishes.
        assert!((dielectric(1.0, 1.5) - 0.04).abs() < 1e-7);
        assert!((dielectric(1.0, 1.0 / 1.5) - 0.04).abs() < 1e-7);
        let brewster = 1.0 / (1.0_f32 + 1.5 * 1.5).sqrt();
        let s = (1.0 - 2.25_f32) / (1.0 + 2.25);
        assert!((dielectric(brewster, 1.5) - 0.5 * s * s).abs() < 1e-6);
        assert!(dielectric(0.0, 1.5) == 1.0 && dielectric(0.7, 1.0) < 1e-12);
        assert_eq!(dielectric(0.5, 1.0 / 1.5), 1.0, "beyond the critical angle");
    }

    #[test]
    fn a_metal_without_extinction_is_a_dielectric_and_one_without_index_a_mirror() {
        for cos in [0.0, 1e-4, 0.1, 0.5, 0.9, 1.0] {
            for eta in [0.5, 1.0, 1.3, 2.5] {
                let difference = conductor(cos, eta, 0.0) - dielectric(cos, eta);
                assert!(difference.abs() < 2e-6 || (eta == 1.0 && cos == 0.0), "{cos} {eta} {difference}");
            }
            assert!((conductor(cos, 0.0, 1.0) - 1.0).abs() < 1e-6);
            for (eta, k) in [(0.0, 0.0), (1e-30, 1e-30), (1e4, 1e4), (1e4, 0.0), (1.0, 1e-20)] {
                let r = conductor(cos, eta, k);
                assert!((0.0..=1.0).contains(&r), "{cos} {eta} {k}: {r}");
            }
        }
    }

    #[test]
    fn gold_reflects_what_it_should() {
        // (η − 1)² + k² over (η + 1)² + k², facing.
        let (eta, k) = (0.143_f64, 3.983_f64);
        let facing = ((eta - 1.0).powi(2) + k * k) / ((eta + 1.0).powi(2) + k * k);
        assert!((f64::from(conductor(1.0, eta as f32, k as f32)) - facing).abs() < 1e-6);
    }
}
