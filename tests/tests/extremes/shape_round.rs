//! Round lights: far away, from inside, from the surface, and cut by the horizon.

use super::{DIRECTIONAL, METHODS, closed_form, density, irradiance, light, near};
use halflight::glam::Vec3;
use halflight::light::{Emitter, Receiver, SurfaceDensity, SurfaceView};
use halflight::shape::{AnyShape, Sphere, SurfacePoint};
use halflight_tests::lights::receiver;
use halflight_tests::random::Uniforms;
use halflight_tests::scenes::Stage;
use halflight_tests::{Verdict, ensure, oracle, oracle_extremes};
use std::f64::consts::PI;

const SAMPLES: usize = 1 << 14;

/// Radius 1, centre straight above the origin.
fn above(distance: f32) -> Sphere {
    Sphere::new(Vec3::Z * distance, 1.0).unwrap()
}

/// At the origin, with the cosine `c` to the zenith.
fn tilted(c: f32) -> Receiver {
    Receiver { point: Vec3::ZERO, normal: Vec3::new(((1.0 - c) * (1.0 + c)).sqrt(), 0.0, c) }
}

/// A cone kept as the cosine of its angle: path tracers lose distant spheres to a solid angle of 0.
#[test]
fn row_01_distant_sphere_keeps_its_solid_angle_and_its_light() -> Verdict {
    for distance in [1.5_f32, 10.0, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7] {
        let (light, s) = (light(above(distance)), 1.0 / f64::from(distance));
        let from = tilted(0.8);
        let (_, pdf) = density(&light, &from, SurfaceDensity::SolidAngle, [0.3, 0.6]).unwrap();
        near("solid angle", 1.0 / f64::from(pdf), oracle::sphere_solid_angle(s), 1e-6);
        let truth = PI * s * s * f64::from(from.normal.z);
        for method in DIRECTIONAL {
            let what = format!("{method:?} at {distance}");
            irradiance(&light, &from, method, SAMPLES).check_mean(&what, truth, 1e-6)?;
        }
        if let Some(e) = closed_form(&light, &from) {
            near("closed form", e, truth, 1e-6);
        }
    }
    Ok(())
}

/// A direction good to a rounding whose point is not: shadow rays then end beside a distant sphere.
#[test]
fn row_02_points_of_a_tiny_cone_are_on_the_sphere_and_seen() {
    for distance in [1.001_f32, 2.0, 1e3, 1e6, 1e7] {
        let sphere = Sphere::new(Vec3::ZERO, 1.0).unwrap();
        let out = Vec3::new(0.48, -0.6, 0.64).normalize();
        let from = Receiver { point: out * distance, normal: -out };
        let stage = Stage::empty().lit(AnyShape::Sphere(sphere), 1.0).build();
        let eye = SurfacePoint { point: from.point, error: Vec3::ZERO, normal: from.normal };
        let mut random = Uniforms::new(112);
        for method in DIRECTIONAL {
            let view = light(sphere).view(&from, method).unwrap();
            for _ in 0..2_000 {
                let sample = view.sample(random.two()).unwrap();
                let off = (sample.at.point.as_dvec3().length() - 1.0).abs();
                assert!(off <= 4.0 * f64::from(f32::EPSILON), "{method:?} at {distance}: {off:e} off");
                assert!(
                    stage.bind().scene().light_visible(&eye, sample.wi, sample.distance, 0),
                    "{sample:?} is hidden"
                );
            }
        }
    }
}

/// The root of `1 − (r/d)²` from inside: NaN in one kind of renderer, a black room in another.
#[test]
fn row_03_inside_a_sphere_is_pi_whatever_the_normal() -> Verdict {
    let mut random = Uniforms::new(113);
    for off in [0.0_f32, 0.3, 0.9] {
        let sphere = Sphere::new(random.direction() * off, 1.0).unwrap();
        let from = receiver(Vec3::ZERO, random.direction());
        for method in METHODS {
            for shell in [light(sphere.flipped()), light(sphere).two_sided()] {
                let moments = irradiance(&shell, &from, method, 1 << 16);
                moments.check_mean(&format!("{method:?}, {off} off"), PI, 1e-5)?;
                ensure!(moments.standard_error() < 0.1 * PI, "only ± {}", moments.standard_error());
                closed_form(&shell, &from).into_iter().for_each(|e| near("closed form", e, PI, 1e-5));
            }
            // The dark side of a shell that emits outward.
            ensure!(light(sphere).sample(&from, method, random.two()).is_none(), "light inside");
        }
        ensure!(closed_form(&light(sphere), &from).is_none_or(|e| e == 0.0), "light inside");
    }
    Ok(())
}

/// Two tests of "inside", one for the sampler and one for the density: speckle on the surface.
#[test]
fn row_04_just_off_the_surface_both_sides_agree() -> Verdict {
    for gap in [1e-6_f32, 1e-5, 1e-4] {
        for distance in [1.0 + gap, 1.0 - gap] {
            let shell = light(above(distance)).two_sided();
            let s = 1.0 / f64::from(distance);
            let truth = if s < 1.0 { PI * s * s } else { PI };
            ensure!((truth / PI - 1.0).abs() < 1e-3, "not close enough");
            for method in DIRECTIONAL {
                let moments = irradiance(&shell, &tilted(1.0), method, SAMPLES);
                ensure!(
                    moments.standard_error() < 0.02 * PI,
                    "{method:?} at {distance}: {} ± {}",
                    moments.mean(),
                    moments.standard_error()
                );
                moments.check_mean(&format!("{method:?} at {distance}"), truth, 1e-3)?;
            }
            closed_form(&shell, &tilted(1.0)).into_iter().for_each(|e| near("closed form", e, truth, 1e-5));
        }
    }
    Ok(())
}

/// `b² − 4ac` of a ray against a distant or huge sphere: ragged rims and wrong depths.
#[test]
fn row_05_rays_meet_distant_and_huge_spheres_within_four_ulps() {
    crate::shapes::a_sphere_is_met_within_four_ulps();
}

/// The textbook form of a sphere cut by the horizon, in `f32`: 18 % off for a small light at dusk.
#[test]
fn row_19_small_spheres_cut_by_the_horizon() -> Verdict {
    for distance in [1.001_f32, 1.25, 2.0, 10.0, 1e2, 1e3, 1e4] {
        for t in [-0.99_f32, -0.5, 0.0, 0.5, 0.99] {
            let (shape, from) = (light(above(distance)), tilted(t / distance));
            let s = 1.0 / f64::from(distance);
            let truth = oracle_extremes::sphere_irradiance(s, f64::from(from.normal.z));
            let e = closed_form(&shape, &from).expect("a closed form");
            let off = (e - truth).abs() / (PI * s * s * s);
            ensure!(off < 1e-5, "{distance} away, {t} radii high: {e:e} instead of {truth:e}");
            for method in DIRECTIONAL {
                let what = format!("{method:?}, {distance} away, {t} radii high");
                // A sliver is as well known as its height, which is rounded with the radius.
                irradiance(&shape, &from, method, 1 << 16).check_mean(&what, truth, 1e-4)?;
            }
        }
    }
    Ok(())
}
