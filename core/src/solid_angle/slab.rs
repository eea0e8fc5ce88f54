//! Directions about an axis through the receiver: a plane's angle `α` around the axis, and the sine
//! `h` of the elevation out of the plane across it. Solid angle is `dα dh`.
//!
//! A light that is bounded by two curves `h₀(α)` and `h₁(α)` is sampled uniformly in `h`. How `α` is
//! distributed is the choice of a small table; the density is exact whatever the table holds.

use crate::num;

/// Intervals of a sweep's table. Relative variance of the solid angle with 8: 4e-4 for a distant
/// disk, 3e-4 for one that is touched.
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
/// linear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sweep {
    middle: f32,
    half: f32,
    /// Density over `τ` at the ends of the intervals.
    density: [f32; INTERVALS + 1],
}

impl Sweep {
    /// What is there before anything is tabulated.
    pub(crate) const EMPTY: Self = Self { middle: 0.0, half: 0.0, density: [0.0; INTERVALS + 1] };

    /// Tabulates what is seen between two angles (rad); `None` when that is nothing.
    ///
    /// * `extent` – the light's extent in `h` at an angle
    pub(crate) fn new(low: f32, high: f32, extent: impl Fn(f32) -> f32) -> Option<Self> {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        // Nothing at both ends, where dx / dτ is 0.
        let mut density = [0.0; INTERVALS + 1];
        let mut sum = 0.0;
        for (i, d) in density.iter_mut().enumerate().take(INTERVALS).skip(1) {
            let tau = STEP * i as f32 - 1.0;
            let x = 2.0 * tau / (1.0 + tau * tau);
            *d = extent(middle + half * x) * slope(tau);
            sum += *d;
        }
        let scale = 1.0 / (sum * STEP);
        if !(half > 0.0 && scale > 0.0 && scale < f32::INFINITY) {
            return None;
        }
        Some(Self { middle, half, density: density.map(|d| d * scale) })
    }

    /// Draws an angle (rad).
    #[inline]
    pub(crate) fn sample(&self, u: f32) -> f32 {
        let mut left = u / STEP;
        let mut i = 0;
        while i < INTERVALS - 1 {
            let mass = 0.5 * (self.density[i] + self.density[i + 1]);
            if left < mass {
                break;
            }
            left -= mass;
            i += 1;
        }
        let (a, b) = (self.density[i], self.density[i + 1]);
        // Root of a t + (b − a) t² / 2 = left, in the form that does not cancel.
        let root = a + num::sqrt(a * a + 2.0 * (b - a) * left);
        let t = if root > 0.0 { (2.0 * left / root).min(1.0) } else { 0.0 };
        let tau = STEP * (i as f32 + t) - 1.0;
        self.middle + self.half * (2.0 * tau / (1.0 + tau * tau))
    }

    /// Where an angle is in the table: the interval, the fraction of it, and `dα / dτ`.
    #[inline]
    fn find(&self, angle: f32) -> (usize, f32, f32) {
        let x = ((angle - self.middle) / self.half).clamp(-1.0, 1.0);
        let tau = x / (1.0 + num::sqrt((1.0 - x) * (1.0 + x)));
        let place = (1.0 + tau) / STEP;
        let i = (place as usize).min(INTERVALS - 1);
        (i, place - i as f32, self.half * slope(tau))
    }

    /// Density of an angle (rad⁻¹).
    #[inline]
    pub(crate) fn pdf(&self, angle: f32) -> f32 {
        let (i, t, slope) = self.find(angle);
        let (a, b) = (self.density[i], self.density[i + 1]);
        (a + (b - a) * t) / slope
    }

    /// Inverse of [`Sweep::sample`].
    pub(crate) fn share(&self, angle: f32) -> f32 {
        let (i, t, _) = self.find(angle);
        let before: f32 = (0..i).map(|j| 0.5 * (self.density[j] + self.density[j + 1])).sum();
        let (a, b) = (self.density[i], self.density[i + 1]);
        STEP * (before + t * (a + 0.5 * (b - a) * t))
    }
}

/// Width of an interval in `τ`.
const STEP: f32 = 2.0 / INTERVALS as f32;

/// `dx / dτ` of `x = 2 τ / (1 + τ²)`.
#[inline]
fn slope(tau: f32) -> f32 {
    let sum = 1.0 + tau * tau;
    2.0 * (1.0 - tau) * (1.0 + tau) / (sum * sum)
}
