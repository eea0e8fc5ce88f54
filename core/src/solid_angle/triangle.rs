//! Uniform directions toward a triangle.

use crate::num::{self, sqrt_in_double as sqrt};
use glam::{DVec3, Vec3};

/// A place on a triangle and the way there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrianglePlace {
    /// Barycentric `(b1, b2)` of the place, in double precision: next to the receiver the differences
    /// between places are as small as its distance.
    pub barycentric: [f64; 2],
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
/// along `v₀ v₂`. Nothing here cancels for small triangles, nor for one that fills the hemisphere,
/// where `s` stays put and the angle at `v₁` does all the way. Ratios of sines along both arcs say
/// where on the flat triangle the place is; direction and distance are those of the place.
///
/// In double precision but for angles: next to a needle the sides of the spherical triangle are half
/// turns less 1e-6, of which single precision knows one digit, and the place depends on the rest. At
/// 1 mrad over the plane a determinant in single precision is off by 1e-4.
///
/// Source: Arvo 1995, *Stratified Sampling of Spherical Triangles*, SIGGRAPH, section 2. Differs:
/// half-angle tangents as above (derived), and no arc cosine; solid angle after Van Oosterom,
/// Strackee 1983, *The Solid Angle of a Plane Triangle*, IEEE Trans. Biomed. Eng. 30(2), equation 8.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphericalTriangle {
    solid_angle: f32,
    /// From the receiver to the first corner, and from there to the others (m).
    origin: DVec3,
    edges: [DVec3; 2],
    /// Distances of the first and the second corner (m).
    first: f64,
    second: f64,
    /// Cosine and sine of the angle at the first corner.
    alpha: [f64; 2],
    /// Of the side from the first to the second corner: `1 − cos`, `1 + cos`, and the cotangent of its
    /// half.
    versine: f64,
    versine_below: f64,
    cot_half: f64,
    /// The edge to the third corner along the direction of the first, and across (m).
    base: [f64; 2],
}

/// A corner that others are measured from.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Apex {
    corner: DVec3,
    from: DVec3,
    /// From the receiver to the corner: way (m), direction and distance (m).
    origin: DVec3,
    v: DVec3,
    l: f64,
}

impl Apex {
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(crate) fn new(from: Vec3, corner: Vec3) -> Self {
        let (from, corner) = (from.as_dvec3(), corner.as_dvec3());
        let origin = corner - from;
        let l = origin.length();
        Self { corner, from, origin, v: origin * (1.0 / l), l }
    }
}

/// Another corner, as triangles of the same apex share it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Corner {
    /// From the apex (m).
    edge: DVec3,
    /// Direction and distance (m) from the receiver.
    v: DVec3,
    l: f64,
    /// From the apex or from the receiver, whichever is shorter and so has lost less (m): all that counts
    /// is the part across the apex's direction.
    way: DVec3,
}

impl Corner {
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(crate) fn new(apex: &Apex, corner: Vec3) -> Self {
        let corner = corner.as_dvec3();
        // Not from the receiver's distances, which far from a needle have lost its width.
        let (p, edge) = (corner - apex.from, corner - apex.corner);
        let square = p.length_squared();
        let l = sqrt(square);
        let way = if square < edge.length_squared() { p } else { edge };
        Self { edge, v: p * (1.0 / l), l, way }
    }
}

/// Volume of the apex's direction and two ways (m²). Their product comes first: next to a needle both
/// are all but along the direction.
#[cfg_attr(not(feature = "small"), inline(always))]
fn volume(apex: &Apex, a: &Corner, b: &Corner) -> f64 {
    apex.v.dot(a.way.cross(b.way)).abs()
}

/// `1 + Σ cos` as `(vᵢ + vₖ)·(vⱼ + vₖ)`. In a needle's plane the first and second are opposite to the
/// third; their sums are small, and so is what they lose.
#[cfg_attr(not(feature = "small"), inline(always))]
fn cosines([v0, v1, v2]: [DVec3; 3]) -> f64 {
    let (c0, c1, c2) = (v1.dot(v2), v2.dot(v0), v0.dot(v1));
    let (i, j, k) = if c0 >= c1 && c0 >= c2 {
        (v1, v2, v0)
    } else if c1 >= c2 {
        (v2, v0, v1)
    } else {
        (v0, v1, v2)
    };
    (i + k).dot(j + k)
}

/// Sine and cosine of half the solid angle of a triangle, from either side, times one number above 0; NaN
/// at a corner.
#[cfg_attr(not(feature = "small"), inline(always))]
#[must_use]
pub(crate) fn half_solid_angle(apex: &Apex, a: &Corner, b: &Corner) -> [f32; 2] {
    [(volume(apex, a, b) / (a.l * b.l)) as f32, cosines([apex.v, a.v, b.v]) as f32]
}

/// `1 − cos` of an angle, itself or as what `1 + cos` leaves of 2: the smaller one has the digits.
#[inline]
fn above_or_rest(versine: f64, versine_below: f64) -> f64 {
    if versine_below < 1.0 { 2.0 - versine_below } else { versine }
}

impl SphericalTriangle {
    /// The triangle of three corners (m), seen from `from`; the winding does not matter.
    ///
    /// `None` in its plane, when it has no area or is too small for `f32` from there, or when something
    /// is not finite.
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[must_use]
    pub fn new(from: Vec3, corners: &[Vec3; 3]) -> Option<Self> {
        let apex = Apex::new(from, corners[0]);
        let (a, b) = (Corner::new(&apex, corners[1]), Corner::new(&apex, corners[2]));
        let [sin, cos] = half_solid_angle(&apex, &a, &b);
        Self::from_corners(&apex, &a, &b, 2.0 * num::atan2(sin, cos))
    }

    /// The same with corners whose solid angle (sr) is known.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(crate) fn from_corners(apex: &Apex, a: &Corner, b: &Corner, solid_angle: f32) -> Option<Self> {
        // The planes through the apex: their angle is that at the apex.
        let (to_a, to_b) = (apex.v.cross(a.way), apex.v.cross(b.way));
        let (aside, across) = (to_a.length(), to_b.length());
        let sin_side = aside / a.l;
        let per_both = 1.0 / (aside * across);
        let cos_alpha = to_a.dot(to_b) * per_both;
        let versine_below = 0.5 * (apex.v + a.v).length_squared();
        let versine = above_or_rest(sin_side * sin_side / versine_below, versine_below);
        let seen = solid_angle >= f32::MIN_POSITIVE && versine > 0.0 && across > 0.0 && !cos_alpha.is_nan();
        seen.then_some(Self {
            solid_angle,
            origin: apex.origin,
            edges: [a.edge, b.edge],
            first: apex.l,
            second: a.l,
            alpha: [cos_alpha, volume(apex, a, b) * per_both],
            versine,
            versine_below,
            cot_half: versine_below / sin_side,
            base: [apex.v.dot(b.edge), across],
        })
    }

    /// The solid angle (sr), in `(0, 2π]`.
    #[inline]
    #[must_use]
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle
    }

    /// Draws a place with the density `1 / solid_angle` (sr⁻¹) in its direction; `None` when that is
    /// the receiver's own, as far as double precision can tell.
    ///
    /// * `u` – two independent uniforms, each in `[0, 1)`
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> Option<TrianglePlace> {
        let arc = Arc::new(self, num::sin_cos_near(0.5 * u[0] * self.solid_angle));
        // The arc's end: its share of the edge from the first to the third corner, and its distance.
        let [along, across] = self.base;
        let (rise, sin) = (across * arc.cos - along * arc.sin, self.first * arc.sin);
        // At least the sine: the end is on the edge.
        let rise = rise.max(sin).max(f64::MIN_POSITIVE);
        let per_rise = 1.0 / rise;
        let (share, reach) = (sin * per_rise, self.first * across * per_rise);
        // 1 − cos and 1 + cos each for itself: next to the second corner's opposite, one has no digits.
        let u = f64::from(u[1]);
        let (versine, below) = (u * arc.versine, arc.versine_below + (1.0 - u) * arc.versine);
        let (sin_max, sin) = (sqrt(arc.versine * arc.versine_below), sqrt(versine * below));
        let rest = sin_max * (1.0 - versine) - (1.0 - arc.versine) * sin;
        // What the arc's ends weigh: sines of the other's side of the arc, times its distance.
        let (out, back) = (self.second * sin, reach * rest.max(0.0));
        let part = if out > 0.0 { out / (out + back) } else { 0.0 };
        let (b1, b2) = (1.0 - part, part * share);
        let way = self.origin + self.edges[0] * b1 + self.edges[1] * b2;
        let distance = way.length();
        (distance as f32 > 0.0 && distance < f64::from(f32::MAX)).then(|| TrianglePlace {
            barycentric: [b1, b2],
            direction: (way * (1.0 / distance)).as_vec3(),
            distance: distance as f32,
        })
    }

    /// What a unit direction meets of the triangle's plane, outside of it as well; `None` along the plane
    /// and away from it.
    #[must_use]
    pub fn meet(&self, direction: Vec3) -> Option<TrianglePlace> {
        let ([to_second, to_third], way) = (self.edges, direction.as_dvec3());
        // Cramer's rule for `origin + b1 e1 + b2 e2 = distance direction`.
        let across = to_third.cross(way);
        let determinant = to_second.dot(across);
        let b1 = -self.origin.dot(across) / determinant;
        let b2 = self.origin.dot(to_second.cross(way)) / determinant;
        let distance = (self.origin.dot(to_second.cross(to_third)) / determinant) as f32;
        (distance > 0.0 && b1.is_finite() && b2.is_finite()).then_some(TrianglePlace {
            barycentric: [b1, b2],
            direction,
            distance,
        })
    }

    /// Inverse of [`SphericalTriangle::sample`]; each in `[0, 1)`.
    ///
    /// * `barycentric` – of the place
    #[must_use]
    pub fn invert(&self, barycentric: [f64; 2]) -> [f32; 2] {
        let b1 = barycentric[0].clamp(0.0, 1.0);
        let part = 1.0 - b1;
        let b2 = barycentric[1].max(0.0).min(part);
        let share = if part > 0.0 { b2 / part } else { 0.0 };
        // The arc's end from the first corner: tan(s/2), then the area.
        let [along, across] = self.base;
        let (x, y) = (self.first + share * along, share * across);
        let reach = sqrt(x * x + y * y);
        let x = if x < 0.0 { y * y / (reach - x) } else { reach + x };
        let [cos_a, sin_a] = self.alpha;
        let half = num::atan2((y * sin_a) as f32, (self.cot_half * x + y * cos_a) as f32);
        // 1 − cos is sin² / (1 + cos), and the sines are as the parts of the line to the arc's end.
        let second = (self.origin + self.edges[0]) / self.second;
        let end = self.origin + self.edges[1] * share;
        let place = self.origin + self.edges[0] * b1 + self.edges[1] * b2;
        let (end_length, length) = (end.length(), place.length());
        let ratio = part * end_length / length;
        let below = (second + end / end_length).length_squared();
        let share = ratio * ratio * below / (second + place / length).length_squared();
        [2.0 * half / self.solid_angle, share as f32].map(num::clamp_unit)
    }
}

/// The arc from the second corner that cuts off a part of the triangle.
struct Arc {
    /// Cosine and sine of the way along `v₀ v₂`.
    cos: f64,
    sin: f64,
    /// `1 − cos` and `1 + cos` of the arc's length.
    versine: f64,
    versine_below: f64,
}

impl Arc {
    /// * `sin_h`, `cos_h` – of half the area to cut off
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn new(triangle: &SphericalTriangle, (sin_h, cos_h): (f32, f32)) -> Self {
        let SphericalTriangle { alpha: [cos_a, sin_a], versine, versine_below, cot_half, .. } = *triangle;
        let (sin_h, cos_h) = (f64::from(sin_h), f64::from(cos_h));
        let (x, y) = (cos_h * sin_a - sin_h * cos_a, sin_h * cot_half);
        let inverse = 1.0 / (x * x + y * y);
        let z = cos_h * sin_a - 2.0 * (sin_h / versine) * cos_a;
        let w = y * cot_half * sin_a;
        // Sine and cosine are of single precision: their squares add up to 1, but for rounding.
        let below = (sin_h * sin_h + cos_h * cos_h) * sin_a * sin_a;
        let versine_below = versine_below * below * inverse;
        Self {
            cos: (x - y) * (x + y) * inverse,
            sin: (2.0 * x * y * inverse).max(0.0),
            versine: above_or_rest(versine * (z * z + w * w) * inverse, versine_below),
            versine_below,
        }
    }
}
