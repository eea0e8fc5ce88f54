//! Directions about an axis through the receiver: a plane's angle `α` around the axis, and the sine
//! `h` of the elevation out of the plane across it. Solid angle is `dα dh`.
//!
//! A light that is bounded by two curves `h₀(α)` and `h₁(α)` is sampled uniformly in `h`. How `α` is
//! distributed is the choice of a small table; the density is exact whatever the table holds.

use crate::num;

/// Intervals of a sweep's table. With 8, the relative variance of the solid angle is 3e-3 for a
/// distant disk, 9e-4 for one that is almost touched, 5e-4 for a tube alongside, 2e-2 for an ellipse
/// of 1 : 10 and a receiver below it.
const INTERVALS: usize = 8;

/// A part of a line, parallel to the axis, as seen from the receiver: one value of `α`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Span {
    /// Where it begins along the axis, from the receiver's foot (m).
    pub(crate) start: f32,
    /// Its length (m).
    pub(crate) length: f32,
    /// Distance of the line from the receiver (m), above 0.
    pub(crate) away: f32,
}

impl Span {
    /// The same seen from the other side, when it lies at negative coordinates: so that of a span on
    /// one side of the foot, the near end comes first.
    #[inline]
    fn turned(&self) -> (Self, bool) {
        let end = self.start + self.length;
        let turn = end < 0.0;
        (if turn { Self { start: -end, ..*self } } else { *self }, turn)
    }

    /// `h₁ − h₀` of the first `part` (m) of a span.
    ///
    /// Derived: with `cᵢ` the cosines of the elevations,
    /// `sin ε₁ − sin ε₀ = sin(ε₁ − ε₀) (c₀ + c₁) / (1 + cos(ε₁ − ε₀))`; nothing cancels on one side
    /// of the foot.
    #[inline]
    fn sines(&self, part: f32) -> f32 {
        let (x0, x1, t) = (self.start, self.start + part, self.away);
        let (r0, r1) = (num::sqrt(x0 * x0 + t * t), num::sqrt(x1 * x1 + t * t));
        if x0 < 0.0 {
            return x1 / r1 - x0 / r0;
        }
        (t / r0) * (t / r1) * part * ((r0 + r1) / (r0 * r1 + t * t + x0 * x1))
    }

    /// Extent in `h`.
    #[inline]
    pub(crate) fn extent(&self) -> f32 {
        let (span, _) = self.turned();
        span.sines(span.length)
    }

    /// The point with the share `u` of the extent before it: its offset from the foot (m), and the
    /// fraction of the span before it.
    #[inline]
    pub(crate) fn at(&self, u: f32) -> (f32, f32) {
        let (span, turn) = self.turned();
        let delta = span.sines(span.length) * if turn { 1.0 - u } else { u };
        let (x0, t) = (span.start, span.away);
        let r0 = num::sqrt(x0 * x0 + t * t);
        let (c0, h) = (t / r0, x0 / r0 + delta);
        let c = num::sqrt((1.0 - h) * (1.0 + h)).max(f32::MIN_POSITIVE);
        let before = if x0 < 0.0 {
            // The foot is within: no digit is lost from it.
            t * (h / c) - x0
        } else {
            // x − x₀ = t sin(ε − ε₀) / (c₀ c)
            t * (delta / c) * ((1.0 + c * c0 + h * (x0 / r0)) / ((c + c0) * c0))
        };
        let before = before.clamp(0.0, span.length);
        let (x, fraction) = (x0 + before, before / span.length);
        // Where the foot is within, close to it.
        let x = if x0 < 0.0 { (t * (h / c)).clamp(x0, x0 + span.length) } else { x };
        if turn { (-x, 1.0 - fraction) } else { (x, fraction) }
    }

    /// Inverse of [`Span::at`]: the share of the extent before a fraction of the span.
    pub(crate) fn share(&self, fraction: f32) -> f32 {
        let (span, turn) = self.turned();
        let part = span.length * if turn { 1.0 - fraction } else { fraction };
        let share = span.sines(part) / span.sines(span.length);
        if turn { 1.0 - share } else { share }
    }
}

/// A density over the angles of a sweep, `[middle − half, middle + half]`.
///
/// The angle is `middle + half x`, `x = 2 τ / (1 + τ²)` with `τ` in `[−1, 1]`: the substitution
/// `x = sin`, without a sine. It takes the roots off both ends. Over `τ` the density is piecewise
/// linear, but for the first and the last interval: there it falls to 0 as a sum of a line and a
/// parabola, the one for a light whose extent ends abruptly, the other for one with a round edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sweep {
    middle: f32,
    half: f32,
    /// Density over an interval at its ends, as a share of the whole.
    density: [f32; INTERVALS + 1],
    /// The share of the first and of the last interval that is parabolic.
    round: [f32; 2],
}

impl Sweep {
    /// What is there before anything is tabulated.
    pub(crate) const EMPTY: Self =
        Self { middle: 0.0, half: 0.0, density: [0.0; INTERVALS + 1], round: [0.0; 2] };

    /// Tabulates what is seen between two angles (rad); `None` when that is nothing.
    ///
    /// * `extent` – the light's extent in `h` at an angle
    pub(crate) fn new(low: f32, high: f32, extent: impl Fn(f32) -> f32) -> Option<Self> {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        let seen = |place: f32| {
            let tau = STEP * place - 1.0;
            extent(middle + half * (2.0 * tau / (1.0 + tau * tau))) * slope(tau)
        };
        let mut sweep = Self { middle, half, ..Self::EMPTY };
        for i in 1..INTERVALS {
            sweep.density[i] = seen(i as f32);
        }
        for (end, place) in [(0, 0.5), (1, INTERVALS as f32 - 0.5)] {
            // A line halves halfway to the end, a parabola falls to a quarter.
            let ratio = seen(place) / sweep.density[if end == 0 { 1 } else { INTERVALS - 1 }];
            sweep.round[end] = ((1.0 - 2.0 * ratio) / (ratio + 0.25)).clamp(0.0, 1.0);
        }
        let scale = 1.0 / (0..INTERVALS).map(|i| sweep.mass(i)).sum::<f32>();
        if !(half > 0.0 && scale > 0.0 && scale < f32::INFINITY) {
            return None;
        }
        sweep.density = sweep.density.map(|d| d * scale);
        Some(sweep)
    }

    /// Half of the sweep (rad).
    #[inline]
    pub(crate) fn half(&self) -> f32 {
        self.half
    }

    /// The parabolic share of an interval at an end; `None` elsewhere.
    #[inline]
    fn end(&self, i: usize) -> Option<f32> {
        match i {
            0 => Some(self.round[0]),
            _ if i == INTERVALS - 1 => Some(self.round[1]),
            _ => None,
        }
    }

    /// Share of an interval.
    #[inline]
    fn mass(&self, i: usize) -> f32 {
        let sum = self.density[i] + self.density[i + 1];
        self.end(i).map_or(0.5 * sum, |w| sum / (2.0 + w))
    }

    /// Draws an angle (rad).
    #[inline]
    pub(crate) fn sample(&self, u: f32) -> f32 {
        let (mut left, mut i) = (u, 0);
        while i < INTERVALS - 1 && left >= self.mass(i) {
            left -= self.mass(i);
            i += 1;
        }
        let mass = self.mass(i);
        let t = match self.end(i) {
            Some(w) if i == 0 => from_end((left / mass).min(1.0), w),
            Some(w) => 1.0 - from_end((1.0 - left / mass).max(0.0), w),
            None => {
                // Root of a t + (b − a) t² / 2 = left, in the form that does not cancel.
                let (a, b) = (self.density[i], self.density[i + 1]);
                let root = a + num::sqrt(a * a + 2.0 * (b - a) * left);
                if root > 0.0 { (2.0 * left / root).min(1.0) } else { 0.0 }
            }
        };
        let tau = STEP * (i as f32 + t) - 1.0;
        self.middle + self.half * (2.0 * tau / (1.0 + tau * tau))
    }

    /// Where an angle is in the table: the interval, the fraction of it before and after the angle,
    /// and `dα / dτ`.
    #[inline]
    fn find(&self, from: FromEnd) -> (usize, [f32; 2], f32) {
        let rest = (from.angle / self.half).clamp(0.0, 2.0);
        let (below, rest) = if rest > 1.0 { (!from.low, 2.0 - rest) } else { (from.low, rest) };
        // 1 − |τ| of 1 − |x|: with its digits at both ends.
        let cos = num::sqrt(rest * (2.0 - rest));
        let rest = (rest + cos) / (1.0 + cos);
        let place = rest / STEP;
        let end = (place as usize).min(INTERVALS / 2 - 1);
        let t = place - end as f32;
        let (i, t) = if below { (end, [t, 1.0 - t]) } else { (INTERVALS - 1 - end, [1.0 - t, t]) };
        (i, t, self.half * slope(1.0 - rest))
    }

    /// Density of an angle (rad⁻¹).
    #[inline]
    pub(crate) fn pdf(&self, angle: FromEnd) -> f32 {
        let (i, [before, after], slope) = self.find(angle);
        let (a, b) = (self.density[i], self.density[i + 1]);
        let density = match self.end(i) {
            Some(w) => {
                let t = if i == 0 { before } else { after };
                self.mass(i) * t * (2.0 * (1.0 - w) + 3.0 * w * t)
            }
            None => a * after + b * before,
        };
        density / (STEP * slope)
    }

    /// Inverse of [`Sweep::sample`].
    pub(crate) fn share(&self, angle: FromEnd) -> f32 {
        let (i, [before, after], _) = self.find(angle);
        let below: f32 = (0..i).map(|j| self.mass(j)).sum();
        let (a, b) = (self.density[i], self.density[i + 1]);
        let part = |t: f32, w: f32| t * t * (1.0 - w + w * t);
        below
            + match self.end(i) {
                Some(w) if i == 0 => self.mass(i) * part(before, w),
                Some(w) => self.mass(i) * (1.0 - part(after, w)),
                None => before * (a + 0.5 * (b - a) * before),
            }
    }
}

/// `t` with `(1 − w) t² + w t³ = u`, in `[0, 1]`: Newton's method from above, where the cubic is
/// convex.
#[inline]
fn from_end(u: f32, w: f32) -> f32 {
    let mut t = 1.0_f32;
    for _ in 0..24 {
        let slope = t * (2.0 * (1.0 - w) + 3.0 * w * t);
        let next = t - (t * t * (1.0 - w + w * t) - u) / slope;
        if !(next < t && next > 0.0) {
            break;
        }
        t = next;
    }
    if u > 0.0 { t } else { 0.0 }
}

/// An angle of a sweep, counted from one of its ends (rad): where the light's edge is round, the
/// density is a quotient of what vanishes there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FromEnd {
    pub(crate) angle: f32,
    /// True when it is counted from the low end.
    pub(crate) low: bool,
}

/// Width of an interval in `τ`.
const STEP: f32 = 2.0 / INTERVALS as f32;

/// `dx / dτ` of `x = 2 τ / (1 + τ²)`.
#[inline]
fn slope(tau: f32) -> f32 {
    let sum = 1.0 + tau * tau;
    2.0 * (1.0 - tau) * (1.0 + tau) / (sum * sum)
}
