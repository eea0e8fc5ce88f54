//! Rectangles.

use super::planar::Planar;
use super::{Shape, ShapeError, ShapeHit, SurfacePoint};
use crate::geom::{Aabb, PreparedRay, Ray};
use glam::{Vec2, Vec3};

/// How far outside its edges a rectangle is still met, in units of the half-edge: a few roundings,
/// so that two rectangles that share an edge leave no gap.
const EDGE_SLACK: f32 = 1.0 + 4.0 * f32::EPSILON;

/// A rectangle: a centre and two half-edges at right angles. Its normal is `half_u × half_v`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rectangle(Planar);

impl Rectangle {
    /// A rectangle with corners `centre ± half_u ± half_v` (m).
    ///
    /// # Errors
    /// When a coordinate is not finite, the area is 0 or beyond `f32`, or the edges are not at right
    /// angles.
    pub fn new(centre: Vec3, half_u: Vec3, half_v: Vec3) -> Result<Self, ShapeError> {
        Planar::new(centre, half_u, half_v).map(Self)
    }

    /// A rectangle that was checked before: for constants; see [`crate::Scene::baked`].
    #[must_use]
    pub const fn baked(centre: Vec3, half_u: Vec3, half_v: Vec3) -> Self {
        Self(Planar { centre, axis_u: half_u, axis_v: half_v })
    }

    /// Centre (m).
    #[must_use]
    pub fn centre(&self) -> Vec3 {
        self.0.centre
    }

    /// First half-edge (m).
    #[must_use]
    pub fn half_u(&self) -> Vec3 {
        self.0.axis_u
    }

    /// Second half-edge (m).
    #[must_use]
    pub fn half_v(&self) -> Vec3 {
        self.0.axis_v
    }

    /// Unit normal.
    #[inline]
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        self.0.normal()
    }

    /// The same rectangle facing the other way.
    #[must_use]
    pub fn flipped(self) -> Self {
        Self(self.0.flipped())
    }

    /// The point at (u, v) in units of the half-edges, each in `[−1, 1]`.
    #[inline]
    #[must_use]
    pub fn point(&self, u: f32, v: f32) -> SurfacePoint {
        self.0.surface_point(u, v)
    }

    /// Coordinates of a point in units of the half-edges: the inverse of [`Rectangle::point`].
    #[inline]
    #[must_use]
    pub fn coordinates(&self, point: Vec3) -> (f32, f32) {
        self.0.coordinates(point)
    }
}

impl Shape for Rectangle {
    fn bounds(&self) -> Aabb {
        self.0.bounds_with(self.0.axis_u.abs() + self.0.axis_v.abs())
    }

    fn area(&self) -> f32 {
        4.0 * self.0.half_axes_area()
    }

    #[inline]
    fn intersect(&self, ray: &PreparedRay, t_max: f32) -> Option<ShapeHit> {
        let hit = self.0.intersect(ray, t_max)?;
        (hit.u.abs() <= EDGE_SLACK && hit.v.abs() <= EDGE_SLACK).then_some(hit)
    }

    /// A flat shape hides nothing of itself.
    #[inline]
    fn hides_itself(&self, _: &PreparedRay, _: f32) -> bool {
        false
    }

    fn is_flat(&self) -> bool {
        true
    }

    fn outline(&self) -> Option<[Vec3; 4]> {
        let Planar { centre, axis_u, axis_v } = self.0;
        Some(
            [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                .map(|(u, v)| centre + axis_u * u + axis_v * v),
        )
    }

    fn support(&self, origin: Vec3, direction: Vec3) -> f32 {
        let Planar { centre, axis_u, axis_v } = self.0;
        direction.dot(centre - origin) + direction.dot(axis_u).abs() + direction.dot(axis_v).abs()
    }

    #[inline]
    fn surface_point(&self, _ray: &Ray, hit: &ShapeHit) -> SurfacePoint {
        self.0.surface_point(hit.u, hit.v)
    }

    /// From a corner at `(−1, −1)` to one at `(1, 1)`.
    fn unit_point(&self, point: Vec3) -> Vec3 {
        let (x, y) = self.coordinates(point);
        Vec3::new(x, y, 0.0)
    }

    /// 0 to 1 along each edge.
    fn uv(&self, unit: Vec3) -> Vec2 {
        Vec2::new(0.5 * unit.x + 0.5, 0.5 * unit.y + 0.5)
    }

    /// Along the edges.
    fn tangents(&self, _: Vec3) -> [Vec3; 2] {
        [self.half_u(), self.half_v()]
    }

    fn check(&self) -> Result<(), ShapeError> {
        Planar::new(self.0.centre, self.0.axis_u, self.0.axis_v).map(drop)
    }
}
