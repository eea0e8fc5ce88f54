//! What rectangles and disks share: a flat frame of a centre and two orthogonal half-axes.

use super::{ShapeError, ShapeHit, SurfacePoint};
use crate::geom::{Aabb, PreparedRay, unit};
use crate::num;
use glam::Vec3;

/// A centre and two orthogonal half-axes; the normal is `axis_u × axis_v`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Planar {
    pub(super) centre: Vec3,
    pub(super) axis_u: Vec3,
    pub(super) axis_v: Vec3,
}

/// How far from a right angle two axes may be (rad): round-off of some twenty rotations, of
/// 1e-6 each, in single precision, and twice what the loaders call one.
///
/// What it may cost, to first order: edges are off by this share of the axes, and densities, irradiance and
/// positions by as much of theirs; coordinates along the shorter axis, which are taken by projection, by
/// this share times the aspect; the area, by 2e-10. Axes are kept as they are given: turned at right
/// angles they would be off as much from what was meant.
const ORTHOGONAL: f32 = 2e-5;

impl Planar {
    pub(super) fn new(centre: Vec3, axis_u: Vec3, axis_v: Vec3) -> Result<Self, ShapeError> {
        for (field, v) in [("the centre", centre), ("the first axis", axis_u), ("the second axis", axis_v)] {
            if !v.is_finite() {
                return Err(ShapeError::NotFinite { field });
            }
        }
        let planar = Self { centre, axis_u, axis_v };
        let area = planar.half_axes_area();
        let squares = axis_u.length_squared().min(axis_v.length_squared());
        // Subnormal squares have lost their digits: refuse what cannot be intersected accurately.
        if !(area > 0.0 && area < f32::INFINITY) || squares < f32::MIN_POSITIVE {
            return Err(ShapeError::Degenerate { what: "area in m²", value: area });
        }
        let cosine = unit(axis_u).zip(unit(axis_v)).map_or(1.0, |(u, v)| u.dot(v));
        if cosine.abs() > ORTHOGONAL {
            return Err(ShapeError::NotOrthogonal { cosine });
        }
        Ok(planar)
    }

    /// Area of the parallelogram of the two half-axes (m²).
    pub(super) fn half_axes_area(&self) -> f32 {
        // Lengths first: the cross product of 1e-12 axes would be subnormal before the root.
        self.axis_u.length() * self.axis_v.length()
    }

    /// Unit normal.
    #[inline]
    pub(super) fn normal(&self) -> Vec3 {
        unit(self.axis_u.cross(self.axis_v)).unwrap_or(Vec3::Z)
    }

    /// Where a ray meets the plane, in units of the half-axes.
    #[inline]
    pub(super) fn intersect(&self, prepared: &PreparedRay, t_max: f32) -> Option<ShapeHit> {
        let ray = &prepared.ray;
        // Not normalised: the length cancels in t.
        let n = self.axis_u.cross(self.axis_v);
        let to_centre = self.centre - ray.origin;
        let t = n.dot(to_centre) / n.dot(ray.direction);
        if !(t > 0.0 && t < t_max) {
            return None;
        }
        let relative = ray.direction * t - to_centre;
        Some(ShapeHit {
            t,
            u: relative.dot(self.axis_u) / self.axis_u.length_squared(),
            v: relative.dot(self.axis_v) / self.axis_v.length_squared(),
        })
    }

    /// The point at (u, v) in units of the half-axes; on the plane whatever the ray's error was.
    #[inline]
    pub(super) fn surface_point(&self, u: f32, v: f32) -> SurfacePoint {
        let (a, b) = (self.axis_u * u, self.axis_v * v);
        SurfacePoint {
            point: self.centre + a + b,
            error: (self.centre.abs() + a.abs() + b.abs()) * num::gamma(8),
            normal: self.normal(),
        }
    }

    /// Coordinates of a point in the plane, in units of the half-axes.
    #[inline]
    pub(super) fn coordinates(&self, point: Vec3) -> (f32, f32) {
        let r = point - self.centre;
        (r.dot(self.axis_u) / self.axis_u.length_squared(), r.dot(self.axis_v) / self.axis_v.length_squared())
    }

    /// The same surface with its normal on the other side.
    pub(super) fn flipped(self) -> Self {
        Self { axis_v: -self.axis_v, ..self }
    }

    /// Box of the parallelogram.
    pub(super) fn bounds_with(&self, extent: Vec3) -> Aabb {
        // The offset of a hit point may leave the exact box by its error bound.
        let slack = (self.centre.abs() + extent) * num::gamma(8);
        Aabb { min: self.centre - extent - slack, max: self.centre + extent + slack }
    }
}
