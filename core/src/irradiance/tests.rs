//! Closed forms in single precision against double precision.

use super::*;
use crate::light::Receiver;
use crate::num::{self, PI};
use crate::projected::oracle::{self, double};
use crate::shape::{Rectangle, Triangle};
use glam::{DVec3, Quat, Vec3};

/// `10⁻⁵` of the irradiance; and, as the horizon is where a rounded normal says, some of the light.
#[track_caller]
fn agree(value: f32, from: &Receiver, corners: &[DVec3]) {
    let exact = oracle::projected_solid_angle(from, corners);
    let tolerance = 1e-5 * exact + 4e-7 * oracle::solid_angle(from, corners);
    let off = (f64::from(value) - exact).abs();
    assert!(off <= tolerance, "{value} {exact}, {:e} off: {from:?} {corners:?}", off / exact);
}

fn random(i: u32, k: u32) -> f32 {
    num::unit_f32(num::hash2(i, k))
}

/// A light with its centre, half-axes and normal, and a receiver.
#[derive(Debug, Clone, Copy)]
struct Case {
    centre: Vec3,
    u: Vec3,
    v: Vec3,
    from: Receiver,
}

/// Receivers `distance` sizes from some point in the light's plane, `angle` from its normal.
fn cases(scale: f32, aspect: f32, distance: f32, angle: f32) -> impl Iterator<Item = Case> {
    (0..120).map(move |i| {
        let r = |k| random(i, k);
        let euler = glam::EulerRot::XYZ;
        let turned = Quat::from_euler(euler, r(1) * 6.0, r(2) * 6.0, r(3) * 6.0);
        let turn = if i % 4 == 0 { Quat::IDENTITY } else { turned };
        let (u, v) = (turn * Vec3::X * (0.5 * scale), turn * Vec3::Y * (0.5 * scale / aspect));
        let normal = turn * Vec3::Z;
        let centre = if i % 3 == 0 { Vec3::new(r(4), r(5), r(6)) * scale } else { Vec3::ZERO };
        let (sin, cos) = num::sin_cos(r(7) * 6.3);
        let aside = turn * [Vec3::X, Vec3::Y, Vec3::new(cos, sin, 0.0)][(i as usize % 5).min(2)];
        let foot = match i % 7 {
            0 => centre,
            1 => centre + u,
            2 => centre + u + v,
            3 => centre + u * 2.0,
            _ => centre + u * (2.0 * r(8) - 1.0) + v * (2.0 * r(9) - 1.0),
        };
        let (sin, cos) = num::sin_cos(angle);
        let out = normal * cos + aside * sin;
        let across = normal.cross(aside);
        let facing = match i % 6 {
            0 => -out,
            1 => -normal,
            2 => (aside - out * 0.1).normalize(),
            3 => (across - out * 0.09).normalize(),
            4 => aside,
            _ => crate::warp::uniform_sphere([r(10), r(11)]),
        };
        let from = Receiver { point: foot + out * (distance * scale), normal: facing };
        Case { centre, u, v, from }
    })
}

/// Nearly the whole of distance × angle × scale × aspect.
fn matrix(mut check: impl FnMut(Case)) {
    for (scale, aspect) in [1e-6_f32, 1.0, 1e6].into_iter().flat_map(|s| [(s, 1.0_f32), (s, 1e3), (s, 1e6)]) {
        for distance in [1e-6, 1e-3, 0.1, 1.0, 1e3, 1e6] {
            for angle in [0.0, 0.7, 1.047, 2.5, num::FRAC_PI_2 - 1e-3] {
                // Where the light's own plane is not known well enough to say what is right.
                if distance * num::sin_cos(angle).1.abs() < 1e-8 * num::sqrt(aspect) {
                    continue;
                }
                cases(scale, aspect, distance, angle).for_each(&mut check);
            }
        }
    }
}

#[test]
fn rectangles_are_right_from_everywhere() {
    matrix(|Case { centre, u, v, from }| {
        let light = Rectangle::new(centre, u, v).unwrap();
        let [c, u, v] = [centre, u, v].map(|a| a.as_dvec3());
        agree(rectangle(&from, &light), &from, &[c - u - v, c + u - v, c + u + v, c - u + v]);
    });
}

#[test]
fn triangles_are_right_from_everywhere() {
    let mut i = 0;
    matrix(|Case { centre, u, v, from }| {
        i += 1;
        let corners =
            [centre - u - v, centre + u * (2.0 * random(i, 1) - 1.0) + v, centre + u - v * random(i, 2)];
        // The corners of a needle are rounded to a triangle without much of an area.
        if let Ok(light) = Triangle::new(corners[0], corners[1], corners[2]) {
            agree(triangle(&from, &light), &from, &double(&corners));
        }
    });
}

#[test]
fn the_zenith_may_be_anywhere() {
    let light = Rectangle::new(Vec3::Z, Vec3::X, Vec3::Y * 0.5).unwrap();
    let corners =
        double(&[[-1.0, -0.5], [1.0, -0.5], [1.0, 0.5], [-1.0, 0.5]].map(|[x, y]| Vec3::new(x, y, 1.0)));
    for x in [0.0, 0.3, 1.0, 1.0 + 1e-6, 1.0 - 1e-6, 2.0] {
        for y in [0.0, -0.5, 0.5, 0.5 - 1e-7, 0.5 + 1e-7, 0.7] {
            for point in [Vec3::new(x, y, 0.0), Vec3::new(-x, y, 0.999), Vec3::new(x, -y, 2.0)] {
                let normal = if point.z > 1.0 { Vec3::NEG_Z } else { Vec3::Z };
                let from = Receiver { point, normal };
                agree(rectangle(&from, &light), &from, &corners);
            }
        }
    }
}

#[test]
fn the_horizon_cuts_off_what_is_below() {
    let light = Rectangle::new(Vec3::new(0.0, 0.0, 0.0), Vec3::Z, Vec3::Y).unwrap();
    let at = |height| Receiver { point: Vec3::new(1.0, 0.0, height), normal: Vec3::Z };
    let upper = Rectangle::new(Vec3::Z * 0.5, Vec3::Z * 0.5, Vec3::Y).unwrap();
    assert!((rectangle(&at(0.0), &light) / rectangle(&at(0.0), &upper) - 1.0).abs() < 1e-6);
    assert!(rectangle(&at(0.999), &light) > 0.0);
    assert_eq!(rectangle(&at(1.0), &light), 0.0);
    assert_eq!(rectangle(&at(1.5), &light), 0.0);
}

#[test]
fn a_touching_light_fills_the_hemisphere_and_its_plane_is_dark() {
    let light = Rectangle::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap();
    let at = |z| Receiver { point: Vec3::new(0.1, 0.2, z), normal: Vec3::Z };
    assert!((rectangle(&at(-1e-6), &light) - PI).abs() < 1e-5);
    assert!((rectangle(&at(-1e-30), &light) - PI).abs() < 1e-5);
    assert_eq!(rectangle(&at(0.0), &light), 0.0);
    let aside = Receiver { point: Vec3::new(0.1, 0.2, -1e-6), normal: Vec3::X };
    assert!((rectangle(&aside, &light) - PI / 2.0).abs() < 1e-5);
}

#[test]
fn polygons_need_not_be_convex() {
    // A staple, from both sides and in both orders.
    let mut corners =
        [[0.0, 0.0], [3.0, 0.0], [3.0, 2.0], [2.0, 2.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]]
            .map(|[x, y]| Vec3::new(x, y, 1.0));
    for point in [Vec3::new(1.5, 1.5, 0.0), Vec3::new(-2.0, 4.0, 0.5), Vec3::new(2.5, 1.7, 3.0)] {
        for normal in [Vec3::new(0.0, 0.6, 0.8), Vec3::new(0.6, 0.0, -0.8)] {
            let from = Receiver { point, normal };
            agree(polygon(&from, &corners), &from, &double(&corners));
        }
        corners.reverse();
    }
    let from = Receiver { point: Vec3::ZERO, normal: Vec3::Z };
    assert_eq!(polygon(&from, &[]), 0.0);
    assert_eq!(polygon(&from, &corners[..2]), 0.0);
    assert_eq!(polygon(&Receiver { point: Vec3::Z, ..from }, &corners), 0.0);
}
