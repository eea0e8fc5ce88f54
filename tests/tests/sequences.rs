//! What the sequences promise, held against the estimator that uses them.

use crate::estimators::{WHITE, panel};
use halflight::estimate::{Direct, Estimator};
use halflight::geom::Ray;
use halflight::glam::Vec3;
use halflight::light::SurfaceDensity;
use halflight::sequence::{AnySequence, Dimension, Random, Sequence, Sobol, ZSobol};
use halflight_tests::scenes::Stage;
use halflight_tests::{Verdict, ensure};

/// Width of the film whose pixels are sampled (pixels).
const WIDTH: u32 = 64;
/// Most samples of a pixel.
const MOST: u32 = 256;

/// A white floor under a rectangle that nothing blocks.
fn open_floor() -> Stage {
    Stage::floor(WHITE).lit(panel(Vec3::new(0.3, 1.0, 0.1), 1.0, 0.7), 3.0)
}

fn sequences() -> [(&'static str, AnySequence); 3] {
    [
        ("random", AnySequence::Random(Random::new(1))),
        ("sobol", AnySequence::Sobol(Sobol::new(1))),
        ("zsobol", AnySequence::ZSobol(ZSobol::new(1, WIDTH, MOST))),
    ]
}

/// Means of 1, 2, 4, … [`MOST`] samples of each of `pixels`. Every pixel sees the same square of the floor,
/// `side` metres wide, from straight above: pixels differ in their points alone.
fn means(
    mut sequence: AnySequence,
    surface: SurfaceDensity,
    side: f32,
    pixels: impl Iterator<Item = u32>,
) -> Vec<Vec<f64>> {
    let buffers = open_floor().build();
    let bound = buffers.bind();
    let scene = bound.scene();
    let direct = Direct { surface, ..Direct::default() };
    let of_pixel = |pixel: u32| {
        let (mut sum, mut means) = (0.0, Vec::new());
        for sample in 0..MOST {
            sequence.start(pixel, sample);
            let [x, z] = sequence.point(Dimension::Film, 0, 1).map(|u| side * (u - 0.5));
            let ray = Ray::new(Vec3::new(x, 1e-3, z), Vec3::NEG_Y);
            sum += f64::from(direct.sample(&scene, &ray, f32::INFINITY, &mut sequence).g);
            let taken = sample + 1;
            if taken.is_power_of_two() {
                means.push(sum / f64::from(taken));
            }
        }
        means
    };
    pixels.map(of_pixel).collect()
}

/// Root mean square deviation of the pixels from their mean, for each number of samples.
fn deviations(means: &[Vec<f64>]) -> Vec<f64> {
    let n = means.len() as f64;
    let truth = means.iter().filter_map(|m| m.last()).sum::<f64>() / n;
    let deviation = |rung: usize| (means.iter().map(|m| (m[rung] - truth).powi(2)).sum::<f64>() / n).sqrt();
    (0..means[0].len()).map(deviation).collect()
}

/// Slope of the logarithm of the deviation over that of the samples, from 4 samples on.
fn order(deviations: &[f64]) -> f64 {
    let points: Vec<_> = deviations.iter().enumerate().skip(2).map(|(i, d)| (i as f64, d.log2())).collect();
    let n = points.len() as f64;
    let (x, y) = points.iter().fold((0.0, 0.0), |(x, y), p| (x + p.0 / n, y + p.1 / n));
    let (xy, xx) = points
        .iter()
        .fold((0.0, 0.0), |(xy, xx), p| (xy + (p.0 - x) * (p.1 - y), xx + (p.0 - x) * (p.0 - x)));
    -xy / xx
}

/// The order of convergence over a square of the floor, with pixels that share no points.
fn order_over(sequence: AnySequence, surface: SurfaceDensity, side: f32) -> f64 {
    order(&deviations(&means(sequence, surface, side, (0..200).map(|i| 37 * i))))
}

#[test]
fn smooth_light_converges_with_the_full_order() -> Verdict {
    for surface in [SurfaceDensity::Area, SurfaceDensity::SolidAngle] {
        for (name, sequence) in sequences() {
            let order = order_over(sequence, surface, 0.0);
            // The deviation of 200 pixels is known to 5 %, a slope over six doublings of them to 0.02.
            let (least, most) = if name == "random" { (0.4, 0.6) } else { (1.4, 2.0) };
            ensure!((least..most).contains(&order), "{name} {surface:?}: order {order}");
        }
    }
    Ok(())
}

#[test]
fn smooth_light_over_a_pixel_converges_nearly_so() -> Verdict {
    // Four dimensions: 256 points are only four along each.
    for (name, sequence) in sequences().into_iter().skip(1) {
        let order = order_over(sequence, SurfaceDensity::Area, 0.2);
        ensure!((1.15..2.0).contains(&order), "{name}: order {order}");
    }
    Ok(())
}

#[test]
fn pixels_are_independent_unless_they_share_their_points() -> Verdict {
    let runs = 1500;
    for (name, sequence) in sequences() {
        // 16 samples of pixels beside one another; each pair in a part of the film of its own.
        let at = |i: u32| 2 * WIDTH * (i / 32) + 2 * (i % 32);
        let of = |offset: u32| {
            let means = means(sequence.clone(), SurfaceDensity::Area, 0.2, (0..runs).map(|i| at(i) + offset));
            let values: Vec<_> = means.iter().map(|m| m[4]).collect();
            let mean = values.iter().sum::<f64>() / values.len() as f64;
            values.into_iter().map(|v| v - mean).collect::<Vec<_>>()
        };
        let (here, beside) = (of(0), of(1));
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let correlation =
            product(&here, &beside) / (product(&here, &here) * product(&beside, &beside)).sqrt();
        let bound = 5.0 / f64::from(runs).sqrt();
        ensure!(correlation.abs() < bound, "{name}: correlation {correlation}");
    }
    Ok(())
}

#[test]
fn neighbours_that_share_their_points_have_opposed_errors() -> Verdict {
    let sixteen = |sequence: AnySequence| {
        // Squares of 4 × 4 pixels, one sample each.
        let pixels = (0..64).flat_map(|square| {
            let (x0, y0) = (4 * (square % 16), 4 * (square / 16));
            (0..16).map(move |i| (y0 + i / 4) * WIDTH + x0 + i % 4)
        });
        let means = means(sequence, SurfaceDensity::Area, 0.2, pixels);
        let singles: Vec<_> = means.iter().map(|m| vec![m[0], m[MOST.ilog2() as usize]]).collect();
        let squares: Vec<_> = singles
            .chunks(16)
            .map(|c| [0, 1].map(|k| c.iter().map(|m| m[k]).sum::<f64>() / 16.0).to_vec())
            .collect();
        deviations(&singles)[0] / deviations(&squares)[0]
    };
    let apart = sixteen(AnySequence::Sobol(Sobol::new(2)));
    let shared = sixteen(AnySequence::ZSobol(ZSobol::new(2, WIDTH, 1)));
    // The mean of 16 independent pixels has a quarter of the error of one: within five standard errors
    // of a deviation of 64 squares.
    ensure!((apart / 4.0 - 1.0).abs() < 5.0 / 128.0_f64.sqrt(), "apart: {apart}");
    ensure!(shared > 12.0, "shared: {shared}");
    Ok(())
}
