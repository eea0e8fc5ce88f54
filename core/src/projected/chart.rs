//! A plane as a receiver sees it.

use glam::{DVec3, Vec2, Vec3};

/// Affine coordinates of a light's plane, relative to a receiver: the point at `(x, y)` is
/// `origin + x u + y v` (m).
///
/// In double precision, as single precision does not know enough of where the corners are: of a
/// receiver a thousandth of the light's size from one, three digits; a milliradian above the plane,
/// four of the height, and all of the light is proportional to it; of the width of a needle, none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Chart {
    /// From the receiver to the point (0, 0) (m).
    pub origin: DVec3,
    /// First axis (m).
    pub u: DVec3,
    /// Second axis (m); with the first at any angle but 0 and π.
    pub v: DVec3,
    volume: f64,
}

impl Chart {
    /// The plane of a point and two axes (m), seen from `from` (m).
    #[inline]
    #[must_use]
    pub fn from_axes(from: Vec3, origin: Vec3, u: Vec3, v: Vec3) -> Self {
        Self::new(origin.as_dvec3() - from.as_dvec3(), u.as_dvec3(), v.as_dvec3())
    }

    /// The plane of three points (m), which are at (0, 0), (1, 0) and (0, 1), seen from `from` (m).
    #[inline]
    #[must_use]
    pub fn from_corners(from: Vec3, corners: [Vec3; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| corner.as_dvec3());
        Self::new(a - from.as_dvec3(), b - a, c - a)
    }

    #[inline(always)]
    fn new(origin: DVec3, u: DVec3, v: DVec3) -> Self {
        Self { origin, u, v, volume: determinant(&origin, &u, &v) }
    }

    /// `det(origin, u, v)` (m³): negative where `u × v` points to the receiver's side; 0 in the plane,
    /// as far as rounding can tell.
    #[inline]
    #[must_use]
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// From the receiver to a point of the plane (m).
    #[inline]
    #[must_use]
    pub fn point(&self, place: Vec2) -> Vec3 {
        (self.origin + self.u * f64::from(place.x) + self.v * f64::from(place.y)).as_vec3()
    }
}

/// `det(a, b, c)`, or 0 where it may be nothing but rounding.
#[cfg_attr(not(feature = "small"), inline)]
#[cfg_attr(feature = "small", inline(never))]
fn determinant(a: &DVec3, b: &DVec3, c: &DVec3) -> f64 {
    let terms = *a * b.cross(*c);
    let (sum, size) = (terms.element_sum(), terms.abs().element_sum());
    if sum.abs() > 4.0 * f64::EPSILON * size { sum } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_and_corners_give_the_same_plane() {
        let (from, a) = (Vec3::new(0.5, -2.0, 1.0), Vec3::new(1.0, 2.0, 3.0));
        let (u, v) = (Vec3::new(0.5, 1.0, 0.25), Vec3::new(-1.0, 2.0, 0.5));
        let by_axes = Chart::from_axes(from, a, u, v);
        assert_eq!(by_axes, Chart::from_corners(from, [a, a + u, a + v]));
        assert_eq!(by_axes.point(Vec2::new(2.0, -1.0)), a + 2.0 * u - v - from);
        assert_eq!(by_axes.volume(), f64::from((a - from).dot(u.cross(v))));
        assert_eq!(Chart::from_axes(a + u, a, u, v).volume(), 0.0);
    }
}
