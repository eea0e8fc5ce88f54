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

/// One of the three axes: an index into three numbers that needs no check.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Axis {
    X,
    Y,
    Z,
}

/// A ray with everything that a triangle test needs more than once: the axes and the shear of Woop,
/// Benthin and Wald 2013, *Watertight Ray/Triangle Intersection*, JCGT 2(1), section 3.1, that turn
/// the ray into the `+z` axis of unit length.
#[derive(Debug, Clone, Copy)]
pub struct PreparedRay {
    /// The ray itself.
    pub ray: Ray,
    /// The axes that become x, y and z; z is the one along which the direction is largest.
    pub(crate) axes: [Axis; 3],
    /// The origin along those axes.
    pub(crate) origin: [f32; 3],
    /// What is taken from x and y, and the factor of z, per unit of z.
    pub(crate) shear: [f32; 3],
}

impl PreparedRay {
    /// Prepares a ray; the direction need not be of unit length, but not zero.
    #[inline]
    #[must_use]
    pub fn new(ray: Ray) -> Self {
        let (o, d, a) = (ray.origin.to_array(), ray.direction.to_array(), ray.direction.abs());
        // The others follow in cyclic order, exchanged when z is negative so that winding is kept.
        let [x, y, z] = if a.z >= a.x && a.z >= a.y {
            [Axis::X, Axis::Y, Axis::Z]
        } else if a.x >= a.y {
            [Axis::Y, Axis::Z, Axis::X]
        } else {
            [Axis::Z, Axis::X, Axis::Y]
        };
        let (o, d) = (|axis: Axis| o[axis as usize], |axis: Axis| d[axis as usize]);
        let (x, y) = if d(z) < 0.0 { (y, x) } else { (x, y) };
        let scale = 1.0 / d(z);
        Self { ray, axes: [x, y, z], origin: [o(x), o(y), o(z)], shear: [d(x) * scale, d(y) * scale, scale] }
    }
}
