//! Shapes from a unit shape and a transform, in double precision.
//!
//! Normals are those of Mitsuba 3: a rectangle and a disk keep the normal `M⁻ᵀ z` when they are
//! mirrored, a mirrored sphere is seen from inside, a mirrored cylinder is not.

use crate::build::{Geometry, Mesh};
use crate::load::Problem;
use crate::shape::{AnyShape, Cylinder, Disk, Rectangle, Sphere};
use crate::texture::ObjectSpace;
use glam::{DMat3, DMat4, DVec3, Vec2, Vec3};
use std::vec::Vec;

/// Cosine up to which two axes are at right angles: below it the shape is off by less than 1e-5 of
/// its size, which is the precision of a matrix written with six digits.
const RIGHT_ANGLE: f64 = 1e-5;
/// How far the lengths of axes may differ in a transform that has only one scale.
const SAME_LENGTH: f64 = 1e-4;

/// The linear part, when it can be inverted.
fn linear(m: &DMat4) -> Result<DMat3, Problem> {
    let l = DMat3::from_mat4(*m);
    let volume = l.determinant();
    let size = l.x_axis.length() * l.y_axis.length() * l.z_axis.length();
    if volume.abs() > 1e-12 * size {
        Ok(l)
    } else {
        Err(Problem::Transform { must: "have an inverse: no scale of 0, no axis in the plane of the others" })
    }
}

/// The space of a unit shape and its transform.
pub(super) fn object_space(m: &DMat4) -> ObjectSpace {
    let to_object = DMat3::from_mat4(*m).inverse().as_mat3();
    ObjectSpace { origin: m.w_axis.truncate().as_vec3(), to_object }
}

/// From the cylinder of radius 1 along z from 0 to 1 to the one given by its ends and radius, turned
/// as in Mitsuba 3.
pub(super) fn unit_cylinder(ends: [DVec3; 2], radius: f64) -> DMat4 {
    let along = ends[1] - ends[0];
    let axis = along.try_normalize().unwrap_or(DVec3::Z);
    let (s, t) = axis.any_orthonormal_pair();
    DMat4::from_cols(
        (s * radius).extend(0.0),
        (t * radius).extend(0.0),
        along.extend(0.0),
        ends[0].extend(1.0),
    )
}

fn cosine(a: DVec3, b: DVec3) -> f64 {
    a.dot(b) / (a.length() * b.length())
}

/// `[−1, 1]²` in the plane `z = 0`; two triangles when it is sheared.
pub(super) fn rectangle(m: &DMat4, flip: bool) -> Result<Geometry, Problem> {
    let l = linear(m)?;
    let (centre, u) = (m.w_axis.truncate(), l.x_axis);
    let v = if (l.determinant() < 0.0) != flip { -l.y_axis } else { l.y_axis };
    if cosine(u, v).abs() <= RIGHT_ANGLE {
        let rectangle = Rectangle::new(centre.as_vec3(), u.as_vec3(), v.as_vec3())?;
        return Ok(Geometry::Shape(AnyShape::Rectangle(rectangle)));
    }
    let positions: Vec<Vec3> =
        [-u - v, u - v, u + v, v - u].iter().map(|corner| (centre + *corner).as_vec3()).collect();
    for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
        crate::shape::Triangle::new(positions[a], positions[b], positions[c])?;
    }
    // The second axis is turned around with the normal; texture coordinates stay where they are.
    let (low, high) = if v.dot(l.y_axis) < 0.0 { (1.0, 0.0) } else { (0.0, 1.0) };
    let uvs = [[0.0, low], [1.0, low], [1.0, high], [0.0, high]].map(Vec2::from_array).to_vec();
    let triangles = [[0, 1, 2], [0, 2, 3]].to_vec();
    Ok(Geometry::Mesh(Mesh { positions, normals: Vec::new(), uvs, triangles }))
}

/// The unit disk in the plane `z = 0`; an ellipse when it is scaled or sheared.
pub(super) fn disk(m: &DMat4, flip: bool) -> Result<Geometry, Problem> {
    let l = linear(m)?;
    let (mut u, mut v) = (l.x_axis, l.y_axis);
    if cosine(u, v).abs() > RIGHT_ANGLE {
        // Principal axes: the turn in the plane of the disk that makes the images of its axes
        // orthogonal diagonalises their Gram matrix.
        let angle = 0.5 * libm::atan2(2.0 * u.dot(v), u.length_squared() - v.length_squared());
        let (sin, cos) = libm::sincos(angle);
        (u, v) = (u * cos + v * sin, v * cos - u * sin);
    }
    if (l.determinant() < 0.0) != flip {
        v = -v;
    }
    let disk = Disk::new(m.w_axis.truncate().as_vec3(), u.as_vec3(), v.as_vec3())?;
    Ok(Geometry::Shape(AnyShape::Disk(disk)))
}

/// A sphere stays one only when all directions are scaled alike.
pub(super) fn sphere(m: &DMat4, centre: DVec3, radius: f64, flip: bool) -> Result<Geometry, Problem> {
    let l = linear(m)?;
    let scale = l.x_axis.length();
    if !similar(&[l.x_axis, l.y_axis, l.z_axis]) {
        return Err(Problem::Transform { must: "scale a sphere alike in all directions, without shear" });
    }
    let sphere = Sphere::new(m.transform_point3(centre).as_vec3(), (radius * scale) as f32)?;
    let inward = (l.determinant() < 0.0) != flip;
    Ok(Geometry::Shape(AnyShape::Sphere(if inward { sphere.flipped() } else { sphere })))
}

/// A cylinder stays one only when its axis stays at right angles to its circles, and these round.
pub(super) fn cylinder(m: &DMat4, ends: [DVec3; 2], radius: f64, flip: bool) -> Result<Geometry, Problem> {
    let l = linear(m)?;
    let along = ends[1] - ends[0];
    let across = along.try_normalize().map(DVec3::any_orthonormal_pair);
    let (a, b) = across.unwrap_or((DVec3::X, DVec3::Y));
    let (image_a, image_b, axis) = (l * a, l * b, l * along);
    let upright = axis.length() == 0.0
        || (cosine(image_a, axis).abs() < SAME_LENGTH && cosine(image_b, axis).abs() < SAME_LENGTH);
    if !upright || !similar(&[image_a, image_b]) {
        return Err(Problem::Transform {
            must: "scale a cylinder alike in all directions across its axis, without shear",
        });
    }
    let base = m.transform_point3(ends[0]);
    let cylinder = Cylinder::new(base.as_vec3(), axis.as_vec3(), (radius * image_a.length()) as f32)?;
    Ok(Geometry::Shape(AnyShape::Cylinder(if flip { cylinder.flipped() } else { cylinder })))
}

/// True when axes are at right angles and equally long.
fn similar(axes: &[DVec3]) -> bool {
    axes.iter().enumerate().all(|(i, a)| {
        axes[..i].iter().all(|b| {
            cosine(*a, *b).abs() < SAME_LENGTH && (a.length() / b.length() - 1.0).abs() < SAME_LENGTH
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Shape;

    #[test]
    fn a_sheared_disk_is_the_ellipse_that_its_points_lie_on() {
        let m = DMat4::from_cols_array(&[
            1.0, 0.2, 0.3, 0.0, 0.5, 2.0, -0.1, 0.0, 0.0, 0.0, 1.0, 0.0, 4.0, 5.0, 6.0, 1.0,
        ]);
        let Geometry::Shape(AnyShape::Disk(d)) = disk(&m, false).unwrap() else { panic!("no disk") };
        for i in 0..64 {
            let (sin, cos) = (f64::from(i) * 0.1).sin_cos();
            let (u, v) = d.coordinates(m.transform_point3(DVec3::new(cos, sin, 0.0)).as_vec3());
            assert!((u.hypot(v) - 1.0).abs() < 1e-5, "{u} {v}");
        }
        let n = m.x_axis.truncate().cross(m.y_axis.truncate()).normalize().as_vec3();
        assert!(n.dot(d.normal()) > 0.999_999);
    }

    #[test]
    fn mirrored_flat_shapes_keep_their_normal() {
        for (scale, z) in [
            (DVec3::new(-1.0, 1.0, 1.0), 1.0),
            (DVec3::new(1.0, 1.0, -1.0), -1.0),
            (DVec3::new(-1.0, -1.0, 1.0), 1.0),
        ] {
            let m = DMat4::from_scale(scale);
            for flip in [false, true] {
                let expected = Vec3::Z * if flip { -z } else { z };
                let Geometry::Shape(AnyShape::Rectangle(r)) = rectangle(&m, flip).unwrap() else {
                    panic!("no rectangle")
                };
                let Geometry::Shape(AnyShape::Disk(d)) = disk(&m, flip).unwrap() else { panic!("no disk") };
                assert_eq!((r.normal(), d.normal()), (expected, expected), "{scale} {flip}");
            }
        }
    }

    #[test]
    fn a_mirrored_sphere_is_seen_from_inside_and_a_mirrored_cylinder_is_not() {
        let mirror = DMat4::from_scale(DVec3::new(-2.0, 2.0, 2.0));
        let Geometry::Shape(AnyShape::Sphere(s)) = sphere(&mirror, DVec3::X, 0.5, false).unwrap() else {
            panic!("no sphere")
        };
        assert!(s.is_inward() && s.radius() == 1.0 && s.centre() == Vec3::new(-2.0, 0.0, 0.0));
        let ends = [DVec3::ZERO, DVec3::Z];
        let Geometry::Shape(AnyShape::Cylinder(c)) = cylinder(&mirror, ends, 0.5, false).unwrap() else {
            panic!("no cylinder")
        };
        assert!(!c.is_inward() && c.radius() == 1.0 && c.axis() == Vec3::Z * 2.0);
    }

    #[test]
    fn a_cylinder_may_be_stretched_along_its_axis_only() {
        let ends = [DVec3::ZERO, DVec3::Y];
        let stretched = |x, y, z| cylinder(&DMat4::from_scale(DVec3::new(x, y, z)), ends, 1.0, false);
        assert!(stretched(1.0, 3.0, 1.0).is_ok());
        assert!(matches!(stretched(2.0, 1.0, 1.0), Err(Problem::Transform { .. })));
    }

    #[test]
    fn a_sheared_rectangle_covers_the_same_parallelogram() {
        let mut m = DMat4::IDENTITY;
        m.y_axis.x = 0.5;
        for flip in [false, true] {
            let Geometry::Mesh(mesh) = rectangle(&m, flip).unwrap() else { panic!("no mesh") };
            let area: f32 = mesh
                .triangles
                .iter()
                .map(|t| t.map(|i| mesh.positions[i as usize]))
                .map(|[a, b, c]| {
                    let t = crate::shape::Triangle::new(a, b, c).unwrap();
                    assert_eq!(t.normal().z > 0.0, !flip);
                    t.area()
                })
                .sum();
            assert!((area - 4.0).abs() < 1e-6);
        }
    }

    #[test]
    fn transforms_without_inverse_are_refused() {
        let flat = DMat4::from_scale(DVec3::new(1.0, 1.0, 0.0));
        assert!(matches!(rectangle(&flat, false), Err(Problem::Transform { .. })));
        assert!(matches!(disk(&DMat4::ZERO, false), Err(Problem::Transform { .. })));
        let bent = DMat4::from_scale(DVec3::new(1.0, 1.0, 2.0));
        assert!(matches!(sphere(&bent, DVec3::ZERO, 1.0, false), Err(Problem::Transform { .. })));
    }
}
