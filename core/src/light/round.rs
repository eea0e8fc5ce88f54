//! What holds for every round light.

use super::{Receiver, SampledShape, Sides, SurfaceDensity, SurfaceView};
use crate::num;
use crate::shape::{Cylinder, Disk, Sphere};
use crate::warp;
use glam::Vec3;
use std::format;

const METHODS: [SurfaceDensity; 4] =
    [SurfaceDensity::Area, SurfaceDensity::SolidAngle, SurfaceDensity::Projected, SurfaceDensity::Auto];

fn uniforms(i: u32) -> [f32; 2] {
    [num::unit_f32(num::hash2(i, 1)), num::unit_f32(num::hash2(i, 2))]
}

/// A number of any size and sign from 1e-12 to 1e12.
fn any(i: u32, j: u32) -> f32 {
    let [a, b] = uniforms(num::hash2(i, j));
    num::pow(10.0, 24.0 * a - 12.0).copysign(b - 0.5)
}

fn any_vec(i: u32, j: u32) -> Vec3 {
    Vec3::new(any(i, j), any(i, j + 1), any(i, j + 2))
}

/// A sample is finite, or there is none.
#[track_caller]
fn is_sound<S: SampledShape + core::fmt::Debug>(shape: S, from: &Receiver, u: [f32; 2]) {
    for sides in [Sides::Front, Sides::Both] {
        if let Some(e) = shape.projected_solid_angle(from, sides) {
            assert!((0.0..=3.141_65).contains(&e), "{shape:?} {from:?} {e}");
        }
        for method in METHODS {
            let Some(view) = shape.view(from, method, sides) else { continue };
            let Some(sample) = view.sample(u) else { continue };
            let what = format!("{shape:?} {from:?} {method:?} {u:?} {sample:?}");
            assert!((sample.wi.length() - 1.0).abs() < 1e-5, "{what}");
            assert!(sample.distance > 0.0 && sample.at.point.is_finite(), "{what}");
            if let Some(pdf) = view.pdf_solid_angle(&sample.at, sample.wi, 1.0) {
                assert!(pdf > 0.0 && pdf.is_finite(), "{what} {pdf}");
            }
            if let Some(v) = view.invert(&sample.at, sample.wi) {
                assert!(v.iter().all(|x| *x >= 0.0 && *x < 1.0), "{what} {v:?}");
            }
        }
    }
}

#[test]
fn random_configurations_give_finite_samples() {
    for i in 0..60_000u32 {
        let normal = warp::uniform_sphere(uniforms(i));
        let from = Receiver { point: any_vec(i, 10), normal };
        let (u, axis) = (uniforms(i + 7), warp::uniform_sphere(uniforms(i + 9)));
        let size = any(i, 20).abs();
        // Beside the receiver as often as anywhere.
        let centre =
            if i % 2 == 0 { from.point + axis * (size * any(i, 4).abs().min(2.0)) } else { any_vec(i, 30) };
        if let Ok(sphere) = Sphere::new(centre, size) {
            is_sound(sphere, &from, u);
            is_sound(sphere.flipped(), &from, u);
        }
        let across = axis.any_orthonormal_vector();
        if let Ok(disk) = Disk::new(centre, axis * size, across * any(i, 40)) {
            is_sound(disk, &from, u);
        }
        if let Ok(tube) = Cylinder::new(centre, axis * any(i, 50), size) {
            is_sound(tube, &from, u);
            is_sound(tube.flipped(), &from, u);
        }
    }
}

/// The inverse returns the uniforms.
#[track_caller]
fn inverts<S: SampledShape + core::fmt::Debug>(shape: S, from: &Receiver, tolerance: f32) {
    for method in [SurfaceDensity::SolidAngle, SurfaceDensity::Projected] {
        let Some(view) = shape.view(from, method, Sides::Front) else { continue };
        let mut inverted = 0;
        for i in 0..2000 {
            let u = uniforms(i).map(|x| 0.01 + 0.98 * x);
            let Some(sample) = view.sample(u) else { continue };
            let Some(v) = view.invert(&sample.at, sample.wi) else { continue };
            let off = (u[0] - v[0]).abs().max((u[1] - v[1]).abs());
            let polar = u[0].min((u[0] - 0.5).abs().max((u[1] - 0.5).abs()));
            assert!(off < tolerance || polar < 0.02, "{shape:?} {from:?} {method:?}: {u:?} became {v:?}");
            inverted += 1;
        }
        assert!(inverted > 1800, "{shape:?} {from:?} {method:?}: {inverted}");
    }
}

#[test]
fn inverses_return_the_uniforms() {
    for distance in [1e-3, 0.3, 2.0, 100.0_f32] {
        let tolerance = 1e-4 * (1.0 + 0.1 * distance + 0.01 / distance);
        for tilt in [0.0, 0.8, 1.5, 1.7_f32] {
            let (sin, cos) = num::sin_cos(tilt);
            let from = Receiver { point: Vec3::ZERO, normal: Vec3::new(sin, 0.0, cos) };
            let ball = Sphere::new(Vec3::Z * (1.0 + distance), 1.0).unwrap();
            inverts(ball, &from, tolerance);
            let disk = Disk::new(Vec3::new(0.4, 0.1, distance), Vec3::Y * 0.7, Vec3::X).unwrap();
            inverts(disk, &from, tolerance);
            let tube = Cylinder::new(Vec3::new(-0.4, 0.1, 1.0 + distance), Vec3::X * 1.4, 1.0).unwrap();
            inverts(tube, &from, tolerance);
        }
    }
}

/// Samples, densities and the irradiance from a scene and from the same in another unit of length.
#[track_caller]
fn is_scale_free<S: SampledShape + core::fmt::Debug>(
    [one, other]: [S; 2],
    from: [&Receiver; 2],
    u: [f32; 2],
) {
    let e =
        [one.projected_solid_angle(from[0], Sides::Both), other.projected_solid_angle(from[1], Sides::Both)];
    assert_eq!(e[0], e[1], "{one:?} {from:?}");
    for method in METHODS {
        let drawn = [(one, from[0]), (other, from[1])].map(|(shape, from)| {
            let view = shape.view(from, method, Sides::Both)?;
            let sample = view.sample(u)?;
            let cos = sample.at.normal.dot(sample.wi).abs();
            Some((sample.wi, view.pdf_solid_angle(&sample.at, sample.wi, cos)))
        });
        assert_eq!(drawn[0], drawn[1], "{one:?} {from:?} {method:?} {u:?}");
    }
}

#[test]
fn a_power_of_two_as_unit_of_length_changes_no_bit() {
    for i in 0..20_000u32 {
        let [a, b] = uniforms(i + 3);
        let size = num::pow(10.0, 14.0 * a - 7.0);
        let (axis, place) = (warp::uniform_sphere(uniforms(i)), warp::uniform_sphere(uniforms(i + 5)));
        let across = axis.any_orthonormal_vector();
        let distance = num::pow(10.0, 6.0 * b - 3.0);
        let normal = warp::uniform_sphere(uniforms(i + 7));
        let k = libm::exp2f((i % 13) as f32 - 6.0);
        let [near, far] = [1.0, k].map(|k| Receiver { point: place * (distance * size) * k, normal });
        let (u, from) = (uniforms(i + 9), [&near, &far]);
        let disk = |k: f32| Disk::new(Vec3::ZERO, axis * size * k, across * (0.3 * size) * k).unwrap();
        is_scale_free([disk(1.0), disk(k)], from, u);
        let ball = |k: f32| Sphere::new(Vec3::ZERO, size * k).unwrap();
        is_scale_free([ball(1.0), ball(k)], from, u);
        let tube = |k: f32| Cylinder::new(Vec3::ZERO, axis * size * k, 0.3 * size * k).unwrap();
        is_scale_free([tube(1.0), tube(k)], from, u);
    }
}
