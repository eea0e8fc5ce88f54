//! What rays rely on.

use halflight::geom::{PreparedRay, Ray, offset_origin};
use halflight::glam::{DVec3, Vec3};
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Shape, Sphere, SurfacePoint, Triangle};
use halflight_tests::random::Uniforms;
use halflight_tests::shapes::{bumpy_ball, random_point, random_shape};

fn hit(shape: &impl Shape, origin: Vec3, direction: Vec3) -> Option<f32> {
    shape.intersect(&PreparedRay::new(Ray::new(origin, direction)), f32::INFINITY).map(|h| h.t)
}

/// One of each, 1 across, at a distance from the origin.
fn one_of_each(offset: f32, size: f32) -> [AnyShape; 5] {
    let at = Vec3::new(0.6, -0.7, 0.8) * offset;
    let (u, v) = (Vec3::new(0.6, 0.64, -0.48) * size, Vec3::new(-0.8, 0.48, -0.36) * size);
    [
        AnyShape::Triangle(Triangle::new(at, at + u, at + v).unwrap()),
        AnyShape::Rectangle(Rectangle::new(at, u, v).unwrap()),
        AnyShape::Disk(Disk::new(at, u, v * 0.5).unwrap()),
        AnyShape::Sphere(Sphere::new(at, size).unwrap()),
        AnyShape::Cylinder(Cylinder::new(at, u, 0.4 * size).unwrap()),
    ]
}

/// Directions of the hemisphere around a normal, grazing ones more often than they are.
fn leaving(normal: Vec3, random: &mut Uniforms) -> Vec3 {
    let d = random.direction();
    let d = if d.dot(normal) < 0.0 { -d } else { d };
    if random.one() < 0.5 {
        return d;
    }
    let graze = 10.0_f32.powf(random.between(-6.0, 0.0));
    (d - normal * (d.dot(normal) * (1.0 - graze))).normalize()
}

#[track_caller]
fn does_not_meet_itself(shape: &AnyShape, at: &SurfacePoint, out: Vec3, random: &mut Uniforms) {
    let direction = leaving(out, random);
    // Flatter than the rounding of a normal, a direction may truly lead into the surface.
    if direction.dot(out) <= 1e-6 {
        return;
    }
    let origin = offset_origin(at.point, at.error, at.normal, direction);
    let met = hit(shape, origin, direction);
    assert!(met.is_none(), "{shape:?}: from {} along {direction} met at {met:?}", at.point);
}

/// Rays that leave a flat or convex surface do not meet it again, wherever it is.
mod a_ray_that_leaves_does_not_return {
    use super::*;

    const POINTS: usize = 200_000;

    fn check(kind: usize) {
        let mut random = Uniforms::new(81);
        for (offset, size) in [(0.0, 1.0), (1.0, 1.0), (1e3, 1.0), (1e6, 100.0), (1.0, 1e-3), (1e-3, 1e6)] {
            let shape = one_of_each(offset, size)[kind];
            for _ in 0..POINTS {
                let sampled = random_point(&shape, &mut random);
                does_not_meet_itself(&shape, &sampled, sampled.normal, &mut random);
                // And from where a ray has met it.
                let eye =
                    sampled.point + leaving(sampled.normal, &mut random) * (size * random.between(0.1, 10.0));
                let ray = Ray::new(eye, (sampled.point - eye).normalize());
                let Some(met) = shape.intersect(&PreparedRay::new(ray), f32::INFINITY) else { continue };
                let at = shape.surface_point(&ray, &met);
                does_not_meet_itself(&shape, &at, at.normal, &mut random);
                if kind <= 2 {
                    does_not_meet_itself(&shape, &at, -at.normal, &mut random);
                }
            }
        }
    }

    #[test]
    fn triangle() {
        check(0);
    }

    #[test]
    fn rectangle() {
        check(1);
    }

    #[test]
    fn disk() {
        check(2);
    }

    #[test]
    fn sphere() {
        check(3);
    }

    #[test]
    fn cylinder() {
        check(4);
    }
}

#[test]
fn no_ray_escapes_from_a_sphere() {
    let mut random = Uniforms::new(82);
    for (offset, radius) in [(0.0, 1.0_f32), (1e3, 1.0), (1e6, 100.0), (1.0, 1e6)] {
        let sphere = Sphere::new(Vec3::new(0.6, -0.7, 0.8) * offset, radius).unwrap().flipped();
        for _ in 0..200_000 {
            let at = random_point(&AnyShape::Sphere(sphere), &mut random);
            let direction = leaving(at.normal, &mut random);
            // Rays along the wall end within the offset.
            if direction.dot(at.normal) < 0.01 {
                continue;
            }
            let origin = offset_origin(at.point, at.error, at.normal, direction);
            let t = hit(&sphere, origin, direction);
            let chord = 2.0 * radius * direction.dot(at.normal);
            // The origin is off the wall by the error bound, and slides along it by that over the cosine.
            let slack = 1e-3 * chord + 8.0 * at.error.length() / direction.dot(at.normal);
            assert!(t.is_some_and(|t| (t - chord).abs() < slack), "{offset} {radius}: {t:?} for {chord}");
        }
    }
}

#[test]
pub(crate) fn every_ray_from_inside_a_closed_mesh_meets_it() {
    for (centre, radius) in [(Vec3::ZERO, 1.0), (Vec3::new(1e3, -2e3, 500.0), 1.0), (Vec3::ZERO, 1e6)] {
        let (corners, triangles) = bumpy_ball(8, centre, radius);
        let mut random = Uniforms::new(83);
        for i in 0..60_000 {
            let origin = centre + random.in_cube() * (0.3 * radius);
            // Into the open, at a corner, and at the middle of an edge.
            let target = match i % 3 {
                0 => origin + random.direction(),
                1 => corners[random.below(corners.len())],
                _ => {
                    let [a, b, _] = triangles[random.below(triangles.len())].corners();
                    a + (b - a) * 0.5
                }
            };
            let direction = (target - origin).normalize();
            assert!(triangles.iter().any(|t| hit(t, origin, direction).is_some()), "{origin} {direction}");
        }
    }
}

#[test]
pub(crate) fn a_sphere_is_met_within_four_ulps() {
    let mut random = Uniforms::new(84);
    for distance in [1.5_f32, 10.0, 1e3, 1e5] {
        for radius in [1.0_f32, 1e-3, 1e4] {
            let sphere = Sphere::new(random.direction() * (distance * radius), radius).unwrap();
            for _ in 0..20_000 {
                // Aimed at the middle half of its disk; at the rim the answer itself is not well known.
                let direction = (sphere.centre() + random.direction() * (0.5 * radius)).normalize();
                let t = f64::from(hit(&sphere, Vec3::ZERO, direction).expect("aimed at"));
                let (c, d): (DVec3, DVec3) = (sphere.centre().as_dvec3(), direction.as_dvec3());
                let b = c.dot(d) / d.length_squared();
                let offside = (c - d * b).length_squared();
                let truth = b - ((f64::from(radius).powi(2) - offside) / d.length_squared()).sqrt();
                let ulps = (t - truth).abs() / (truth * f64::from(f32::EPSILON));
                assert!(ulps <= 4.0, "{distance} {radius}: {t} instead of {truth}, {ulps} ulps");
            }
        }
    }
}

#[test]
fn what_a_ray_meets_is_on_the_ray_and_in_the_box() {
    let mut random = Uniforms::new(85);
    for _ in 0..200_000 {
        let shape = random_shape(&mut random, 2.0, 1.0);
        let ray = Ray::new(random.in_cube() * 5.0, random.direction());
        let Some(hit) = shape.intersect(&PreparedRay::new(ray), f32::INFINITY) else { continue };
        let at = shape.surface_point(&ray, &hit);
        let bounds = shape.bounds();
        assert!(at.point.cmpge(bounds.min).all() && at.point.cmple(bounds.max).all(), "{shape:?} {at:?}");
        // Grazing rays slide along the surface: by the rounding over the cosine.
        let slide = 1e-5 / at.normal.dot(ray.direction).abs().max(1e-3);
        assert!((ray.at(hit.t) - at.point).length() < slide, "{shape:?} {ray:?} {at:?}");
        assert!((at.normal.length() - 1.0).abs() < 1e-6);
        assert!(shape.intersect(&PreparedRay::new(ray), hit.t).is_none_or(|h| h.t < hit.t));
    }
}

#[test]
pub(crate) fn rays_that_are_not_numbers_meet_nothing() {
    for shape in one_of_each(0.0, 1.0) {
        for (origin, direction) in [
            (Vec3::NAN, Vec3::Z),
            (Vec3::ZERO, Vec3::NAN),
            (Vec3::new(0.0, f32::NAN, -5.0), Vec3::Z),
            (Vec3::new(0.1, 0.1, -5.0), Vec3::new(0.0, f32::NAN, 1.0)),
        ] {
            assert_eq!(hit(&shape, origin, direction), None, "{shape:?} {origin} {direction}");
        }
    }
}

#[test]
fn a_ray_in_the_plane_of_a_flat_shape_meets_nothing_or_a_number() {
    for shape in &one_of_each(0.0, 1.0)[..3] {
        let mut random = Uniforms::new(86);
        for _ in 0..10_000 {
            let a = random_point(shape, &mut random);
            let b = random_point(shape, &mut random);
            let direction = (b.point - a.point).normalize_or(Vec3::X);
            let t = hit(shape, a.point - direction * 3.0, direction);
            assert!(t.is_none_or(|t| t.is_finite() && t > 0.0), "{t:?}");
        }
    }
}
