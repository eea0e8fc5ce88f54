//! A camera for scenes without one.

use crate::build::{CameraDescription, FovAxis, Geometry, Object, ProjectionDescription};
use crate::camera::{CameraError, View};
use crate::film::{Film, Filter};
use crate::geom::Aabb;
use crate::num;
use crate::shape::Shape;
use glam::Vec3;

/// Field of view along the shorter edge of the picture (degrees).
const FOV: f32 = 40.0;

/// The raster of a picture of which nothing is said, as Mitsuba 3 has it.
pub(super) const FILM: Film = match Film::new(768, 576, Filter::Gaussian { stddev: 0.5 }) {
    Ok(film) => film,
    Err(_) => panic!("no raster"),
};

/// A camera in front of the scene and somewhat above it, so far away that a sphere around the scene
/// fits into the picture.
pub(super) fn framing_camera(objects: &[Object]) -> Result<CameraDescription, CameraError> {
    let bounds = objects.iter().fold(Aabb::EMPTY, |b, o| {
        b.union(match &o.geometry {
            Geometry::Shape(shape) => shape.bounds(),
            Geometry::Mesh(mesh) => Aabb::around(&mesh.positions),
        })
    });
    let (centre, radius) =
        if bounds.is_empty() { (Vec3::ZERO, 1.0) } else { (bounds.centre(), 0.5 * bounds.diagonal()) };
    let distance = radius / num::sin_cos(0.5 * FOV.to_radians()).0;
    let origin = centre + Vec3::new(0.4, 0.35, 1.0).normalize() * distance;
    let view = View::look_at(origin, centre, Vec3::Y)?;
    let projection = ProjectionDescription::Perspective { fov: FOV, axis: FovAxis::Smaller };
    Ok(CameraDescription { view, projection, near: 1e-3 * distance, far: 2.0 * (distance + radius) })
}
