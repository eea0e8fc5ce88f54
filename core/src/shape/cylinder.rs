//! Open cylinders.

use super::sphere::roots;
use super::{Shape, ShapeError, ShapeHit, SurfacePoint, turn};
use crate::geom::{Aabb, Frame, PreparedRay, Ray, unit};
use crate::num::{self, TAU};
use glam::{Vec2, Vec3};

/// A cylinder without caps. Its normal points away from the axis, or toward it after
/// [`Cylinder::flipped`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cylinder {
    base: Vec3,
    axis: Vec3,
    radius: f32,
    inward: bool,
}

impl Cylinder {
    /// A cylinder around the segment from `base` to `base + axis` (m).
    ///
    /// # Errors
    /// When a number is not finite, or the radius or the length is 0 or beyond `f32`.
    pub fn new(base: Vec3, axis: Vec3, radius: f32) -> Result<Self, ShapeError> {
        if !base.is_finite() {
            return Err(ShapeError::NotFinite { field: "the base" });
        }
        if !axis.is_finite() {
            return Err(ShapeError::NotFinite { field: "the axis" });
        }
        if !radius.is_finite() {
            return Err(ShapeError::NotFinite { field: "the radius" });
        }
        if radius <= 0.0 || !(radius * radius).is_normal() {
            return Err(ShapeError::Degenerate { what: "radius in m", value: radius });
        }
        if !axis.length_squared().is_normal() {
            return Err(ShapeError::Degenerate { what: "length in m", value: axis.length() });
        }
        Ok(Self { base, axis, radius, inward: false })
    }

    /// A cylinder that was checked before: for constants; see [`crate::Scene::baked`].
    #[must_use]
    pub const fn baked(base: Vec3, axis: Vec3, radius: f32) -> Self {
        Self { base, axis, radius, inward: false }
    }

    /// Centre of the lower end (m).
    #[must_use]
    pub const fn base(&self) -> Vec3 {
        self.base
    }

    /// From the lower to the upper end (m).
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.axis
    }

    /// Radius (m).
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// True when the normal points to the axis.
    #[must_use]
    pub const fn is_inward(&self) -> bool {
        self.inward
    }

    /// The same cylinder facing the other way.
    #[must_use]
    pub const fn flipped(self) -> Self {
        Self { inward: !self.inward, ..self }
    }

    /// The surface point at height `h` in `[0, 1]`, in the unit direction `n` from the axis.
    #[inline]
    #[must_use]
    pub fn point(&self, h: f32, n: Vec3) -> SurfacePoint {
        let (along, arm) = (self.axis * h, n * self.radius);
        SurfacePoint {
            point: self.base + along + arm,
            error: (self.base.abs() + along.abs() + arm.abs()) * num::gamma(10),
            normal: if self.inward { -n } else { n },
        }
    }

    /// Unit vector along the axis.
    #[inline]
    #[must_use]
    pub fn unit_axis(&self) -> Vec3 {
        self.axis / self.axis.length()
    }

    /// Height of a point in units of the axis, and its unit direction from the axis.
    #[inline]
    #[must_use]
    pub fn coordinates(&self, point: Vec3) -> (f32, Vec3) {
        let r = point - self.base;
        let h = r.dot(self.axis) / self.axis.length_squared();
        (h, unit(r - self.axis * h).unwrap_or(Vec3::X))
    }
}

impl Shape for Cylinder {
    fn bounds(&self) -> Aabb {
        // A circle around axis a extends by r √(1 − a_i²) along axis i.
        let a = self.unit_axis();
        let across = Vec3::ONE - a * a;
        let extent = Vec3::new(num::sqrt(across.x), num::sqrt(across.y), num::sqrt(across.z)) * self.radius;
        let ends = Aabb::around(&[self.base, self.base + self.axis]);
        let slack = (self.base.abs() + self.axis.abs() + Vec3::splat(self.radius)) * num::gamma(10);
        Aabb { min: ends.min - extent - slack, max: ends.max + extent + slack }
    }

    fn area(&self) -> f32 {
        TAU * self.radius * self.axis.length()
    }

    #[inline]
    fn intersect(&self, prepared: &PreparedRay, t_max: f32) -> Option<ShapeHit> {
        let Ray { origin, direction } = prepared.ray;
        let a = self.unit_axis();
        let from = origin - self.base;
        let (h0, dh) = (from.dot(a), direction.dot(a));
        // In the plane across the axis the cylinder is a circle.
        let (near, far) = roots(from - a * h0, direction - a * dh, self.radius)?;
        let length = self.axis.length();
        let meets = |t: f32| {
            let h = h0 + t * dh;
            (t > 0.0 && t < t_max && h >= 0.0 && h <= length).then_some(ShapeHit { t, u: 0.0, v: h / length })
        };
        meets(near).or_else(|| meets(far))
    }

    #[inline]
    fn surface_point(&self, ray: &Ray, hit: &ShapeHit) -> SurfacePoint {
        let r = ray.at(hit.t) - self.base - self.axis * hit.v;
        let a = self.unit_axis();
        self.point(hit.v, unit(r - a * r.dot(a)).unwrap_or(Vec3::X))
    }

    /// On the cylinder of radius 1 from `z = 0` to `z = 1`, turned as [`Frame::from_normal`] turns
    /// the axis.
    fn unit_point(&self, point: Vec3) -> Vec3 {
        let (h, n) = self.coordinates(point);
        let frame = Frame::from_normal(self.unit_axis());
        Vec3::new(n.dot(frame.s), n.dot(frame.t), h)
    }

    /// Angle in turns, and height.
    fn uv(&self, unit: Vec3) -> Vec2 {
        Vec2::new(turn(unit), unit.z)
    }

    fn unit_tangent(&self, unit: Vec3) -> Vec3 {
        Vec3::new(-unit.y, unit.x, 0.0)
    }

    /// Around the axis, and along it.
    fn tangents(&self, point: Vec3) -> [Vec3; 2] {
        [self.axis.cross(self.coordinates(point).1), self.axis]
    }

    fn check(&self) -> Result<(), ShapeError> {
        Self::new(self.base, self.axis, self.radius).map(drop)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hit(c: &Cylinder, origin: Vec3, direction: Vec3) -> Option<f32> {
        c.intersect(&PreparedRay::new(Ray::new(origin, direction)), f32::INFINITY).map(|h| h.t)
    }

    #[test]
    fn is_met_from_outside_and_through_its_open_end() {
        let c = Cylinder::new(Vec3::ZERO, Vec3::Y * 2.0, 1.0).unwrap();
        assert!((hit(&c, Vec3::new(5.0, 1.0, 0.0), Vec3::NEG_X).unwrap() - 4.0).abs() < 1e-6);
        // From above, through the open end onto the inside of the wall.
        let d = Vec3::new(1.0, -1.0, 0.0).normalize();
        assert!((hit(&c, Vec3::new(0.0, 3.0, 0.0), d).unwrap() - 2.0_f32.sqrt()).abs() < 0.5);
        assert_eq!(hit(&c, Vec3::new(0.0, 5.0, 0.0), Vec3::NEG_Y), None);
        assert_eq!(hit(&c, Vec3::new(5.0, 2.1, 0.0), Vec3::NEG_X), None);
    }

    #[test]
    fn surface_points_lie_on_the_surface() {
        let c = Cylinder::new(Vec3::new(3.0, 1.0, 2.0), Vec3::new(1.0, 2.0, 0.5), 0.25).unwrap();
        for i in 0..1000u32 {
            let u = [num::unit_f32(num::hash(i)), num::unit_f32(num::hash2(i, 3))];
            let ray = Ray::new(Vec3::new(-4.0, 5.0, 8.0), crate::warp::uniform_sphere(u));
            if let Some(h) = c.intersect(&PreparedRay::new(ray), f32::INFINITY) {
                let p = c.surface_point(&ray, &h);
                let (at, n) = c.coordinates(p.point);
                let r = (p.point - c.base() - c.axis() * at).length();
                assert!((r - 0.25).abs() < 2e-6 && n.dot(p.normal) > 0.999);
            }
        }
    }

    #[test]
    fn bad_numbers_are_refused() {
        assert!(Cylinder::new(Vec3::ZERO, Vec3::ZERO, 1.0).is_err());
        assert!(Cylinder::new(Vec3::ZERO, Vec3::Y, 0.0).is_err());
        assert!(Cylinder::new(Vec3::ZERO, Vec3::NAN, 1.0).is_err());
    }
}
