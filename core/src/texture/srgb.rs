//! The sRGB transfer curve.

/// Linear value of each 8-bit sRGB code.
static SRGB: [f32; 256] = table();

/// From an 8-bit sRGB code to its linear value, in `[0, 1]`.
///
/// Source: IEC 61966-2-1:1999.
#[inline]
pub(super) fn srgb8_to_linear(code: u8) -> f32 {
    SRGB[code as usize]
}

const fn table() -> [f32; 256] {
    let (mut table, mut code) = ([0.0; 256], 0);
    while code < 256 {
        table[code] = decode(code as f64 / 255.0) as f32;
        code += 1;
    }
    table
}

/// `c / 12.92` below 0.04045, `((c + 0.055) / 1.055)^2.4` above.
const fn decode(c: f64) -> f64 {
    if c <= 0.040_45 {
        return c / 12.92;
    }
    let x = (c + 0.055) / 1.055;
    // x^2.4 = x² · x^(2/5), by Newton's method on y⁵ = x² from above.
    let square = x * x;
    let (mut y, mut step) = (1.0, 0);
    while step < 40 {
        let fourth = y * y * y * y;
        y -= (fourth * y - square) / (5.0 * fourth);
        step += 1;
    }
    square * y
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_are_those_of_the_standard() {
        for code in 0..=255_u8 {
            let c = f64::from(code) / 255.0;
            let exact = if c <= 0.040_45 { c / 12.92 } else { libm::pow((c + 0.055) / 1.055, 2.4) };
            assert_eq!(srgb8_to_linear(code), exact as f32, "{code}");
        }
        assert_eq!((srgb8_to_linear(0), srgb8_to_linear(255)), (0.0, 1.0));
    }
}
