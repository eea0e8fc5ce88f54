//! Irradiance from polygons.

use crate::light::{Receiver, SampledShape, Sides};
use crate::projected::{Chart, ProjectedPolygon};
use crate::shape::{Rectangle, Triangle};
use glam::{Vec2, Vec3};

/// Irradiance from either side of a rectangle, cut at the receiver's horizon; 0 in its plane.
#[must_use]
pub fn rectangle(from: &Receiver, rectangle: &Rectangle) -> f32 {
    rectangle.projected_solid_angle(from, Sides::Both).unwrap_or(0.0)
}

/// Irradiance from either side of a triangle, cut at the receiver's horizon; 0 in its plane.
#[must_use]
pub fn triangle(from: &Receiver, triangle: &Triangle) -> f32 {
    triangle.projected_solid_angle(from, Sides::Both).unwrap_or(0.0)
}

/// Irradiance from either side of a planar polygon, cut at the receiver's horizon; 0 in its plane.
///
/// * `corners` – in order (m), any number; the polygon need not be convex, but its edges must not cross
///
/// Derived: the sum over a fan of triangles, each with the sign of its orientation. One triangle is
/// the sum of its sectors (see [`ProjectedPolygon`]), which in exact arithmetic is the sum over its
/// edges of Lambert 1760, *Photometria*, and keeps its digits for any distance, size and aspect.
#[must_use]
pub fn polygon(from: &Receiver, corners: &[Vec3]) -> f32 {
    let [first, rest @ ..] = corners else { return 0.0 };
    let pieces = rest.windows(2).map(|pair| fan_piece(from, [*first, pair[0], pair[1]]));
    pieces.sum::<f32>().abs()
}

/// Irradiance from a triangle, negative when its corners run clockwise as the receiver sees them.
fn fan_piece(from: &Receiver, corners: [Vec3; 3]) -> f32 {
    let chart = Chart::from_corners(from.point, corners);
    let piece = ProjectedPolygon::<5>::new(from.normal, &chart, &[Vec2::ZERO, Vec2::X, Vec2::Y]);
    let size = piece.map_or(0.0, |piece| piece.projected_solid_angle());
    if chart.volume() < 0.0 { size } else { -size }
}
