//! Light that comes by way of other surfaces.

use crate::estimators::{BLACK, GLOSSY, ROUNDING, SAMPLES, WHITE, ball, panel, point, several};
use halflight::Rgb;
use halflight::bsdf::{AnyBsdf, Lambert, TwoSided};
use halflight::build::{Material, SceneBuffers};
use halflight::choose::LightChoice;
use halflight::estimate::{Direct, Estimator, Heuristic, Path, Technique};
use halflight::geom::Ray;
use halflight::glam::Vec3;
use halflight::sequence::{Sequence, Sobol};
use halflight::shape::{AnyShape, Rectangle, Sphere};
use halflight_tests::scenes::{Stage, eyes, seen, seen_as_difference, seen_at_origin, to_origin};
use halflight_tests::{Verdict, ensure};
use std::f64::consts::PI;

const TECHNIQUES: [Technique; 4] = [
    Technique::Light,
    Technique::Bsdf,
    Technique::Mis(Heuristic::Balance),
    Technique::Auto(Heuristic::Power),
];

/// Index of the material that [`grey`] adds.
const GREY: usize = 3;

/// A scene with a matte material of its own.
fn grey(mut stage: Stage, reflectance: Rgb) -> Stage {
    let bsdf = TwoSided::both(AnyBsdf::Lambert(Lambert::new(reflectance).unwrap()));
    stage.0.materials.push(Material { name: "grey".into(), bsdf, textures: <[_; 2]>::default() });
    stage
}

fn with(technique: Technique, max_depth: u32) -> Path<'static> {
    Path { direct: Direct { technique, ..Direct::default() }, max_depth, ..Path::default() }
}

/// The inside of a sphere around the origin.
fn hollow(radius: f32) -> AnyShape {
    AnyShape::Sphere(Sphere::new(Vec3::ZERO, radius).unwrap().flipped())
}

/// A room of 2 m, its walls to the inside.
fn room(mut stage: Stage, material: usize, radiance: f32) -> Stage {
    for n in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
        let u = n.any_orthonormal_vector();
        let wall = AnyShape::Rectangle(Rectangle::new(-n, u, n.cross(u)).unwrap());
        stage = if radiance > 0.0 { stage.lit(wall, radiance) } else { stage.with(wall, material) };
        stage.0.objects.last_mut().unwrap().material = material;
    }
    stage
}

/// `1 + ρ + ρ² + …` of so many terms, or of all of them.
fn series(albedo: f64, terms: u32) -> f64 {
    let missing = if terms == u32::MAX { 0.0 } else { albedo.powi(terms as i32) };
    if albedo == 1.0 { f64::from(terms) } else { (1.0 - missing) / (1.0 - albedo) }
}

/// Where all walls shine with `L_e` and reflect `ρ`, `L_e (1 + ρ + ρ² + …)` is seen, one term for
/// each segment, and in front of a white ball as well.
mod a_furnace_of_grey_walls {
    use super::*;

    fn check(albedo: f32, depth: u32, technique: Technique) -> Verdict {
        let stage = grey(Stage::empty(), Rgb::splat(albedo));
        let ball_within = room(stage.clone(), GREY, 2.0).with(ball(Vec3::ZERO, 0.3), WHITE).build();
        let mut sphere = stage.lit(hollow(1.0), 2.0);
        sphere.0.objects[0].material = GREY;
        let sphere = sphere.build();
        let truth = 2.0 * series(f64::from(albedo), depth);
        let path = with(technique, depth);
        for eye in eyes(2) {
            let what = format!("{technique:?} albedo {albedo} depth {depth}");
            let ray = Ray::new(eye * 0.6, eye);
            seen(&sphere, &path, &ray, SAMPLES / 4).check_mean(&what, truth, ROUNDING)?;
            if depth == u32::MAX {
                let ray = Ray::new(eye * 0.6, -eye);
                seen(&ball_within, &path, &ray, SAMPLES / 4).check_mean(&what, truth, ROUNDING)?;
            }
        }
        Ok(())
    }

    #[test]
    fn has_a_term_for_each_segment() -> Verdict {
        for depth in [1, 2, 3, 7, 20] {
            for technique in TECHNIQUES {
                check(0.6, depth, technique)?;
            }
        }
        check(1.0, 30, Technique::Bsdf)
    }

    #[test]
    fn has_the_sum_of_the_series_without_end() -> Verdict {
        for albedo in [0.0, 0.3, 0.8] {
            for technique in TECHNIQUES {
                check(albedo, u32::MAX, technique)?;
            }
        }
        Ok(())
    }

    #[test]
    fn and_also_where_almost_nothing_is_lost() -> Verdict {
        check(0.99, u32::MAX, Technique::Auto(Heuristic::Power))
    }
}

/// In a sphere every point sends the same light to every other, so that all light but the first is even:
/// `L = ρ/π (E + ρ Φ / (A (1 − ρ)))`.
#[test]
fn a_lamp_in_a_hollow_sphere_has_its_closed_form() -> Verdict {
    let (place, albedo, radius) = (Vec3::new(0.5, 0.0, 0.0), 0.7, 2.0);
    let stage = grey(Stage::empty(), Rgb::splat(albedo)).with(hollow(radius), GREY).lit_by(point(place, 3.0));
    let buffers = stage.build();
    let (albedo, area) = (f64::from(albedo), 4.0 * PI * f64::from(radius).powi(2));
    for eye in eyes(4) {
        let (wall, flux) = (eye * radius, 4.0 * PI * 3.0);
        let way = (place - wall).as_dvec3();
        let direct = 3.0 * way.normalize().dot(-eye.as_dvec3()) / way.length_squared();
        let truth = albedo / PI * (direct + albedo * flux / (area * (1.0 - albedo)));
        for technique in TECHNIQUES {
            let moments = seen(&buffers, &with(technique, u32::MAX), &Ray::new(Vec3::ZERO, eye), SAMPLES / 4);
            moments.check_mean(&format!("{technique:?}"), truth, ROUNDING)?;
        }
    }
    Ok(())
}

/// A room with walls of a colour, a glossy floor, and lights of several kinds.
fn furnished() -> Stage {
    let stage = grey(several(), Rgb::new(0.8, 0.5, 0.2));
    stage.with(ball(Vec3::ZERO, 6.0), GREY).with(ball(Vec3::new(-0.6, 0.3, 0.2), 0.3), GLOSSY)
}

#[test]
fn every_choice_agrees() -> Verdict {
    let buffers = furnished().build();
    let eye = Vec3::new(0.4, 0.8, 1.0);
    let reference = seen_at_origin(&buffers, &Path::default(), eye, 4 * SAMPLES);
    let direct = seen_at_origin(&buffers, &Direct::default(), eye, SAMPLES);
    ensure!(reference.mean() > 1.2 * direct.mean(), "the walls reflect nothing");
    for technique in TECHNIQUES {
        let choices = [LightChoice::All, LightChoice::Uniform, LightChoice::Tree(buffers.light_tree())];
        for choice in choices {
            let direct = Direct { technique, choice, light_samples: 2, ..Direct::default() };
            let path = Path { direct, ..Path::default() };
            let what = format!("{technique:?} {choice:?}");
            seen_at_origin(&buffers, &path, eye, SAMPLES).check_same(&what, &reference, ROUNDING)?;
        }
    }
    let control = with(Technique::Control(Heuristic::Power), u32::MAX);
    let moments = seen_as_difference(&buffers, &control, &to_origin(eye), SAMPLES);
    moments.check_same("control", &reference, ROUNDING)
}

#[test]
fn roulette_does_not_change_the_mean() -> Verdict {
    let buffers = furnished().build();
    let eye = Vec3::new(0.4, 0.8, 1.0);
    let seen = |rr_depth| {
        let path = Path { max_depth: 12, rr_depth, ..Path::default() };
        seen_at_origin(&buffers, &path, eye, 2 * SAMPLES)
    };
    let never = seen(u32::MAX);
    for rr_depth in [0, 1, 2, 5, 11] {
        seen(rr_depth).check_same(&format!("from {rr_depth}"), &never, ROUNDING)?;
    }
    Ok(())
}

/// Samples along some rays of the furnished room.
fn samples(buffers: &SceneBuffers, estimator: &impl Estimator) -> Vec<Rgb> {
    let bound = buffers.bind();
    let (scene, mut sequence) = (bound.scene(), Sobol::new(3));
    let mut samples = Vec::new();
    for (pixel, eye) in (0..).zip(eyes(64)) {
        for sample in 0..16 {
            sequence.start(pixel, sample);
            let ray = Ray::new(Vec3::new(0.3, 0.5, 0.4), if pixel % 2 == 0 { eye } else { -eye });
            samples.push(estimator.sample(&scene, &ray, f32::INFINITY, &mut sequence));
        }
    }
    samples
}

#[test]
fn two_segments_are_direct_light_to_the_last_bit() {
    let buffers = furnished().build();
    let control = Technique::Control(Heuristic::Power);
    for technique in TECHNIQUES.into_iter().chain([control]) {
        let direct = Direct { technique, light_samples: 2, ..Direct::default() };
        let path = Path { direct, max_depth: 2, ..Path::default() };
        assert_eq!(samples(&buffers, &path), samples(&buffers, &direct), "{technique:?}");
    }
}

#[test]
fn one_segment_shows_the_lights_alone() {
    let buffers = furnished().build();
    let from = Vec3::new(0.3, 0.5, 0.4);
    let path = Path { max_depth: 1, ..Path::default() };
    let toward = |place: Vec3| seen(&buffers, &path, &Ray::new(from, (place - from).normalize()), 16);
    // The ball of light, the floor, and the wall.
    assert_eq!(toward(Vec3::new(-1.0, 1.5, -1.0)).mean(), 3.0);
    assert_eq!(toward(Vec3::ZERO).mean(), 0.0);
    assert_eq!(toward(Vec3::new(1.0, 0.7, 9.0)).mean(), 0.0);
}

#[test]
fn hidden_lights_light_and_are_not_seen() -> Verdict {
    let stage = Stage::floor(WHITE)
        .lit(panel(Vec3::Y * 0.2, 1.0, 1.0), 3.0)
        .two_sided()
        .lit(ball(Vec3::Y * 0.5, 0.2), 5.0)
        .with(ball(Vec3::Y * 9.0, 1.0), BLACK);
    let buffers = stage.build();
    let path = Path { max_depth: 2, hide_emitters: true, ..Path::default() };
    let below = seen_at_origin(&buffers, &path, Vec3::Y, SAMPLES);
    // From above the ball and the panel, through both, the floor is as bright as from below them.
    let above = seen(&buffers, &path, &Ray::new(Vec3::Y * 2.0, Vec3::NEG_Y), SAMPLES);
    ensure!(below.mean() > 0.5, "{}", below.mean());
    above.check_same("through the lights", &below, ROUNDING)?;
    let up = Ray::new(Vec3::new(0.1, 0.1, 0.1), Vec3::new(1.0, 0.2, 0.0).normalize());
    ensure!(seen(&buffers, &path, &up, 16).mean() == 0.0, "nothing is black");
    Ok(())
}

/// No sample is negative, infinite or NaN, which [`seen`] looks after, and none takes for ever.
mod at_the_extremes {
    use super::*;

    #[test]
    fn the_unit_of_length_does_not_matter() -> Verdict {
        for radius in [1e-6_f32, 1.0, 1e6] {
            let stage = grey(Stage::empty(), Rgb::splat(0.5)).with(hollow(radius), GREY);
            let stage = stage.lit(ball(Vec3::X * (0.3 * radius), 0.1 * radius), 100.0).build();
            let reference = 100.0 * 4.0 * PI * PI * 0.01 / (4.0 * PI) * 0.5 * 0.5 / 0.5 / PI;
            // What comes after the first bounce is even, but for what the lamp itself takes away.
            let wall = Ray::new(Vec3::ZERO, Vec3::NEG_X);
            let all = seen(&stage, &Path::default(), &wall, SAMPLES).mean();
            let first = seen(&stage, &with(Technique::Light, 2), &wall, SAMPLES).mean();
            ensure!(((all - first) / reference - 1.0).abs() < 0.05, "{radius}: {all} {first} {reference}");
        }
        Ok(())
    }

    #[test]
    fn lights_may_be_as_bright_or_dark_as_numbers_go() {
        for radiance in [1e-36, 1e-20, 1e20, 1e30] {
            let stage = grey(Stage::empty(), Rgb::new(1.0, 0.5, 1e-20));
            let buffers = room(stage, GREY, 0.0).lit(panel(Vec3::Y * 0.9, 0.01, 1.0), radiance).build();
            for technique in TECHNIQUES {
                let path = with(technique, u32::MAX);
                let moments = seen(&buffers, &path, &Ray::new(Vec3::ZERO, Vec3::X), 1024);
                assert!(moments.mean() > 0.0, "{technique:?} {radiance}");
            }
        }
    }

    #[test]
    fn white_rooms_let_paths_end() {
        let stage = room(Stage::empty(), WHITE, 0.0).lit(panel(Vec3::Y * 0.9, 0.1, 0.1), 3.0).build();
        for rr_depth in [0, 5, u32::MAX] {
            let path = Path { rr_depth, ..Path::default() };
            assert!(seen(&stage, &path, &Ray::new(Vec3::ZERO, Vec3::X), 64).mean() > 1.0);
        }
    }
}
