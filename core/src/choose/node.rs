//! One node of a light tree: what is known of the lights below it, in 28 bytes.

use crate::geom::unit;
use crate::light::{LightBounds, Receiver};
use crate::num::{self, larger};
use glam::Vec3;

/// Cosines nearer to 0 than this are not told from 0, so that what rounding does to a node hides no
/// light: axes are off by 5·10⁻⁵, cosines by 3·10⁻⁵. Where a bound says that nothing arrives, but by
/// less than this, this is the cosine.
const SLACK: f32 = 1e-3;

/// Steps of a cosine or a coordinate of an axis on either side of 0.
const STEPS: f32 = 32_767.0;

/// The lights of a subtree as one: a sphere around them, a cone of normals, how far from these they
/// shine, and how much. Rounded so that no light is lost.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct LightNode {
    centre: [f32; 3],
    /// Upper halves of `f32`: radius, rounded up, and intensity.
    radius: u16,
    intensity: u16,
    /// Of the cone of normals, in octahedral coordinates.
    axis: [i16; 2],
    /// Cosine of the cone's half-angle, and of the largest angle beyond it; rounded down. The last bit
    /// of the second one is set where both sides emit.
    cos_normals: i16,
    cos_emission: i16,
    /// Index of the second child, or of the light.
    link: u32,
}

impl LightNode {
    /// * `link` – index of the second child, or of the light at a leaf
    #[must_use]
    pub fn new(bounds: &LightBounds, link: u32) -> Self {
        let region = bounds.region;
        let centre = region.centre();
        // To the farthest corner from the rounded centre; beyond `f32` is everywhere.
        let radius = larger((region.max - centre).length(), (centre - region.min).length()) * (1.0 + 1e-6);
        let cosine = |angle: f32| {
            let (_, cos) = num::sin_cos(angle);
            libm::floorf(cos * STEPS) as i16
        };
        Self {
            centre: centre.to_array(),
            radius: upper_half(radius),
            intensity: upper_half(bounds.intensity),
            axis: to_octahedron(bounds.normals.axis),
            cos_normals: cosine(bounds.normals.angle),
            cos_emission: cosine(bounds.emission) & !1 | i16::from(bounds.two_sided),
            link,
        }
    }

    /// Index of the second child, or of the light at a leaf.
    #[inline]
    #[must_use]
    pub const fn link(&self) -> u32 {
        self.link
    }

    /// Intensity of the lights together (W sr⁻¹).
    #[inline]
    #[must_use]
    pub fn intensity(&self) -> f32 {
        from_upper_half(self.intensity)
    }

    /// How much the lights are expected to matter at `from` (W m⁻²): 0 where nothing arrives from them,
    /// else positive and finite. No length comes with a unit of its own.
    ///
    /// Source: Conty Estevez, Kulla 2018, section 4.2.
    #[inline]
    #[must_use]
    pub fn importance(&self, from: &Receiver) -> f32 {
        let v = Vec3::from_array(self.centre) - from.point;
        let (d2, radius) = (v.length_squared(), from_upper_half(self.radius));
        let r2 = radius * radius;
        if !(d2 > r2) {
            return in_range(self.intensity() / r2);
        }
        let wi = v / num::sqrt(d2);
        let sphere = Angle::of_sine(num::sqrt(r2 / d2));
        let incidence = Angle::of_cosine(from.normal.dot(wi)).less(sphere).cos;
        let along = -from_octahedron(self.axis).dot(wi);
        let along = if self.cos_emission & 1 == 1 { along.abs() } else { along };
        let normals = Angle::of_cosine(f32::from(self.cos_normals) * (1.0 / STEPS));
        let emission = Angle::of_cosine(along).less(normals).less(sphere).cos;
        let least = f32::from(self.cos_emission) * (1.0 / STEPS);
        if incidence < -SLACK || emission < least - SLACK {
            return 0.0;
        }
        in_range(self.intensity() * larger(incidence, SLACK) * larger(emission, SLACK) / d2)
    }
}

/// A positive number that is neither 0 nor infinite, nor is the sum of two.
#[inline]
fn in_range(x: f32) -> f32 {
    num::clamp(x, f32::MIN_POSITIVE, 0.25 * f32::MAX)
}

/// An angle from 0 to π.
#[derive(Clone, Copy)]
struct Angle {
    cos: f32,
    sin: f32,
}

impl Angle {
    #[inline]
    fn of_cosine(cos: f32) -> Self {
        Self { cos, sin: num::sqrt((1.0 - cos) * (1.0 + cos)) }
    }

    /// At most a right angle.
    #[inline]
    fn of_sine(sin: f32) -> Self {
        Self { cos: num::sqrt((1.0 - sin) * (1.0 + sin)), sin }
    }

    /// The difference of two angles, 0 where it would be negative.
    #[inline]
    fn less(self, other: Self) -> Self {
        if self.cos >= other.cos {
            return Self { cos: 1.0, sin: 0.0 };
        }
        Self {
            cos: self.cos * other.cos + self.sin * other.sin,
            sin: self.sin * other.cos - self.cos * other.sin,
        }
    }
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

#[inline]
fn from_octahedron(axis: [i16; 2]) -> Vec3 {
    let [x, y] = axis.map(|c| f32::from(c) * (1.0 / STEPS));
    let z = 1.0 - x.abs() - y.abs();
    let under = larger(-z, 0.0);
    let n = Vec3::new(x - under.copysign(x), y - under.copysign(y), z);
    unit(n).unwrap_or(Vec3::Z)
}
