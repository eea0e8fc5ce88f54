//! Scalar functions that give the same bits on every target.
//!
//! Everything that is not an exact IEEE operation comes from [`libm`] or is made of such operations
//! here, also where the platform would offer its own: a picture rendered on x86-64, in WebAssembly
//! and on a Cortex-M is the same.

mod double;
pub(crate) mod lanes;
mod trig;

pub use double::{atan2_in_double, sin_cos_in_double, sqrt_in_double};
use glam::Vec4;
pub(crate) use trig::sin_cos_near;
pub use trig::{atan2, atan2_of_four, sin_cos, sin_cos_turns};

pub use core::f32::consts::{FRAC_1_PI, FRAC_PI_2, FRAC_PI_4, PI, TAU};

/// Half the distance from 1 to the next larger `f32`: the unit round-off of one operation.
pub const UNIT_ROUND_OFF: f32 = f32::EPSILON * 0.5;

/// The largest `f32` below 1.
pub const ONE_MINUS_EPSILON: f32 = 1.0 - UNIT_ROUND_OFF;

/// Bound on the relative error of `n` roundings in a row: `n ε / (1 − n ε)`.
///
/// Source: Higham 2002, *Accuracy and Stability of Numerical Algorithms*, lemma 3.1.
#[must_use]
pub const fn gamma(n: u32) -> f32 {
    let n_eps = n as f32 * UNIT_ROUND_OFF;
    n_eps / (1.0 - n_eps)
}

/// Square root, correctly rounded; 0 for negative arguments, which here are always round-off.
#[inline(always)]
#[must_use]
pub fn sqrt(x: f32) -> f32 {
    libm::sqrtf(if x > 0.0 { x } else { 0.0 })
}

/// Square roots, as [`sqrt`].
#[inline(always)]
#[must_use]
pub fn sqrt_of_four(x: Vec4) -> Vec4 {
    let x = Vec4::select(x.cmpgt(Vec4::ZERO), x, Vec4::ZERO);
    Vec4::new(libm::sqrtf(x.x), libm::sqrtf(x.y), libm::sqrtf(x.z), libm::sqrtf(x.w))
}

/// The larger of two numbers; `b` when `a` is NaN. A single instruction, which `f32::max` is not.
#[inline(always)]
#[must_use]
pub fn larger(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}

/// `x` in `[low, high]`: the nearest there, and `low` for NaN.
#[inline(always)]
#[must_use]
pub fn clamp(x: f32, low: f32, high: f32) -> f32 {
    let x = larger(x, low);
    if x < high { x } else { high }
}

/// `x` less the largest whole number below it, in `[0, 1)`; 0 for NaN, and where `f32` has no fractions.
#[inline]
#[must_use]
pub fn fraction(x: f32) -> f32 {
    let rest = x - (x as i32) as f32;
    let rest = if rest < 0.0 { rest + 1.0 } else { rest };
    if (0.0..1.0).contains(&rest) { rest } else { 0.0 }
}

/// `x` in `[0, 1)`: the nearest there, and 0 for NaN.
#[inline]
#[must_use]
pub fn clamp_unit(x: f32) -> f32 {
    if x > 0.0 { x.min(ONE_MINUS_EPSILON) } else { 0.0 }
}

/// `x` to the power `y`.
#[inline]
#[must_use]
pub fn pow(x: f32, y: f32) -> f32 {
    libm::powf(x, y)
}

/// `e^x − 1`, accurate near 0.
#[inline]
#[must_use]
pub fn exp_m1(x: f32) -> f32 {
    libm::expm1f(x)
}

/// `e^x`.
#[inline]
#[must_use]
pub fn exp(x: f32) -> f32 {
    libm::expf(x)
}

/// Natural logarithm.
#[inline]
#[must_use]
pub fn ln(x: f32) -> f32 {
    libm::logf(x)
}

/// `ln(1 + x)`, accurate near 0.
#[inline]
#[must_use]
pub fn ln_1p(x: f32) -> f32 {
    libm::log1pf(x)
}

/// `Σ a_i b_i` as if in twice the precision, rounded once: keeps its digits when the terms cancel.
///
/// Source: Ogita, Rump, Oishi 2005, *Accurate Sum and Dot Product*, SIAM J. Sci. Comput. 26(6),
/// algorithm 5.3. Differs: terms too large for its splitting are summed plainly.
#[must_use]
pub fn sum_of_products<const N: usize>(a: [f32; N], b: [f32; N]) -> f32 {
    let (mut sum, mut error) = (0.0, 0.0);
    for i in 0..N {
        let (product, low) = exact_product(a[i], b[i]);
        let next = sum + product;
        let part = next - sum;
        error += (sum - (next - part)) + (product - part) + low;
        sum = next;
    }
    if error.is_finite() { sum + error } else { sum }
}

/// A product and its rounding error, without a fused multiply-add.
///
/// Source: Dekker 1971, *A Floating-Point Technique for Extending the Available Precision*, Numer.
/// Math. 18, section 5; the halves have 12 bits.
#[inline]
fn exact_product(a: f32, b: f32) -> (f32, f32) {
    let halves = |x: f32| {
        let scaled = 4097.0 * x;
        let high = scaled - (scaled - x);
        (high, x - high)
    };
    let ((ah, al), (bh, bl)) = (halves(a), halves(b));
    let product = a * b;
    (product, al * bl - (((product - ah * bh) - al * bh) - ah * bl))
}

/// Arc cosine (rad); the argument is clamped to `[−1, 1]`.
#[inline]
#[must_use]
pub fn acos(x: f32) -> f32 {
    libm::acosf(x.clamp(-1.0, 1.0))
}

/// Tangent of an angle (rad).
#[inline]
#[must_use]
pub fn tan(x: f32) -> f32 {
    libm::tanf(x)
}

/// A well-mixed 32-bit hash: neighbouring inputs give unrelated outputs.
///
/// Source: Wellons 2018, *Prospecting for Hash Functions*, "lowbias32" as improved by
/// The-Traveller-Robot (bias 0.107).
#[inline]
#[must_use]
pub const fn hash(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x21f0_aaad);
    x ^= x >> 15;
    x = x.wrapping_mul(0xd35a_2d97);
    x ^ (x >> 15)
}

/// Hash of two words, in order.
#[inline]
#[must_use]
pub const fn hash2(a: u32, b: u32) -> u32 {
    hash(a ^ hash(b).wrapping_add(0x9e37_79b9))
}

/// A uniform number in `[0, 1)` from the upper 24 bits of `bits`; never 1.
#[inline]
#[must_use]
pub const fn unit_f32(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sums_of_products_survive_cancellation() {
        for i in 0..10_000u32 {
            let random = |j| unit_f32(hash2(i, j)) - 0.5;
            let a = [random(0), random(1), random(2)];
            let b = [random(3), random(4), -(a[0] * random(3) + a[1] * random(4)) / a[2]];
            let exact: f64 = (0..3).map(|j| f64::from(a[j]) * f64::from(b[j])).sum();
            let got = f64::from(sum_of_products(a, b));
            assert!((got - exact).abs() <= 1e-7 * exact.abs() + 1e-13, "{a:?} {b:?} {got} {exact}");
        }
    }

    #[test]
    fn sums_of_huge_products_stay_finite() {
        assert_eq!(sum_of_products([1e36, 1.0], [1.0, 1.0]), 1e36);
    }
}
