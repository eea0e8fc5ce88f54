//! Uniform directions toward a rectangle.

use crate::num::{self, TAU};

/// Least height over the plane, in units of the farthest coordinate: there the square still has all
/// its digits. `f32` coordinates place no receiver this near.
const LEAST_HEIGHT: f32 = 1e-12;

/// A place on a rectangle.
///
/// Both coordinates say the same, but far from the foot only the fraction has digits to tell two
/// places apart, and near it only the offset has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RectanglePlace {
    /// From the foot of the receiver's perpendicular on the rectangle's plane, along its axes, in
    /// units of [`SphericalRectangle::reach`].
    pub offset: [f32; 2],
    /// From the low corner, in units of the sides, each in `[0, 1]`.
    pub fraction: [f32; 2],
}

/// The directions in which a rectangle is seen.
///
/// A place is drawn column by column: `u[0]` is the share of the solid angle below the column, `u[1]`
/// the share of the column. With `z` the height of the receiver, the solid angle over
/// `[0, x] × [y₀, y₁]` is the angle `a(x)` of the complex number
///
/// ```text
/// (z² r₀ r₁ + x² y₀ y₁) + i x z (y₁ r₀ − y₀ r₁),      rₖ² = x² + yₖ² + z².
/// ```
///
/// Sums of angles are products of such numbers, and their modulus `(x² + z²) ρ₀ ρ₁` with
/// `ρₖ² = yₖ² + z²` needs no root of its own. Where a coordinate keeps its sign, differences are
/// expanded until nothing cancels, so that the share of the solid angle is right within some 1e-6 at
/// every distance, angle and aspect, and a place far away is right in units of the rectangle.
///
/// Source: Ureña, Fajardo, King 2013, *An Area-Preserving Parametrization for Spherical Rectangles*,
/// CGF 32(4), sections 3 and 4. Differs: complex numbers instead of four arc cosines; with
/// `κ = z² / (ρ₀ ρ₁)`, `Δ = (y₁ r₀ − y₀ r₁) / (x² + z²)` and `τ = Δ² / (1 + √(1 + Δ²))` it is
/// `x = z sin a / (κ Δ)` and `cos a = const + κ τ`, which replaces their division by a sine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphericalRectangle {
    solid_angle: f32,
    reach: f32,
    /// True when the first axis here is the rectangle's second.
    swapped: bool,
    x: Axis,
    y: Axis,
    strip: Strip,
    /// The columns at both ends; the angle of the low one is negative when the foot is between.
    low: Column,
    high: Column,
    /// Cosine and sine of half the solid angle.
    half: [f32; 2],
}

/// One side, turned so that the farther end is the high one.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Axis {
    low: f32,
    size: f32,
    turned: bool,
}

impl Axis {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn new(low: f32, size: f32) -> Self {
        let turned = low + 0.5 * size < 0.0;
        Self { low: if turned { -(low + size) } else { low }, size, turned }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn scaled(&self, scale: f32) -> Self {
        Self { low: self.low * scale, size: self.size * scale, ..*self }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn high(&self) -> f32 {
        self.low + self.size
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn spans_foot(&self) -> bool {
        self.low < 0.0
    }

    /// From here to the rectangle's own offset and fraction, or back.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn turn(&self, [offset, fraction]: [f32; 2]) -> [f32; 2] {
        if self.turned { [-offset, 1.0 - fraction] } else { [offset, fraction] }
    }
}

/// What all columns share: the two long edges and the height.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Strip {
    y0: f32,
    y1: f32,
    size: f32,
    z: f32,
    /// `1 / (ρ₀ ρ₁)`.
    inverse_rho: f32,
    kappa: f32,
}

/// The column at one `x`.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Column {
    /// Distances to its two ends.
    r: [f32; 2],
    /// The angle `a`.
    cos: f32,
    sin: f32,
    delta: f32,
}

/// `τ` of `Δ`.
#[cfg_attr(not(feature = "small"), inline(always))]
fn tau(delta: f32) -> f32 {
    let square = delta * delta;
    square / (1.0 + num::sqrt(1.0 + square))
}

impl Strip {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn new(y: &Axis, z: f32) -> Self {
        let (y0, y1) = (y.low, y.high());
        let zz = z * z;
        let inverse_rho = 1.0 / (num::sqrt(y0 * y0 + zz) * num::sqrt(y1 * y1 + zz));
        Self { y0, y1, size: y.size, z, inverse_rho, kappa: zz * inverse_rho }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn column(&self, x: f32) -> Column {
        let Self { y0, y1, z, .. } = *self;
        let d2 = x * x + z * z;
        let r = [num::sqrt(d2 + y0 * y0), num::sqrt(d2 + y1 * y1)];
        let delta = if y0 < 0.0 {
            (y1 * r[0] - y0 * r[1]) / d2
        } else {
            self.size * (y1 + y0) / (y1 * r[0] + y0 * r[1])
        };
        Column {
            r,
            cos: (z * z * r[0] * r[1] + x * x * y0 * y1) * self.inverse_rho / d2,
            sin: x * z * delta * self.inverse_rho,
            delta,
        }
    }

    /// The column with the sine of its angle and `Δ²`.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn x_of(&self, sin: f32, delta2: f32) -> f32 {
        self.z * sin / (self.kappa * num::sqrt(delta2))
    }

    /// Where `v` of the column's solid angle is below, in `[y₀, y₁]`, and how far from `y₀`.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn along(&self, x: f32, v: f32) -> [f32; 2] {
        let Self { y0, y1, size, z, .. } = *self;
        let dd = x * x + z * z;
        let d = num::sqrt(dd);
        let (e0, e1) = (num::sqrt(dd + y0 * y0), num::sqrt(dd + y1 * y1));
        let (h0, h1) = (y0 / e0, y1 / e1);
        // What is left to the sine 1 at the end that is approached.
        let rest_high = dd / (e1 * (e1 + y1));
        if y0 < 0.0 {
            let range = h1 - h0;
            let h = h0 + v * range;
            let rest =
                if h < 0.0 { dd / (e0 * (e0 - y0)) + v * range } else { rest_high + (1.0 - v) * range };
            let y = num::clamp(d * h / num::sqrt(rest * (2.0 - rest)), y0, y1);
            return [y, num::clamp(y - y0, 0.0, size)];
        }
        let range = dd * size * (y1 + y0) / (e0 * e1 * (y1 * e0 + y0 * e1));
        let h = h0 + v * range;
        let rest = rest_high + (1.0 - v) * range;
        let k = rest * (2.0 - rest);
        let sum = num::larger(d * h / num::sqrt(k) + y0, f32::MIN_POSITIVE);
        let step = num::clamp(e0 * e0 * v * range * (h + h0) / (k * sum), 0.0, size);
        [y0 + step, step]
    }

    /// Inverse of [`Strip::along`].
    fn share(&self, x: f32, [y, step]: [f32; 2]) -> f32 {
        let Self { y0, y1, size, z, .. } = *self;
        let dd = x * x + z * z;
        let [e0, e, e1] = [y0, y, y1].map(|y| num::sqrt(dd + y * y));
        if y0 < 0.0 {
            return (y / e - y0 / e0) / (y1 / e1 - y0 / e0);
        }
        let part = step * (y + y0) / (e * (y * e0 + y0 * e)).max(f32::MIN_POSITIVE);
        part / (size * (y1 + y0) / (e1 * (y1 * e0 + y0 * e1)))
    }
}

impl SphericalRectangle {
    /// The rectangle from `corner` to `corner + size`, seen from `height` above the origin of its
    /// plane; all in one unit of length. The size counts for itself: far away the sum has lost it.
    ///
    /// `None` when the size or the height is not above 0, or something is not finite.
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[must_use]
    pub fn new(corner: [f32; 2], size: [f32; 2], height: f32) -> Option<Self> {
        let (first, second) = (Axis::new(corner[0], size[0]), Axis::new(corner[1], size[1]));
        let reach = num::larger(num::larger(first.high(), second.high()), height);
        if !(size[0] > 0.0 && size[1] > 0.0 && height > 0.0 && reach < f32::INFINITY) {
            return None;
        }
        let scale = 1.0 / reach;
        let z = num::larger(height * scale, LEAST_HEIGHT);
        let (first, second) = (first.scaled(scale), second.scaled(scale));
        // Columns run along the axis whose ends are on both sides of the foot, if only one is.
        let swapped = second.spans_foot() && !first.spans_foot();
        let (x, y) = if swapped { (second, first) } else { (first, second) };
        let strip = Strip::new(&y, z);
        let (low, high) = (strip.column(x.low), strip.column(x.high()));
        let (solid_angle, half) =
            if x.spans_foot() { both_sides(&low, &high) } else { one_corner(&x, &strip, &low, &high) };
        if !(solid_angle >= f32::MIN_POSITIVE) {
            return None;
        }
        Some(Self { solid_angle, reach, swapped, x, y, strip, low, high, half })
    }

    /// The solid angle (sr), in `(0, 2π]`.
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[must_use]
    pub fn solid_angle(&self) -> f32 {
        self.solid_angle
    }

    /// The unit of offsets: the farthest coordinate, or the height.
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[must_use]
    pub fn reach(&self) -> f32 {
        self.reach
    }

    /// The height in units of the reach.
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[must_use]
    pub fn height(&self) -> f32 {
        self.strip.z
    }

    /// Whether `u[0]` decides about the second axis, and which axes are counted from their high end.
    #[cfg(test)]
    pub(super) fn layout(&self) -> (bool, [bool; 2]) {
        let turned = [self.x.turned, self.y.turned];
        (self.swapped, if self.swapped { [turned[1], turned[0]] } else { turned })
    }

    /// Draws a place with the density `1 / solid_angle` (sr⁻¹) in its direction.
    ///
    /// * `u` – two independent uniforms, each in `[0, 1)`
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> RectanglePlace {
        let x = self.column_of(u[0]);
        let y = self.strip.along(x[0], u[1]);
        let [x, y] = [self.x.turn([x[0], x[1] / self.x.size]), self.y.turn([y[0], y[1] / self.y.size])];
        let [[x, s], [y, t]] = if self.swapped { [y, x] } else { [x, y] };
        RectanglePlace { offset: [x, y], fraction: [s, t] }
    }

    /// Inverse of [`SphericalRectangle::sample`]; each in `[0, 1)`.
    #[must_use]
    pub fn invert(&self, at: &RectanglePlace) -> [f32; 2] {
        let own = [0, 1].map(|i| [at.offset[i], at.fraction[i]]);
        let [x, y] = if self.swapped { [own[1], own[0]] } else { own };
        let [x, y] = [self.x.turn(x), self.y.turn(y)];
        let share = if self.x.spans_foot() {
            let (column, low) = (self.strip.column(x[0]), &self.low);
            let sin = column.sin * low.cos - column.cos * low.sin;
            let angle = num::atan2(sin, column.cos * low.cos + column.sin * low.sin);
            // Backward is round-off near the low end, or more than half a turn.
            if angle >= 0.0 || x[0] < 0.0 { angle } else { angle + TAU }
        } else {
            let part = Axis { size: x[1] * self.x.size, ..self.x };
            one_corner(&part, &self.strip, &self.low, &self.strip.column(part.high())).0
        };
        let u = [share / self.solid_angle, self.strip.share(x[0], [y[0], y[1] * self.y.size])];
        u.map(num::clamp_unit)
    }

    /// The column below which is the share `u` of the solid angle, and how far from the low one.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn column_of(&self, u: f32) -> [f32; 2] {
        let (sin, cos) = num::sin_cos_near(0.5 * u * self.solid_angle);
        // Half of what is above the column.
        let [cos_half, sin_half] = self.half;
        let rest = [cos_half * cos + sin_half * sin, sin_half * cos - cos_half * sin];
        // The angle halfway from the low column.
        let low = &self.low;
        let middle = [low.cos * cos - low.sin * sin, low.sin * cos + low.cos * sin];
        let angle = middle[1] * cos + middle[0] * sin;
        // What the cosine of the angle lost from the low column on.
        let fall = 2.0 * sin * middle[1];
        if self.x.spans_foot() {
            self.column_across(angle, fall, rest)
        } else {
            // What it will lose up to the high one.
            let rise = 2.0 * rest[1] * (middle[1] * cos_half + middle[0] * sin_half);
            self.column_beside(angle, fall, rise)
        }
    }

    /// With the foot between both ends.
    ///
    /// * `sin` – of the column's angle
    /// * `rest` – cosine and sine of half the angle up to the high column
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn column_across(&self, sin: f32, fall: f32, [cos_r, sin_r]: [f32; 2]) -> [f32; 2] {
        let Self { x: Axis { low, size, .. }, strip, low: low_column, high: high_column, .. } = self;
        // From the end on the same side.
        let (end, gain) = if sin < 0.0 {
            (low_column.delta, -fall)
        } else {
            (high_column.delta, 2.0 * sin_r * (high_column.sin * cos_r - high_column.cos * sin_r))
        };
        let tau = tau(end) + num::larger(gain, 0.0) / strip.kappa;
        // NaN, where τ is 0, becomes an end.
        let x = num::clamp(strip.x_of(sin, tau * (tau + 2.0)), *low, self.x.high());
        [x, num::clamp(x - low, 0.0, *size)]
    }

    /// With the foot beside both ends: the step from the low one, of terms that are all positive.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn column_beside(&self, sin: f32, fall: f32, rise: f32) -> [f32; 2] {
        let Self { x: Axis { low, size, .. }, strip, low: low_column, high: high_column, .. } = self;
        let (tau, tau_low) =
            (tau(high_column.delta) + num::larger(rise, 0.0) / strip.kappa, tau(low_column.delta));
        let delta2 = tau * (tau + 2.0);
        let sum = num::larger(strip.x_of(sin, delta2) + low, f32::MIN_POSITIVE);
        let across =
            strip.size * strip.size * (2.0 + tau + tau_low) - 2.0 * strip.y0 * strip.y1 * tau * tau_low;
        let step = fall / strip.kappa / delta2 * across / (low_column.delta * low_column.delta) / sum;
        let step = num::clamp(step, 0.0, *size);
        [low + step, step]
    }
}

/// Solid angle (sr) from a low to a high column on two sides of the foot, and half of it.
#[cfg_attr(not(feature = "small"), inline(always))]
fn both_sides(low: &Column, high: &Column) -> (f32, [f32; 2]) {
    let cos = low.cos * high.cos + low.sin * high.sin;
    let sin = high.sin * low.cos - low.sin * high.cos;
    let angle = num::atan2(sin, cos);
    // The root that does not cancel, then the other.
    let root = num::sqrt(0.5 + 0.5 * cos.abs());
    let other = 0.5 * sin / root;
    let half = if cos < 0.0 { [other, root] } else { [root.copysign(other), other.abs()] };
    (if angle < 0.0 { angle + TAU } else { angle }, half)
}

/// Solid angle (sr) between two columns on one side of the foot that do not span it either, and
/// half of it: the angles of two triangles with one determinant, all of whose terms are positive.
///
/// Source: Van Oosterom, Strackee 1983, *The Solid Angle of a Plane Triangle*, IEEE Trans. Biomed.
/// Eng. 30(2), equation 8.
#[cfg_attr(not(feature = "small"), inline(always))]
fn one_corner(x: &Axis, strip: &Strip, low: &Column, high: &Column) -> (f32, [f32; 2]) {
    let Strip { y0, y1, z, .. } = *strip;
    let (x0, x1) = (x.low, x.high());
    let ([p, t], [q, r]) = (low.r, high.r);
    let (xx, yy, zz) = (x0 * x1, y0 * y1, z * z);
    let pr = xx + yy + zz;
    let near = r * (p * q + xx + y0 * y0 + zz) + p * (yy + x1 * x1 + zz) + q * pr;
    let far = t * (p * r + pr) + p * (xx + y1 * y1 + zz) + r * (yy + x0 * x0 + zz);
    let det = z * x.size * strip.size;
    let (cos, sin) = (near * far - det * det, det * (near + far));
    let inverse = 1.0 / num::sqrt(cos * cos + sin * sin);
    (2.0 * num::atan2(sin, cos), [cos * inverse, sin * inverse])
}
