//! Disks and ellipses.

use super::planar::Planar;
use super::{Shape, ShapeError, ShapeHit, SurfacePoint, turn};
use crate::geom::{Aabb, PreparedRay, Ray};
use crate::num::{self, PI};
use glam::{Vec2, Vec3};

/// A disk, or an ellipse: a centre and two semi-axes at right angles. Its normal is `axis_u × axis_v`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Disk(Planar);

impl Disk {
    /// An ellipse with the given semi-axes (m); a disk when they have the same length.
    ///
    /// # Errors
    /// When a coordinate is not finite, the area is 0 or beyond `f32`, or the axes are not at right
    /// angles.
    pub fn new(centre: Vec3, axis_u: Vec3, axis_v: Vec3) -> Result<Self, ShapeError> {
        Planar::new(centre, axis_u, axis_v).map(Self)
    }

    /// A disk that was checked before: for constants; see [`crate::Scene::baked`].
    #[must_use]
    pub const fn baked(centre: Vec3, axis_u: Vec3, axis_v: Vec3) -> Self {
        Self(Planar { centre, axis_u, axis_v })
    }

    /// Centre (m).
    #[must_use]
    pub fn centre(&self) -> Vec3 {
        self.0.centre
    }

    /// First semi-axis (m).
    #[must_use]
    pub fn axis_u(&self) -> Vec3 {
        self.0.axis_u
    }

    /// Second semi-axis (m).
    #[must_use]
    pub fn axis_v(&self) -> Vec3 {
        self.0.axis_v
    }

    /// Unit normal.
    #[inline]
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        self.0.normal()
    }

    /// The same disk facing the other way.
    #[must_use]
    pub fn flipped(self) -> Self {
        Self(self.0.flipped())
    }

    /// The point at (u, v) in units of the semi-axes, `u² + v² ≤ 1`.
    #[inline]
    #[must_use]
    pub fn point(&self, u: f32, v: f32) -> SurfacePoint {
        self.0.surface_point(u, v)
    }

    /// Coordinates of a point in units of the semi-axes: the inverse of [`Disk::point`].
    #[inline]
    #[must_use]
    pub fn coordinates(&self, point: Vec3) -> (f32, f32) {
        self.0.coordinates(point)
    }
}

impl Shape for Disk {
    fn bounds(&self) -> Aabb {
        let (u, v) = (self.0.axis_u, self.0.axis_v);
        let extent = |a: f32, b: f32| num::sqrt(a * a + b * b);
        self.0.bounds_with(Vec3::new(extent(u.x, v.x), extent(u.y, v.y), extent(u.z, v.z)))
    }

    fn area(&self) -> f32 {
        PI * self.0.half_axes_area()
    }

    #[inline]
    fn intersect(&self, ray: &PreparedRay, t_max: f32) -> Option<ShapeHit> {
        let hit = self.0.intersect(ray, t_max)?;
        (hit.u * hit.u + hit.v * hit.v <= 1.0).then_some(hit)
    }

    /// A flat shape hides nothing of itself.
    #[inline]
    fn hides_itself(&self, _: &PreparedRay, _: f32) -> bool {
        false
    }

    fn is_flat(&self) -> bool {
        true
    }

    fn support(&self, origin: Vec3, direction: Vec3) -> f32 {
        let Planar { centre, axis_u, axis_v } = self.0;
        let (u, v) = (direction.dot(axis_u), direction.dot(axis_v));
        direction.dot(centre - origin) + num::sqrt(u * u + v * v)
    }

    #[inline]
    fn surface_point(&self, _ray: &Ray, hit: &ShapeHit) -> SurfacePoint {
        self.0.surface_point(hit.u, hit.v)
    }

    /// On the unit disk.
    fn unit_point(&self, point: Vec3) -> Vec3 {
        let (x, y) = self.coordinates(point);
        Vec3::new(x, y, 0.0)
    }

    /// Radius, and angle in turns.
    fn uv(&self, unit: Vec3) -> Vec2 {
        Vec2::new(num::sqrt(unit.x * unit.x + unit.y * unit.y), turn(unit))
    }

    fn unit_tangent(&self, unit: Vec3) -> Vec3 {
        Vec3::new(unit.x, unit.y, 0.0)
    }

    /// Away from the centre, and around it.
    fn tangents(&self, point: Vec3) -> [Vec3; 2] {
        let outward = point - self.centre();
        [outward, self.normal().cross(outward)]
    }

    fn check(&self) -> Result<(), ShapeError> {
        Planar::new(self.0.centre, self.0.axis_u, self.0.axis_v).map(drop)
    }
}
