//! A piece of a polygon between two meridians.

use super::arc::{atan_ratio, atan_ratio_and_slope};
use super::meridian::Meridian;
use crate::num;
use glam::{Vec2, Vec3};

/// A piece between two meridians and two great circles, or the zenith instead of the inner circle.
///
/// Derived: Peters 2021, *BRDF Importance Sampling for Polygonal Lights*, TOG 40(4), section 4,
/// samples the same pieces. Differs: places along the circles are fractions of their chords, on which
/// heights and azimuth vectors depend linearly; and where two circles nearly coincide, their
/// difference is a sum of differences that are known, not one of arc tangents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sector {
    pub(super) first: Meridian,
    pub(super) last: Meridian,
    /// How much of the sides of the whole piece is in those of this one.
    sides: [Vec2; 2],
    /// The cross product of the outer ends; its z is that of the azimuth vectors.
    pole: Vec3,
    /// True when it reaches up to the zenith.
    to_zenith: bool,
    /// Cosine of the outer arc.
    cos: f32,
    /// Square of its sine.
    sin2: f32,
    /// Square of the cross product of the inner chord's ends, less that of the outer chord's.
    inner_sin2: f32,
}

impl Sector {
    /// The piece from `first` counter-clockwise to `last`.
    ///
    /// * `pole` – cross product of the outer ends; of their azimuth vectors, its z, above 0
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn new(first: Meridian, last: Meridian, pole: Vec3, to_zenith: bool) -> Self {
        let (a, b) = (first.outer, last.outer);
        let (ea, eb) = (a.truncate(), b.truncate());
        let (qa, qb) = (first.square_rise(), last.square_rise());
        let mixed = first.rise * last.height_sum() + last.rise * first.height_sum();
        let inner_sin2 = eb.length_squared() * qa + ea.length_squared() * qb - ea.dot(eb) * mixed;
        let sides = [Vec2::X, Vec2::Y];
        Self { first, last, sides, pole, to_zenith, cos: a.dot(b), sin2: pole.length_squared(), inner_sin2 }
    }

    /// True when the outer arc is much beyond a right angle.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn is_wide(&self) -> bool {
        self.cos < WIDE
    }

    /// Both halves of a wide piece; they are not wide.
    ///
    /// Derived: the bisector of two unit vectors by their cross product, which keeps its digits when
    /// they are almost opposite.
    pub(super) fn halves(&self) -> [Self; 2] {
        let (a, b) = (self.first.outer, self.last.outer);
        let doubled = 1.0 - self.cos;
        // Length of the sum of both: √(2 + 2 cos).
        let length = num::sqrt(2.0 * self.sin2 / doubled);
        let bisector = (b - a).cross(self.pole) / (doubled * length);
        let both = self.first.toward(&self.last, 0.5).times(2.0 / length);
        let middle = Meridian { outer: Vec3 { z: both.outer.z, ..bisector }, ..both };
        let half = |first, last| Self::new(first, last, self.pole / length, self.to_zenith);
        let mut halves = [half(self.first, middle), half(middle, self.last)];
        let [a, b] = self.sides;
        let both = (a + b) / length;
        halves[0].sides = [a, both];
        halves[1].sides = [both, b];
        halves
    }

    /// Projected solid angle of a wide piece (sr).
    #[cold]
    pub(super) fn area_of_halves(&self) -> f32 {
        self.halves().iter().map(|half| half.area_to(1.0)).sum()
    }

    /// The half of a wide piece in which the projected solid angle `area` ends, what of it remains
    /// (sr), and that of the half (sr).
    #[cold]
    pub(super) fn half_at(&self, area: f32) -> (Self, f32, f32) {
        let [first, last] = self.halves();
        let middle = first.area_to(1.0);
        if area < middle { (first, area, middle) } else { (last, area - middle, last.area_to(1.0)) }
    }

    /// The meridian at the fraction `t` of the chords, and how much of the sides of the whole piece is
    /// in it.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn at(&self, t: f32) -> (Meridian, Vec2) {
        let [a, b] = self.sides;
        (self.first.toward(&self.last, t), a * (1.0 - t) + b * t)
    }

    /// The height above the outer end below which the share `v` of the meridian's `sin² θ` lies.
    ///
    /// Derived: `sin² θ` is the azimuth vector's square over that of the whole vector, Q, so `1 / Q`
    /// is even between both ends.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn height_of(&self, meridian: &Meridian, v: f32) -> f32 {
        let outer2 = meridian.outer.length_squared();
        let square = if self.to_zenith {
            outer2 * v / (1.0 - v)
        } else {
            let rise = meridian.square_rise();
            outer2 * v * rise / (outer2 + (1.0 - v) * rise)
        };
        let low = meridian.outer.z;
        let sum = low + num::sqrt(low * low + square);
        if sum > 0.0 { square / sum } else { 0.0 }
    }

    /// The share of the meridian's `sin² θ` below a height above its outer end: the inverse of
    /// [`Sector::height_of`].
    #[inline]
    pub(super) fn share_below(&self, meridian: &Meridian, height: f32) -> f32 {
        let outer2 = meridian.outer.length_squared();
        let square = height * (2.0 * meridian.outer.z + height);
        let share = square / (outer2 + square);
        if self.to_zenith {
            return share;
        }
        let rise = meridian.square_rise();
        if rise > 0.0 { share * ((outer2 + rise) / rise) } else { 0.0 }
    }

    /// Projected solid angle of the part up to the fraction `t` of the chords (sr).
    ///
    /// Derived: for an arc of angle θ with ends p_a, p_b, X the cross product of their azimuth
    /// vectors and N = |p_a × p_b|, the part below is `½ X θ / N` (Lambert 1760). By
    /// `tan(θ/2) = N / K`, `K = p_a·p_b + |p_a| |p_b|`, that is `X H(N² / K²) / K`, and the
    /// difference of two such terms is one of divided differences.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn area_to(&self, t: f32) -> f32 {
        self.area_of(&self.part(t))
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn part(&self, t: f32) -> Part {
        let (cos, sin2) = (1.0 + t * (self.cos - 1.0), t * t * self.sin2);
        let (da, sa) = (self.first.rise, self.first.height_sum());
        let rise = da + t * (self.last.rise - da);
        let height_sum = sa + t * (self.last.height_sum() - sa);
        Part { t, cos, sin2, outer2: cos * cos + sin2, rise, height_sum, square: rise * height_sum }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn area_of(&self, part: &Part) -> f32 {
        let Part { t, cos, sin2, outer2, rise, height_sum, square: qt } = *part;
        let outer = num::sqrt(outer2);
        let k_outer = cos + outer;
        let x_outer = sin2 / (k_outer * k_outer);
        if self.to_zenith {
            return self.pole.z * t * atan_ratio(x_outer) / k_outer;
        }
        let (da, sa) = (self.first.rise, self.first.height_sum());
        let qa = da * sa;
        let square = qa * outer2 + qt + qa * qt;
        let k_rise = 0.5 * (da * height_sum + rise * sa) + square / (num::sqrt(outer2 + square) + outer);
        let k_inner = k_outer + k_rise;
        let per_k = 1.0 / k_inner;
        // N² / K² of the outer arc less that of the inner one.
        let x_fall = (x_outer * k_rise * (k_inner + k_outer) - t * t * self.inner_sin2) * per_k * per_k;
        let (h, slope) = atan_ratio_and_slope(x_outer, (x_outer - x_fall).max(0.0));
        self.pole.z * t * per_k * (k_rise * h / k_outer + slope * x_fall)
    }

    /// Derivative of [`Sector::area_to`], the area of the strip there; and half of its own over it.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn strip(&self, part: &Part) -> (f32, f32) {
        let Part { t, outer2, rise, height_sum, square, .. } = *part;
        // Half the derivatives of the squares.
        let outer_slope = (t + t - 1.0) * (1.0 - self.cos);
        if self.to_zenith {
            let per = 1.0 / outer2;
            return (0.5 * self.pole.z * per, -outer_slope * per);
        }
        let height_slope = self.last.height_sum() - self.first.height_sum();
        let slope = 0.5 * ((self.last.rise - self.first.rise) * height_sum + rise * height_slope);
        let inner2 = outer2 + square;
        let both = outer2 * inner2;
        let growth = slope * both - square * (outer_slope * (outer2 + inner2) + slope * outer2);
        (0.5 * self.pole.z * square / both, growth / (square * both))
    }

    /// The fraction of the chords up to which the projected solid angle is `area` (sr).
    ///
    /// * `whole` – that of the whole (sr)
    ///
    /// Halley's method on [`Sector::area_to`] within a shrinking bracket.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn fraction_at(&self, area: f32, whole: f32) -> f32 {
        let mut t = self.first_guess(area / whole, whole);
        let (mut low, mut high) = (0.0, 1.0);
        let smaller = area.min(whole - area);
        let enough = TOLERANCE * whole * smaller * smaller;
        for _ in 0..MAX_STEPS {
            if !(t >= low && t <= high) {
                t = 0.5 * (low + high);
            }
            let part = self.part(t);
            let error = self.area_of(&part) - area;
            if error > 0.0 {
                high = t;
            } else {
                low = t;
            }
            let (strip, growth) = self.strip(&part);
            let step = error / strip;
            let next = t - step / (1.0 - step * growth);
            if error.abs() * error * error <= enough {
                return if next >= low && next <= high { next } else { t };
            }
            t = next;
        }
        if t >= low && t <= high { t } else { low }
    }

    /// Where the share `s` of the area ends, by the quotient of two quadratics that has the area's
    /// values and derivatives at both ends.
    ///
    /// Source: Gregory and Delbourgo 1982, *Piecewise Rational Quadratic Interpolation to Monotonic
    /// Data*, IMA J. Numer. Anal. 2(2). Derived: its inverse.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn first_guess(&self, s: f32, whole: f32) -> f32 {
        let r = 1.0 - s;
        let per_whole = 0.5 * self.pole.z / whole;
        // As in `strip`, where the outer end is a unit vector.
        let strip = |end: &Meridian| {
            let square = end.square_rise();
            if self.to_zenith { per_whole } else { per_whole * square / (1.0 + square) }
        };
        let (d0, d1) = (strip(&self.first), strip(&self.last));
        let b = d0 * r + (2.0 - d1) * s;
        let root = num::sqrt((b - 2.0 * s) * (b - 2.0 * s) + 4.0 * s * r);
        if b > 0.0 { 2.0 * s / (b + root) } else { 0.5 * (root - b) / (1.0 - b) }
    }
}

/// What is known of a piece up to a fraction of its chords.
#[derive(Debug, Clone, Copy)]
struct Part {
    /// The fraction.
    t: f32,
    /// Scalar product of the outer ends, and square of their cross product.
    cos: f32,
    sin2: f32,
    /// Square of the second outer end.
    outer2: f32,
    /// The second meridian's rise, the sum of its heights, and the product of these.
    rise: f32,
    height_sum: f32,
    square: f32,
}

/// The cosine of the outer arc from which a piece is wide: just beyond a right angle, as those of a
/// square are about its middle.
pub(super) const WIDE: f32 = -0.1;

/// Steps of Halley's method at most; one or two are common.
const MAX_STEPS: usize = 16;

/// The cube of an error in the share, over the square of the smaller of the shares on both sides, from
/// which one more step left 1e-6 of the whole at most, for squares, triangles and hexagons 0.1 to 3 sizes away.
const TOLERANCE: f32 = 1e-5;
