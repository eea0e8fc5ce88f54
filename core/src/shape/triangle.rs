//! Triangles, met without gaps along shared edges.

use super::{Shape, ShapeError, ShapeHit, SurfacePoint};
use crate::geom::{Aabb, PreparedRay, Ray, unit};
use crate::num;
use glam::{DVec3, Vec2, Vec3};

/// A triangle. Its normal is `(b − a) × (c − a)`: counter-clockwise corners face the viewer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Triangle {
    /// The x of the three corners, then their y and z: a ray looks at them axis by axis.
    axes: [Vec3; 3],
}

impl Triangle {
    /// A triangle from its corners (m).
    ///
    /// # Errors
    /// When a coordinate is not finite, or the area is 0 or beyond `f32`.
    pub fn new(a: Vec3, b: Vec3, c: Vec3) -> Result<Self, ShapeError> {
        if !(a.is_finite() && b.is_finite() && c.is_finite()) {
            return Err(ShapeError::NotFinite { field: "a corner" });
        }
        let triangle = Self::from_corners([a, b, c]);
        let area = triangle.area();
        if !(area > 0.0 && area < f32::INFINITY) || unit(triangle.cross()).is_none() {
            return Err(ShapeError::Degenerate { what: "area in m²", value: area });
        }
        Ok(triangle)
    }

    /// A triangle that was checked before, from its corners (m): for constants; see
    /// [`crate::Scene::baked`].
    #[must_use]
    pub const fn baked(corners: [Vec3; 3]) -> Self {
        Self::from_corners(corners)
    }

    /// The corners (m).
    #[must_use]
    pub const fn corners(&self) -> [Vec3; 3] {
        let [x, y, z] = self.axes;
        [Vec3::new(x.x, y.x, z.x), Vec3::new(x.y, y.y, z.y), Vec3::new(x.z, y.z, z.z)]
    }

    pub(super) const fn from_corners([a, b, c]: [Vec3; 3]) -> Self {
        Self { axes: [Vec3::new(a.x, b.x, c.x), Vec3::new(a.y, b.y, c.y), Vec3::new(a.z, b.z, c.z)] }
    }

    /// Unit normal.
    #[inline]
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        unit(self.cross()).unwrap_or(Vec3::Z)
    }

    /// The same triangle facing the other way.
    #[must_use]
    pub const fn flipped(self) -> Self {
        let [a, b, c] = self.corners();
        Self::from_corners([a, c, b])
    }

    /// The point with barycentric coordinates `1 − b1 − b2`, `b1`, `b2`.
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[must_use]
    pub fn point(&self, b1: f32, b2: f32) -> SurfacePoint {
        let [a, b, c] = self.corners();
        let (pa, pb, pc) = (a * (1.0 - b1 - b2), b * b1, c * b2);
        SurfacePoint {
            point: pa + pb + pc,
            error: (pa.abs() + pb.abs() + pc.abs()) * num::gamma(8),
            normal: self.normal(),
        }
    }

    /// Barycentric `(b1, b2)` of a point in the plane: the inverse of [`Triangle::point`].
    #[inline]
    #[must_use]
    pub fn coordinates(&self, point: Vec3) -> (f32, f32) {
        let [a, b, c] = self.corners_in_double();
        let (e1, e2, r) = (b - a, c - a, point.as_dvec3() - a);
        let n = e1.cross(e2);
        let n2 = n.length_squared();
        ((r.cross(e2).dot(n) / n2) as f32, (e1.cross(r).dot(n) / n2) as f32)
    }

    #[inline]
    fn corners_in_double(&self) -> [DVec3; 3] {
        let [a, b, c] = self.corners();
        [a.as_dvec3(), b.as_dvec3(), c.as_dvec3()]
    }

    #[inline]
    fn cross(&self) -> Vec3 {
        let [x, y, z] = &self.axes;
        Vec3::new(twice_area(y, z), twice_area(z, x), twice_area(x, y))
    }
}

/// Twice the area of a triangle in the plane, positive when it is counter-clockwise, from the first and the
/// second coordinates of its corners.
///
/// In single precision, the normal of a triangle of aspect 10⁶ is 3° off, and its area 6 %.
#[cfg_attr(not(feature = "small"), inline(always))]
#[cfg_attr(feature = "small", inline(never))]
fn twice_area(p: &Vec3, q: &Vec3) -> f32 {
    let (p, q) = (p.as_dvec3(), q.as_dvec3());
    ((p.y - p.x) * (q.z - q.x) - (p.z - p.x) * (q.y - q.x)) as f32
}

/// The three scaled edge functions in double precision, for a ray through an edge or a corner.
///
/// Source: Woop, Benthin, Wald 2013, section 3.3.
#[cold]
fn edges_in_double(x: Vec3, y: Vec3) -> Vec3 {
    y.as_dvec3().cross(x.as_dvec3()).as_vec3()
}

impl Shape for Triangle {
    #[inline]
    fn bounds(&self) -> Aabb {
        Aabb::around(&self.corners())
    }

    #[inline]
    fn area(&self) -> f32 {
        // Not the root of squares: those of a small sliver's would be subnormal.
        let cross = self.cross();
        0.5 * unit(cross).map_or(0.0, |n| n.dot(cross))
    }

    /// Source: Woop, Benthin, Wald 2013, *Watertight Ray/Triangle Intersection*, JCGT 2(1),
    /// appendix A; bound on `t` after Pharr, Jakob, Humphreys 2023, section 6.8.7.
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[cfg_attr(feature = "small", inline(never))]
    fn intersect(&self, ray: &PreparedRay, t_max: f32) -> Option<ShapeHit> {
        // The corners relative to the origin, axis by axis, in the sheared space of the ray.
        let along = self.axes[ray.axes[2] as usize] - ray.origin[2];
        let x = self.axes[ray.axes[0] as usize] - ray.origin[0] - along * ray.shear[0];
        let y = self.axes[ray.axes[1] as usize] - ray.origin[1] - along * ray.shear[1];
        let mut e = y.cross(x);
        if e.x == 0.0 || e.y == 0.0 || e.z == 0.0 {
            e = edges_in_double(x, y);
        }
        let some_negative = e.x < 0.0 || e.y < 0.0 || e.z < 0.0;
        let some_positive = e.x > 0.0 || e.y > 0.0 || e.z > 0.0;
        let det = e.x + e.y + e.z;
        if (some_negative && some_positive) || det == 0.0 {
            return None;
        }
        let scale = 1.0 / det;
        let z = along * ray.shear[2];
        let t = e.dot(z) * scale;
        if !(t > 0.0 && t < t_max) || t <= t_error(x, y, z, e, scale) {
            return None;
        }
        Some(ShapeHit { t, u: e.y * scale, v: e.z * scale })
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
        let [a, b, c] = self.corners();
        Some([a, b, c, c])
    }

    fn support(&self, origin: Vec3, direction: Vec3) -> f32 {
        self.corners()
            .map(|corner| direction.dot(corner - origin))
            .into_iter()
            .fold(f32::NEG_INFINITY, f32::max)
    }

    #[inline]
    fn surface_point(&self, _ray: &Ray, hit: &ShapeHit) -> SurfacePoint {
        self.point(hit.u, hit.v)
    }

    /// On the triangle with corners `(0, 0)`, `(1, 0)` and `(0, 1)`.
    fn unit_point(&self, point: Vec3) -> Vec3 {
        let (b1, b2) = self.coordinates(point);
        Vec3::new(b1, b2, 0.0)
    }

    /// Barycentric coordinates of the second and third corner.
    fn uv(&self, unit: Vec3) -> Vec2 {
        Vec2::new(unit.x, unit.y)
    }

    /// Along the edges from the first corner.
    fn tangents(&self, _: Vec3) -> [Vec3; 2] {
        let [a, b, c] = self.corners();
        [b - a, c - a]
    }

    fn check(&self) -> Result<(), ShapeError> {
        let [a, b, c] = self.corners();
        Self::new(a, b, c).map(drop)
    }
}

/// Bound on the error of `t`: a hit nearer than this may in truth be behind the origin.
#[inline(never)]
fn t_error(x: Vec3, y: Vec3, z: Vec3, e: Vec3, scale: f32) -> f32 {
    let max = Vec3::new(x.abs().max_element(), y.abs().max_element(), z.abs().max_element());
    let delta = Vec3::new(num::gamma(5), num::gamma(5), num::gamma(3)) * (max + Vec3::new(max.z, max.z, 0.0));
    let delta_e = 2.0 * (num::gamma(2) * max.x * max.y + delta.y * max.x + delta.x * max.y);
    let max_e = e.abs().max_element();
    3.0 * (num::gamma(3) * max_e * max.z + delta_e * max.z + delta.z * max_e) * scale.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tri() -> Triangle {
        Triangle::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap()
    }

    fn hit(t: &Triangle, origin: Vec3, direction: Vec3) -> Option<ShapeHit> {
        t.intersect(&PreparedRay::new(Ray::new(origin, direction)), f32::INFINITY)
    }

    #[test]
    fn collinear_corners_are_refused_also_where_single_precision_sees_an_area() {
        // The edge of five times as much takes more than 24 bits: rounded, it is not parallel.
        let along = Vec3::new(0.1, 0.7, 0.3);
        let corners = [along, along * 2.0, along * -4.0];
        assert!((corners[1] - corners[0]).cross(corners[2] - corners[0]) != Vec3::ZERO);
        assert!(Triangle::new(corners[0], corners[1], corners[2]).is_err());
    }

    #[test]
    fn barycentric_coordinates_are_those_of_the_point() {
        let h = hit(&tri(), Vec3::new(0.25, 0.5, 3.0), Vec3::NEG_Z).unwrap();
        assert!((h.t - 3.0).abs() < 1e-6 && (h.u - 0.25).abs() < 1e-6 && (h.v - 0.5).abs() < 1e-6);
        let (u, v) = tri().coordinates(Vec3::new(0.25, 0.5, 0.0));
        assert!((u - 0.25).abs() < 1e-6 && (v - 0.5).abs() < 1e-6);
        assert_eq!(tri().normal(), Vec3::Z);
        assert_eq!(tri().flipped().normal(), Vec3::NEG_Z);
    }

    #[test]
    fn every_axis_and_sign_of_direction_works() {
        let t =
            Triangle::new(Vec3::new(-3.0, -3.0, -3.0), Vec3::new(6.0, -3.0, -3.0), Vec3::new(-3.0, 6.0, 3.0))
                .unwrap();
        for d in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE, Vec3::new(-1.0, 2.0, 0.5)] {
            let n = t.normal();
            if n.dot(d).abs() < 1e-3 {
                continue;
            }
            let target = t.point(0.3, 0.3).point;
            for sign in [1.0, -1.0] {
                let h = hit(&t, target - d * sign * 2.0, d * sign).unwrap();
                assert!((h.t - 2.0).abs() < 1e-5, "{d} {sign} {h:?}");
            }
        }
    }

    #[test]
    fn edges_and_corners_of_a_fan_leave_no_gap() {
        let rim = |k: usize| {
            let (s, c) = num::sin_cos(k as f32 * num::FRAC_PI_4 + 0.1);
            Vec3::new(c, s, 0.05 * (k % 2) as f32)
        };
        let fan: [Triangle; 8] =
            core::array::from_fn(|i| Triangle::new(Vec3::ZERO, rim(i), rim((i + 1) % 8)).unwrap());
        for i in 0..100_000u32 {
            let d = crate::warp::cosine_hemisphere([
                num::unit_f32(num::hash(i)),
                num::unit_f32(num::hash2(i, 5)),
            ]);
            if d.z < 0.3 {
                continue;
            }
            // Aim exactly at the shared corner.
            assert!(fan.iter().any(|t| hit(t, -d * 3.0, d).is_some()), "{d}");
        }
    }

    #[test]
    fn needles_and_nans_are_refused() {
        assert!(Triangle::new(Vec3::ZERO, Vec3::X, Vec3::X * 2.0).is_err());
        assert!(Triangle::new(Vec3::ZERO, Vec3::ZERO, Vec3::ZERO).is_err());
        assert!(Triangle::new(Vec3::NAN, Vec3::X, Vec3::Y).is_err());
        assert!(Triangle::new(Vec3::ZERO, Vec3::X * 1e30, Vec3::Y * 1e30).is_err());
    }
}
