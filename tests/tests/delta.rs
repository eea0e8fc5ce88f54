//! Lights that no ray meets by chance.

use halflight::Rgb;
use halflight::glam::Vec3;
use halflight::light::{Density, Directional, Emitter, LightSample, Point, Receiver, Spot, SurfaceDensity};
use halflight::shape::SurfacePoint;
use halflight_tests::lights::receiver;
use halflight_tests::random::Uniforms;
use halflight_tests::{Verdict, ensure};

fn sample(light: &impl Emitter, from: &Receiver) -> Option<LightSample> {
    light.sample(from, SurfaceDensity::SolidAngle, [0.3, 0.7])
}

/// What holds for all of them.
fn has_no_density(light: &impl Emitter, from: &Receiver) -> Verdict {
    let mut random = Uniforms::new(31);
    for _ in 0..1000 {
        let u = random.two();
        let Some(drawn) = light.sample(from, SurfaceDensity::Area, u) else { continue };
        ensure!(drawn.density == Density::Delta, "{drawn:?}");
        ensure!((drawn.wi.length() - 1.0).abs() < 1e-6, "{drawn:?}");
        let at = SurfacePoint {
            point: from.point + drawn.wi * drawn.distance.min(1e9),
            error: Vec3::ZERO,
            normal: -drawn.wi,
        };
        let pdf = light.pdf_solid_angle(from, SurfaceDensity::Area, drawn.wi, &at);
        ensure!(pdf == 0.0 && light.pdf_escaping(from, drawn.wi) == 0.0, "density {pdf} of a delta light");
        ensure!(light.radiance(&at, -drawn.wi).is_black(), "a delta light is seen");
        ensure!(light.radiance_escaping(drawn.wi).is_black(), "a delta light is seen");
    }
    ensure!(light.is_delta() && !light.is_environment(), "it does not say what it is");
    Ok(())
}

/// The checks that each passes. To add a light: a line here.
macro_rules! conformance {
    ($name:ident, $light:expr) => {
        mod $name {
            use super::*;

            #[test]
            fn has_no_density() -> Verdict {
                super::has_no_density(&$light, &receiver(Vec3::new(0.2, 0.1, -0.3), Vec3::Z))
            }

            #[test]
            fn extreme_distances_stay_finite() -> Verdict {
                super::extreme_distances_stay_finite(&$light)
            }
        }
    };
}

conformance!(point_above, Point::new(Vec3::Z, Rgb::splat(3.0)).unwrap());
conformance!(spot_above, Spot::new(Vec3::Z, Vec3::NEG_Z, Rgb::splat(3.0), 0.4, 0.9).unwrap());
conformance!(spot_narrow, Spot::new(Vec3::Z, Vec3::NEG_Z, Rgb::splat(3.0), 0.0, 1e-4).unwrap());
conformance!(directional_down, Directional::new(Vec3::NEG_Z, Rgb::splat(3.0)).unwrap());

fn extreme_distances_stay_finite(light: &impl Emitter) -> Verdict {
    for distance in [0.0, 1e-30, 1e-12, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e12, 1e30] {
        for out in [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::new(0.6, 0.0, -0.8)] {
            let from = receiver(Vec3::Z + out * distance, -out);
            let Some(drawn) = sample(light, &from) else { continue };
            ensure!(drawn.incident.is_valid(), "{distance} m away: {drawn:?}");
            ensure!((drawn.wi.length() - 1.0).abs() < 1e-6, "{distance} m away: {drawn:?}");
            ensure!(drawn.distance > 0.0, "{distance} m away: {drawn:?}");
        }
    }
    Ok(())
}

#[test]
fn a_point_falls_off_with_the_square_of_the_distance() {
    let light = Point::new(Vec3::new(1.0, 2.0, 3.0), Rgb::new(1.0, 2.0, 4.0)).unwrap();
    for d in [1e-3_f32, 0.5, 1.0, 7.0, 1e4] {
        let drawn = sample(&light, &receiver(Vec3::new(1.0, 2.0, 3.0 - d), Vec3::Z)).unwrap();
        let d = f64::from(drawn.distance);
        assert!((f64::from(drawn.incident.b) * d * d - 4.0).abs() < 4e-6, "{d} {drawn:?}");
        assert_eq!(drawn.incident.b / drawn.incident.r, 4.0);
    }
}

#[test]
fn a_spot_is_full_in_its_beam_dark_beyond_its_cutoff_and_linear_between() {
    let (beam, cutoff) = (0.3_f32, 0.8_f32);
    let light = Spot::new(Vec3::ZERO, Vec3::Z, Rgb::WHITE, beam, cutoff).unwrap();
    for step in 0..100 {
        let angle = step as f32 * 0.01;
        let (sin, cos) = angle.sin_cos();
        let expected = ((cutoff - angle) / (cutoff - beam)).clamp(0.0, 1.0);
        let drawn = sample(&light, &receiver(Vec3::new(sin, 0.0, cos) * 2.0, Vec3::NEG_Z));
        let incident = drawn.map_or(0.0, |d| d.incident.g);
        assert!((incident - 0.25 * expected).abs() < 1e-6, "{angle} {incident} {expected}");
    }
}

#[test]
fn a_narrow_spot_keeps_its_edge() {
    // 1e-4 rad: the cosine of its cut-off rounds to 1.
    let light = Spot::new(Vec3::ZERO, Vec3::Z, Rgb::WHITE, 0.0, 1e-4).unwrap();
    for (angle, expected) in [(0.0_f32, 1.0_f32), (2.5e-5, 0.75), (5e-5, 0.5), (9.9e-5, 0.01), (1.1e-4, 0.0)]
    {
        let drawn = sample(&light, &receiver(Vec3::new(angle, 0.0, 1.0), Vec3::NEG_Z));
        let incident = drawn.map_or(0.0, |d| d.incident.g);
        assert!((incident - expected).abs() < 2e-3, "{angle} {incident}");
    }
}

#[test]
fn parallel_light_is_the_same_everywhere() {
    let light = Directional::new(Vec3::new(0.0, -2.0, 0.0), Rgb::WHITE).unwrap();
    for point in [Vec3::ZERO, Vec3::splat(1e6), Vec3::splat(-1e30)] {
        let drawn = sample(&light, &receiver(point, Vec3::Y)).unwrap();
        assert_eq!((drawn.wi, drawn.distance, drawn.incident), (Vec3::Y, f32::INFINITY, Rgb::WHITE));
    }
}

#[test]
fn the_power_of_a_spot_is_its_intensity_over_its_cone() {
    use halflight_tests::quadrature::integrate;
    for (beam, cutoff) in [(0.3, 0.3001), (0.5, 0.6), (1.0, 1.2)] {
        let light = Spot::new(Vec3::ZERO, Vec3::Z, Rgb::WHITE, beam, cutoff).unwrap();
        let (b, c) = (f64::from(beam), f64::from(cutoff));
        let fall = |a: f64| ((c - a) / (c - b)).clamp(0.0, 1.0);
        let truth = std::f64::consts::TAU
            * (integrate(0.0, b, 64, |a| a.sin()) + integrate(b, c, 64, |a| a.sin() * fall(a)));
        // Choosing among lights needs no more than the edge's first order.
        assert!((f64::from(light.power(1.0)) / truth - 1.0).abs() < 0.01, "{beam} {cutoff} {truth}");
    }
}
