//! The sky through portals is the sky, with less noise.

use crate::estimators::{BLACK, ROUNDING, WHITE};
use halflight::Rgb;
use halflight::estimate::Direct;
use halflight::glam::{Mat3, Vec3};
use halflight::light::{
    AnyLight, Constant, Density, Emitter, EnvironmentDensity, EnvironmentMap, Portal, Portals, SurfaceDensity,
};
use halflight::shape::{AnyShape, Rectangle};
use halflight_tests::environments::{map, noise, slope};
use halflight_tests::lights::{self, Environment, Lying, receiver, scaled};
use halflight_tests::random::{Uniforms, corners};
use halflight_tests::scenes::{Stage, seen_at_origin};
use halflight_tests::{Verdict, ensure};

/// A square opening that faces `toward` from its middle.
fn opening(middle: Vec3, toward: Vec3, half: f32) -> Portal {
    let normal = (toward - middle).normalize();
    let u = normal.any_orthonormal_vector();
    Portal::new(Rectangle::new(middle, u * half, normal.cross(u) * half).unwrap()).unwrap()
}

/// Around the slope: one ahead, another that overlaps it, one that its horizon cuts, one that faces
/// away, and one behind. They live as long as the tests do.
fn openings() -> &'static [Portal] {
    let from = slope();
    let aside = from.normal.any_orthonormal_vector();
    let at = |up: f32, along: f32, distance: f32| {
        from.point + (from.normal * up + aside * along).normalize() * distance
    };
    let inward = |middle: Vec3, half: f32| opening(middle, from.point, half);
    Box::leak(Box::new([
        inward(at(1.0, 0.3, 2.0), 0.7),
        inward(at(1.0, 0.5, 4.0), 1.0),
        inward(at(0.1, -1.0, 1.5), 0.8),
        opening(at(1.0, -1.0, 2.0), at(1.0, -1.0, 4.0), 0.6),
        inward(at(-1.0, 0.0, 2.0), 0.7),
    ]))
}

fn constant() -> Environment<Portals<'static, Constant>> {
    let light = Constant::new(Rgb::WHITE).expect("a proper radiance");
    Environment { light: Portals::new(light, openings()), from: slope() }
}

fn mapped(density: EnvironmentDensity) -> Environment<Portals<'static, EnvironmentMap<'static>>> {
    let turned = Mat3::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), 1.1);
    Environment { light: Portals::new(map(noise(30, 15), turned, density), openings()), from: slope() }
}

/// The checks that each environment passes.
macro_rules! conformance {
    ($name:ident, $subject:expr) => {
        mod $name {
            use super::*;

            #[test]
            fn queried_density_equals_sampled_density() -> Verdict {
                lights::queried_density_equals_sampled_density(&$subject)
            }

            #[test]
            fn mean_reciprocal_density_is_the_solid_angle() -> Verdict {
                lights::mean_reciprocal_density_is_the_solid_angle(&$subject)
            }

            #[test]
            fn area_and_direction_sampling_agree() -> Verdict {
                lights::area_and_direction_sampling_agree(&$subject)
            }

            #[test]
            fn directions_pass_chi_square() -> Verdict {
                lights::directions_pass_chi_square(&$subject)
            }

            #[test]
            fn wrong_densities_are_noticed() {
                let lying = Lying { subject: $subject, sampled: 1.02, queried: [1.0; 2] };
                assert!(lights::queried_density_equals_sampled_density(&lying).is_err());
                let lying = scaled($subject, 1.02);
                assert!(lights::mean_reciprocal_density_is_the_solid_angle(&lying).is_err());
                let lying = Lying { subject: $subject, sampled: 1.0, queried: [1.02; 2] };
                assert!(lights::directions_pass_chi_square(&lying).is_err());
            }
        }
    };
}

conformance!(constant_through_portals_around_a_slope, constant());
conformance!(envmap_through_portals_by_product, mapped(EnvironmentDensity::Product));
conformance!(envmap_through_portals_by_luminance, mapped(EnvironmentDensity::Luminance));

/// On its plane, at its corner, in its middle, beside it, as near and as far as numbers go.
#[test]
fn a_receiver_anywhere_near_a_portal_gets_finite_samples() -> Verdict {
    let portals = [opening(Vec3::ZERO, Vec3::Z, 1.0)];
    let light = Portals::new(Constant::new(Rgb::WHITE).unwrap(), &portals);
    let corner = portals[0].shape().point(1.0, 1.0).point;
    let feet = [Vec3::ZERO, corner, corner * 0.999_999, corner * 3.0, Vec3::X];
    let heights = [0.0, 1e-30, 1e-7, 1e-3, 1.0, 1e6, 1e18, -1e-7, -1.0];
    let normals = [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::new(1.0, 0.0, -1e-4)];
    let mut random = Uniforms::new(7);
    for (foot, height) in feet.into_iter().flat_map(|f| heights.map(|h| (f, h))) {
        for normal in normals {
            let from = receiver(foot + Vec3::Z * height, normal);
            for u in corners().chain((0..200).map(|_| random.two())) {
                let Some(sample) = light.sample(&from, SurfaceDensity::Auto, u) else { continue };
                let Density::SolidAngle(pdf) = sample.density else { continue };
                let queried = light.pdf_escaping(&from, sample.wi);
                ensure!(pdf > 0.0 && pdf.is_finite(), "density {pdf} at {u:?} from {from:?}");
                ensure!(queried.is_finite() && queried >= 0.0, "queried {queried} at {u:?} from {from:?}");
                ensure!(sample.wi.is_normalized(), "direction {} at {u:?} from {from:?}", sample.wi);
            }
        }
    }
    Ok(())
}

/// A receiver that sees no portal from the front has the environment's own density, to the last bit.
#[test]
fn where_no_portal_is_seen_nothing_changes() {
    let plain = Constant::new(Rgb::WHITE).unwrap();
    let portals = [opening(Vec3::Z, Vec3::Z * 2.0, 1.0)];
    let light = Portals::new(plain, &portals);
    let mut random = Uniforms::new(8);
    for normal in [Vec3::Z, Vec3::NEG_Z, Vec3::X] {
        let from = receiver(Vec3::ZERO, normal);
        for _ in 0..1000 {
            let u = random.two();
            assert_eq!(
                light.sample(&from, SurfaceDensity::Auto, u),
                plain.sample(&from, SurfaceDensity::Auto, u)
            );
        }
    }
}

/// A closed room of black walls 4 m wide around a white floor, but for a window of 1 m by 1 m above it.
fn room() -> Stage {
    let wall = |middle: Vec3, u: Vec3, v: Vec3| AnyShape::Rectangle(Rectangle::new(middle, u, v).unwrap());
    let (x, y, z) = (Vec3::X, Vec3::Y, Vec3::Z);
    let mut stage = Stage::empty().with(wall(Vec3::ZERO, x * 2.0, z * 2.0), WHITE);
    for (side, along) in [(x, z), (-x, z), (z, x), (-z, x)] {
        stage = stage.with(wall(side * 2.0 + y, along * 2.0, y * 2.0), BLACK);
    }
    // The ceiling, around the window.
    for (side, along, length) in [(x, z, 2.0), (-x, z, 2.0), (z, x, 0.5), (-z, x, 0.5)] {
        stage = stage.with(wall(side * 1.25 + y * 2.0, side * 0.75, along * length), BLACK);
    }
    stage.lit_by(AnyLight::Constant(Constant::new(Rgb::splat(3.0)).unwrap()))
}

/// The answer is in closed form: the window's projected solid angle times the sky's radiance. Portals
/// must not change it, and must pay.
#[test]
fn a_room_with_a_window_is_as_bright_and_much_less_noisy() -> Verdict {
    let window = Rectangle::new(Vec3::Y * 2.0, Vec3::X * 0.5, Vec3::Z * 0.5).unwrap();
    let portal = Portal::new(window).unwrap();
    assert!(portal.shape().normal().y < 0.0, "into the room");
    let (plain, mut with) = (room(), room());
    with.0.portals.push(portal);
    // Two parallel squares of side 1 at distance 2, from a point below the middle.
    let (a, h) = (0.5_f64, 2.0_f64);
    let edge = (a * a + h * h).sqrt();
    let exact = 3.0 * 4.0 * a / edge * (a / edge).atan() / std::f64::consts::PI;
    let toward = Vec3::new(0.1, 1.0, 0.2);
    let without = seen_at_origin(&plain.build(), &Direct::default(), toward, 1 << 18);
    let with = seen_at_origin(&with.build(), &Direct::default(), toward, 1 << 18);
    without.check_mean("without portals", exact, ROUNDING)?;
    with.check_mean("with portals", exact, ROUNDING)?;
    ensure!(with.check_mean("too bright", 1.02 * exact, ROUNDING).is_err(), "2 % go unnoticed");
    let ratio = without.variance() / with.variance();
    ensure!(ratio > 8.0, "portals divide the variance by {ratio}");
    Ok(())
}

/// A portal where there is no opening, and an opening without a portal, cost samples but no light.
#[test]
fn portals_in_the_wrong_place_change_nothing() -> Verdict {
    let mut wrong = room();
    let middle = Vec3::new(1.5, 2.0, 0.0);
    wrong.0.portals.push(Portal::new(Rectangle::new(middle, Vec3::X * 0.3, Vec3::Z * 0.5).unwrap()).unwrap());
    let toward = Vec3::new(0.1, 1.0, 0.2);
    let without = seen_at_origin(&room().build(), &Direct::default(), toward, 1 << 17);
    let with = seen_at_origin(&wrong.build(), &Direct::default(), toward, 1 << 17);
    with.check_same("with a portal in the ceiling", &without, ROUNDING)
}
