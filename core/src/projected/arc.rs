//! The length of an arc over its chord, and how it changes.

use crate::num::lanes::Number;

/// Coefficients of `atan(√x) / √x` in powers of x for `x` in `[0, 1.25]`: error at most 3e-8, of the
/// derivative at most 2.1e-6. Derived: interpolation at the Chebyshev nodes of that range.
const ATAN: [f32; 10] = [
    1.0,
    -0.333_331_1,
    0.199_939_6,
    -0.142_205_48,
    0.107_423_57,
    -0.078_351_63,
    0.048_888_918,
    -0.022_720_901,
    0.006_650_957_3,
    -0.000_895_753_6,
];

/// `H(x) = atan(√x) / √x` for `x` in `[0, 1.25]`.
#[inline]
pub(super) fn atan_ratio<T: Number>(x: T) -> T {
    let [rest @ .., last] = ATAN;
    rest.iter().rev().fold(x * 0.0 + last, |h, c| h * x + *c)
}

/// `H(x)` and `(H(x) − H(y)) / (x − y)`, also for `x = y`; both in `[0, 1.25]`.
///
/// Derived: Horner's rule divides by `x − y` as it goes, so that nothing cancels.
#[inline]
pub(super) fn atan_ratio_and_slope<T: Number>(x: T, y: T) -> (T, T) {
    let [c0, rest @ .., c8, c9] = ATAN;
    let start = (x * c9 + c8, y * 0.0 + c9);
    let (h, slope) = rest.iter().rev().fold(start, |(h, slope), c| (h * x + *c, slope * y + h));
    (h * x + c0, slope * y + h)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(x: f64) -> f64 {
        x.sqrt().atan() / x.sqrt()
    }

    #[test]
    fn value_and_slope_follow_the_arc_tangent() {
        for i in 1..=1250u16 {
            let x = f32::from(i) * 1e-3;
            assert!((f64::from(atan_ratio(x)) - exact(f64::from(x))).abs() < 1.5e-7, "{x}");
            for y in [1e-3, 0.3, 0.999 * x, 1.25] {
                let (h, slope) = atan_ratio_and_slope(x, y);
                let (x, y) = (f64::from(x), f64::from(y));
                assert_eq!(h, atan_ratio(x as f32));
                if (x - y).abs() > 1e-4 {
                    let expected = (exact(x) - exact(y)) / (x - y);
                    assert!((f64::from(slope) - expected).abs() < 4e-6, "{x} {y} {slope} {expected}");
                }
            }
        }
    }
}
