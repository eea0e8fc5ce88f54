//! The sRGB transfer curve.
//!
//! Source: IEC 61966-2-1:1999.

use halflight::num::pow;

/// From a linear value to its sRGB code; both in `[0, 1]`, what lies outside is cut off, NaN is 0.
pub(crate) fn encode(linear: f32) -> f32 {
    let x = if linear > 0.0 { linear.min(1.0) } else { 0.0 };
    if x <= 0.003_130_8 { 12.92 * x } else { 1.055 * pow(x, 1.0 / 2.4) - 0.055 }
}

/// From an sRGB code to its linear value.
pub(crate) fn decode(code: f32) -> f32 {
    if code <= 0.040_45 { code / 12.92 } else { pow((code + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_the_round_trip() {
        for byte in 0..=255_u8 {
            let linear = decode(f32::from(byte) / 255.0);
            assert_eq!((encode(linear) * 255.0).round() as u8, byte);
        }
    }

    #[test]
    fn what_cannot_be_shown_is_cut_off() {
        assert_eq!(encode(-1.0), 0.0);
        assert_eq!(encode(f32::NAN), 0.0);
        assert!((encode(f32::INFINITY) - 1.0).abs() < 1e-6);
        assert!((encode(0.5) - 0.735_356_9).abs() < 1e-5);
    }
}
