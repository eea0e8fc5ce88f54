//! An orthonormal basis around a normal.

use crate::num;
use glam::Vec3;

/// A right-handed orthonormal basis whose third axis is the normal. In the local frame the cosine
/// to the normal is simply `z`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// First tangent.
    pub s: Vec3,
    /// Second tangent.
    pub t: Vec3,
    /// The normal.
    pub n: Vec3,
}

impl Frame {
    /// Builds a basis around the unit vector `n`, for every `n`, `−z` included.
    ///
    /// Source: Duff et al. 2017, *Building an Orthonormal Basis, Revisited*, JCGT 6(1), listing 3.
    #[inline]
    #[must_use]
    pub fn from_normal(n: Vec3) -> Self {
        let sign = 1.0_f32.copysign(n.z);
        let a = -1.0 / (sign + n.z);
        let b = n.x * n.y * a;
        Self {
            s: Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
            t: Vec3::new(b, sign + n.y * n.y * a, -n.y),
            n,
        }
    }

    /// Builds a basis around the unit vector `n` whose first tangent is along `tangent`, as far as that
    /// is at right angles to `n`; as [`Frame::from_normal`] where nothing of it is.
    ///
    /// * `tangent` – of any length
    #[inline]
    #[must_use]
    pub fn from_normal_and_tangent(n: Vec3, tangent: Vec3) -> Self {
        let across = |t: Vec3| t - n * n.dot(t);
        let along = unit(tangent)
            .map(across)
            // What rounding leaves of a tangent along the normal has no direction.
            .filter(|t| t.length_squared() > 1e-10)
            .and_then(unit)
            // Once more, because little was left of a tangent almost along the normal.
            .and_then(|t| unit(across(t)));
        match along {
            Some(s) => Self { s, t: n.cross(s), n },
            None => Self::from_normal(n),
        }
    }

    /// From world to local coordinates.
    #[inline]
    #[must_use]
    pub fn to_local(&self, v: Vec3) -> Vec3 {
        Vec3::new(v.dot(self.s), v.dot(self.t), v.dot(self.n))
    }

    /// From local to world coordinates.
    #[inline]
    #[must_use]
    pub fn to_world(&self, v: Vec3) -> Vec3 {
        self.s * v.x + self.t * v.y + self.n * v.z
    }
}

/// Unit vector in the direction of `v`, or `None` when `v` has no usable direction
/// (zero, infinite or NaN). Neither 1e-30 nor 1e30 is lost.
#[inline]
#[must_use]
pub(crate) fn unit(v: Vec3) -> Option<Vec3> {
    let squared = v.length_squared();
    // Squares in here have lost no digits to underflow.
    if squared > 1e-24 && squared < 1e30 {
        return Some(v / num::sqrt(squared));
    }
    unit_of_extreme(v)
}

/// Scales first, by a power of two: the result is to the last bit that of `v` in any other unit of length.
#[cold]
fn unit_of_extreme(v: Vec3) -> Option<Vec3> {
    let scale = v.abs().max_element();
    if !(scale > 0.0 && scale < f32::INFINITY) {
        return None;
    }
    // The exponent alone; of two factors, as that of 1e-45 or its reciprocal is no number.
    let exponent = libm::ilogbf(scale);
    let half = exponent / 2;
    let w = v * libm::scalbnf(1.0, -half) * libm::scalbnf(1.0, half - exponent);
    let squared = w.length_squared();
    // Between 1 and 12, unless a component is NaN, which the largest one does not show.
    (squared >= 1.0).then(|| w / num::sqrt(squared))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_and_signed_zeros_give_orthonormal_bases() {
        for n in
            [Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z, Vec3::new(0.0, -0.0, -1.0)]
        {
            let f = Frame::from_normal(n);
            assert!((f.s.cross(f.t) - f.n).length() < 1e-6, "{n}");
            assert!((f.s.length() - 1.0).abs() < 1e-6);
        }
    }

    #[test]
    fn random_normals_give_orthonormal_bases() {
        for i in 0..1_000_000u32 {
            let u = num::unit_f32(num::hash(i));
            let v = num::unit_f32(num::hash2(i, 1));
            let n = crate::warp::uniform_sphere([u, v]);
            let f = Frame::from_normal(n);
            let err = f.s.dot(f.t).abs().max(f.s.dot(n).abs()).max((f.t.length() - 1.0).abs());
            assert!(err < 1e-6, "{n} {err}");
            assert!((f.to_world(f.to_local(Vec3::X)) - Vec3::X).length() < 2e-6);
        }
    }

    #[test]
    fn tangents_are_kept_as_far_as_they_are_at_right_angles() {
        let n = Vec3::new(0.6, 0.0, 0.8);
        for tangent in [Vec3::X, Vec3::NEG_X, Vec3::Y * 1e-30, Vec3::new(0.6, 1e-3, 0.8) * 1e10] {
            let f = Frame::from_normal_and_tangent(n, tangent);
            assert!(f.s.dot(tangent) > 0.0 && (f.s.cross(f.t) - n).length() < 1e-6, "{tangent} {f:?}");
            assert!(f.t.dot(unit(tangent).unwrap()).abs() < 1e-4, "{tangent} {f:?}");
        }
        for nothing in [Vec3::ZERO, n, n * 1e9, Vec3::NAN, Vec3::INFINITY] {
            assert_eq!(Frame::from_normal_and_tangent(n, nothing), Frame::from_normal(n));
        }
    }

    #[test]
    fn unit_is_the_same_to_the_last_bit_in_other_units_of_length() {
        for i in 0..1000 {
            let [x, y, z] = [0, 1, 2].map(|j| num::unit_f32(num::hash2(i, j)) - 0.5);
            let v = Vec3::new(x, y, z);
            for power in -100..100 {
                assert_eq!(unit(v * libm::exp2f(power as f32)), unit(v), "{v} times 2 to the {power}");
            }
        }
    }

    #[test]
    fn unit_keeps_extreme_lengths_and_refuses_no_direction() {
        for s in [1e-38, 1e-20, 1.0, 1e20, 1e38] {
            let n = unit(Vec3::new(1.0, 2.0, -2.0) * s).unwrap();
            assert!((n - Vec3::new(1.0, 2.0, -2.0) / 3.0).length() < 1e-6, "{s}");
        }
        assert_eq!(unit(Vec3::ZERO), None);
        assert_eq!(unit(Vec3::NAN), None);
        assert_eq!(unit(Vec3::new(f32::NAN, -1.0, 0.0)), None);
        assert_eq!(unit(Vec3::new(1.0, 0.0, f32::NAN)), None);
        assert_eq!(unit(Vec3::INFINITY), None);
    }
}
