//! Directions about an axis through the receiver: a plane's angle `α` around the axis, and the sine
//! `h` of the elevation out of the plane across it. Solid angle is `dα dh`.
//!
//! A light that is bounded by two curves `h₀(α)` and `h₁(α)` is sampled uniformly in `h`. How `α` is
//! distributed is the choice of a small table; the density is exact whatever the table holds.

use crate::num;
use crate::num::lanes::{Lane, Number};
use glam::Vec4;

/// Intervals of a sweep's table: as many as four lanes fill on either side.
///
/// The relative variance of the solid angle is 3e-4 for a disk five radii away, up to 1e-2 for one that
/// is near and 2e-2 for one that is touched at the rim; 0.1 for an ellipse of aspect 10 that is all but
/// touched; 5e-5 for a tube alongside; 0.3 for a tube that is seen along its wall, from a fiftieth of its
/// radius off it and half a radius before it. Two intervals more would halve the small ones.
const INTERVALS: usize = 6;

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

    /// Extents in `h` of several spans, by their starts, lengths and distances (m).
    #[inline]
    pub(crate) fn extents(x0: Lane, length: Lane, t: Lane) -> Lane {
        let (x1, tt) = (x0 + length, t * t);
        let (r0, r1) = ((x0 * x0 + tt).root(), (x1 * x1 + tt).root());
        let along = x0 * x1;
        let beside = (t / r0) * (t / r1) * length * ((r0 + r1) / (r0 * r1 + tt + along));
        along.if_positive(beside, x1 / r1 - x0 / r0)
    }

    /// The point with the share `u` of the extent before it: its offset from the foot (m), and the
    /// fraction of the span before it.
    ///
    /// Derived: from the sine of an end and `δ = |hᵢ − h|`, the squared cosine is
    /// `c² = cᵢ² + δ |hᵢ + h|`; of the ends it is the one that is farther up, so that nothing cancels
    /// however near the axis the span is.
    #[inline]
    pub(crate) fn at(&self, u: f32) -> (f32, f32) {
        let (span, turn) = self.turned();
        let u = if turn { 1.0 - u } else { u };
        let extent = span.sines(span.length);
        let (before, after) = (extent * u, extent * (1.0 - u));
        let (x0, x1, t) = (span.start, span.start + span.length, span.away);
        let (r0, r1) = (num::sqrt(x0 * x0 + t * t), num::sqrt(x1 * x1 + t * t));
        let (c0, c1, h0, h1) = (t / r0, t / r1, x0 / r0, x1 / r1);
        let h = h0 + before;
        let square = if h < 0.0 { c0 * c0 - before * (h0 + h) } else { c1 * c1 + after * (h1 + h) };
        let c = num::sqrt(square).max(f32::MIN_POSITIVE);
        let (x, part) = if x0 < 0.0 {
            // The foot is within: no digit is lost from it.
            let x = num::clamp(t * (h / c), x0, x1);
            (x, x - x0)
        } else {
            // x − x₀ = t sin(ε − ε₀) / (c₀ c)
            let part = (t * (before / c) * ((1.0 + c * c0 + h * h0) / ((c + c0) * c0))).min(span.length);
            (x0 + part, part)
        };
        let fraction = (part / span.length).min(1.0);
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

/// A density over the turns of a sweep: half-angle tangents or the like, so that no trigonometry is
/// needed.
///
/// It is piecewise linear, but for the first and the last interval: there it is constant, for a
/// light whose extent falls off toward its end, or falls to 0 as a root, for one with a round edge,
/// or blends the two; a light that ends abruptly has a line there too.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sweep {
    /// Half of its width.
    half: f32,
    /// Density over an interval at its ends, as a share of the whole.
    density: [f32; INTERVALS + 1],
    /// Shares of the first and the last interval.
    outer: [f32; 2],
    /// How the density ends.
    ends: [End; 2],
}

impl Sweep {
    /// Where a light is tabulated, counted from an end: halfway through the first interval, and at its
    /// inner nodes up to the middle.
    ///
    /// * `half` – half of the width of the sweep
    #[inline]
    pub(crate) fn turns(half: f32) -> Vec4 {
        Vec4::new(0.5 * STEP, STEP, 2.0 * STEP, 3.0 * STEP) * half
    }

    /// Tabulates what is seen; `None` when that is nothing.
    ///
    /// * `seen` – solid angle per turn at [`Sweep::turns`] from the low and from the high end
    #[inline]
    pub(crate) fn new(half: f32, [low, high]: [Vec4; 2]) -> Option<Self> {
        let (first, last) = (End::new(low.x / low.y), End::new(high.x / high.y));
        let (at_first, at_last) = (first.line(low.x, low.y), last.line(high.x, high.y));
        let outer = [(at_first + low.y) * first.mean(), (at_last + high.y) * last.mean()];
        let inner = 0.5 * (low.y + high.y) + (low.z + low.w + high.z);
        let scale = 1.0 / (outer[0] + outer[1] + inner);
        if !(half > 0.0 && scale > 0.0 && scale < f32::INFINITY) {
            return None;
        }
        let (low, high) = (low * scale, high * scale);
        Some(Self {
            half,
            density: [at_first * scale, low.y, low.z, low.w, high.z, high.y, at_last * scale],
            outer: [outer[0] * scale, outer[1] * scale],
            ends: [first, last],
        })
    }

    /// Half of the width of the sweep.
    #[inline]
    pub(crate) fn half(&self) -> f32 {
        self.half
    }

    /// How the density ends in an interval at an end; `None` elsewhere, and where it ends as a line.
    #[inline]
    fn end(&self, i: usize) -> Option<End> {
        let end = match i {
            0 => self.ends[0],
            _ if i == INTERVALS - 1 => self.ends[1],
            _ => return None,
        };
        (!end.abrupt).then_some(end)
    }

    /// The density at both ends of an interval.
    #[inline]
    fn density_at(&self, i: usize) -> [f32; 2] {
        match self.density.get(i..i + 2) {
            Some(&[a, b]) => [a, b],
            _ => [0.0; 2],
        }
    }

    /// Share of an interval.
    #[inline]
    fn mass(&self, i: usize) -> f32 {
        match i {
            0 => self.outer[0],
            _ if i == INTERVALS - 1 => self.outer[1],
            _ => {
                let [a, b] = self.density_at(i);
                0.5 * (a + b)
            }
        }
    }

    /// Draws a turn, counted from the nearer end.
    #[inline]
    pub(crate) fn sample(&self, u: f32) -> FromEnd {
        let (mut left, mut i) = (u, 0);
        while i < INTERVALS - 1 && left >= self.mass(i) {
            left -= self.mass(i);
            i += 1;
        }
        let low = i < MIDDLE;
        // Fraction of the interval between its outer end and the turn.
        let t = match self.end(i) {
            Some(end) if low => end.sample((left / self.mass(i)).min(1.0)),
            Some(end) => end.sample((1.0 - left / self.mass(i)).max(0.0)),
            None => {
                // Root of a t + (b − a) t² / 2 = left, in the form that does not cancel.
                let [a, b] = self.density_at(i);
                let root = a + num::sqrt(a * a + 2.0 * (b - a) * left);
                let t = if root > 0.0 { (2.0 * left / root).min(1.0) } else { 0.0 };
                if low { t } else { 1.0 - t }
            }
        };
        let outer = if low { i } else { INTERVALS - 1 - i };
        FromEnd { turn: self.half * (STEP * (outer as f32 + t)), low }
    }

    /// Where a turn is in the table: the interval, and the fraction of it before and after the turn.
    #[inline]
    fn find(&self, from: FromEnd) -> (usize, [f32; 2]) {
        let place = (from.turn / self.half).clamp(0.0, 1.0) / STEP;
        let end = (place as usize).min(MIDDLE - 1);
        let t = place - end as f32;
        if from.low { (end, [t, 1.0 - t]) } else { (INTERVALS - 1 - end, [1.0 - t, t]) }
    }

    /// Density of a turn.
    #[inline]
    pub(crate) fn pdf(&self, turn: FromEnd) -> f32 {
        let (i, [before, after]) = self.find(turn);
        let density = match self.end(i) {
            Some(end) => self.mass(i) * end.density(if i == 0 { before } else { after }),
            None => {
                let [a, b] = self.density_at(i);
                a * after + b * before
            }
        };
        density / (STEP * self.half)
    }

    /// Inverse of [`Sweep::sample`].
    pub(crate) fn share(&self, turn: FromEnd) -> f32 {
        let (i, [before, after]) = self.find(turn);
        let below: f32 = (0..i).map(|j| self.mass(j)).sum();
        let [a, b] = self.density_at(i);
        below
            + match self.end(i) {
                Some(end) if i == 0 => self.mass(i) * end.share(before),
                Some(end) => self.mass(i) * (1.0 - end.share(after)),
                None => before * (a + 0.5 * (b - a) * before),
            }
    }
}

/// A density over `t` in `[0, 1]`: the blend of a constant and of the root `3/2 √t`; or a line.
#[derive(Debug, Clone, Copy, PartialEq)]
struct End {
    /// Share of the root.
    round: f32,
    /// Whether it is a line: it does not fall as a rim does.
    abrupt: bool,
}

impl End {
    /// * `ratio` – of the value halfway to that at 1: 1 for an abrupt end, [`CIRCLE`] for a circle
    ///
    /// From halfway on it is the root alone: at a rim, what remains of the constant would let the
    /// light's density grow beyond all bounds.
    #[inline]
    fn new(ratio: f32) -> Self {
        const PER_RATIO: f32 = 2.0 / (1.0 - CIRCLE);
        Self { round: num::clamp((1.0 - ratio) * PER_RATIO, 0.0, 1.0), abrupt: ratio > ABRUPT }
    }

    /// Where the line begins; 0 if it is none.
    #[inline]
    fn line(&self, halfway: f32, next: f32) -> f32 {
        if self.abrupt { 2.0 * halfway - next } else { 0.0 }
    }

    /// The mean, in units of the sum of both ends.
    #[inline]
    fn mean(&self) -> f32 {
        if self.abrupt { 0.5 } else { 1.0 / self.density(1.0) }
    }

    #[inline]
    fn density(&self, t: f32) -> f32 {
        1.0 - self.round + self.round * 1.5 * num::sqrt(t)
    }

    /// What is below `t`.
    #[inline]
    fn share(&self, t: f32) -> f32 {
        t * (1.0 - self.round + self.round * num::sqrt(t))
    }

    /// `t` with the share `u` below: Newton's method for `√t`, from above, where the share is convex.
    #[inline]
    fn sample(&self, u: f32) -> f32 {
        let (a, b) = (1.0 - self.round, self.round);
        let mut z = 1.0_f32;
        for _ in 0..24 {
            let next = z - (z * z * (a + b * z) - u) / (z * (2.0 * a + 3.0 * b * z));
            if !(next < z && next > 0.0) {
                break;
            }
            z = next;
        }
        if u > 0.0 { z * z } else { 0.0 }
    }
}

/// A turn of a sweep, counted inward from the nearer of its ends: where the light's edge is round,
/// the density is a quotient of what vanishes there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FromEnd {
    pub(crate) turn: f32,
    /// True when it is counted from the low end.
    pub(crate) low: bool,
}

/// `√(11/20)`: a circle's chord a twelfth of its width from the edge, over that at a sixth.
const CIRCLE: f32 = 0.741_619_8;

/// Width of an interval, for a sweep of 2.
const STEP: f32 = 2.0 / INTERVALS as f32;

/// From which ratio of the value halfway through the last interval to that before it a light ends
/// abruptly. The angle per turn alone makes it 0.85 at a right angle; a circle's rim, 0.74.
const ABRUPT: f32 = 0.82;

/// Intervals on either side.
const MIDDLE: usize = INTERVALS / 2;
