//! Whole scenes with known light.

use halflight::Rgb;
use halflight::choose::{LightChoice, PowerTable};
use halflight::estimate::{Direct, Heuristic, Occlusion, PixelStats, Technique};
use halflight::geom::Ray;
use halflight::glam::{DVec3, Vec3};
use halflight::light::{AnyLight, Constant, Directional, Point, SurfaceDensity};
use halflight::sequence::{Sequence, Sobol};
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Sphere, Triangle};
use halflight_tests::oracle;
use halflight_tests::scenes::{Stage, eyes, seen, seen_at_origin};
use halflight_tests::{Verdict, ensure};
use std::f64::consts::PI;

pub(crate) const BLACK: usize = 0;
pub(crate) const WHITE: usize = 1;
pub(crate) const GLOSSY: usize = 2;
pub(crate) const SAMPLES: u32 = 1 << 16;
/// What single precision adds to a mean.
pub(crate) const ROUNDING: f64 = 1e-5;

/// Every way of sampling a surface.
pub(crate) const SURFACES: [SurfaceDensity; 4] =
    [SurfaceDensity::Area, SurfaceDensity::SolidAngle, SurfaceDensity::Projected, SurfaceDensity::Auto];

/// Facing down, `a` by `b`.
pub(crate) fn panel(centre: Vec3, a: f32, b: f32) -> AnyShape {
    AnyShape::Rectangle(Rectangle::new(centre, Vec3::X * (0.5 * a), Vec3::Z * (0.5 * b)).unwrap())
}

/// Facing down.
fn lamp(centre: Vec3, radius: f32) -> AnyShape {
    AnyShape::Disk(Disk::new(centre, Vec3::X * radius, Vec3::Z * radius).unwrap())
}

pub(crate) fn ball(centre: Vec3, radius: f32) -> AnyShape {
    AnyShape::Sphere(Sphere::new(centre, radius).unwrap())
}

fn constant(radiance: f32) -> AnyLight<'static> {
    AnyLight::Constant(Constant::new(Rgb::splat(radiance)).unwrap())
}

pub(crate) fn point(position: Vec3, intensity: f32) -> AnyLight<'static> {
    AnyLight::Point(Point::new(position, Rgb::splat(intensity)).unwrap())
}

/// Several lights of several kinds over a glossy floor, one of them half hidden.
pub(crate) fn several() -> Stage {
    several_over(GLOSSY)
}

pub(crate) fn several_over(floor: usize) -> Stage {
    let tube = Cylinder::new(Vec3::new(-1.5, 0.3, 1.0), Vec3::new(0.5, 0.8, 0.3), 0.2).unwrap();
    let corners = [Vec3::new(1.0, 1.0, 1.0), Vec3::new(1.5, 1.2, 0.2), Vec3::new(1.2, 2.0, 0.8)];
    Stage::floor(floor)
        .lit(panel(Vec3::new(0.3, 2.0, -0.5), 1.0, 0.6), 4.0)
        .lit(ball(Vec3::new(-1.0, 1.5, -1.0), 0.4), 3.0)
        .lit(AnyShape::Cylinder(tube), 5.0)
        .lit(AnyShape::Triangle(Triangle::new(corners[0], corners[1], corners[2]).unwrap()), 6.0)
        .lit_by(constant(0.2))
        .lit_by(point(Vec3::new(0.5, 1.5, 2.0), 1.0))
        .with(panel(Vec3::new(0.3, 1.0, 0.0), 0.5, 0.5), WHITE)
}

/// Every technique, every way of sampling a surface and of choosing a light has the same mean.
fn every_choice_agrees(stage: &Stage) -> Verdict {
    let buffers = stage.build();
    let table: Option<PowerTable> = buffers.power_table();
    let eye = Vec3::new(0.4, 0.8, 1.0);
    let reference = seen_at_origin(&buffers, &Direct::default(), eye, 4 * SAMPLES);
    ensure!(reference.mean() > 0.0, "the scene is dark");
    let heuristics = [Heuristic::Balance, Heuristic::Power];
    let techniques = [Technique::Light, Technique::Bsdf].into_iter();
    for technique in
        techniques.chain(heuristics.map(Technique::Mis)).chain([Technique::Auto(Heuristic::Balance)])
    {
        for surface in SURFACES {
            let mut choices =
                vec![LightChoice::All, LightChoice::Uniform, LightChoice::Tree(buffers.light_tree())];
            choices.extend(table.map(LightChoice::Power));
            for choice in choices {
                let direct = Direct { technique, surface, choice, ..Direct::default() };
                let what = format!("{technique:?} {surface:?} {choice:?}");
                let moments = seen_at_origin(&buffers, &direct, eye, SAMPLES);
                moments.check_same(&what, &reference, ROUNDING)?;
                let more = Direct { light_samples: 3, bsdf_samples: 2, ..direct };
                seen_at_origin(&buffers, &more, eye, SAMPLES / 4).check_same(&what, &reference, ROUNDING)?;
            }
        }
    }
    Ok(())
}

mod every_choice_agrees {
    use super::*;

    #[test]
    fn on_a_glossy_floor_under_several_lights() -> Verdict {
        every_choice_agrees(&several())
    }

    #[test]
    fn on_a_white_floor_with_a_blocker() -> Verdict {
        let stage = Stage::floor(WHITE)
            .lit(panel(Vec3::Y * 2.0, 1.5, 1.0), 3.0)
            .with(ball(Vec3::new(0.3, 1.0, 0.1), 0.2), BLACK);
        every_choice_agrees(&stage)
    }

    #[test]
    fn under_an_environment_with_a_blocker() -> Verdict {
        let stage =
            Stage::floor(GLOSSY).lit_by(constant(1.0)).with(ball(Vec3::new(-0.4, 1.0, -0.8), 0.7), WHITE);
        every_choice_agrees(&stage)
    }
}

#[test]
fn a_coaxial_blocker_takes_its_own_cone() -> Verdict {
    for blocker in [0.1_f32, 0.3, 0.49] {
        let buffers = Stage::floor(WHITE)
            .lit(lamp(Vec3::Y * 2.0, 1.0), 3.0)
            .with(lamp(Vec3::Y, blocker), BLACK)
            .build();
        let sin2 = |r: f64, h: f64| r * r / (r * r + h * h);
        let truth = 3.0 * (sin2(1.0, 2.0) - sin2(f64::from(blocker), 1.0));
        seen_at_origin(&buffers, &Direct::default(), Vec3::Y, SAMPLES).check_mean(
            "ring of light",
            truth,
            ROUNDING,
        )?;
    }
    // And one that covers it all leaves nothing.
    let buffers =
        Stage::floor(WHITE).lit(lamp(Vec3::Y * 2.0, 1.0), 3.0).with(lamp(Vec3::Y, 0.51), BLACK).build();
    let moments = seen_at_origin(&buffers, &Direct::default(), Vec3::Y, SAMPLES);
    ensure!(moments.mean() == 0.0, "{} leaks", moments.mean());
    Ok(())
}

#[test]
fn half_a_cover_leaves_half() -> Verdict {
    let open = Stage::floor(WHITE).lit(panel(Vec3::Y * 2.0, 1.0, 1.0), 3.0);
    let half = open.clone().with(panel(Vec3::new(5.0, 1.0, 0.0), 10.0, 10.0), BLACK);
    let truth = 3.0 * 4.0 * oracle::rectangle_over_corner(0.5, 0.5, 2.0) / PI;
    let all = seen_at_origin(&open.build(), &Direct::default(), Vec3::Y, SAMPLES);
    all.check_mean("open", truth, ROUNDING)?;
    // The eye looks past the cover from its open side.
    let rest = seen_at_origin(&half.build(), &Direct::default(), Vec3::new(-1.0, 1.0, 0.0), SAMPLES);
    rest.check_mean("half covered", 0.5 * truth, ROUNDING)
}

#[test]
fn a_polygon_cut_by_an_edge_is_clipped() -> Verdict {
    // An edge over x = 0.1 at height 1 hides all of the panel beyond x = 0.2 at height 2.
    let buffers = Stage::floor(WHITE)
        .lit(panel(Vec3::Y * 2.0, 1.0, 1.0), 3.0)
        .with(panel(Vec3::new(5.1, 1.0, 0.0), 10.0, 10.0), BLACK)
        .build();
    let corner = |x: f64, z: f64| DVec3::new(x, 2.0, z);
    let rest = [corner(-0.5, -0.5), corner(0.2, -0.5), corner(0.2, 0.5), corner(-0.5, 0.5)];
    let truth = 3.0 * oracle::polygon_irradiance(DVec3::ZERO, DVec3::Y, &rest) / PI;
    seen_at_origin(&buffers, &Direct::default(), Vec3::new(-1.0, 1.0, 0.0), SAMPLES)
        .check_mean("penumbra", truth, 2e-5)
}

/// Inside light of the same radiance from everywhere, a white object cannot be seen.
mod a_white_furnace_hides_what_is_in_it {
    use super::*;

    fn check(stage: &Stage, truth: f64) -> Verdict {
        let buffers = stage.build();
        for surface in SURFACES {
            for technique in [Technique::Light, Technique::Bsdf, Technique::Mis(Heuristic::Power)] {
                let direct = Direct { technique, surface, ..Direct::default() };
                for eye in eyes(4) {
                    let moments = seen(&buffers, &direct, &Ray::new(eye * 0.6, -eye), SAMPLES / 4);
                    moments.check_mean(&format!("furnace by {technique:?} {surface:?}"), truth, ROUNDING)?;
                }
            }
        }
        Ok(())
    }

    fn closed_ball() -> AnyShape {
        AnyShape::Sphere(Sphere::new(Vec3::ZERO, 1.0).unwrap().flipped())
    }

    #[test]
    fn of_a_sphere() -> Verdict {
        check(&Stage::empty().lit(closed_ball(), 1.0).with(ball(Vec3::ZERO, 0.3), WHITE), 1.0)
    }

    #[test]
    fn of_an_environment() -> Verdict {
        check(&Stage::empty().lit_by(constant(1.0)).with(ball(Vec3::ZERO, 0.3), WHITE), 1.0)
    }

    #[test]
    fn of_a_box() -> Verdict {
        let mut stage = Stage::empty().with(ball(Vec3::ZERO, 0.3), WHITE);
        for n in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
            let u = n.any_orthonormal_vector();
            let wall = Rectangle::new(-n, u, n.cross(u)).unwrap();
            stage = stage.lit(AnyShape::Rectangle(wall), 1.0);
        }
        check(&stage, 1.0)
    }

    #[test]
    fn and_its_own_white_wall_is_twice_as_bright() -> Verdict {
        let mut stage = Stage::empty().lit(closed_ball(), 1.0);
        stage.0.objects[0].material = WHITE;
        check(&stage, 2.0)
    }
}

mod occlusion {
    use super::*;

    fn openness(stage: &Stage, reach: f32, toward: Vec3) -> halflight_tests::statistics::Moments {
        let occlusion = Occlusion { reach, samples: 4 };
        seen_at_origin(&stage.build(), &occlusion, toward, SAMPLES)
    }

    #[test]
    fn an_open_plane_is_open() -> Verdict {
        openness(&Stage::floor(WHITE), f32::INFINITY, Vec3::Y).check_mean("openness", 1.0, 0.0)
    }

    #[test]
    fn a_ceiling_disk_takes_its_form_factor() -> Verdict {
        let stage = Stage::floor(WHITE).with(lamp(Vec3::new(0.5, 1.0, 0.0), 1.0), WHITE);
        let truth = 1.0 - oracle::disk_parallel(1.0, 1.0, 0.5) / PI;
        openness(&stage, f32::INFINITY, Vec3::Y).check_mean("openness", truth, ROUNDING)
    }

    #[test]
    fn a_wall_takes_its_form_factor() -> Verdict {
        let wall = Rectangle::new(Vec3::new(0.0, 1.0, -1.0), Vec3::X * 3.0, Vec3::Y).unwrap();
        let stage = Stage::floor(WHITE).with(AnyShape::Rectangle(wall), WHITE);
        let truth = 1.0 - 2.0 * oracle::rectangle_at_right_angles(2.0, 3.0, 1.0) / PI;
        openness(&stage, f32::INFINITY, Vec3::Y).check_mean("openness", truth, ROUNDING)
    }

    #[test]
    fn what_is_beyond_reach_does_not_occlude() -> Verdict {
        let stage = Stage::floor(WHITE).with(lamp(Vec3::Y, 10.0), WHITE);
        openness(&stage, 0.99, Vec3::Y).check_mean("openness", 1.0, 0.0)?;
        // Up to 1.25 m away is the part of the ceiling within 0.75 m of the axis.
        let truth = 1.0 - oracle::disk_parallel(0.75, 1.0, 0.0) / PI;
        openness(&stage, 1.25, Vec3::Y).check_mean("openness", truth, 1e-4)
    }

    #[test]
    fn a_closed_room_is_dark() -> Verdict {
        let stage = Stage::floor(WHITE).with(ball(Vec3::ZERO, 5.0), WHITE);
        openness(&stage, f32::INFINITY, Vec3::Y).check_mean("openness", 0.0, 0.0)
    }
}

mod delta_lights {
    use super::*;

    #[test]
    fn have_no_noise_and_their_closed_form() -> Verdict {
        let (at, towards) = (Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.3, -1.0, 0.2));
        let sun = Directional::new(towards, Rgb::splat(2.0)).unwrap();
        let stage = Stage::floor(WHITE).lit_by(point(at, 3.0)).lit_by(AnyLight::Directional(sun));
        let truth = (3.0 * 0.8 + 2.0 / f64::from(towards.length())) / PI;
        for technique in [Technique::Light, Technique::Bsdf, Technique::Mis(Heuristic::Power)] {
            let direct = Direct { technique, ..Direct::default() };
            seen_at_origin(&stage.build(), &direct, Vec3::Y, 64).check_mean("E/π", truth, 1e-6)?;
        }
        Ok(())
    }

    #[test]
    fn are_blocked() {
        let stage = Stage::floor(WHITE).lit_by(point(Vec3::Y * 2.0, 3.0)).with(ball(Vec3::Y, 0.1), BLACK);
        assert_eq!(seen_at_origin(&stage.build(), &Direct::default(), Vec3::Y, 64).mean(), 0.0);
    }
}

#[test]
fn a_closed_box_lets_nothing_out() {
    // Six walls that share edges, a light inside, a receiver outside.
    let mut stage = Stage::floor(WHITE);
    let centre = Vec3::new(0.31, 1.77, -0.23);
    for n in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
        let u = n.any_orthonormal_vector() * 0.7;
        let wall = Rectangle::new(centre + n * 0.7, u, n.cross(u)).unwrap();
        stage = stage.with(AnyShape::Rectangle(wall), BLACK);
    }
    let stage = stage.lit(ball(centre, 0.69), 100.0);
    assert_eq!(seen_at_origin(&stage.build(), &Direct::default(), Vec3::Y, 1 << 18).mean(), 0.0);
}

#[test]
fn the_order_of_lights_does_not_matter() -> Verdict {
    let forward = several();
    let mut backward = forward.clone();
    backward.0.objects.reverse();
    backward.0.lights.reverse();
    let eye = Vec3::new(0.4, 0.8, 1.0);
    for buffers in [forward.build(), backward.build()] {
        let table = buffers.power_table().ok_or(halflight_tests::Failure("no power".into()))?;
        let direct = Direct { choice: LightChoice::Power(table), ..Direct::default() };
        let reference = seen_at_origin(&forward.build(), &Direct::default(), eye, 4 * SAMPLES);
        seen_at_origin(&buffers, &direct, eye, SAMPLES).check_same(
            "light in any order",
            &reference,
            ROUNDING,
        )?;
    }
    Ok(())
}

#[test]
fn two_halves_of_a_light_are_the_light() -> Verdict {
    let whole = Stage::floor(GLOSSY).lit(panel(Vec3::new(0.2, 1.0, 0.0), 2.0, 1.0), 3.0);
    let halves = Stage::floor(GLOSSY)
        .lit(panel(Vec3::new(-0.3, 1.0, 0.0), 1.0, 1.0), 3.0)
        .lit(panel(Vec3::new(0.7, 1.0, 0.0), 1.0, 1.0), 3.0);
    let eye = Vec3::new(0.4, 0.8, 1.0);
    let (a, b) = (whole.build(), halves.build());
    for choice in [LightChoice::All, LightChoice::Uniform] {
        let direct = Direct { choice, ..Direct::default() };
        let whole = seen_at_origin(&a, &direct, eye, SAMPLES);
        whole.check_same("halves", &seen_at_origin(&b, &direct, eye, SAMPLES), ROUNDING)?;
    }
    Ok(())
}

#[test]
fn both_sequences_have_the_same_mean() -> Verdict {
    let stage = several();
    let buffers = stage.build();
    let bound = buffers.bind();
    let scene = bound.scene();
    let eye = Vec3::new(0.4, 0.8, 1.0).normalize();
    let ray = Ray::new(eye * 5e-4, -eye);
    let random = seen(&buffers, &Direct::default(), &ray, 4 * SAMPLES);
    // 64 scrambles of 256 points each.
    let mut sobol = Sobol::new(9);
    let runs = (0..64).map(|pixel| {
        let mut run = PixelStats::NEW;
        for sample in 0..256 {
            sobol.start(pixel, sample);
            run.add(halflight::estimate::Estimator::sample(
                &Direct::default(),
                &scene,
                &ray,
                f32::INFINITY,
                &mut sobol,
            ));
        }
        f64::from(run.mean().g)
    });
    halflight_tests::statistics::Moments::of(runs).check_same("Sobol points", &random, ROUNDING)
}
