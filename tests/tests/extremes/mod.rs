//! Sixty numerical extremes that have broken renderers, each with a test of its number or the feature
//! that it waits for.
//!
//! Numbers 1 to 20 are about the shape of a light against the receiver, 21 to 28 about probabilities
//! and weights, 29 to 40 about environment maps, 41 to 51 about rays, boxes and trees, 52 to 60 about
//! the arithmetic around them. Each test says which mistake it guards against.

mod arithmetic;
mod environment;
mod rays;
mod shape_any;
mod shape_flat;
mod shape_round;
mod weights;

use halflight::Rgb;
use halflight::glam::{DVec3, Vec3};
use halflight::light::{AreaLight, Density, Emitter, Receiver, SampledShape, SurfaceDensity};
use halflight::shape::{Rectangle, Triangle};
use halflight_tests::random::Uniforms;
use halflight_tests::statistics::Moments;

/// Extremes without a test, and what they wait for.
const WAITING: [(u8, &str); 1] =
    [(50, "shadow rays that know the smooth surface behind a coarse mesh with interpolated normals")];

/// Each extreme has a test or waits, never both.
#[test]
fn each_extreme_has_a_test_or_waits_for_a_feature() {
    let sources = [
        include_str!("shape_round.rs"),
        include_str!("shape_flat.rs"),
        include_str!("shape_any.rs"),
        include_str!("weights.rs"),
        include_str!("rays.rs"),
        include_str!("arithmetic.rs"),
        include_str!("environment.rs"),
        include_str!("../../../core/tests/load/environments.rs"),
        include_str!("../../../cli/tests/cli/output_range.rs"),
    ];
    let lines: Vec<&str> = sources.iter().flat_map(|s| s.lines()).map(str::trim).collect();
    for row in 1..=60_u8 {
        let name = format!("fn row_{row:02}_");
        let tests = lines.windows(2).filter(|w| w[0] == "#[test]" && w[1].starts_with(&name)).count();
        let waits = WAITING.iter().filter(|(waiting, _)| *waiting == row).count();
        assert_eq!(tests + waits, 1, "extreme {row}: {tests} tests, waiting {waits} times");
    }
    let named = lines.iter().filter(|line| line.starts_with("fn row_")).count();
    assert_eq!(named + WAITING.len(), 60, "a test whose number is not between 1 and 60");
}

/// Every way of sampling a surface.
const METHODS: [SurfaceDensity; 4] =
    [SurfaceDensity::Area, SurfaceDensity::SolidAngle, SurfaceDensity::Projected, SurfaceDensity::Auto];

/// Those that do not depend on how far the light is.
const DIRECTIONAL: [SurfaceDensity; 3] =
    [SurfaceDensity::SolidAngle, SurfaceDensity::Projected, SurfaceDensity::Auto];

/// A light of radiance 1.
fn light<S: SampledShape>(shape: S) -> AreaLight<S> {
    AreaLight::new(shape, Rgb::WHITE).unwrap()
}

/// The density of a sample, which must be a positive number.
#[track_caller]
fn density<S: SampledShape>(
    light: &AreaLight<S>,
    from: &Receiver,
    method: SurfaceDensity,
    u: [f32; 2],
) -> Option<(Vec3, f32)> {
    let sample = light.sample(from, method, u)?;
    let Density::SolidAngle(pdf) = sample.density else { panic!("an area light without density") };
    assert!(pdf > 0.0 && pdf.is_finite(), "{method:?}: density {pdf} at {u:?}");
    assert!((sample.wi.length() - 1.0).abs() < 1e-6, "{method:?}: direction {} at {u:?}", sample.wi);
    Some((sample.wi, pdf))
}

/// Irradiance from independent samples.
#[track_caller]
fn irradiance<S: SampledShape>(
    light: &AreaLight<S>,
    from: &Receiver,
    method: SurfaceDensity,
    samples: usize,
) -> Moments {
    let mut random = Uniforms::new(111);
    Moments::of((0..samples).map(|_| {
        density(light, from, method, random.two())
            .map_or(0.0, |(wi, pdf)| f64::from(from.normal.dot(wi).max(0.0)) / f64::from(pdf))
    }))
}

/// Irradiance in closed form, which must be a number from 0 to π.
#[track_caller]
fn closed_form<S: SampledShape>(light: &AreaLight<S>, from: &Receiver) -> Option<f64> {
    let e = light.unshadowed_irradiance(from)?.g;
    assert!((0.0..=3.141_594).contains(&e), "irradiance {e}");
    Some(f64::from(e))
}

#[track_caller]
fn near(what: &str, value: f64, truth: f64, tolerance: f64) {
    let off = (value - truth).abs();
    assert!(
        off <= tolerance * truth.abs(),
        "{what}: {value:e} instead of {truth:e}, off by {:e}",
        off / truth
    );
}

/// A flat light with corners.
trait Polygon: SampledShape {
    fn corners(&self) -> Vec<DVec3>;
}

impl Polygon for Rectangle {
    fn corners(&self) -> Vec<DVec3> {
        let [c, u, v] = [self.centre(), self.half_u(), self.half_v()].map(|v| v.as_dvec3());
        vec![c - u - v, c + u - v, c + u + v, c - u + v]
    }
}

impl Polygon for Triangle {
    fn corners(&self) -> Vec<DVec3> {
        self.corners().map(|c| c.as_dvec3()).to_vec()
    }
}
