//! What holds for any light, any receiver and any uniforms: over a million random cases.
//!
//! They are the same in every run. `PROPTEST_CASES=10000000 cargo test properties` tries that many
//! others for each property, new ones each time. A failure is shrunk, printed, and kept in
//! `proptest-regressions/`, which is under version control: what has failed once is tried first from then
//! on.

mod case;

use case::{Case, cases};
use halflight::Rgb;
use halflight::estimate::Heuristic;
use halflight::glam::Vec3;
use halflight::light::{AreaLight, Density, Emitter, LightSample, Receiver, SampledShape, SurfaceDensity};
use halflight::light::{SurfaceSample, SurfaceView};
use halflight::num::UNIT_ROUND_OFF;
use halflight::shape::{AnyShape, Rectangle};
use halflight_tests::lights::Specimen;
use halflight_tests::{Failure, Verdict, ensure, with_shape};
use proptest::prelude::*;
use proptest::test_runner::{FileFailurePersistence, RngSeed};

/// Cases of each property.
const CASES: u32 = 300_000;

/// Probability that two directions may enclose and still count as the same: the last step of a uniform
/// moves the end of a round light by the root of a rounding.
const SLIVER: f32 = 1e-6;

fn config() -> ProptestConfig {
    const KEPT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/proptest-regressions/properties.txt");
    let failure_persistence = Some(Box::new(FileFailurePersistence::Direct(KEPT)) as Box<_>);
    let asked = ProptestConfig { failure_persistence, ..ProptestConfig::default() };
    if std::env::var_os("PROPTEST_CASES").is_some() {
        return asked;
    }
    ProptestConfig { cases: CASES, rng_seed: RngSeed::Fixed(0x6861_6c66), ..asked }
}

fn fails(verdict: Verdict) -> Result<(), TestCaseError> {
    verdict.map_err(|Failure(why)| TestCaseError::fail(why))
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn samples_are_numbers_and_have_the_queried_density(case in cases()) {
        fails(with_shape!(case.shape, s => samples(&light(s, &case), &case)))?;
    }

    #[test]
    fn the_inverse_returns_the_uniforms_or_the_same_point(case in cases()) {
        fails(with_shape!(case.shape, s => inverse(&light(s, &case), &case)))?;
    }

    #[test]
    fn irradiance_is_a_number_from_0_to_pi(case in cases()) {
        fails(with_shape!(case.shape, s => irradiance(&light(s, &case), &case.from)))?;
    }

    #[test]
    fn projected_samples_of_polygons_and_spheres_are_the_irradiance(case in cases()) {
        if !matches!(case.shape, AnyShape::Disk(_) | AnyShape::Cylinder(_)) {
            fails(with_shape!(case.shape, s => without_variance(&light(s, &case), &case)))?;
        }
    }

    #[test]
    fn two_halves_of_a_rectangle_send_what_it_sends(case in cases()) {
        if let AnyShape::Rectangle(shape) = case.shape {
            fails(halves(&shape, &case))?;
        }
    }

    #[test]
    fn the_unit_of_length_does_not_matter(case in cases(), power in -6..=6) {
        fails(with_shape!(case.shape, s => scaling(s, &case, 2.0_f32.powi(power))))?;
    }

    #[test]
    fn weights_of_both_techniques_add_up_to_one(a in -38.0..38.0_f32, b in -38.0..38.0_f32) {
        let (a, b) = (10.0_f32.powf(a), 10.0_f32.powf(b));
        for h in [Heuristic::Balance, Heuristic::Power] {
            let (this, other) = (h.weight(a, b), h.weight(b, a));
            prop_assert!((0.0..=1.0).contains(&this) && (0.0..=1.0).contains(&other), "{h:?} {a:e} {b:e}");
            prop_assert!((this + other - 1.0).abs() < 1e-6, "{h:?} {a:e} {b:e}: {this} + {other}");
        }
    }
}

fn light<S: SampledShape>(shape: S, case: &Case) -> AreaLight<S> {
    let light = AreaLight::new(shape, Rgb::WHITE).expect("a proper radiance");
    if case.two_sided { light.two_sided() } else { light }
}

/// A sample with its density and the point that was drawn.
fn draw<S: SampledShape>(
    light: &AreaLight<S>,
    case: &Case,
) -> Result<Option<(LightSample, f32, SurfaceSample)>, Failure> {
    let Some(sample) = light.sample(&case.from, case.method, case.u) else { return Ok(None) };
    let Density::SolidAngle(pdf) = sample.density else {
        return Err(Failure(format!("{sample:?} of an area light")));
    };
    let drawn = light.view(&case.from, case.method).and_then(|view| view.sample(case.u));
    drawn.map(|drawn| Some((sample, pdf, drawn))).ok_or_else(|| Failure("a sample without a point".into()))
}

fn samples<S: SampledShape>(light: &AreaLight<S>, case: &Case) -> Verdict {
    let Some((sample, pdf, drawn)) = draw(light, case)? else { return Ok(()) };
    ensure!((sample.wi.length() - 1.0).abs() < 1e-6, "direction {}", sample.wi);
    ensure!(sample.distance > 0.0 && sample.distance.is_finite(), "distance {}", sample.distance);
    ensure!(pdf > 0.0 && pdf.is_finite(), "density {pdf}");
    ensure!(sample.incident == Rgb::WHITE, "radiance {:?}", sample.incident);
    let share = case.from.normal.dot(sample.wi).max(0.0) / pdf;
    ensure!(share.is_finite(), "{share} arrives with density {pdf}");
    let queried = light.pdf_solid_angle(&case.from, case.method, sample.wi, &drawn.at);
    ensure!((queried / pdf - 1.0).abs() <= 1e-5, "density {queried} when queried, {pdf} when sampled");
    let off = (case.from.point + sample.wi * sample.distance - drawn.at.point).length();
    let reach = case.reach.max(sample.distance);
    ensure!(off <= 64.0 * UNIT_ROUND_OFF * reach, "the way ends {off} beside {:?}", drawn.at);
    Ok(())
}

/// True for a sample from where a map begins or ends: the chords of a round light have no length there,
/// and are known as well as the root of a rounding; a zenith has every azimuth.
fn is_at_end(case: &Case) -> bool {
    case.u.iter().any(|u| u.min(1.0 - u) < 1e-6)
}

/// True when coordinates are rounded to more than some 1e-4 of the light's width: the conformance
/// matrix judges needles, by what their last bits decide.
fn is_coarse(case: &Case) -> bool {
    64.0 * UNIT_ROUND_OFF * case.reach > 1e-3 * case.minor
}

/// True when rounding decides on which side of the light's plane the receiver is.
fn is_edge_on<S: Specimen>(shape: &S, case: &Case) -> bool {
    let (foot, normal) = shape.foot();
    normal.dot(case.from.point - foot).abs() <= 64.0 * UNIT_ROUND_OFF * case.reach
}

/// The uniforms come back, as well as the drawn point says where it is: to the rounding of its
/// coordinates in extents of the light. Where the map from uniforms to points is flatter than that
/// (a needle, a seam, the end of an ellipse), they are others that draw the same point to that
/// rounding, or a direction so near that a square between the two holds at most a [`SLIVER`]
/// of the probability.
fn inverse<S: Specimen>(light: &AreaLight<S>, case: &Case) -> Verdict {
    let Some((_, pdf, drawn)) = draw(light, case)? else { return Ok(()) };
    let view = light.view(&case.from, case.method).expect("what was sampled");
    let Some(back) = view.invert(&drawn.at, drawn.wi) else {
        ensure!(is_edge_on(light.shape(), case), "{drawn:?} is never drawn");
        return Ok(());
    };
    ensure!(back.iter().all(|u| (0.0..1.0).contains(u)), "{:?} became {back:?}", case.u);
    let rounding = 64.0 * UNIT_ROUND_OFF * case.reach.max(drawn.distance);
    let off = (back[0] - case.u[0]).abs().max((back[1] - case.u[1]).abs());
    if off <= 1e-4 + rounding / case.minor {
        return Ok(());
    }
    if is_edge_on(light.shape(), case) || is_at_end(case) || is_coarse(case) {
        return Ok(());
    }
    let again = view.sample(back);
    let same = again.is_some_and(|again| {
        let (beside, turned) = (again.at.point.distance(drawn.at.point), (again.wi - drawn.wi).length());
        beside <= rounding || turned <= 64.0 * UNIT_ROUND_OFF || pdf * turned * turned <= SLIVER
    });
    ensure!(same, "{:?} became {back:?}: {again:?} instead of {drawn:?}", case.u);
    Ok(())
}

fn irradiance<S: SampledShape>(light: &AreaLight<S>, from: &Receiver) -> Verdict {
    let Some(Rgb { g, .. }) = light.unshadowed_irradiance(from) else { return Ok(()) };
    ensure!((0.0..=3.141_594).contains(&g), "irradiance {g}");
    Ok(())
}

/// Density in proportion to the cosine: each sample alone is the irradiance.
fn without_variance<S: SampledShape>(light: &AreaLight<S>, case: &Case) -> Verdict {
    let case = Case { method: SurfaceDensity::Projected, ..*case };
    let Some(Rgb { g: truth, .. }) = light.unshadowed_irradiance(&case.from) else { return Ok(()) };
    let Some((sample, pdf, _)) = draw(light, &case)? else { return Ok(()) };
    let one = case.from.normal.dot(sample.wi) / pdf;
    ensure!((one - truth).abs() <= 1e-4 * truth, "a sample of {one} of the irradiance {truth}");
    Ok(())
}

/// To the rounding of the receiver's height above the light's plane, and of the light as it is seen.
fn halves(shape: &Rectangle, case: &Case) -> Verdict {
    // Around the origin the halves are exact.
    let (u, v, point) = (shape.half_u(), shape.half_v(), case.from.point - shape.centre());
    let from = Receiver { point, ..case.from };
    let sends = |centre: Vec3, half_u: Vec3| {
        let shape = Rectangle::new(centre, half_u, v).map_err(|e| Failure(e.to_string()))?;
        Ok::<_, Failure>(light(shape, case).unshadowed_irradiance(&from).map(|e| e.g))
    };
    let Some(whole) = sends(Vec3::ZERO, u)? else { return Ok(()) };
    let parts = [sends(u * 0.5, u * 0.5)?, sends(u * -0.5, u * 0.5)?].map(Option::unwrap_or_default);
    let height = shape.normal().dot(point).abs();
    let lost = (case.reach / height.min(case.minor).max(f32::MIN_POSITIVE)).min(f32::MAX);
    let tolerance = 1e-4 + 32.0 * UNIT_ROUND_OFF * lost;
    let sum = parts[0] + parts[1];
    ensure!((sum - whole).abs() <= tolerance * whole.max(sum), "{parts:?} instead of {whole}");
    Ok(())
}

/// By a power of two, which rounds nothing: to the last bit.
fn scaling<S: Specimen>(shape: S, case: &Case, k: f32) -> Verdict {
    // Below, fourth powers of lengths may lose their digits to underflow.
    if case.minor < 1e-7 {
        return scaling_of_the_tiny(shape, case, k);
    }
    let scaled = Case { from: Receiver { point: case.from.point * k, ..case.from }, ..*case };
    let (one, other) = (light(shape, case), light(shape.scaled(k), &scaled));
    let (a, b) = (draw(&one, case)?, draw(&other, &scaled)?);
    ensure!(a.is_some() == b.is_some(), "{a:?}, times {k} {b:?}");
    if let Some(((a, pdf_a, _), (b, pdf_b, _))) = a.zip(b) {
        ensure!(a.wi == b.wi, "toward {}, times {k} {}", a.wi, b.wi);
        ensure!(pdf_a == pdf_b, "density {pdf_a}, times {k} {pdf_b}");
    }
    let e = [one.unshadowed_irradiance(&case.from), other.unshadowed_irradiance(&scaled.from)];
    let [a, b] = e.map(|e| e.map_or(0.0, |e| e.g));
    ensure!(a == b, "irradiance {a}, times {k} {b}");
    Ok(())
}

/// The same to a tolerance, but at the ends of a sweep and edge-on.
fn scaling_of_the_tiny<S: Specimen>(shape: S, case: &Case, k: f32) -> Verdict {
    let scaled = Case { from: Receiver { point: case.from.point * k, ..case.from }, ..*case };
    let (one, other) = (light(shape, case), light(shape.scaled(k), &scaled));
    let (a, b) = (draw(&one, case)?, draw(&other, &scaled)?);
    let edge_on = is_edge_on(&shape, case);
    // The rim of a round light is as well known as the root of a rounding, be it seen along the surface
    // or be it where the sweep over the light begins and ends.
    let end = is_at_end(case) || is_coarse(case);
    let rim = end || a.or(b).is_some_and(|(a, _, drawn)| drawn.at.normal.dot(a.wi).abs() < 1e-3);
    ensure!(a.is_some() == b.is_some() || edge_on || rim, "{a:?}, times {k} {b:?}");
    // Near the plane a last bit of the height turns a direction.
    let (foot, normal) = shape.foot();
    let near = normal.dot(case.from.point - foot).abs() < 1e-2 * case.reach;
    if let Some(((a, pdf_a, drawn), (b, pdf_b, _))) = a.zip(b).filter(|_| !end && !near) {
        let turned = (a.wi - b.wi).length();
        ensure!(turned < 1e-6 || pdf_a * turned * turned <= SLIVER, "toward {}, times {k} {}", a.wi, b.wi);
        let tolerance = 1e-5 + 16.0 * UNIT_ROUND_OFF / drawn.at.normal.dot(a.wi).abs();
        ensure!((pdf_a / pdf_b - 1.0).abs() < tolerance, "density {pdf_a}, times {k} {pdf_b}");
    }
    let e = [one.unshadowed_irradiance(&case.from), other.unshadowed_irradiance(&scaled.from)];
    let [a, b] = e.map(|e| e.map_or(0.0, |e| e.g));
    ensure!((a - b).abs() <= 1e-5 * a.max(b) || edge_on, "irradiance {a}, times {k} {b}");
    Ok(())
}
