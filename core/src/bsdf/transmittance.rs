//! How much light a rough dielectric boundary lets through.

use super::fresnel::dielectric;
use super::microfacet::Ggx;
use crate::num;
use glam::Vec3;

/// Terms of the fit: powers of the cosine from 0, then simple fractions.
const POWERS: usize = 4;
const FRACTIONS: usize = 6;
const TERMS: usize = POWERS + FRACTIONS;

/// Poles farther from 0 than this do not help, whatever the roughness.
const NEAREST_MAX: f32 = 0.1;
/// The farthest pole; those between are spaced evenly in their logarithms.
const FARTHEST: f32 = 0.5;
/// Cosines at which the fit is made.
const NODES: u16 = 33;
/// Added to the diagonal of the normal equations: bounds the coefficients by some hundreds, which `f32`
/// sums with an error below 1e-4.
const RIDGE: f64 = 1e-10;

/// The part of the light from direction `ω` that a rough boundary lets through,
/// `T(cos θ) = ∫ (1 − F) G1(ω_t) p(h) dh` over the facets that `ω` sees, as a sum of ten terms:
/// `Σ a_i cos^i + Σ c_k cos / (cos + b_k)`.
///
/// Where the surface is smooth, `T` falls to 0 within `cos < α`; the poles `−b_k`, evenly spaced in
/// logarithm from `−α`, resolve that for every roughness, and being fixed leave a linear fit without
/// poles between 0 and 1. Differs from Mitsuba 3, which interpolates in 64 values of the same integral. The
/// largest error of the fit is 1.3e-3 for `α` in `[1e-3, 1]` and `η` in `[1.05, 2.5]`, and a third of
/// that for most.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Transmittance {
    terms: [f32; TERMS],
    /// The smallest `b`, and the ratio of each to the one before.
    nearest: f32,
    ratio: f32,
}

impl Transmittance {
    /// How many numbers describe it.
    pub(super) const NUMBERS: usize = TERMS + 2;

    /// The numbers that describe it.
    pub(super) const fn to_numbers(self) -> [f32; Self::NUMBERS] {
        let mut all = [self.nearest; Self::NUMBERS];
        all[1] = self.ratio;
        let mut i = 0;
        while i < TERMS {
            all[i + 2] = self.terms[i];
            i += 1;
        }
        all
    }

    /// What [`Transmittance::to_numbers`] gave.
    pub(super) const fn baked(numbers: [f32; Self::NUMBERS]) -> Self {
        let mut terms = [0.0; TERMS];
        let mut i = 0;
        while i < TERMS {
            terms[i] = numbers[i + 2];
            i += 1;
        }
        Self { terms, nearest: numbers[0], ratio: numbers[1] }
    }

    /// * `eta` – index of refraction inside over that outside, at least 1
    pub(super) fn new(facets: &Ggx, eta: f32) -> Self {
        let nearest = facets.alpha()[0].min(NEAREST_MAX);
        let ratio = num::pow(FARTHEST / nearest, 1.0 / (FRACTIONS - 1) as f32);
        let mut fit = Self { terms: [0.0; TERMS], nearest, ratio };
        let (mut normal, mut right) = ([[0.0; TERMS]; TERMS], [0.0; TERMS]);
        for node in 0..NODES {
            let x = f32::from(node) / f32::from(NODES - 1);
            // Dense near 0, and a little so near 1.
            let cos = 1.0 - num::pow(1.0 - x * x * x, 1.6);
            let values = fit.basis(cos).map(f64::from);
            let target = f64::from(over_facets(facets, cos, eta, Side::Through));
            for (i, row) in normal.iter_mut().enumerate() {
                row.iter_mut().zip(values).for_each(|(entry, value)| *entry += values[i] * value);
                right[i] += values[i] * target;
            }
        }
        fit.terms = solve(normal, right).map(|term| term as f32);
        fit
    }

    /// The functions that are summed.
    fn basis(&self, cos: f32) -> [f32; TERMS] {
        let mut values = [1.0; TERMS];
        for power in 1..POWERS {
            values[power] = values[power - 1] * cos;
        }
        let mut pole = self.nearest;
        for value in &mut values[POWERS..] {
            *value = cos / (cos + pole);
            pole *= self.ratio;
        }
        values
    }

    /// The transmittance in a direction, in `[0, 1]`.
    #[inline]
    pub(super) fn at(&self, cos: f32) -> f32 {
        let sum: f32 = self.basis(cos).iter().zip(&self.terms).map(|(value, term)| value * term).sum();
        num::clamp(sum, 0.0, 1.0)
    }
}

/// The part of uniformly diffuse light inside that a rough boundary throws back:
/// `2 ∫ R(cos θ) cos θ dcos θ`, `R` the reflectance from inside.
///
/// Summed as Mitsuba 3 sums it, over 64 cosines from 0 to 1 with equal weights, which is 1 to 2 % less
/// than the integral.
pub(super) fn internal_reflectance(facets: &Ggx, eta: f32) -> f32 {
    let of = |i: u16| {
        let cos = f32::from(i) / 63.0;
        over_facets(facets, cos, 1.0 / eta, Side::Back) * cos
    };
    (0..64).map(of).sum::<f32>() / 32.0
}

/// Which light is counted.
#[derive(Clone, Copy)]
enum Side {
    /// What is refracted.
    Through,
    /// What is reflected.
    Back,
}

/// What leaves by one side of the light that comes in at a cosine: the integral over visible facets.
///
/// Source: Walter et al. 2007, section 4. The rule of midpoints is taken after `u = t − sin(2πt)/2π`,
/// whose derivative vanishes at both ends, so that it converges as for a periodic function.
fn over_facets(facets: &Ggx, cos: f32, eta: f32, side: Side) -> f32 {
    const RINGS: u16 = 32;
    const SECTORS: u16 = 16;
    let cos = cos.max(1e-6);
    let wo = Vec3::new(num::sqrt((1.0 - cos) * (1.0 + cos)), 0.0, cos);
    let mut sum = 0.0;
    for ring in 0..RINGS {
        let t = (f32::from(ring) + 0.5) / f32::from(RINGS);
        let (sin_t, cos_t) = num::sin_cos_turns(t);
        let u = num::clamp_unit(t - sin_t / num::TAU);
        let mut around = 0.0;
        for sector in 0..SECTORS {
            // Half a turn: the other half is its mirror image.
            let v = (f32::from(sector) + 0.5) / f32::from(2 * SECTORS);
            around += facets.visible_normal(wo, [u, v]).map_or(0.0, |h| leaving(facets, wo, h, eta, side));
        }
        sum += around * (1.0 - cos_t);
    }
    sum / f32::from(RINGS * SECTORS)
}

/// What one facet sends to one side and the others do not mask.
fn leaving(facets: &Ggx, wo: Vec3, h: Vec3, eta: f32, side: Side) -> f32 {
    let c = wo.dot(h).clamp(0.0, 1.0);
    let reflected = dielectric(c, eta);
    let (share, out) = match side {
        Side::Back => (reflected, h * (2.0 * c) - wo),
        Side::Through => {
            let along = c - num::sqrt(c * c + (eta - 1.0) * (eta + 1.0));
            (1.0 - reflected, (wo - h * along) / eta)
        }
    };
    if out.z > 0.0 { share * 2.0 * out.z / (out.z + facets.stretched(out)) } else { 0.0 }
}

/// Solves `A x = b` for a symmetric positive definite `A` by Cholesky's method. In double precision:
/// normal equations square the condition, which here is far beyond what `f32` holds.
fn solve(mut a: [[f64; TERMS]; TERMS], mut b: [f64; TERMS]) -> [f64; TERMS] {
    for i in 0..TERMS {
        a[i][i] += RIDGE;
        for j in 0..=i {
            let dot: f64 = (0..j).map(|k| a[i][k] * a[j][k]).sum();
            a[i][j] = if i == j { num::sqrt_in_double(a[i][i] - dot) } else { (a[i][j] - dot) / a[j][j] };
        }
    }
    for i in 0..TERMS {
        let dot: f64 = (0..i).map(|k| a[i][k] * b[k]).sum();
        b[i] = (b[i] - dot) / a[i][i];
    }
    for i in (0..TERMS).rev() {
        let dot: f64 = (i + 1..TERMS).map(|k| a[k][i] * b[k]).sum();
        b[i] = (b[i] - dot) / a[i][i];
    }
    b
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facets(alpha: f32) -> Ggx {
        Ggx::new([alpha; 2]).unwrap()
    }

    #[test]
    fn the_fit_is_as_close_as_it_says() {
        for alpha in [1e-3_f32, 3e-3, 1e-2, 0.03, 0.1, 0.3, 0.6, 1.0] {
            for eta in [1.05, 1.15, 1.33, 1.49, 2.5] {
                let fit = Transmittance::new(&facets(alpha), eta);
                for i in 0..=200_u16 {
                    let x = f32::from(i) / 200.0;
                    for cos in [x, x * x * x * 0.1] {
                        let error = fit.at(cos) - over_facets(&facets(alpha), cos, eta, Side::Through);
                        assert!(error.abs() < 1.3e-3, "α = {alpha}, η = {eta}, cos = {cos}: {error}");
                    }
                }
            }
        }
    }

    #[test]
    fn a_smooth_boundary_lets_through_what_fresnel_says() {
        let smooth = facets(1e-4);
        for eta in [1.05, 1.49, 2.5] {
            for cos in [0.05, 0.2, 0.5, 0.9, 1.0] {
                let error = over_facets(&smooth, cos, eta, Side::Through) - (1.0 - dielectric(cos, eta));
                assert!(error.abs() < 2e-3, "{eta} {cos} {error}");
            }
        }
    }

    #[test]
    fn the_internal_reflectance_is_that_of_mitsuba() {
        // Solved for from values of Mitsuba 3.9.1's `roughplastic` for two diffuse reflectances.
        for (alpha, eta, expected) in [
            (1e-3, 1.05, 0.10468),
            (1e-3, 1.4896, 0.57913),
            (0.01, 1.333, 0.4665),
            (0.1, 1.4896, 0.54553),
            (0.1, 2.4, 0.82129),
            (0.3, 1.4896, 0.40877),
            (0.3, 2.4, 0.68751),
            (1.0, 1.05, 0.00266),
            (1.0, 2.4, 0.26734),
        ] {
            let seen = internal_reflectance(&facets(alpha), eta);
            assert!((seen - expected).abs() < 5e-4, "α = {alpha}, η = {eta}: {seen}, not {expected}");
        }
    }
}
