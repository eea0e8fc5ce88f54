//! FLIP: the difference that people see when they flip between two pictures.

use super::convolve::{Plane, normalized, weights};
use crate::picture::Picture;
use halflight::Rgb;
use std::f32::consts::PI;

/// Pixels per degree of sight: 0.7 m before a screen of 0.7 m and 3840 columns.
const PIXELS_PER_DEGREE: f32 = 0.7 * 3840.0 / 0.7 * PI / 180.0;

/// White of sRGB in XYZ (D65).
const WHITE: [f32; 3] = [0.950_428_55, 1.0, 1.088_900_4];

/// The error of each pixel, 0 for none and 1 for the largest, of pictures of one size as shown, cut off at
/// white.
///
/// Source: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild 2020, *FLIP: A Difference
/// Evaluator for Alternating Images*, Proceedings of the ACM on Computer Graphics and Interactive
/// Techniques 3(2), section 4 and appendix A.
pub(crate) fn flip(picture: &Picture, reference: &Picture) -> Vec<f32> {
    let [test, truth] = [picture, reference].map(Seen::new);
    let largest = hyab(hunt(lab([0.0, 1.0, 0.0])), hunt(lab([0.0, 0.0, 1.0]))).powf(0.7);
    (0..truth.lab.len())
        .map(|i| {
            let colour = redistributed(hyab(truth.lab[i], test.lab[i]).powf(0.7), largest);
            let apart = |of: fn(&Seen) -> &Vec<f32>| (of(&truth)[i] - of(&test)[i]).abs();
            let feature = apart(|seen| &seen.edges).max(apart(|seen| &seen.points));
            let feature = (feature * std::f32::consts::FRAC_1_SQRT_2).sqrt().min(1.0);
            colour.powf(1.0 - feature)
        })
        .collect()
}

/// What is seen of a picture.
struct Seen {
    /// Colours after the eye's blur, in L*a*b* with the Hunt effect.
    lab: Vec<[f32; 3]>,
    /// How much of an edge and of a point there is.
    edges: Vec<f32>,
    points: Vec<f32>,
}

impl Seen {
    fn new(picture: &Picture) -> Self {
        let (width, height) = (picture.width as usize, picture.height as usize);
        // As the 8-bit codes that are shown, without their rounding.
        let shown: Vec<[f32; 3]> = picture.pixels.iter().map(|p| p.map(cut).to_array()).collect();
        let opponent: Vec<[f32; 3]> = shown.iter().map(|c| to_opponent(xyz(*c))).collect();
        let plane = |channel: usize| Plane::new(width, height, |i| opponent[i][channel]);
        let lightness = Plane::new(width, height, |i| (opponent[i][0] + 16.0) / 116.0);
        let [y, cx, cz] = [0, 1, 2].map(|channel| blurred(&plane(channel), channel));
        let blurred = |i: usize| [y.values[i], cx.values[i], cz.values[i]];
        let lab = (0..width * height).map(|i| hunt(lab(rgb(from_opponent(blurred(i))).map(cut)))).collect();
        Self { lab, edges: features(&lightness, false), points: features(&lightness, true) }
    }
}

fn cut(x: f32) -> f32 {
    if x > 0.0 { x.min(1.0) } else { 0.0 }
}

/// Blurs as the eye does at this distance: achromatic, red-green, blue-yellow.
fn blurred(plane: &Plane, channel: usize) -> Plane {
    // Weight and width of the Gaussians: table 1 of the paper.
    let gaussians: &[[f32; 2]] =
        [&[[1.0, 0.0047]][..], &[[1.0, 0.0053]], &[[34.1, 0.04], [13.5, 0.025]]][channel];
    let radius = (3.0 * (0.04 / (2.0 * PI * PI)).sqrt() * PIXELS_PER_DEGREE).ceil() as usize;
    let parts = gaussians.iter().map(|&[a, b]| {
        let kernel = weights(radius, |x| (-(PI * x / PIXELS_PER_DEGREE).powi(2) / b).exp());
        let sum: f32 = kernel.iter().sum();
        let kernel = normalized(kernel);
        (a * (PI / b).sqrt() * sum * sum, plane.convolved(&kernel, &kernel))
    });
    let parts: Vec<(f32, Plane)> = parts.collect();
    let total: f32 = parts.iter().map(|(share, _)| share).sum();
    Plane::new(plane.width, plane.height, |i| {
        parts.iter().map(|(share, part)| share / total * part.values[i]).sum()
    })
}

/// Length of the first derivative, or of the second, of the lightness after a blur.
fn features(lightness: &Plane, points: bool) -> Vec<f32> {
    let deviation = 0.5 * 0.082 * PIXELS_PER_DEGREE;
    let radius = (3.0 * deviation).ceil() as usize;
    let gauss = |x: f32| (-0.5 * (x / deviation).powi(2)).exp();
    let derivative = weights(radius, |x| {
        let factor = if points { (x / deviation).powi(2) - 1.0 } else { -x };
        factor * gauss(x)
    });
    let (above, below): (Vec<f32>, Vec<f32>) = derivative.iter().partition(|w| **w > 0.0);
    let (above, below) = (above.iter().sum::<f32>(), -below.iter().sum::<f32>());
    let derivative: Vec<f32> = derivative.iter().map(|w| w / if *w > 0.0 { above } else { below }).collect();
    let blur = normalized(weights(radius, gauss));
    let (dx, dy) = (lightness.convolved(&derivative, &blur), lightness.convolved(&blur, &derivative));
    dx.values.iter().zip(&dy.values).map(|(x, y)| x.hypot(*y)).collect()
}

/// Spreads colour differences up to the `largest` over `[0, 1]`, the small ones over more of it.
fn redistributed(error: f32, largest: f32) -> f32 {
    const SMALL: f32 = 0.4;
    const SHARE: f32 = 0.95;
    let bend = SMALL * largest;
    let spread = if error < bend {
        SHARE / bend * error
    } else {
        SHARE + (error - bend) / (largest - bend) * (1.0 - SHARE)
    };
    spread.min(1.0)
}

fn hyab([l1, a1, b1]: [f32; 3], [l2, a2, b2]: [f32; 3]) -> f32 {
    (l1 - l2).abs() + (a1 - a2).hypot(b1 - b2)
}

/// Colours look stronger where it is bright.
fn hunt([l, a, b]: [f32; 3]) -> [f32; 3] {
    [l, 0.01 * l * a, 0.01 * l * b]
}

/// Linear sRGB to XYZ. Source: IEC 61966-2-1:1999.
fn xyz([r, g, b]: [f32; 3]) -> [f32; 3] {
    [
        10_135_552.0 / 24_577_794.0 * r + 8_788_810.0 / 24_577_794.0 * g + 4_435_075.0 / 24_577_794.0 * b,
        2_613_072.0 / 12_288_897.0 * r + 8_788_810.0 / 12_288_897.0 * g + 887_015.0 / 12_288_897.0 * b,
        1_425_312.0 / 73_733_382.0 * r + 8_788_810.0 / 73_733_382.0 * g + 70_074_185.0 / 73_733_382.0 * b,
    ]
}

/// XYZ to linear sRGB: the inverse of [`xyz`].
fn rgb([x, y, z]: [f32; 3]) -> [f32; 3] {
    [
        3.241_003_2 * x - 1.537_398_9 * y - 0.498_615_86 * z,
        -0.969_224_3 * x + 1.875_93 * y + 0.041_554_226 * z,
        0.055_639_42 * x - 0.204_011_2 * y + 1.057_149 * z,
    ]
}

/// XYZ to an opponent space that is linear.
fn to_opponent(xyz: [f32; 3]) -> [f32; 3] {
    let [x, y, z] = [0, 1, 2].map(|i| xyz[i] / WHITE[i]);
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

fn from_opponent([l, cx, cz]: [f32; 3]) -> [f32; 3] {
    let y = (l + 16.0) / 116.0;
    [(y + cx / 500.0) * WHITE[0], y * WHITE[1], (y - cz / 200.0) * WHITE[2]]
}

/// Linear sRGB to L*a*b*. Source: ISO/CIE 11664-4:2019.
fn lab(colour: [f32; 3]) -> [f32; 3] {
    let delta = 6.0_f32 / 29.0;
    let xyz = xyz(colour);
    let [x, y, z] = [0, 1, 2].map(|i| {
        let t = xyz[i] / WHITE[i];
        if t > delta.powi(3) { t.cbrt() } else { t / (3.0 * delta * delta) + 4.0 / 29.0 }
    });
    [116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)]
}

/// The errors as a picture: from black over red and yellow to white.
pub(crate) fn heat(errors: &[f32], width: u32, height: u32) -> Picture {
    let ramp = |error: f32| {
        let step = |from: f32| crate::picture::decode((3.0 * error - from).clamp(0.0, 1.0));
        Rgb::new(step(0.0), step(1.0), step(2.0))
    };
    Picture { width, height, pixels: errors.iter().map(|&error| ramp(error)).collect() }
}
