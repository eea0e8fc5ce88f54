//! Rays, and rays prepared for many intersection tests.

use glam::Vec3;

/// A half-line: `origin + t direction`, `t > 0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Where it starts (m).
    pub origin: Vec3,
    /// Where it goes; a unit vector wherever `t` is used as a distance.
    pub direction: Vec3,
}

impl Ray {
    /// A ray from a point in a direction.
    #[inline]
    #[must_use]
    pub const fn new(origin: Vec3, direction: Vec3) -> Self {
        Self { origin, direction }
    }

    /// The point at parameter `t`.
    #[inline]
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }

    /// True when the ray can be traced: finite, and with a direction.
    #[inline]
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.origin.is_finite() && self.direction.is_finite() && self.direction != Vec3::ZERO
    }
}

/// A ray with everything that box and triangle tests need more than once.
///
/// The three rows map a point relative to the origin into the sheared space of Woop, Benthin and
/// Wald 2013, *Watertight Ray/Triangle Intersection*, JCGT 2(1), section 3.1, in which the ray is
/// the `+z` axis of unit length. Rows with literal ones and zeros give the same sums as the
/// paper's permuted indices, without indexing by a variable.
#[derive(Debug, Clone, Copy)]
pub struct PreparedRay {
    /// The ray itself.
    pub ray: Ray,
    /// Reciprocal of the direction; infinite where a component is 0.
    pub inverse: Vec3,
    pub(crate) row_x: Vec3,
    pub(crate) row_y: Vec3,
    pub(crate) row_z: Vec3,
}

impl PreparedRay {
    /// Prepares a ray; the direction need not be of unit length, but not zero.
    #[inline]
    #[must_use]
    pub fn new(ray: Ray) -> Self {
        let d = ray.direction;
        let a = d.abs();
        // The largest component becomes z; x and y follow in cyclic order, exchanged when z is
        // negative so that the winding is kept.
        let (ex, ey, ez, dx, dy, dz) = if a.z >= a.x && a.z >= a.y {
            (Vec3::X, Vec3::Y, Vec3::Z, d.x, d.y, d.z)
        } else if a.x >= a.y {
            (Vec3::Y, Vec3::Z, Vec3::X, d.y, d.z, d.x)
        } else {
            (Vec3::Z, Vec3::X, Vec3::Y, d.z, d.x, d.y)
        };
        let (ex, ey, dx, dy) = if dz < 0.0 { (ey, ex, dy, dx) } else { (ex, ey, dx, dy) };
        let scale = 1.0 / dz;
        Self {
            ray,
            inverse: d.recip(),
            row_x: ex - ez * (dx * scale),
            row_y: ey - ez * (dy * scale),
            row_z: ez * scale,
        }
    }
}
