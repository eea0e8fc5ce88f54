//! Where a light is and whither it shines, for choosing among many.

use super::AreaLight;
use super::area::{SampledShape, Sides};
use crate::geom::{Aabb, unit};
use crate::num::{self, FRAC_PI_2, PI};
use glam::Vec3;

/// Unit normals within an angle of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NormalCone {
    /// Unit vector in the middle.
    pub axis: Vec3,
    /// Largest angle to it (rad), in [0, π].
    pub angle: f32,
}

impl NormalCone {
    /// All directions.
    pub const ALL: Self = Self { axis: Vec3::Z, angle: PI };

    /// One direction.
    #[must_use]
    pub const fn around(normal: Vec3) -> Self {
        Self { axis: normal, angle: 0.0 }
    }

    /// A cone that holds two cones, the smallest one but for rounding.
    ///
    /// Source: Barequet, Elber 2005, *Optimal bounding cones of vectors in three dimensions*, Inf. Process.
    /// Lett. 93, section 2, for two cones.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        let (wide, narrow) = if self.angle >= other.angle { (self, other) } else { (other, self) };
        let across = wide.axis.cross(narrow.axis);
        let between = num::atan2(across.length(), wide.axis.dot(narrow.axis));
        if between + narrow.angle <= wide.angle {
            return wide;
        }
        let angle = 0.5 * (wide.angle + between + narrow.angle);
        let Some(pole) = unit(across).filter(|_| angle < PI) else { return Self::ALL };
        // Turned from the wider cone's axis toward the other's.
        let (sin, cos) = num::sin_cos(angle - wide.angle);
        let axis = wide.axis * cos + pole.cross(wide.axis) * sin;
        Self { axis: unit(axis).unwrap_or(wide.axis), angle }
    }
}

/// What bounds the light of one or several lights that have a place: none comes from outside of the
/// box, and none leaves at more than [`LightBounds::emission`] from one of the normals.
///
/// Source: Conty Estevez, Kulla 2018, *Importance Sampling of Many Lights with Adaptive Tree Splitting*,
/// Proc. ACM Comput. Graph. Interact. Tech. 1(2), section 4.1. Differs: lights are weighed by the
/// intensity along their normal, which is what a receiver gets, and not by their power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightBounds {
    /// Box around the light (m).
    pub region: Aabb,
    /// Its normals: the paper's axis and `θ_o`.
    pub normals: NormalCone,
    /// Largest angle between a normal and the light that leaves there (rad), in [0, π]: the paper's `θ_e`.
    pub emission: f32,
    /// True when light leaves also against the normals.
    pub two_sided: bool,
    /// Largest intensity, as average over the channels (W sr⁻¹); 0 for what is dark.
    pub intensity: f32,
}

impl LightBounds {
    /// What bounds the lights of both.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        let two_sided = self.two_sided || other.two_sided;
        let (a, mut b) = (self.normals, other.normals);
        if two_sided && a.axis.dot(b.axis) < 0.0 {
            b.axis = -b.axis;
        }
        Self {
            region: self.region.union(other.region),
            normals: a.union(b),
            emission: num::larger(self.emission, other.emission),
            two_sided,
            intensity: (self.intensity + other.intensity).min(f32::MAX),
        }
    }
}

impl<S: SampledShape> AreaLight<S> {
    /// Its box, its normals and the intensity `L A'`, where `A'` is the largest area that the shape can
    /// show.
    pub(super) fn light_bounds(&self) -> LightBounds {
        let (normals, share) = self.shape().normals();
        LightBounds {
            region: self.shape().bounds(),
            normals,
            emission: FRAC_PI_2,
            two_sided: self.sides() == Sides::Both,
            intensity: positive(self.mean_radiance(), self.shape().area() * share),
        }
    }
}

/// The product of two positive numbers, kept in the range of `f32`: 0 only when the first is.
pub(super) fn positive(a: f32, b: f32) -> f32 {
    if a > 0.0 { (a * b).clamp(f32::MIN_POSITIVE, f32::MAX) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::warp;

    fn random(i: u32) -> f32 {
        num::unit_f32(num::hash(i))
    }

    fn direction(i: u32) -> Vec3 {
        warp::uniform_sphere([random(2 * i), random(2 * i + 1)])
    }

    fn angle(a: Vec3, b: Vec3) -> f32 {
        num::atan2(a.cross(b).length(), a.dot(b))
    }

    #[test]
    fn a_union_holds_both_cones() {
        for i in 0..20_000 {
            let cone = |j: u32| {
                let angle = [0.0, 1e-3, 0.3, 1.5, 3.0][(num::hash(i + j) % 5) as usize];
                NormalCone { axis: direction(5 * i + j), angle }
            };
            let (a, b) = (cone(0), cone(1));
            let both = a.union(b);
            assert!((both.axis.length() - 1.0).abs() < 1e-6, "{both:?}");
            for one in [a, b] {
                let farthest = (angle(one.axis, both.axis) + one.angle).min(PI);
                assert!(farthest <= both.angle + 1e-5, "{a:?} {b:?} {both:?}");
            }
            // The smallest: both touch it, unless one held the other.
            let least = 0.5 * (a.angle + b.angle + angle(a.axis, b.axis));
            assert!(both.angle <= least.max(a.angle).max(b.angle).min(PI) + 1e-5);
        }
    }

    #[test]
    fn opposite_normals_are_all_directions_unless_both_sides_emit() {
        let light = |axis, two_sided| LightBounds {
            region: Aabb::around(&[Vec3::ZERO]),
            normals: NormalCone::around(axis),
            emission: FRAC_PI_2,
            two_sided,
            intensity: 1.0,
        };
        assert_eq!(light(Vec3::Y, false).union(light(Vec3::NEG_Y, false)).normals, NormalCone::ALL);
        let both = light(Vec3::Y, true).union(light(Vec3::NEG_Y, false));
        assert_eq!((both.normals, both.two_sided), (NormalCone::around(Vec3::Y), true));
    }
}
