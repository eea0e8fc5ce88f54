//! Views: from linear light to the codes that a display is given.

use super::encode;
use crate::args::{Showing, View};
use halflight::Rgb;
use halflight::num::{ln, pow};
use std::f32::consts::LOG2_E;

/// A matrix, row by row.
type Rows = [[f32; 3]; 3];

/// Light beyond this is this bright: far above what any view tells from white, and its square is finite.
const BRIGHTEST: f32 = 1e9;

impl View {
    /// The codes for a linear colour (Rec. 709), each in `[0, 1]`. What is negative or NaN counts as 0.
    pub(crate) fn codes(self, linear: Rgb) -> Rgb {
        let light = linear.map(|v| if v > 0.0 { v.min(BRIGHTEST) } else { 0.0 });
        match self {
            Self::Standard => light.map(encode),
            Self::Agx => agx(light),
            Self::Aces => aces(light).map(encode),
            Self::KhronosNeutral => khronos_neutral(light).map(encode),
            Self::None => light.map(unit),
        }
    }
}

impl Showing {
    /// The codes for linear colours, each in `[0, 1]`.
    pub(crate) fn codes(&self, pixels: &[Rgb]) -> impl Iterator<Item = [f32; 3]> {
        let (view, gain) = (self.view.unwrap_or_default(), pow(2.0, self.exposure.unwrap_or(0.0)));
        pixels.iter().map(move |&p| view.codes(p * gain).to_array())
    }
}

/// Cut off to `[0, 1]`.
fn unit(x: f32) -> f32 {
    x.clamp(0.0, 1.0)
}

/// AgX without a look; its codes are for a display of exponent 2.2 and given to it as they are.
///
/// Source: Sobotka 2022, AgX (the configuration of OpenColorIO, github.com/sobotka/AgX); its curve as the
/// polynomial of Wrensch 2023, "Minimal AgX Implementation" (mean squared error 3.7e-6).
fn agx(light: Rgb) -> Rgb {
    const INSET: Rows = [
        [0.842_479_06, 0.078_433_6, 0.079_223_745],
        [0.042_328_224, 0.878_468_64, 0.079_166_13],
        [0.042_375_655, 0.078_433_6, 0.879_143],
    ];
    const OUTSET: Rows = [
        [1.196_879, -0.098_020_88, -0.099_029_74],
        [-0.052_896_757, 1.151_903_1, -0.098_961_18],
        [-0.052_971_636, -0.098_043_45, 1.151_073_7],
    ];
    // Stops around 1 that the curve takes in: from 10 below middle grey to 6.5 above it.
    const STOPS: [f32; 2] = [-12.473_93, 4.026_069];
    let curve = |v: f32| {
        let x = unit((ln(v) * LOG2_E - STOPS[0]) / (STOPS[1] - STOPS[0]));
        let coefficients = [15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.002_32];
        coefficients.into_iter().fold(0.0, |sum: f32, c| sum * x + c)
    };
    multiply(&OUTSET, multiply(&INSET, light).map(curve)).map(unit)
}

/// ACES: from sRGB to AP1, the reference rendering and output transforms, and back; linear.
///
/// Source: Hill 2016, `ACES.hlsl` in Pettineo's BakingLab, a fit of ACES 1.0. Differs: no brightening
/// before it, as some renderers have it (0.18 becomes 0.106); `--exposure 0.74` does the same.
fn aces(light: Rgb) -> Rgb {
    const TO_AP1: Rows =
        [[0.597_19, 0.354_58, 0.048_23], [0.076, 0.908_34, 0.015_66], [0.028_4, 0.133_83, 0.837_77]];
    const FROM_AP1: Rows = [
        [1.604_75, -0.531_08, -0.073_67],
        [-0.102_08, 1.108_13, -0.006_05],
        [-0.003_27, -0.072_76, 1.076_02],
    ];
    let curve =
        |v: f32| (v * (v + 0.024_578_6) - 0.000_090_537) / (v * (0.983_729 * v + 0.432_951) + 0.238_081);
    multiply(&FROM_AP1, multiply(&TO_AP1, light).map(curve)).map(unit)
}

/// Khronos PBR Neutral: less the reflection at normal incidence, and highlights compressed; linear.
///
/// Source: Khronos Group 2024, "Khronos PBR Neutral Tone Mapper", specification.
fn khronos_neutral(light: Rgb) -> Rgb {
    const REFLECTED: f32 = 0.04;
    const START: f32 = 0.8 - REFLECTED;
    const DESATURATION: f32 = 0.15;
    let least = light.r.min(light.g).min(light.b);
    let offset = if least < 2.0 * REFLECTED { least - least * least / (4.0 * REFLECTED) } else { REFLECTED };
    let light = light.map(|v| v - offset);
    let peak = light.max_component();
    if peak < START {
        return light;
    }
    let room = 1.0 - START;
    let compressed = 1.0 - room * room / (peak + room - START);
    let white = 1.0 - 1.0 / (DESATURATION * (peak - compressed) + 1.0);
    light.map(|v| v * (compressed / peak)).map(|v| v + (compressed - v) * white)
}

/// A matrix times a colour.
fn multiply(rows: &Rows, v: Rgb) -> Rgb {
    let [r, g, b] = rows.map(|row| row[0] * v.r + row[1] * v.g + row[2] * v.b);
    Rgb::new(r, g, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::ValueEnum;

    /// Codes of colours, computed in double precision from the published formulas.
    const PUBLISHED: [(View, [f32; 3], [f32; 3]); 15] = [
        (View::Agx, [0.18, 0.18, 0.18], [0.496676, 0.496745, 0.496749]),
        (View::Agx, [1.0, 1.0, 1.0], [0.786745, 0.786885, 0.786893]),
        (View::Agx, [0.8, 0.1, 0.02], [0.800259, 0.425595, 0.273089]),
        (View::Agx, [0.05, 0.4, 4.0], [0.597527, 0.711181, 0.960715]),
        (View::Agx, [16.0, 8.0, 0.0], [1.000000, 0.982457, 0.800081]),
        (View::Aces, [0.18, 0.18, 0.18], [0.358457, 0.358457, 0.358456]),
        (View::Aces, [1.0, 1.0, 1.0], [0.808954, 0.808954, 0.808950]),
        (View::Aces, [0.8, 0.1, 0.02], [0.780903, 0.251291, 0.094020]),
        (View::Aces, [0.05, 0.4, 4.0], [0.479305, 0.604752, 0.970233]),
        (View::Aces, [16.0, 8.0, 0.0], [1.000000, 0.984828, 0.867456]),
        (View::KhronosNeutral, [0.18, 0.18, 0.18], [0.410021, 0.410021, 0.410021]),
        (View::KhronosNeutral, [1.0, 1.0, 1.0], [0.940091, 0.940091, 0.940091]),
        (View::KhronosNeutral, [0.8, 0.1, 0.02], [0.896534, 0.318054, 0.035128]),
        (View::KhronosNeutral, [0.05, 0.4, 4.0], [0.589644, 0.639453, 0.992615]),
        (View::KhronosNeutral, [16.0, 8.0, 0.0], [0.998363, 0.927549, 0.848753]),
    ];

    #[test]
    fn colours_are_those_of_the_published_formulas() {
        for (view, colour, expected) in PUBLISHED {
            let codes = view.codes(Rgb::from(colour)).to_array();
            for (code, expected) in codes.into_iter().zip(expected) {
                assert!((code - expected).abs() < 1e-5, "{view:?} of {colour:?}: {codes:?}");
            }
        }
    }

    #[test]
    fn black_is_black_and_more_light_is_never_darker() {
        for view in View::value_variants() {
            assert_eq!(view.codes(Rgb::BLACK).map(|v| (v * 255.0).round()), Rgb::BLACK, "{view:?}");
            let mut last = -1.0;
            for step in -4000..4000 {
                let grey = view.codes(Rgb::splat((step as f32 / 100.0).exp2()));
                assert!(grey.g >= last - 1e-6, "{view:?} at 2^({step}/100): {grey:?} after {last}");
                last = grey.g;
            }
            assert!(last > 0.995, "{view:?}: white is {last}");
        }
    }

    #[test]
    fn grey_stays_grey() {
        for view in View::value_variants() {
            for step in -40..40 {
                let Rgb { r, g, b } = view.codes(Rgb::splat((step as f32 / 4.0).exp2()));
                let apart = r.max(g).max(b) - r.min(g).min(b);
                // What the digits of the matrices leave; below half a code of 8 bits.
                assert!(apart < 5e-4, "{view:?}: {r} {g} {b}");
            }
        }
    }

    #[test]
    fn whatever_comes_in_a_code_comes_out() {
        let odd = [0.0, -0.0, -1.0, 1e-45, 1e-20, 1.0, 1e20, f32::MAX, f32::INFINITY, f32::NAN];
        for view in View::value_variants() {
            for (r, g, b) in odd.iter().flat_map(|r| odd.iter().flat_map(move |g| odd.map(|b| (*r, *g, b)))) {
                let codes = view.codes(Rgb::new(r, g, b)).to_array();
                assert!(codes.iter().all(|c| (0.0..=1.0).contains(c)), "{view:?} of {r} {g} {b}: {codes:?}");
            }
        }
    }
}
