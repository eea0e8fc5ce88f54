//! Shapes and rays in bulk.

use crate::random::Uniforms;
use halflight::glam::Vec3;
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Shape, Sphere, SurfacePoint, Triangle};

/// An expression over a shape of whatever kind.
#[macro_export]
macro_rules! with_shape {
    ($shape:expr, $inner:ident => $body:expr) => {
        match $shape {
            halflight::shape::AnyShape::Triangle($inner) => $body,
            halflight::shape::AnyShape::Rectangle($inner) => $body,
            halflight::shape::AnyShape::Disk($inner) => $body,
            halflight::shape::AnyShape::Sphere($inner) => $body,
            halflight::shape::AnyShape::Cylinder($inner) => $body,
        }
    };
}

/// A random shape about `size` across within a cube of half-edge `spread`.
pub fn random_shape(random: &mut Uniforms, spread: f32, size: f32) -> AnyShape {
    let at = random.in_cube() * spread;
    let u = random.direction();
    let v = u.cross(random.direction()).normalize_or(u.any_orthonormal_vector());
    let (a, b) = (size * random.between(0.2, 1.0), size * random.between(0.2, 1.0));
    let made = match random.below(5) {
        0 => Triangle::new(at, at + u * a, at + v * b + u * (0.3 * a)).map(AnyShape::Triangle),
        1 => Rectangle::new(at, u * a, v * b).map(AnyShape::Rectangle),
        2 => Disk::new(at, u * a, v * b).map(AnyShape::Disk),
        3 => Sphere::new(at, a).map(AnyShape::Sphere),
        _ => Cylinder::new(at, u * a, b).map(AnyShape::Cylinder),
    };
    made.expect("a proper shape")
}

/// A random point of a shape, outward.
pub fn random_point(shape: &AnyShape, random: &mut Uniforms) -> SurfacePoint {
    use halflight::light::SampledShape;
    let u = random.two();
    with_shape!(shape, s => s.sample_area(u))
}

/// A closed mesh: a torus-like ring of bumps around a sphere, as triangles with shared corners.
#[must_use]
pub fn bumpy_ball(rings: usize, centre: Vec3, radius: f32) -> (Vec<Vec3>, Vec<Triangle>) {
    let mut random = Uniforms::new(71);
    let around = 2 * rings;
    let mut corners = vec![centre + Vec3::Z * radius, centre - Vec3::Z * radius];
    for i in 1..rings {
        for j in 0..around {
            let (sin, cos) = (std::f32::consts::PI * i as f32 / rings as f32).sin_cos();
            let (y, x) = (std::f32::consts::TAU * j as f32 / around as f32).sin_cos();
            let bump = radius * random.between(0.9, 1.1);
            corners.push(centre + Vec3::new(sin * x, sin * y, cos) * bump);
        }
    }
    let at = |i: usize, j: usize| match i {
        0 => 0,
        i if i == rings => 1,
        i => 2 + (i - 1) * around + j % around,
    };
    let mut triangles = Vec::new();
    for i in 0..rings {
        for j in 0..around {
            let quad = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)].map(|k| corners[k]);
            triangles.extend(Triangle::new(quad[0], quad[1], quad[2]));
            triangles.extend(Triangle::new(quad[0], quad[2], quad[3]));
        }
    }
    (corners, triangles)
}

/// The nearest hit among some shapes, one after the other.
pub fn brute_force<S: Shape>(
    shapes: &[S],
    ray: &halflight::geom::PreparedRay,
    t_max: f32,
) -> Option<(f32, usize)> {
    let mut nearest = None;
    let mut reach = t_max;
    for (i, shape) in shapes.iter().enumerate() {
        if let Some(hit) = shape.intersect(ray, reach) {
            reach = hit.t;
            nearest = Some((hit.t, i));
        }
    }
    nearest
}
