//! One node of a light tree: what is known of the lights below it, in 28 bytes.

use crate::geom::unit;
use crate::light::{LightBounds, Receiver, expected_absolute_cosine, expected_cosine};
use crate::num::{self, PI, larger};
use glam::Vec3;

/// Cosines that differ by less are not told apart, so that rounding hides no light: axes are off by
/// 5·10⁻⁵, cosines by 3·10⁻⁵. It is also the least factor of what is not dark.
const SLACK: f32 = 1e-3;

/// Steps of a cosine or a coordinate of an axis on either side of 0.
const STEPS: f32 = 32_767.0;

/// The lights of a subtree as one: bounds of place and direction, beyond which nothing arrives, and
/// means, from which follows how much does.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct LightNode {
    centre: [f32; 3],
    /// Upper half of an `f32`: radius of a sphere around the centre that holds the lights, rounded up.
    radius: u16,
    /// Upper half of an `f32`: intensity; with the sign of a negative number where both sides emit.
    intensity: u16,
    /// Axis of the cone of directions, in octahedral coordinates.
    axis: [i16; 2],
    /// Cosine of its half-angle, rounded down.
    directions: i16,
    /// Root mean square of the distance to the centre, in units of the radius.
    spread: u8,
    /// Length of the mean normal.
    agreement: u8,
    /// Index of the second child, or of the light.
    link: u32,
}

impl LightNode {
    /// * `link` – index of the second child, or of the light at a leaf
    #[must_use]
    pub fn new(bounds: &LightBounds, link: u32) -> Self {
        let region = bounds.region;
        let centre = bounds.centre.clamp(region.min, region.max);
        let radius = (region.max - centre).max(centre - region.min).length() * (1.0 + 1e-6);
        // One axis serves the cone and the mean normal; the cone is widened to hold itself.
        let cone = bounds.directions;
        let axis = unit(bounds.normal).unwrap_or(cone.axis);
        let between = num::atan2(axis.cross(cone.axis).length(), axis.dot(cone.axis));
        let (_, cos) = num::sin_cos_near((cone.angle + between).min(PI));
        let side = if bounds.two_sided { SIGN } else { 0 };
        let byte = |x: f32| (num::clamp(x, 0.0, 1.0) * 255.0 + 0.5) as u8;
        Self {
            centre: centre.to_array(),
            radius: upper_half(radius),
            intensity: upper_half(bounds.intensity) | side,
            axis: to_octahedron(axis),
            directions: libm::floorf(cos * STEPS) as i16,
            spread: byte(num::sqrt(bounds.variance) / radius),
            agreement: byte(bounds.normal.length()),
            link,
        }
    }

    /// Index of the second child, or of the light at a leaf.
    #[inline]
    #[must_use]
    pub const fn link(&self) -> u32 {
        self.link
    }

    /// How much is expected to arrive at `from` when nothing is in the way, up to a factor (W m⁻²): 0 only
    /// where the bounds say that nothing does, else positive and finite. No length has a unit of its own.
    ///
    /// Source: of the bounds, Conty Estevez, Kulla 2018, section 4.2. Differs: what the bounds do not
    /// exclude is weighed by means. With the lights as a cloud around their centre, the squared distance
    /// is `d² + σ²`, the height above the receiver's horizon `(h + √(h² + 8/15 σ²)) / 2`, and the emitted
    /// share that of normals with the given mean. On the peers' scene `many`, one sample then has a
    /// seventh of the variance that bounds alone leave.
    #[inline]
    #[must_use]
    pub fn importance(&self, from: &Receiver) -> f32 {
        let v = Vec3::from_array(self.centre) - from.point;
        let radius = from_upper_half(self.radius);
        let (d2, height) = (v.length_squared(), from.normal.dot(v));
        let distance = num::sqrt(d2);
        if height < -(radius + SLACK * distance) {
            return 0.0;
        }
        let axis = from_octahedron(self.axis);
        let both = self.intensity & SIGN != 0;
        // From the centre itself, no direction in particular.
        let along = if distance > 0.0 { -axis.dot(v) / (distance * axis.length()) } else { 0.0 };
        let along = if both { along.abs() } else { along };
        if distance > radius && self.is_outside(along, radius / distance) {
            return 0.0;
        }
        let sigma = radius * (f32::from(self.spread) * (1.0 / 255.0));
        let around = larger(d2 + sigma * sigma, f32::MIN_POSITIVE);
        let mean_distance = num::sqrt(around);
        let above = 0.5 * (height + num::sqrt(height * height + (8.0 / 15.0) * sigma * sigma));
        // Seen from near by, the directions to the lights differ too.
        let agreement = f32::from(self.agreement) * (1.0 / 255.0) * (distance / mean_distance);
        let cos = along * agreement;
        let emitted =
            if both { expected_absolute_cosine(cos, agreement) } else { expected_cosine(cos, agreement) };
        let received = larger(above / mean_distance, SLACK);
        let intensity = from_upper_half(self.intensity & !SIGN);
        in_range(intensity * received * larger(emitted, SLACK) / around)
    }

    /// True when no light leaves toward a receiver outside of the sphere.
    ///
    /// * `along` – cosine between the axis and the way to the receiver
    /// * `sin` – sine of the angle that the sphere's radius fills
    #[inline]
    fn is_outside(&self, along: f32, sin: f32) -> bool {
        let least = f32::from(self.directions) * (1.0 / STEPS);
        if least <= -1.0 {
            return false;
        }
        // The cosine of the angle to the axis less that of the sphere.
        let cos = num::sqrt((1.0 - sin) * (1.0 + sin));
        if along >= cos {
            return false;
        }
        let across = num::sqrt((1.0 - along) * (1.0 + along));
        along * cos + across * sin < least - SLACK
    }
}

/// The sign bit of the upper half of an `f32`.
const SIGN: u16 = 1 << 15;

/// A positive number that is neither 0 nor infinite, nor is the sum of two.
#[inline]
fn in_range(x: f32) -> f32 {
    num::clamp(x, f32::MIN_POSITIVE, f32::MAX / 8.0)
}

/// The upper half of the bits of a positive number, rounded up; at most the largest finite one.
fn upper_half(x: f32) -> u16 {
    let up = (u64::from(x.to_bits()) + 0xffff) >> 16;
    up.min(0x7f7f) as u16
}

#[inline]
fn from_upper_half(x: u16) -> f32 {
    f32::from_bits(u32::from(x) << 16)
}

/// A unit vector on the octahedron `|x| + |y| + |z| = 1`, unfolded.
///
/// Source: Cigolle et al. 2014, *A Survey of Efficient Representations for Independent Unit Vectors*,
/// JCGT 3(2), section 3.
fn to_octahedron(n: Vec3) -> [i16; 2] {
    let p = n / n.abs().element_sum();
    let fold = |a: f32, b: f32| (1.0 - b.abs()).copysign(a);
    let (x, y) = if p.z >= 0.0 { (p.x, p.y) } else { (fold(p.x, p.y), fold(p.y, p.x)) };
    [x, y].map(|c| libm::roundf(c * STEPS) as i16)
}

/// Its direction; not of unit length.
#[inline]
fn from_octahedron(axis: [i16; 2]) -> Vec3 {
    let [x, y] = axis.map(|c| f32::from(c) * (1.0 / STEPS));
    let z = 1.0 - x.abs() - y.abs();
    let under = larger(-z, 0.0);
    Vec3::new(x - under.copysign(x), y - under.copysign(y), z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::warp;

    #[test]
    fn axes_keep_their_direction() {
        for i in 0..100_000 {
            let u = [num::unit_f32(num::hash(i)), num::unit_f32(num::hash2(i, 1))];
            let n = warp::uniform_sphere(u);
            assert!((from_octahedron(to_octahedron(n)).normalize() - n).length() < 1e-4, "{n}");
        }
        for n in [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z] {
            assert_eq!(from_octahedron(to_octahedron(n)), n);
        }
    }

    #[test]
    fn halves_are_never_smaller_and_always_finite() {
        for x in [0.0, 1e-45, 1e-30, 0.1, 1.0, 1.001, 3e38, f32::MAX, f32::INFINITY, f32::NAN] {
            let half = from_upper_half(upper_half(x));
            assert!(half >= x.min(3.3e38) && half.is_finite(), "{x:e} {half:e}");
            assert!(!(x > 1e-30) || half <= 1.008 * x, "{x:e} {half:e}");
        }
    }
}
