//! Spheres.

use super::{Shape, ShapeError, ShapeHit, SurfacePoint, turn};
use crate::geom::{Aabb, PreparedRay, Ray, unit};
use crate::num::{self, PI};
use glam::{Vec2, Vec3};

/// A sphere. Its normal points outward, or inward after [`Sphere::flipped`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sphere {
    centre: Vec3,
    radius: f32,
    inward: bool,
}

impl Sphere {
    /// A sphere from centre and radius (m).
    ///
    /// # Errors
    /// When a number is not finite, or the squared radius is not a normal `f32`.
    pub fn new(centre: Vec3, radius: f32) -> Result<Self, ShapeError> {
        if !centre.is_finite() {
            return Err(ShapeError::NotFinite { field: "the centre" });
        }
        if !radius.is_finite() {
            return Err(ShapeError::NotFinite { field: "the radius" });
        }
        if radius <= 0.0 || !(radius * radius).is_normal() {
            return Err(ShapeError::Degenerate { what: "radius in m", value: radius });
        }
        Ok(Self { centre, radius, inward: false })
    }

    /// A sphere that was checked before: for constants; see [`crate::Scene::baked`].
    #[must_use]
    pub const fn baked(centre: Vec3, radius: f32) -> Self {
        Self { centre, radius, inward: false }
    }

    /// Centre (m).
    #[must_use]
    pub const fn centre(&self) -> Vec3 {
        self.centre
    }

    /// Radius (m).
    #[must_use]
    pub const fn radius(&self) -> f32 {
        self.radius
    }

    /// True when the normal points to the centre.
    #[must_use]
    pub const fn is_inward(&self) -> bool {
        self.inward
    }

    /// The same sphere facing the other way.
    #[must_use]
    pub const fn flipped(self) -> Self {
        Self { inward: !self.inward, ..self }
    }

    /// How far outside the surface a point is (m); negative inside. `(d² − r²) / (d + r)` with the
    /// squares in double precision, where they are exact: a millionth of the radius is still known.
    #[inline]
    #[must_use]
    pub fn clearance(&self, point: Vec3) -> f32 {
        let v = self.centre - point;
        let power = v.as_dvec3().length_squared() - f64::from(self.radius) * f64::from(self.radius);
        (power / f64::from(v.length() + self.radius)) as f32
    }

    /// The surface point in the outward unit direction `n` from the centre.
    #[inline]
    #[must_use]
    pub fn point(&self, n: Vec3) -> SurfacePoint {
        let arm = n * self.radius;
        SurfacePoint {
            point: self.centre + arm,
            error: (self.centre.abs() + arm.abs()) * num::gamma(8),
            normal: if self.inward { -n } else { n },
        }
    }
}

impl Shape for Sphere {
    fn bounds(&self) -> Aabb {
        let extent = Vec3::splat(self.radius);
        let slack = (self.centre.abs() + extent) * num::gamma(8);
        Aabb { min: self.centre - extent - slack, max: self.centre + extent + slack }
    }

    fn area(&self) -> f32 {
        4.0 * PI * self.radius * self.radius
    }

    #[inline]
    fn intersect(&self, prepared: &PreparedRay, t_max: f32) -> Option<ShapeHit> {
        let Ray { origin, direction } = prepared.ray;
        let from = origin - self.centre;
        let (near, far) = roots(from, direction, self.radius)?;
        let t = if near > 0.0 { near } else { far };
        (t > 0.0 && t < t_max).then_some(ShapeHit { t, u: 0.0, v: 0.0 })
    }

    /// A sphere hides its far side, beyond the ray's point nearest to the centre.
    #[inline]
    fn hides_itself(&self, prepared: &PreparedRay, reach: f32) -> bool {
        let Ray { origin, direction } = prepared.ray;
        let nearest = (self.centre - origin).dot(direction) / direction.length_squared();
        reach > nearest && self.intersect(prepared, reach).is_some()
    }

    fn support(&self, origin: Vec3, direction: Vec3) -> f32 {
        direction.dot(self.centre - origin) + direction.length() * self.radius
    }

    #[inline]
    fn surface_point(&self, ray: &Ray, hit: &ShapeHit) -> SurfacePoint {
        // Pulled back onto the surface: the error does not depend on the distance of the origin.
        self.point(unit(ray.at(hit.t) - self.centre).unwrap_or(Vec3::Z))
    }

    /// On the unit sphere, with the world's axes.
    fn unit_point(&self, point: Vec3) -> Vec3 {
        (point - self.centre) / self.radius
    }

    /// Longitude in turns, and angle from the third axis in half turns.
    fn uv(&self, unit: Vec3) -> Vec2 {
        let across = num::sqrt(unit.x * unit.x + unit.y * unit.y);
        Vec2::new(turn(unit), num::atan2(across, unit.z) * num::FRAC_1_PI)
    }

    fn unit_tangent(&self, unit: Vec3) -> Vec3 {
        Vec3::new(-unit.y, unit.x, 0.0)
    }

    /// Around the third axis of the world, and away from that axis' upper end.
    fn tangents(&self, point: Vec3) -> [Vec3; 2] {
        let outward = point - self.centre;
        let around = Vec3::Z.cross(outward);
        [around, around.cross(outward)]
    }

    fn check(&self) -> Result<(), ShapeError> {
        Self::new(self.centre, self.radius).map(drop)
    }
}

/// Both parameters at which `from + t direction` is `radius` away from the origin, in order.
///
/// The discriminant is taken at the point of the ray nearest to the centre, where it does not lose
/// its digits to distance; the two roots come from one another without cancellation.
///
/// Source: Haines et al. 2019, *Precision Improvements for Ray/Sphere Intersection*, Ray Tracing
/// Gems chapter 7, equations 5 and 6.
#[inline]
pub(super) fn roots(from: Vec3, direction: Vec3, radius: f32) -> Option<(f32, f32)> {
    let a = direction.length_squared();
    let b = -from.dot(direction);
    let nearest = from + direction * (b / a);
    let offside = nearest.length();
    let discriminant = (radius - offside) * (radius + offside);
    if !(discriminant >= 0.0) {
        return None;
    }
    let distance = from.length();
    let c = (distance - radius) * (distance + radius);
    let q = b + num::sqrt(a * discriminant).copysign(b);
    let (t0, t1) = (c / q, q / a);
    Some(if t0 <= t1 { (t0, t1) } else { (t1, t0) })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hit(s: &Sphere, origin: Vec3, direction: Vec3) -> Option<f32> {
        s.intersect(&PreparedRay::new(Ray::new(origin, direction)), f32::INFINITY).map(|h| h.t)
    }

    #[test]
    fn distant_spheres_are_hit_within_ulps() {
        for distance in [10.0, 1e3, 1e5_f32] {
            let s = Sphere::new(Vec3::new(0.0, 0.0, distance), 1.0).unwrap();
            let t = hit(&s, Vec3::ZERO, Vec3::Z).unwrap();
            assert!((t - (distance - 1.0)).abs() <= 4.0 * f32::EPSILON * distance, "{distance} {t}");
        }
    }

    #[test]
    fn inside_sees_the_far_side_and_behind_sees_nothing() {
        let s = Sphere::new(Vec3::ZERO, 2.0).unwrap();
        assert_eq!(hit(&s, Vec3::ZERO, Vec3::X), Some(2.0));
        assert!((hit(&s, Vec3::new(0.5, 0.0, 0.0), Vec3::X).unwrap() - 1.5).abs() < 1e-6);
        assert_eq!(hit(&s, Vec3::new(3.0, 0.0, 0.0), Vec3::X), None);
        assert_eq!(hit(&s, Vec3::new(-3.0, 2.1, 0.0), Vec3::X), None);
    }

    #[test]
    fn bad_numbers_are_refused() {
        assert!(matches!(Sphere::new(Vec3::NAN, 1.0), Err(ShapeError::NotFinite { .. })));
        for r in [0.0, -1.0, 1e-30, 1e30] {
            assert!(matches!(Sphere::new(Vec3::ZERO, r), Err(ShapeError::Degenerate { .. })), "{r}");
        }
    }
}
