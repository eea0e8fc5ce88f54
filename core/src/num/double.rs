//! What single precision is too short for.

/// `π/2` in two parts: the first has 33 bits, so that its products with a quarter count are exact.
const QUARTER: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];

/// A number that leaves no room for a fraction: added and taken away again, it rounds to an integer.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// Coefficients of the cosine, and of the sine over its angle, in the angle's square: `(−1)ⁱ / (2i)!` and
/// `(−1)ⁱ / (2i + 1)!`.
const TAYLOR: [[f64; 2]; 9] = {
    let mut all = [[1.0; 2]; 9];
    let mut i = 1;
    while i < all.len() {
        let even = 2.0 * i as f64;
        let cos = -all[i - 1][1] / even;
        all[i] = [cos, cos / (even + 1.0)];
        i += 1;
    }
    all
};

/// Square root in double precision; NaN below 0.
#[inline]
#[must_use]
pub fn sqrt_in_double(x: f64) -> f64 {
    libm::sqrt(x)
}

/// Angle of the vector (x, y) in double precision (rad), in `[−π, π]`.
#[inline]
#[must_use]
pub fn atan2_in_double(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Sine and cosine in double precision of an angle (rad).
///
/// * `x` – within `±100`; not right beyond, so that programs have no code that brings any angle near 0
///
/// Within 3e-16. Derived: of what is left of the quarters, at most `π/4`, Taylor's series; what they leave
/// out is below 1e-18.
#[cfg_attr(not(feature = "small"), inline)]
#[must_use]
pub fn sin_cos_in_double(x: f64) -> (f64, f64) {
    let shifted = x * core::f64::consts::FRAC_2_PI + ROUNDING;
    let quarters = shifted - ROUNDING;
    let rest = QUARTER.iter().fold(x, |rest, part| rest - quarters * part);
    let square = rest * rest;
    let [cos, sin] = TAYLOR
        .iter()
        .rev()
        .fold([0.0; 2], |sum, terms| [square * sum[0] + terms[0], square * sum[1] + terms[1]]);
    let sin = rest * sin;
    match shifted.to_bits() & 3 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sines_and_cosines_agree_with_those_of_libm() {
        for i in -100_000..=100_000 {
            let x = f64::from(i) * 1e-3;
            let ((sin, cos), exact) = (sin_cos_in_double(x), libm::sincos(x));
            assert!((sin - exact.0).abs() <= 3e-16 && (cos - exact.1).abs() <= 3e-16, "{x}");
        }
        for quarters in -8..=8 {
            let x = f64::from(quarters) * core::f64::consts::FRAC_PI_2;
            let ((sin, cos), exact) = (sin_cos_in_double(x), libm::sincos(x));
            let small = if quarters % 2 == 0 { sin - exact.0 } else { cos - exact.1 };
            assert!(small.abs() < 1e-24, "{x} {small}");
        }
        assert!(sin_cos_in_double(f64::NAN).0.is_nan());
    }
}
