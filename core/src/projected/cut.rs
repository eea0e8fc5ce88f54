//! The part of a cap above the horizon that cuts it, in slices across.

use super::cap::Rim;
use crate::num;
use crate::num::lanes::{self, Number};
use glam::Vec4;

/// Slices across a cap that the horizon cuts: at `y = y_max sin ψ`, where `τ = tan ½ψ`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Cut {
    rim: Rim,
    /// Largest `y` above the horizon.
    y_max: f32,
    /// Half width of the rim where it meets the horizon.
    q_turn: f32,
    /// The `τ` of that; beyond, slices end at the rim on either side.
    turn: f32,
    /// Projected solid angle of the slices from the middle up to there (sr).
    mass_to_turn: f32,
    /// That of all from the middle to one end (sr).
    mass: f32,
}

/// One slice of a cut cap, or several at once.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slice<T> {
    /// Offset across.
    pub(super) y: T,
    /// `y_max cos ψ`: its derivative.
    across: T,
    /// `dψ / dτ`.
    per_tau: T,
    /// Half of the chord of the cap's rim.
    pub(super) half_rim: T,
    /// The unit circle: `√(1 − y²)`.
    pub(super) circle: T,
    /// Length from the rim to the circle, or from rim to rim.
    pub(super) length: T,
}

/// Nodes and weights of the eight-point Gauss–Legendre rule on `[0, 1]`.
///
/// Source: Abramowitz and Stegun 1964, table 25.4.
const GAUSS: [(Vec4, Vec4); 2] = [
    (
        Vec4::new(0.019_855_072, 0.101_666_76, 0.237_233_79, 0.408_282_68),
        Vec4::new(0.050_614_268, 0.111_190_52, 0.156_853_32, 0.181_341_89),
    ),
    (
        Vec4::new(0.591_717_3, 0.762_766_2, 0.898_333_25, 0.980_144_9),
        Vec4::new(0.181_341_89, 0.156_853_32, 0.111_190_52, 0.050_614_268),
    ),
];

impl Cut {
    /// * `rim` – with a height between `−sine` and `sine`
    pub(super) fn new(rim: &Rim) -> Self {
        let Rim { sine: s, cosine: k, height: c, aside: b } = *rim;
        // s² − c² = b² − k²: of both the one whose terms are small.
        let above_horizon = if s < k { (s - c) * (s + c) } else { (b - k) * (b + k) };
        let (y_turn, q_turn) = (num::sqrt(above_horizon) / b, c.abs() * k / b);
        // Where they meet, the squares of both make s².
        let (y_max, turn) = if c > 0.0 { (s, y_turn / (s + q_turn)) } else { (y_turn, 1.0) };
        let mut cut = Self { rim: *rim, y_max, q_turn, turn, mass_to_turn: 0.0, mass: 0.0 };
        cut.mass_to_turn = cut.mass_of_cut_slices(turn);
        cut.mass = cut.mass_below(1.0);
        cut
    }

    /// Projected solid angle above the horizon (sr).
    #[inline]
    pub(super) fn area(&self) -> f32 {
        2.0 * self.mass
    }

    /// True when the slice at `τ` ends at the rim on either side, above the horizon.
    #[inline]
    pub(super) fn is_clear(&self, tau: f32) -> bool {
        tau > self.turn
    }

    /// The slice at `τ`.
    #[inline]
    pub(super) fn slice(&self, tau: f32) -> Slice<f32> {
        let slice = self.cut_slice(tau);
        let length = if self.is_clear(tau) { 2.0 * self.rim.height * slice.half_rim } else { slice.length };
        Slice { length, ..slice }
    }

    /// The slices at `τ`, from the rim to the unit circle.
    ///
    /// Derived: from the rim's near side at `b k − c q`, `q = √(s² − y²)`, to the unit circle at
    /// `√(1 − y²)` are `(b q + c k)² / (√(1 − y²) + b k − c q)`.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn cut_slice<T: Number>(&self, tau: T) -> Slice<T> {
        let Rim { cosine: k, height: c, aside: b, .. } = self.rim;
        let half_per_tau = (tau * tau + 1.0).recip();
        let across = (tau * -1.0 + 1.0) * (tau + 1.0) * half_per_tau * self.y_max;
        let (half_rim, rise) = if c > 0.0 {
            (across, across * b + c * k)
        } else {
            // b q − |c| k, from the difference of the squares.
            let squared = across * across;
            let q = (squared + self.q_turn * self.q_turn).sqrt();
            (q, squared * b * (q + self.q_turn).recip())
        };
        let circle = (half_rim * half_rim + k * k).sqrt();
        let near = half_rim * -c + b * k;
        let length = near.if_positive(rise * rise * (circle + near).recip(), circle + near * -1.0);
        let per_tau = half_per_tau * 2.0;
        Slice { y: tau * per_tau * self.y_max, across, per_tau, half_rim, circle, length }
    }

    /// Projected solid angle of the slices from the middle to `τ` (sr), as if all ended at the horizon.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn mass_of_cut_slices(&self, tau: f32) -> f32 {
        let [low, high] =
            GAUSS.map(|(node, weight)| lanes::map(node * tau, |tau| self.cut_slice(tau).strip()) * weight);
        let [a, b, c, d] = (low + high).to_array();
        tau * ((a + b) + (c + d))
    }

    /// Projected solid angle of the slices from the middle to `τ` (sr).
    #[inline]
    pub(super) fn mass_below(&self, tau: f32) -> f32 {
        if !self.is_clear(tau) {
            return self.mass_of_cut_slices(tau);
        }
        // ∫ 2 c q dy
        let sin_cos =
            |tau: f32| 2.0 * tau * (1.0 - tau) * (1.0 + tau) / ((1.0 + tau * tau) * (1.0 + tau * tau));
        let turned = 2.0 * num::atan2(tau - self.turn, 1.0 + tau * self.turn);
        let clear = turned + sin_cos(tau) - sin_cos(self.turn);
        self.mass_to_turn + self.rim.height * self.rim.sine * self.rim.sine * clear
    }

    /// The `τ` of the slice at `y`, 0 or above.
    #[inline]
    pub(super) fn tau_at(&self, y: f32) -> f32 {
        let sin = (y / self.y_max).min(1.0);
        sin / (1.0 + num::sqrt((1.0 - sin) * (1.0 + sin)))
    }

    /// The share of the mass of one side below `τ`.
    #[inline]
    pub(super) fn share_below(&self, tau: f32) -> f32 {
        self.mass_below(tau) / self.mass
    }

    /// `τ` with the given share of the mass of one side below it: Halley's method.
    #[inline]
    pub(super) fn solve(&self, share: f32) -> f32 {
        let target = share * self.mass;
        let enough = ENOUGH * target.min(self.mass - target);
        let mut tau = self.first_guess(share);
        for _ in 0..MAX_STEPS {
            let error = self.mass_below(tau) - target;
            let slice = self.slice(tau);
            let step = error / slice.strip();
            let bend = 0.5 * step * slice.growth(tau, self.is_clear(tau), self.rim.height);
            let next = tau - step / (1.0 - bend.min(0.8));
            if !(next > 0.0 && next < 1.0) {
                break;
            }
            tau = next;
            if error.abs() <= enough {
                break;
            }
        }
        tau
    }

    /// Where about the given share of the mass of one side ends: within 0.02 of it.
    ///
    /// Derived: a slice is about as long as a power of `cos ψ`, from 1 for a cap right above the
    /// horizon to 4 for a sliver; which one, the mean over the middle one tells. The coefficients are
    /// a fit to random caps.
    #[inline]
    fn first_guess(&self, share: f32) -> f32 {
        let middle = self.cut_slice(0.0);
        let shape = self.mass / (middle.length * self.y_max) - 2.0 / 3.0;
        let rest = (1.0 - share).max(num::UNIT_ROUND_OFF);
        let root = num::sqrt(rest);
        let fourth = num::sqrt(root);
        let h = rest
            + (0.835_07 - 2.827_81 * shape) * (fourth - rest)
            + (2.884_7 * shape - 0.415_04) * (root - rest);
        // h is the tangent of half of what is left of a right angle.
        ((1.0 - h) / (1.0 + h)).clamp(num::UNIT_ROUND_OFF, num::ONE_MINUS_EPSILON)
    }
}

impl<T: Number> Slice<T> {
    /// Mass over `dτ`.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn strip(&self) -> T {
        self.length * self.across * self.per_tau
    }
}

impl Slice<f32> {
    /// Derivative of the strip by `τ`, over the strip.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn growth(&self, tau: f32, is_clear: bool, height: f32) -> f32 {
        let Self { y, across, half_rim: q, circle, length, .. } = *self;
        let lengthening = if is_clear { 1.0 / q } else { (q / circle + height) / length };
        -self.per_tau * (y / across + across * y / q * lengthening + tau)
    }
}

/// Steps of Halley's method at most; one or two are common.
const MAX_STEPS: usize = 6;

/// The error in what is on the smaller side, over that, from which one more step leaves rounding.
const ENOUGH: f32 = 3e-3;
