//! Sine, cosine and the angle of a vector, as light sampling needs them.
//!
//! A sample by solid angle takes one of each, and a quarter of its time when they come from `libm`,
//! which carries its intermediates in `f64` and branches over the arguments. These are polynomials
//! in `f32` without branches, each within some 2 units in the last place.
//!
//! Derived: the coefficients are minimax fits of the relative error (Lawson's reweighted least
//! squares), rounded one after the other with the rest fitted anew.

use super::{FRAC_PI_2, PI, TAU};
use glam::Vec4;

/// `(sin x − x) / x³` in `x²` for `|x| ≤ π/4`: 4e-9 of the sine.
const SIN: [f32; 3] = [-0.166_666_55, 0.008_332_188, -0.000_195_181];

/// `(cos x − 1 + x²/2) / x⁴` in `x²` for `|x| ≤ π/4`: 2e-10 of the cosine.
const COS: [f32; 3] = [0.041_666_646, -0.001_388_731, 2.443_233e-5];

/// `(atan t − t) / t³` in `t²` for `|t| ≤ 1`: 2e-8 of the angle.
const ATAN: [f32; 8] = [
    -0.333_331_53,
    0.199_937_67,
    -0.142_110_03,
    0.106_657_855,
    -0.075_517_24,
    0.043_205_857,
    -0.016_364_133,
    0.002_919_722_8,
];

/// `π/2` in four parts: all but the last have 11 bits, so that their products with a quarter count
/// below 2¹³ are exact, and angles next to a multiple of a quarter keep their digits.
const QUARTER: [f32; 4] = [1.570_312_5, 4.837_513e-4, 7.549_533_6e-8, 2.563_344_2e-12];

/// Farthest angle that the parts of a quarter bring near 0 (rad).
const FAR: f32 = 100.0;

/// A number that leaves no room for a fraction: added and taken away again, it rounds to an integer.
const ROUNDING: f32 = 12_582_912.0;

/// Sine and cosine of an angle (rad).
///
/// Within 2 units in the last place for angles up to 100 rad; beyond, as `libm`.
#[inline]
#[must_use]
pub fn sin_cos(x: f32) -> (f32, f32) {
    // NaN goes the long way too.
    if x.abs() <= FAR { sin_cos_near(x) } else { sin_cos_far(x) }
}

/// The same of an angle that its maker keeps within 100 rad: without what is for others, which a program
/// then does not have. Not right beyond.
#[inline]
#[must_use]
pub(crate) fn sin_cos_near(x: f32) -> (f32, f32) {
    let shifted = x * (1.0 / FRAC_PI_2) + ROUNDING;
    let quarters = shifted - ROUNDING;
    let rest = QUARTER.iter().fold(x, |rest, part| rest - quarters * part);
    in_quarter(rest, shifted.to_bits())
}

#[cold]
fn sin_cos_far(x: f32) -> (f32, f32) {
    libm::sincosf(x)
}

/// Sine and cosine of an angle in turns: of `2π u`.
///
/// * `u` – `|u| < 2²⁰`
///
/// Within 2 units in the last place of the angle that `u` says: no `2π` is rounded before the
/// quarters are taken off.
#[inline]
#[must_use]
pub fn sin_cos_turns(u: f32) -> (f32, f32) {
    let shifted = 4.0 * u + ROUNDING;
    let rest = u - 0.25 * (shifted - ROUNDING);
    in_quarter(TAU * rest, shifted.to_bits())
}

/// Sine and cosine of `x` and some quarters, of which the two low bits count.
#[inline]
fn in_quarter(x: f32, quarters: u32) -> (f32, f32) {
    let s = x * x;
    let sin = x + x * s * (SIN[0] + s * (SIN[1] + s * SIN[2]));
    let cos = 1.0 - (0.5 * s - s * s * (COS[0] + s * (COS[1] + s * COS[2])));
    let (sin, cos) = if quarters & 1 == 0 { (sin, cos) } else { (cos, sin) };
    let sign = |bits: u32| (bits & 2) << 30;
    (
        f32::from_bits(sin.to_bits() ^ sign(quarters)),
        f32::from_bits(cos.to_bits() ^ sign(quarters.wrapping_add(1))),
    )
}

/// Angle of the vector (x, y) (rad), in `[−π, π]`, with the sign of `y`; 0 of the zero vector.
///
/// Within 2.2 units in the last place. NaN when a coordinate is, or both are infinite.
#[inline]
#[must_use]
pub fn atan2(y: f32, x: f32) -> f32 {
    let (x_size, y_size) = (x.abs(), y.abs());
    let steep = y_size > x_size;
    let (short, long) = if steep { (x_size, y_size) } else { (y_size, x_size) };
    let t = if long == 0.0 { 0.0 } else { short / long };
    let (s, c) = (t * t, &ATAN);
    // In pairs: half as many steps wait for each other.
    let (s2, low, high) = (s * s, [c[0] + s * c[1], c[2] + s * c[3]], [c[4] + s * c[5], c[6] + s * c[7]]);
    let angle = t + t * s * (low[0] + s2 * low[1] + s2 * s2 * (high[0] + s2 * high[1]));
    let angle = if steep { FRAC_PI_2 - angle } else { angle };
    let angle = if x < 0.0 { PI - angle } else { angle };
    angle.copysign(y)
}

/// Four angles, each as of [`atan2`], of vectors with `y ≥ 0` of which not both coordinates are 0.
#[inline(always)]
#[must_use]
pub fn atan2_of_four(y: Vec4, x: Vec4) -> Vec4 {
    let x_size = x.abs();
    let steep = y.cmpgt(x_size);
    let t = Vec4::select(steep, x_size, y) / Vec4::select(steep, y, x_size);
    let (s, c) = (t * t, &ATAN);
    let (s2, low, high) = (s * s, [s * c[1] + c[0], s * c[3] + c[2]], [s * c[5] + c[4], s * c[7] + c[6]]);
    let angle = t + t * s * (low[0] + s2 * low[1] + s2 * s2 * (high[0] + s2 * high[1]));
    let angle = Vec4::select(steep, FRAC_PI_2 - angle, angle);
    Vec4::select(x.cmplt(Vec4::ZERO), PI - angle, angle)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::{hash, unit_f32};

    /// Distance of `seen` from `exact`, in units in the last place of the latter.
    fn ulps(seen: f32, exact: f64) -> f64 {
        let size = exact.abs() as f32;
        let unit = f64::from(size.max(f32::MIN_POSITIVE).next_up()) - f64::from(size.max(f32::MIN_POSITIVE));
        (f64::from(seen) - exact).abs() / unit
    }

    #[track_caller]
    fn close((sin, cos): (f32, f32), angle: f64, what: f32) {
        let worst = ulps(sin, angle.sin()).max(ulps(cos, angle.cos()));
        assert!(worst <= 2.0, "{what}: {worst} ulp");
    }

    #[test]
    fn sines_and_cosines_are_within_two_ulp() {
        // One in 61 of all numbers up to the farthest angle, and all next to multiples of a quarter.
        for bits in (0..FAR.to_bits()).step_by(61) {
            let x = f32::from_bits(bits);
            close(sin_cos(x), x.into(), x);
            close(sin_cos(-x), (-x).into(), -x);
        }
        for k in 0..63_u8 {
            let x = f32::from(k) * FRAC_PI_2;
            for bits in x.to_bits().saturating_sub(2000)..x.to_bits() + 2000 {
                let x = f32::from_bits(bits);
                close(sin_cos(x), x.into(), x);
            }
        }
        assert!(sin_cos(f32::NAN).0.is_nan() && sin_cos(f32::INFINITY).1.is_nan());
        assert_eq!(sin_cos(1e5), libm::sincosf(1e5));
    }

    #[test]
    fn turns_are_within_two_ulp() {
        for i in 0..1 << 24 {
            // Quarters are taken off, as `f64` has no exact zero but at 0.
            let u = unit_f32(i << 8);
            let (sin, cos) = sin_cos_turns(u);
            let (right, (sin, cos)) = match (4.0 * u).round() as u8 & 3 {
                0 => (0.0, (sin, cos)),
                1 => (0.25, (-cos, sin)),
                2 => (0.5, (-sin, -cos)),
                _ => (0.75, (cos, -sin)),
            };
            let rest = if u > 0.875 { u - 1.0 } else { u - right };
            close((sin, cos), f64::from(rest) * core::f64::consts::TAU, u);
        }
        for [u, sin, cos] in [[0.0, 0.0, 1.0], [0.25, 1.0, 0.0], [0.5, 0.0, -1.0], [0.75, -1.0, 0.0]] {
            assert_eq!(sin_cos_turns(u), (sin, cos));
        }
    }

    #[track_caller]
    fn check_angle(y: f32, x: f32) {
        let worst = ulps(atan2(y, x), f64::from(y).atan2(f64::from(x)));
        assert!(worst <= 2.2, "{y} {x}: {worst} ulp");
    }

    #[test]
    fn angles_are_within_two_ulp() {
        for i in 0..1 << 22 {
            let [a, b] = [unit_f32(hash(i)), unit_f32(hash(!i))];
            // Every ratio between 2⁻⁶⁰ and 2⁶⁰, all quadrants, all sizes.
            let x = (a - 0.5) * libm::exp2f(120.0 * (b - 0.5));
            let y = b - 0.5;
            for scale in [1.0, 1e-20, 1e18] {
                let (x, y) = (x * scale, y * scale);
                if x.abs() < f32::MIN_POSITIVE || x.abs() > 1e37 {
                    continue;
                }
                check_angle(y, x);
            }
        }
    }

    #[test]
    fn four_angles_are_those_of_each() {
        for i in 0..1 << 16 {
            let random =
                |j: u32| (unit_f32(hash(4 * i + j)) - 0.5) * libm::exp2f(unit_f32(hash(!(4 * i + j))) * 60.0);
            let (x, y) = ([0, 1, 2, 3].map(random), [4, 5, 6, 7].map(|j| random(j).abs()));
            let seen = atan2_of_four(y.into(), x.into()).to_array();
            for k in 0..4 {
                assert_eq!(seen[k], atan2(y[k], x[k]), "{} {}", y[k], x[k]);
            }
        }
    }

    #[test]
    fn angles_of_axes_and_extremes_are_right() {
        let values = [0.0, 1.0, 1e-45, 1e-38, 3.4e38, f32::INFINITY];
        for (y, x) in values.into_iter().flat_map(|y| values.map(|x| (y, x))) {
            if y == f32::INFINITY && x == f32::INFINITY {
                continue;
            }
            for (y, x) in [(y, x), (-y, x), (y, -x), (-y, -x)] {
                if x != 0.0 || y != 0.0 {
                    check_angle(y, x);
                }
            }
        }
        assert_eq!(atan2(0.0, -0.0), 0.0);
        assert!(atan2(f32::NAN, 1.0).is_nan() && atan2(1.0, f32::NAN).is_nan());
    }
}
