//! Where a light is and whither it shines, for choosing among many.

use super::area::{SampledShape, Sides};
use super::{AreaLight, SurfaceRadiance};
use crate::geom::{Aabb, unit};
use crate::num::{self, FRAC_PI_2, PI, larger};
use glam::Vec3;

/// The directions within an angle of an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cone {
    /// Unit vector in the middle.
    pub axis: Vec3,
    /// Largest angle to it (rad), in [0, π].
    pub angle: f32,
}

impl Cone {
    /// All directions.
    pub const ALL: Self = Self { axis: Vec3::Z, angle: PI };

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
        let (sin, cos) = num::sin_cos_near(angle - wide.angle);
        let axis = wide.axis * cos + pole.cross(wide.axis) * sin;
        Self { axis: unit(axis).unwrap_or(wide.axis), angle }
    }
}

/// What is known of one or several lights that have a place. The box and the cone are bounds: no light
/// comes from outside of the one, nor leaves outside of the other. The rest are means, weighted by
/// intensity.
///
/// Source: the bounds are those of Conty Estevez, Kulla 2018, *Importance Sampling of Many Lights with
/// Adaptive Tree Splitting*, Proc. ACM Comput. Graph. Interact. Tech. 1(2), section 4.1. Differs: one cone
/// of the directions of light, `θ_o + θ_e` wide, instead of one of normals and a width beyond it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightBounds {
    /// Box around the lights (m).
    pub region: Aabb,
    /// The directions in which light leaves.
    pub directions: Cone,
    /// True when it leaves in the opposite directions too.
    pub two_sided: bool,
    /// Power over π, that is the intensity of a Lambertian surface along its normal, as average over the
    /// channels (W sr⁻¹); of one side where two emit. 0 for what is dark.
    pub intensity: f32,
    /// Where the light is in the mean (m).
    pub centre: Vec3,
    /// Mean squared distance to there (m²).
    pub variance: f32,
    /// Mean of the unit normals: of length 1 where all agree, 0 for what shines alike all around.
    pub normal: Vec3,
}

impl LightBounds {
    /// A light at a point.
    pub(super) fn at(position: Vec3, directions: Cone, normal: Vec3, intensity: f32) -> Self {
        Self {
            region: Aabb::around(&[position]),
            directions,
            two_sided: false,
            intensity,
            centre: position,
            variance: 0.0,
            normal,
        }
    }

    /// What is known of the lights of both.
    #[must_use]
    pub fn union(self, mut other: Self) -> Self {
        let two_sided = self.two_sided || other.two_sided;
        if two_sided && self.directions.axis.dot(other.directions.axis) < 0.0 {
            other.directions.axis = -other.directions.axis;
            other.normal = -other.normal;
        }
        // Halves, whose sum is finite.
        let (a, b) = (0.5 * self.intensity, 0.5 * other.intensity);
        let share = if a + b > 0.0 { b / (a + b) } else { 0.5 };
        let apart = other.centre - self.centre;
        let within = self.variance + (other.variance - self.variance) * share;
        Self {
            region: self.region.union(other.region),
            directions: self.directions.union(other.directions),
            two_sided,
            intensity: (self.intensity + other.intensity).min(f32::MAX),
            centre: self.centre + apart * share,
            variance: within + apart.length_squared() * (share * (1.0 - share)),
            normal: self.normal + (other.normal - self.normal) * share,
        }
    }
}

impl<S: SampledShape, R: SurfaceRadiance> AreaLight<S, R> {
    /// Its box and its normals; `L A` as intensity.
    pub(super) fn light_bounds(&self) -> LightBounds {
        let (region, normals) = (self.shape().bounds(), self.shape().normals());
        let flat = normals.angle < PI;
        let diagonal = region.diagonal();
        LightBounds {
            region,
            directions: Cone { angle: (normals.angle + FRAC_PI_2).min(PI), ..normals },
            two_sided: flat && self.sides() == Sides::Both,
            intensity: positive(self.mean_radiance(), self.shape().area()),
            centre: region.centre(),
            // Of a rectangle in its plane.
            variance: diagonal * diagonal * (1.0 / 12.0),
            normal: if flat { normals.axis } else { Vec3::ZERO },
        }
    }
}

/// Expected `max(cos θ, 0)` between a direction and unit vectors with a given mean.
///
/// * `length` – of their mean, in [0, 1]
/// * `cos` – of the mean, not normalised, with the direction
///
/// Derived: `max(x, 0) = (x + |x|) / 2`, and `|x|` is about the root of `x² + v / 4` where `v` is how much
/// the vectors differ: exact for one direction, and 1/4 for all of them.
#[inline]
pub(crate) fn expected_cosine(cos: f32, length: f32) -> f32 {
    0.5 * (cos + expected_absolute_cosine(cos, length))
}

/// Expected `|cos θ|`, likewise.
#[inline]
pub(crate) fn expected_absolute_cosine(cos: f32, length: f32) -> f32 {
    num::sqrt(cos * cos + 0.25 * larger(1.0 - length * length, 0.0))
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
                Cone { axis: direction(5 * i + j), angle }
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

    fn flat(position: Vec3, normal: Vec3, two_sided: bool, intensity: f32) -> LightBounds {
        let directions = Cone { axis: normal, angle: FRAC_PI_2 };
        LightBounds { two_sided, ..LightBounds::at(position, directions, normal, intensity) }
    }

    #[test]
    fn opposite_normals_are_all_directions_unless_both_sides_emit() {
        let light = |normal, two_sided| flat(Vec3::ZERO, normal, two_sided, 1.0);
        let one = light(Vec3::Y, false).union(light(Vec3::NEG_Y, false));
        assert_eq!((one.directions, one.normal), (Cone::ALL, Vec3::ZERO));
        let both = light(Vec3::Y, true).union(light(Vec3::NEG_Y, false));
        assert_eq!((both.directions.angle, both.normal, both.two_sided), (FRAC_PI_2, Vec3::Y, true));
    }

    #[test]
    fn means_are_those_of_all_lights_together() {
        let lights: std::vec::Vec<_> = (0..100)
            .map(|i| flat(direction(i) * 3.0, direction(200 + i), false, 0.1 + random(500 + i)))
            .collect();
        let all = lights[1..].iter().fold(lights[0], |a, b| a.union(*b));
        let total: f32 = lights.iter().map(|l| l.intensity).sum();
        let mean = |f: &dyn Fn(&LightBounds) -> Vec3| {
            lights.iter().fold(Vec3::ZERO, |sum, l| sum + f(l) * l.intensity) / total
        };
        let centre = mean(&|l| l.centre);
        let squares = mean(&|l| Vec3::splat((l.centre - centre).length_squared())).x;
        assert!((all.intensity / total - 1.0).abs() < 1e-5);
        assert!((all.centre - centre).length() < 1e-5 && (all.normal - mean(&|l| l.normal)).length() < 1e-5);
        assert!((all.variance / squares - 1.0).abs() < 1e-4, "{} {squares}", all.variance);
    }
}
