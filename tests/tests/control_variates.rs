//! Closed forms less what is blocked have the same mean as sampling what is not.

use crate::estimators::{BLACK, ROUNDING, SAMPLES, SURFACES, WHITE, ball, panel, several, several_over};
use halflight::choose::LightChoice;
use halflight::estimate::{Direct, Heuristic, Technique};
use halflight::glam::Vec3;
use halflight::light::SurfaceDensity;
use halflight_tests::Verdict;
use halflight_tests::scenes::{Stage, seen, seen_as_difference, to_origin};

fn check(stage: &Stage) -> Verdict {
    let buffers = stage.build();
    let ray = to_origin(Vec3::new(0.4, 0.8, 1.0));
    let reference = seen(&buffers, &Direct::default(), &ray, 4 * SAMPLES);
    for surface in SURFACES {
        for choice in [LightChoice::All, LightChoice::Uniform] {
            let technique = Technique::Control(Heuristic::Power);
            let direct = Direct { technique, surface, choice, ..Direct::default() };
            let moments = seen_as_difference(&buffers, &direct, &ray, SAMPLES);
            moments.check_same(&format!("{surface:?} {choice:?}"), &reference, ROUNDING)?;
        }
    }
    Ok(())
}

#[test]
fn agree_on_a_matte_floor_under_several_lights() -> Verdict {
    check(&several_over(WHITE))
}

#[test]
fn agree_on_a_glossy_floor_where_they_have_no_use() -> Verdict {
    check(&several())
}

#[test]
fn agree_in_shadow() -> Verdict {
    check(&Stage::floor(WHITE).lit(panel(Vec3::Y * 2.0, 1.6, 1.6), 3.0).with(ball(Vec3::Y, 0.45), BLACK))
}

#[test]
fn agree_with_both_sides_of_the_lights() -> Verdict {
    check(&Stage::floor(WHITE).lit(ball(Vec3::Y * 1.5, 0.5), 3.0).two_sided())
}

#[test]
fn have_no_noise_in_the_open() {
    let stage = Stage::floor(WHITE).lit(panel(Vec3::new(0.2, 0.7, 0.0), 1.0, 1.4), 3.0);
    let technique = Technique::Control(Heuristic::Power);
    let direct = Direct { technique, surface: SurfaceDensity::Area, ..Direct::default() };
    let moments = seen(&stage.build(), &direct, &to_origin(Vec3::ONE), 256);
    assert_eq!(moments.variance(), 0.0);
}
