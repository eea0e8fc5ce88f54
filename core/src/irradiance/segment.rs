//! Irradiance from the part of an ellipse above the horizon.

use super::disk::Ellipse;
use crate::num;
use core::f64::consts::PI;

/// The part of an ellipse above a horizon that cuts it, in strips along the shorter axis.
///
/// A strip is named by the turn t in `[0, π]` of its upper end on the ellipse's edge: it is at
/// `a cos t` along the longer axis. Axes point upward.
#[derive(Debug, Clone, Copy)]
pub(super) struct Segment {
    /// The longer and the shorter semi-axis, and how high the plane is (m).
    a: f64,
    b: f64,
    h: f64,
    /// From the receiver's foot to the centre (m).
    x: f64,
    y: f64,
    /// Height of the centre above the horizon, and of the ends of both semi-axes above the centre (m).
    up: f64,
    rise: [f64; 2],
}

/// Part of a line of the ellipse: ends and their heights above the horizon, the lower one first.
#[derive(Debug, Clone, Copy)]
struct Strip {
    /// Offset from the foot across the line, and squared distance of the receiver from the line.
    x: f64,
    line2: f64,
    /// Offset from the foot along the line.
    y: [f64; 2],
    /// Squared distance from the receiver (m²).
    far2: [f64; 2],
    /// Height above the horizon (m).
    height: [f64; 2],
}

/// Nodes and weights of the six-point Gauss–Legendre rule on [−1, 1], for either sign.
///
/// Source: Abramowitz and Stegun 1964, table 25.4.
const GAUSS: [(f64, f64); 3] = [
    (0.238_619_186_083_197, 0.467_913_934_572_691),
    (0.661_209_386_466_265, 0.360_761_573_048_139),
    (0.932_469_514_203_152, 0.171_324_492_379_170),
];

/// How near the plane is taken to be at the nearest, in longer semi-axes: no closer do doubles say
/// where along the ellipse the receiver is.
const NEAREST: f64 = 1e-13;

/// How short a piece is against its distance, squared: the rule's error then is some 1e-7.
const SHORT: f64 = 0.4;

/// The largest piece of a turn for one rule (rad).
const WIDEST: f64 = 1.0;

/// The smallest, as a share of the whole.
const NARROWEST: f64 = 1e-15;

/// Pieces in a row: each doubles or halves its distance from where the receiver is nearest.
const MOST: usize = 400;

impl Segment {
    pub(super) fn new(whole: &Ellipse) -> Self {
        let Ellipse { a, b, centre, normal, up } = *whole;
        let (x, y) = (centre.x * 1.0_f64.copysign(normal.x), centre.y * 1.0_f64.copysign(normal.y));
        let is_inside = x * x / (a * a) + y * y / (b * b) < 1.0;
        let h = if is_inside { centre.z.max(NEAREST * a) } else { centre.z };
        Self { a, b, h, x, y, up, rise: [a * normal.x.abs(), b * normal.y.abs()] }
    }

    /// Irradiance (sr).
    ///
    /// Derived: the edge is above the horizon from the turn `t₀ − Δ` to `t₀ + Δ`. Strips between these reach
    /// from the horizon up to the edge; where the horizon leaves through the lower half of the edge, those
    /// beyond are whole chords.
    pub(super) fn irradiance(&self) -> f64 {
        let [p, q] = self.rise;
        let most = num::sqrt_in_double(p * p + q * q);
        let middle = num::atan2_in_double(q, p);
        let half = num::atan2_in_double(num::sqrt_in_double((most - self.up) * (most + self.up)), -self.up);
        let (low, high) = (middle - half, middle + half);
        let (start, end) = (low.abs(), high.min(2.0 * PI - high));
        let mut sum = self.integral(start, end, true);
        if low < 0.0 {
            sum += self.integral(0.0, start, false);
        }
        if high > PI {
            sum += self.integral(end, PI, false);
        }
        self.a * self.h * sum
    }

    /// The strip whose upper end is at the turn `t`.
    fn strip(&self, t: f64, is_cut: bool) -> Strip {
        let (sin, cos) = num::sin_cos_in_double(t);
        let [p, q] = self.rise;
        let (across, x) = (self.b * sin, self.x + self.a * cos);
        let top = (self.up + p * cos + q * sin).max(0.0);
        let whole = 2.0 * across;
        let (length, bottom) = if is_cut {
            (if top < 2.0 * q * sin { self.b * (top / q) } else { whole }, 0.0)
        } else {
            (whole, (top - 2.0 * q * sin).max(0.0))
        };
        let y = [self.y + across - length, self.y + across];
        let line2 = x * x + self.h * self.h;
        Strip { x, line2, y, far2: y.map(|y| line2 + y * y), height: [bottom, top] }
    }

    /// `∫ sin t f dt` over the strips, by pieces that are short against their distance.
    fn integral(&self, from: f64, to: f64, is_cut: bool) -> f64 {
        let strip = |t: f64| self.strip(t, is_cut);
        let (mut sum, mut t, mut step) = (0.0, from, (to - from).min(WIDEST));
        let mut here = strip(t);
        for _ in 0..MOST {
            if !(step > 0.0) {
                break;
            }
            let mut next = strip(t + step);
            while !here.is_near(&next) && step > NARROWEST * (to - from) {
                step *= 0.5;
                next = strip(t + step);
            }
            let half = 0.5 * step;
            let at = |x: f64| {
                let t = t + half * (1.0 + x);
                strip(t).density() * num::sin_cos_in_double(t).0
            };
            sum += half * GAUSS.iter().map(|(x, w)| w * (at(-x) + at(*x))).sum::<f64>();
            t += step;
            here = next;
            step = (2.0 * step).min(to - t).min(WIDEST);
        }
        sum
    }
}

impl Strip {
    /// Whether the way from one to the other is short against the distance of the ends, and of the lines
    /// where these pass by the receiver's foot.
    fn is_near(&self, other: &Self) -> bool {
        let across = (self.x - other.x) * (self.x - other.x);
        let is_over = |strip: &Self| strip.y[0] < 0.0 && strip.y[1] > 0.0;
        let ends = (0..2).all(|i| {
            let along = self.y[i] - other.y[i];
            across + along * along <= SHORT * self.far2[i].min(other.far2[i])
        });
        ends && (across <= SHORT * self.line2.min(other.line2) || !(is_over(self) || is_over(other)))
    }

    /// Height above the horizon, integrated along the strip over the fourth power of the distance (m⁻²).
    ///
    /// Derived: the height is linear. With d₀, d₁ and g₀, g₁ the ends' distances and heights, L the length,
    /// δ the angle between the ends, `k = L / (d₀ d₁)` and `f = (δ − sin δ cos δ) / sin³ δ`, the integral is
    /// `L (g₁ (1 − y₀ f k) + g₀ (1 + y₁ f k)) / (2 d₀² d₁²)`. It does not cancel by more than a third.
    fn density(&self) -> f64 {
        let ([y0, y1], [g0, g1]) = (self.y, self.height);
        let (length, far2) = (y1 - y0, self.far2[0] * self.far2[1]);
        let far = num::sqrt_in_double(far2);
        let k = length / far;
        let (sin, cos) = (num::sqrt_in_double(self.line2) * k, (self.line2 + y0 * y1) / far);
        let s2 = sin * sin;
        let f = if cos > 0.0 && s2 < 1e-3 {
            2.0 / 3.0 + s2 * (0.2 + s2 * (3.0 / 28.0))
        } else {
            (num::atan2_in_double(sin, cos) - sin * cos) / (s2 * sin)
        };
        0.5 * length / far2 * (g1 * (1.0 - y0 * f * k) + g0 * (1.0 + y1 * f * k))
    }
}
