//! Uniform directions toward a triangle.

use crate::num;
use glam::{DVec3, Vec3};

/// A place on a triangle and the way there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrianglePlace {
    /// Barycentric `(b1, b2)` of the place.
    pub barycentric: [f32; 2],
    /// Unit direction to it.
    pub direction: Vec3,
    /// Its distance (m).
    pub distance: f32,
}

/// The directions in which a triangle is seen, from either side.
///
/// A place is drawn on an arc from the second corner `v₁` to a point of the arc `v₀ v₂`: `u[0]` is
/// the share of the solid angle on the side of `v₀`, `u[1]` that of the arc's cap. With `α` the angle
/// at `v₀`, `c` the side `v₀ v₁` and `T = tan(ω/2)` for the area `ω` to cut off, the point is at
///
/// ```text
/// tan(s/2) = T cot(c/2) / (sin α − T cos α)
/// ```
///
/// along `v₀ v₂`, and seen from `v₁` it is at the angle to `v₀` whose cosine and sine are as
/// `sin α − T (2/n) cos α − T² cot²(c/2) sin α` to `T (2/n) (sin α − T cos α)`, `n = 1 − cos c`.
/// Nothing here cancels for small triangles, nor for one that fills the hemisphere, where `s` stays
/// put and the angle at `v₁` does all the way.
///
/// The set-up is in double precision: in single, a determinant is off by 1e-4 at 1 mrad over the
/// plane, and a denominator by 6 % at 1e-6 sizes from an edge. What comes after is single.
///
/// Source: Arvo 1995, *Stratified Sampling of Spherical Triangles*, SIGGRAPH, section 2. Differs:
/// half-angle tangents as above (derived), and no arc cosine; solid angle after Van Oosterom,
/// Strackee 1983, *The Solid Angle of a Plane Triangle*, IEEE Trans. Biomed. Eng. 30(2), equation 8.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphericalTriangle {
    solid_angle: f32,
    /// Toward the second corner, with a tangent toward the first and one toward the third's side.
    apex: Vec3,
    toward_first: Vec3,
    toward_third: Vec3,
    /// Cosine and sine of the angle at the first corner.
    alpha: [f32; 2],
    /// Of the side from the first to the second corner: `1 − cos`, and the cotangent of its half.
    versine: f32,
    cot_half: f32,
    /// Cosine and sine of the side from the first to the third corner.
    base: [f32; 2],
    /// Distance of the nearest corner (m), and its ratio to the distance of each.
    nearest: f32,
    nearness: [f32; 3],
}

/// The corners relative to a receiver.
struct Relative {
    /// Directions, and one over their distances.
    v: [DVec3; 3],
    per_l: [f64; 3],
    /// Normals of the planes through the receiver and the first corner: with the second, of length
    /// `l₁ sin`, and with the third, `l₂ sin`.
    side: DVec3,
    base: DVec3,
    /// Volume of the first direction and the other corners, negative when clockwise.
    det: f64,
}

impl Relative {
    #[inline(always)]
    fn new(from: Vec3, corners: &[Vec3; 3]) -> Self {
        let [a, b, c] = corners.map(|c| c.as_dvec3());
        let p = [a, b, c].map(|corner| corner - from.as_dvec3());
        let squares = p.map(DVec3::length_squared);
        let per_l = squares.map(|square| 1.0 / libm::sqrt(square));
        let v = [p[0] * per_l[0], p[1] * per_l[1], p[2] * per_l[2]];
        // From the first corner to the others, or from the receiver, whichever is shorter and so has
        // lost less: all that counts is the part across the first direction.
        let shorter = |edge: DVec3, i: usize| if squares[i] < edge.length_squared() { p[i] } else { edge };
        let ways = [shorter(b - a, 1), shorter(c - a, 2)];
        // Products of differences of `f32` are exact: a needle has its area.
        let det = v[0].dot(ways[0].cross(ways[1]));
        Self { v, per_l, side: v[0].cross(ways[0]), base: v[0].cross(ways[1]), det }
    }

    /// `1 + Σ cos` as `(vᵢ + vₖ)·(vⱼ + vₖ)`. In a needle's plane the first and second are opposite to
    /// the third; their sums are small, and so is what they lose.
    #[inline(always)]
    fn cosines(&self) -> f64 {
        let [v0, v1, v2] = self.v;
        let (c0, c1, c2) = (v1.dot(v2), v2.dot(v0), v0.dot(v1));
        if c0 >= c1 && c0 >= c2 {
            (v1 + v0).dot(v2 + v0)
        } else if c1 >= c2 {
            (v2 + v1).dot(v0 + v1)
        } else {
            (v0 + v2).dot(v1 + v2)
        }
    }

    #[inline(always)]
    fn solid_angle(&self) -> f32 {
        let volume = self.det.abs() * (self.per_l[1] * self.per_l[2]);
        let angle = 2.0 * num::atan2(volume as f32, self.cosines() as f32);
        // NaN at a corner.
        num::larger(angle, 0.0)
    }
}

#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Solid angle of a triangle (sr), in `[0, 2π]`, from either side; 0 in its plane.
#[inline]
#[must_use]
pub(crate) fn triangle_solid_angle(from: Vec3, corners: &[Vec3; 3]) -> f32 {
    Relative::new(from, corners).solid_angle()
}

impl SphericalTriangle {
    /// The triangle of three corners (m), seen from `from`; the winding does not matter.
    ///
    /// `None` in its plane, when it has no area or is too small for `f32` from there, or when something
    /// is not finite.
    #[inline(always)]
    #[must_use]
    pub fn new(from: Vec3, corners: &[Vec3; 3]) -> Option<Self> {
        let relative = Relative::new(from, corners);
        let solid_angle = relative.solid_angle();
        let Relative { v: [v0, v1, v2], per_l: [per_l0, per_l1, per_l2], side, base, det } = relative;
        let (side_length, base_length) = (side.length(), base.length());
        let sin_side = side_length * per_l1;
        let below = 0.5 * (v0 + v1).length_squared();
        // Of 1 − cos and 1 + cos, the smaller one has the digits.
        let (versine, cot_half) = if below < 1.0 {
            (2.0 - below, sin_side / (2.0 - below))
        } else {
            (sin_side * sin_side / below, below / sin_side)
        };
        let versine = versine as f32;
        // NaN is refused too; a volume above 0 has sides above 0.
        if !(solid_angle >= f32::MIN_POSITIVE && versine >= f32::MIN_POSITIVE) {
            return None;
        }
        let (per_side, per_both) = (1.0 / side_length, 1.0 / (side_length * base_length));
        let aside = side * per_side;
        let nearest = 1.0 / larger(larger(per_l0, per_l1), per_l2);
        Some(Self {
            solid_angle,
            apex: v1.as_vec3(),
            toward_first: v1.cross(aside).as_vec3(),
            toward_third: (if det < 0.0 { -aside } else { aside }).as_vec3(),
            // Between the planes of both sides: their normals are the tangents, turned.
            alpha: [(side.dot(base) * per_both) as f32, (det.abs() * per_both) as f32],
            versine,
            cot_half: cot_half as f32,
            base: [v0.dot(v2) as f32, (base_length * per_l2) as f32],
            nearest: nearest as f32,
            nearness: [per_l0, per_l1, per_l2].map(|per_l| (nearest * per_l) as f32),
        })
    }

    /// The solid angle (sr), in `(0, 2π]`.
    #[inline]
    #[must_use]
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle
    }

    /// Draws a place with the density `1 / solid_angle` (sr⁻¹) in its direction.
    ///
    /// * `u` – two independent uniforms, each in `[0, 1)`
    #[inline(always)]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> TrianglePlace {
        let arc = Arc::new(self, num::sin_cos(0.5 * u[0] * self.solid_angle));
        // 1 − cos and 1 + cos each for itself: next to the second corner's opposite, one has no digits.
        let (versine, below) = (u[1] * arc.versine, arc.versine_below + (1.0 - u[1]) * arc.versine);
        let (sin, cos) =
            (num::sqrt(versine * below), if versine < 1.0 { 1.0 - versine } else { below - 1.0 });
        let tangent = self.toward_first * arc.tangent[0] + self.toward_third * arc.tangent[1];
        // The place by the sines of the parts of both arcs: what the corners weigh, times distance.
        let [cos_base, sin_base] = self.base;
        let sin_max = num::sqrt(arc.versine * arc.versine_below);
        let rest = num::larger(sin_max * cos - (1.0 - arc.versine) * sin, 0.0);
        let weights = [
            sin * num::larger(sin_base * arc.cos - cos_base * arc.sin, 0.0) * self.nearness[0],
            rest * sin_base * self.nearness[1],
            sin * arc.sin * self.nearness[2],
        ];
        let sum = weights[0] + weights[1] + weights[2];
        TrianglePlace {
            barycentric: if sum > 0.0 { [weights[1] / sum, weights[2] / sum] } else { [1.0, 0.0] },
            direction: self.apex * cos + tangent * sin,
            distance: self.nearest * if sum > 0.0 { sin_max * sin_base / sum } else { 1.0 },
        }
    }

    /// Inverse of [`SphericalTriangle::sample`]; each in `[0, 1)`.
    ///
    /// A small triangle's place is better known by its coordinates, a large one's by its direction.
    #[must_use]
    pub fn invert(&self, place: &TrianglePlace) -> [f32; 2] {
        let u = if self.solid_angle < 1.0 {
            self.invert_barycentric(place.barycentric)
        } else {
            self.invert_direction(place.direction)
        };
        u.map(num::clamp_unit)
    }

    fn invert_barycentric(&self, [b1, b2]: [f32; 2]) -> [f32; 2] {
        // The place as a sum of the corners' directions, and that of the first and third alone.
        let first = (1.0 - b1 - b2).max(0.0) / self.nearness[0];
        let second = b1.max(0.0) / self.nearness[1];
        let third = b2.max(0.0) / self.nearness[2];
        let [cos_base, sin_base] = self.base;
        let (x, y) = (first + third * cos_base, third * sin_base);
        let reach = num::sqrt(x * x + y * y);
        let tan_half = y / (reach + x).max(f32::MIN_POSITIVE);
        let [cos_a, sin_a] = self.alpha;
        let half = num::atan2(tan_half * sin_a, self.cot_half + tan_half * cos_a);
        let arc = Arc::new(self, num::sin_cos(half));
        let sin = reach * num::sqrt(arc.versine * arc.versine_below);
        let cos = second + reach * (1.0 - arc.versine);
        let radius = num::sqrt(sin * sin + cos * cos);
        let versine = if cos > 0.0 { sin * sin / (radius * (radius + cos)) } else { 1.0 - cos / radius };
        [2.0 * half / self.solid_angle, versine / arc.versine]
    }

    fn invert_direction(&self, direction: Vec3) -> [f32; 2] {
        let (x, y) = (direction.dot(self.toward_first), direction.dot(self.toward_third));
        let sin2 = x * x + y * y;
        let cos = direction.dot(self.apex);
        let versine = if cos > 0.0 { sin2 / (1.0 + cos) } else { 1.0 - cos };
        let inverse = 1.0 / num::sqrt(sin2).max(f32::MIN_POSITIVE);
        let (cos_b, sin_b) = (x * inverse, (y * inverse).max(0.0));
        // Area from two angles and the side between them:
        // tan(ω/2) = n sin α sin β / (sin(α + β) + sin γ), or the other root's form.
        let [cos_a, sin_a] = self.alpha;
        let (cosines, sines) = (cos_a * cos_b, sin_a * sin_b);
        let sum = sin_a * cos_b + cos_a * sin_b;
        let product = self.versine * sines;
        let other = (2.0 - self.versine) * sines - 2.0 * cosines;
        let gamma = num::sqrt(sum * sum + product * other);
        let half = if sum > 0.0 { num::atan2(product, sum + gamma) } else { num::atan2(gamma - sum, other) };
        let arc = Arc::new(self, num::sin_cos(half));
        [2.0 * half / self.solid_angle, versine / arc.versine]
    }
}

/// The arc from the second corner that cuts off a part of the triangle.
struct Arc {
    /// Cosine and sine of the way along `v₀ v₂`.
    cos: f32,
    sin: f32,
    /// `1 − cos` and `1 + cos` of the arc's length.
    versine: f32,
    versine_below: f32,
    /// Unit tangent at the second corner: toward the first, toward the third.
    tangent: [f32; 2],
}

impl Arc {
    /// * `sin_h`, `cos_h` – of half the area to cut off
    #[inline]
    fn new(triangle: &SphericalTriangle, (sin_h, cos_h): (f32, f32)) -> Self {
        let SphericalTriangle { alpha: [cos_a, sin_a], versine: n, cot_half, .. } = *triangle;
        let per_n = sin_h / n;
        let (x, y) = (cos_h * sin_a - sin_h * cos_a, sin_h * cot_half);
        let inverse = 1.0 / num::larger(x * x + y * y, f32::MIN_POSITIVE);
        let z = cos_h * sin_a - 2.0 * per_n * cos_a;
        let w = sin_h * cot_half * cot_half * sin_a;
        let norm2 = z * z + w * w;
        let tangent = [cos_h * z - sin_h * w, 2.0 * per_n * x];
        // As long as the root of norm2, but for round-off next to a needle.
        let length = num::sqrt(tangent[0] * tangent[0] + tangent[1] * tangent[1]);
        // The smaller of the two has the digits; they add up to 2.
        let (versine, below) = (n * norm2 * inverse, (2.0 - n) * sin_a * sin_a * inverse);
        let (versine, below) = if below < 1.0 { (2.0 - below, below) } else { (versine, 2.0 - versine) };
        Self {
            cos: (x - y) * (x + y) * inverse,
            sin: num::larger(2.0 * x * y * inverse, 0.0),
            versine,
            versine_below: below,
            tangent: if length > 0.0 { tangent.map(|t| t / length) } else { [1.0, 0.0] },
        }
    }
}
