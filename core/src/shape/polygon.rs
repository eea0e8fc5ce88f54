//! Convex polygons in a plane.

use super::{Shape, ShapeError, ShapeHit, SurfacePoint, Triangle};
use crate::geom::{Aabb, PreparedRay, Ray, unit};
use crate::num;
use glam::{DVec3, Vec2, Vec3};

/// How far a corner may be off the plane or inside an edge, in units of the largest coordinate: the
/// round-off of a rotation in single precision.
const ROUND_OFF: f32 = 16.0 * f32::EPSILON;

/// A convex polygon of 3 to 8 corners in a plane; counter-clockwise corners face the viewer.
///
/// It is no variant of [`super::AnyShape`]: that would make each triangle of a mesh three times as
/// large. A program that has polygons uses a `Scene<Polygon, …>`, an `AreaLight<Polygon>`, or an enum
/// of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polygon {
    corners: [Vec3; Self::MAX_CORNERS],
    count: usize,
    normal: Vec3,
}

impl Polygon {
    /// The most corners that a polygon has.
    pub const MAX_CORNERS: usize = 8;

    /// A polygon from its corners (m), in order. Corners may lie on a line with their neighbours: the
    /// triangles without area that they make are never met nor sampled. No two may coincide.
    ///
    /// # Errors
    /// When there are fewer than 3 or more than 8 corners, a coordinate is not finite, the area is 0
    /// or beyond `f32`, two corners coincide, or they are not in a plane, or not convex, by more than
    /// round-off.
    pub fn new(corners: &[Vec3]) -> Result<Self, ShapeError> {
        let count = corners.len();
        if !(3..=Self::MAX_CORNERS).contains(&count) {
            return Err(ShapeError::CornerCount { count });
        }
        if !corners.iter().all(|c| c.is_finite()) {
            return Err(ShapeError::NotFinite { field: "a corner" });
        }
        for (i, a) in corners.iter().enumerate() {
            if corners[..i].contains(a) {
                return Err(ShapeError::Degenerate { what: "distance between two corners in m", value: 0.0 });
            }
        }
        let normal = area_vector(corners);
        let area = 0.5 * normal.length() as f32;
        if !(area > 0.0 && area < f32::INFINITY) {
            return Err(ShapeError::Degenerate { what: "area in m²", value: area });
        }
        check_plane_and_turns(corners, normal.normalize())?;
        let mut all = [corners[0]; Self::MAX_CORNERS];
        all[..count].copy_from_slice(corners);
        Ok(Self { corners: all, count, normal: normal.normalize().as_vec3() })
    }

    /// The corners (m).
    #[inline]
    #[must_use]
    pub fn corners(&self) -> &[Vec3] {
        &self.corners[..self.count]
    }

    /// Unit normal.
    #[inline]
    #[must_use]
    pub fn normal(&self) -> Vec3 {
        self.normal
    }

    /// The same polygon facing the other way.
    #[must_use]
    pub fn flipped(self) -> Self {
        let mut corners = self.corners;
        corners[1..self.count].reverse();
        Self { corners, normal: -self.normal, ..self }
    }

    /// Into how many triangles the first corner fans out.
    #[inline]
    pub(crate) fn fan_len(&self) -> usize {
        self.count - 2
    }

    /// One of the triangles, from the first corner.
    #[inline]
    pub(crate) fn fan(&self, index: usize) -> Triangle {
        Triangle::from_corners([self.corners[0], self.corners[index + 1], self.corners[index + 2]])
    }

    /// The point with barycentric `(b1, b2)` in a triangle of the fan.
    #[inline]
    pub(crate) fn place(&self, index: usize, b1: f32, b2: f32) -> SurfacePoint {
        let [a, b, c] = self.fan(index).corners();
        SurfacePoint {
            point: a * (1.0 - b1 - b2) + b * b1 + c * b2,
            error: (a.abs() + b.abs() + c.abs()) * num::gamma(8),
            normal: self.normal,
        }
    }

    /// The triangle of the fan that a point is in, with its barycentric `(b1, b2)`.
    pub(crate) fn locate(&self, point: Vec3) -> (usize, [f32; 2]) {
        let mut best = (0, [0.0; 2], f32::NEG_INFINITY);
        for i in 0..self.fan_len() {
            let (b1, b2) = self.fan(i).coordinates(point);
            let inside = b1.min(b2).min(1.0 - b1 - b2);
            if inside > best.2 {
                best = (i, [b1, b2], inside);
            }
        }
        (best.0, best.1)
    }
}

/// Twice the area, along the normal. In double precision, so that needles have one.
fn area_vector(corners: &[Vec3]) -> DVec3 {
    let from_first = |c: Vec3| c.as_dvec3() - corners[0].as_dvec3();
    corners.windows(2).map(|pair| from_first(pair[0]).cross(from_first(pair[1]))).sum()
}

/// Each corner is in the plane, and on the inner side of each edge.
fn check_plane_and_turns(corners: &[Vec3], normal: DVec3) -> Result<(), ShapeError> {
    let reach = corners.iter().map(|c| c.abs().max_element()).fold(0.0, f32::max);
    let slack = f64::from(reach * ROUND_OFF);
    let next = corners.iter().cycle().skip(1);
    for (index, (a, b)) in corners.iter().zip(next).enumerate() {
        let off = normal.dot(a.as_dvec3() - corners[0].as_dvec3());
        if off.abs() > slack {
            return Err(ShapeError::NotPlanar { corner: index, off: off as f32 });
        }
        let inward = normal.cross(b.as_dvec3() - a.as_dvec3()).normalize();
        if corners.iter().any(|c| inward.dot(c.as_dvec3() - a.as_dvec3()) < -slack) {
            return Err(ShapeError::NotConvex { corner: index });
        }
    }
    Ok(())
}

impl Shape for Polygon {
    fn bounds(&self) -> Aabb {
        Aabb::around(self.corners())
    }

    fn area(&self) -> f32 {
        (0..self.fan_len()).map(|i| self.fan(i).area()).sum()
    }

    /// Triangle by triangle: two that share an edge leave no gap, here and between polygons. The
    /// first coordinate counts the edges from the second corner on, the second is the share of the
    /// way from the first corner to there.
    #[inline]
    fn intersect(&self, ray: &PreparedRay, t_max: f32) -> Option<ShapeHit> {
        (0..self.fan_len()).find_map(|i| {
            let hit = self.fan(i).intersect(ray, t_max)?;
            let out = hit.u + hit.v;
            let along = if out > 0.0 { (hit.v / out).min(1.0) } else { 0.0 };
            Some(ShapeHit { t: hit.t, u: i as f32 + along, v: out })
        })
    }

    /// A flat shape hides nothing of itself.
    #[inline]
    fn hides_itself(&self, _: &PreparedRay, _: f32) -> bool {
        false
    }

    fn is_flat(&self) -> bool {
        true
    }

    #[inline]
    fn surface_point(&self, _ray: &Ray, hit: &ShapeHit) -> SurfacePoint {
        let index = (hit.u as usize).min(self.fan_len() - 1);
        let along = hit.u - index as f32;
        self.place(index, hit.v * (1.0 - along), hit.v * along)
    }

    /// In the plane of the polygon, from its first corner, the first axis along its first edge (m).
    fn unit_point(&self, point: Vec3) -> Vec3 {
        let [first, second] = [self.corners()[0], self.corners()[1]];
        let along = unit(second - first).unwrap_or(Vec3::X);
        let arm = point - first;
        Vec3::new(arm.dot(along), arm.dot(self.normal().cross(along)), 0.0)
    }

    /// The first two coordinates: Mitsuba has no polygons.
    fn uv(&self, unit: Vec3) -> Vec2 {
        Vec2::new(unit.x, unit.y)
    }

    /// Along the first edge, and across it.
    fn tangents(&self, _: Vec3) -> [Vec3; 2] {
        let along = self.corners()[1] - self.corners()[0];
        [along, self.normal().cross(along)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::PreparedRay;
    use std::vec::Vec;

    fn regular(n: usize) -> Vec<Vec3> {
        let corner = |i: usize| {
            let (sin, cos) = num::sin_cos(num::TAU * i as f32 / n as f32);
            Vec3::new(3.0 + cos, sin, 0.5 * cos)
        };
        (0..n).map(corner).collect()
    }

    #[test]
    fn regular_ones_have_their_area_and_normal() {
        for n in 3..=8 {
            let p = Polygon::new(&regular(n)).unwrap();
            let flat = 0.5 * n as f32 * num::sin_cos(num::TAU / n as f32).0;
            assert!((p.area() / (flat * 1.25_f32.sqrt()) - 1.0).abs() < 1e-6, "{n}");
            assert!((p.normal() - Vec3::new(-0.5, 0.0, 1.0).normalize()).length() < 1e-6);
            assert_eq!(p.flipped().normal(), -p.normal());
            assert!(Polygon::new(p.flipped().corners()).unwrap().normal().dot(p.normal()) < -0.999);
        }
    }

    #[test]
    fn what_is_no_convex_polygon_is_refused_in_words() {
        let square = [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y];
        let [a, b, c, d] = square;
        assert!(Polygon::new(&square).is_ok());
        assert!(Polygon::new(&[a, b, b + Vec3::Y * 0.5, c, d]).is_ok(), "three on a line");
        let error = |corners: &[Vec3]| Polygon::new(corners).unwrap_err();
        assert_eq!(error(&[a, b]), ShapeError::CornerCount { count: 2 });
        assert_eq!(error(&regular(9)), ShapeError::CornerCount { count: 9 });
        assert_eq!(error(&[a, b, Vec3::NAN]), ShapeError::NotFinite { field: "a corner" });
        assert!(matches!(error(&[a, b, b * 2.0]), ShapeError::Degenerate { .. }));
        assert!(matches!(error(&[a, b, b, c]), ShapeError::Degenerate { .. }));
        assert!(matches!(error(&[a, b, c + Vec3::Z * 1e-3, d]), ShapeError::NotPlanar { .. }));
        assert!(matches!(error(&[a, b, (b + d) * 0.4, d]), ShapeError::NotConvex { .. }));
        let star: [Vec3; 5] = core::array::from_fn(|i| regular(5)[i * 2 % 5]);
        assert!(matches!(error(&star), ShapeError::NotConvex { .. }));
    }

    #[test]
    fn rays_meet_it_where_its_points_are() {
        let p = Polygon::new(&regular(7)).unwrap();
        let eye = Vec3::new(2.0, 0.3, 4.0);
        for i in 0..20_000u32 {
            let u = [num::unit_f32(num::hash(i)), num::unit_f32(num::hash2(i, 3))];
            let (index, [b1, b2]) = (i as usize % 5, crate::warp::square_to_triangle(u));
            let target = p.place(index, b1, b2).point;
            let ray = Ray::new(eye, target - eye);
            // Corners and edges may be passed by one rounding.
            if let Some(hit) = p.intersect(&PreparedRay::new(ray), f32::INFINITY) {
                assert!((p.surface_point(&ray, &hit).point - target).length() < 3e-6);
                assert!((hit.t - 1.0).abs() < 1e-5);
            } else {
                assert!(b1.min(b2).min(1.0 - b1 - b2) < 1e-5, "{index} {b1} {b2}");
            }
        }
    }
}
