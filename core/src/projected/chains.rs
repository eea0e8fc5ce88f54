//! The two boundaries of a polygon, as a sweep over the azimuth meets them.

use super::clip::{Above, Outline};
use glam::DVec3;

/// Edges in one direction around the zenith.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chain {
    /// The corner that the sweep has reached.
    at: usize,
    /// Edges that remain.
    left: usize,
}

/// How a polygon lies about the zenith, and how far a sweep over the azimuth has got.
#[derive(Debug, Clone, Copy)]
pub(super) enum Layout {
    /// The zenith is inside or on an edge: all edges are one chain.
    Around(Chain),
    /// It is outside: the outer and the inner boundary, from the smallest azimuth to the greatest.
    Beside(Chain, Chain),
}

/// A corner that a sweep meets.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Step {
    pub(super) corner: u8,
    /// The ends of the edge on the other boundary, counter-clockwise in azimuth.
    pub(super) edge: [u8; 2],
    /// True when the corner is on the outer boundary.
    pub(super) outward: bool,
}

impl Layout {
    /// `None` for a polygon that rounding has turned inside out, or that has no width.
    ///
    /// * `n` – how many corners it has
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn of<const N: usize>(outline: &Outline<N>, n: usize) -> Option<Self> {
        let (mut forward, mut backward) = (0_u32, 0_u32);
        for i in 0..n {
            let (x, rounding) = outline.azimuth_and_rounding(i, next(i, n));
            forward |= u32::from(x > rounding) << i;
            backward |= u32::from(x < -rounding) << i;
        }
        if forward == 0 {
            return None;
        }
        if backward == 0 {
            return Some(Self::Around(Chain { at: 0, left: n }));
        }
        let rise = first_from(forward, backward.trailing_zeros() as usize);
        let fall = first_from(backward, rise);
        // Edges along a meridian belong to neither chain.
        let back_to = |edges: u32, mut end: usize| {
            while edges >> previous(end, n) & 1 == 0 {
                end = previous(end, n);
            }
            end
        };
        let (outer_end, inner_end) = (back_to(forward, fall), back_to(backward, rise));
        let outer = Chain { at: rise, left: distance(rise, outer_end, n) };
        let inner = Chain { at: inner_end, left: distance(fall, inner_end, n) };
        Some(Self::Beside(outer, inner))
    }

    /// True when the zenith is inside or on an edge.
    #[inline]
    pub(super) fn is_around(&self) -> bool {
        matches!(self, Self::Around(_))
    }

    /// The corner that a sweep starts from.
    ///
    /// * `n` – how many there are
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn first(&self, n: usize) -> Step {
        match self {
            Self::Around(all) => Step::new(all.at, [all.at; 2], true),
            Self::Beside(outer, inner) => Step::new(outer.at, [inner.at, previous(inner.at, n)], true),
        }
    }

    /// The next corner in the order of azimuth.
    ///
    /// * `n` – how many there are
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn advance<const N: usize>(&mut self, outline: &Outline<N>, n: usize) -> Option<Step> {
        match self {
            Self::Around(all) if all.left == 0 => None,
            Self::Around(all) => {
                all.go(next(all.at, n));
                Some(Step::new(all.at, [all.at; 2], true))
            }
            Self::Beside(outer, inner) if outer.left == 0 || inner.left == 0 => None,
            Self::Beside(outer, inner) => {
                let [from, to] = [[outer.at, inner.at], [next(outer.at, n), previous(inner.at, n)]];
                let inner_first = inner.left > 1 && (outer.left == 1 || outline.azimuth(to[1], to[0]) > 0.0);
                let (k, chain) = if inner_first { (1, inner) } else { (0, outer) };
                chain.go(to[k]);
                Some(Step::new(to[k], [from[1 - k], to[1 - k]], !inner_first))
            }
        }
    }
}

impl Chain {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn go(&mut self, to: usize) {
        *self = Self { at: to, left: self.left - 1 };
    }
}

impl Step {
    /// That of the first corner, alone.
    pub(super) const FIRST: Self = Self { corner: 0, edge: [0; 2], outward: true };

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn new(corner: usize, edge: [usize; 2], outward: bool) -> Self {
        Self { corner: corner as u8, edge: edge.map(|i| i as u8), outward }
    }
}

/// The first bit that is set from bit `i` on, or else the first of all.
#[inline]
fn first_from(bits: u32, i: usize) -> usize {
    let at_or_after = bits >> i << i;
    (if at_or_after == 0 { bits } else { at_or_after }).trailing_zeros() as usize
}

#[inline]
fn next(i: usize, n: usize) -> usize {
    if i + 1 == n { 0 } else { i + 1 }
}

#[inline]
fn previous(i: usize, n: usize) -> usize {
    if i == 0 { n - 1 } else { i - 1 }
}

/// Steps forward from `a` to `b`.
#[inline]
fn distance(a: usize, b: usize, n: usize) -> usize {
    if b >= a { b - a } else { b + n - a }
}

impl<const N: usize> Above<N> {
    /// The meridian at a corner.
    ///
    /// Derived: with X the cross products of azimuths, the edge from i to j has the azimuth vector of
    /// the corner k at `(X_kj p_i + X_ik p_j) / X_ij`, and is `det(p_i, p_j, p_k) / X_ij` above or below
    /// it; the determinant is the plane's times that of the places. The outer end comes from the first:
    /// its direction does not depend on `X_ij`, of which few digits may be known.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn cut(&self, step: &Step) -> Cut {
        let (corner, [i, j]) = (step.corner.into(), step.edge.map(usize::from));
        let point = self.point(corner);
        if corner == i || corner == j {
            let shares = if corner == i { [1.0, 0.0] } else { [0.0, 1.0] };
            return Cut { outer: point, rise: 0.0, shares };
        }
        let outline = &self.outline;
        let per_width = 1.0 / outline.azimuth(i, j);
        let shares = [(corner, j), (i, corner)].map(|(a, b)| outline.azimuth(a, b).max(0.0) * per_width);
        let rise = self.volume * outline.doubled_area(i, j, corner) * per_width;
        let outer = if step.outward { point } else { self.point(i) * shares[0] + self.point(j) * shares[1] };
        Cut { outer, rise, shares: shares.map(|share| share as f32) }
    }
}

/// A meridian through a corner, before it is brought to scale.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut {
    /// The outer end: azimuth vector, and height (m).
    pub(super) outer: DVec3,
    /// By how much the inner end is higher (m).
    pub(super) rise: f64,
    /// How much of the ends of the edge on the other boundary is in the end there.
    pub(super) shares: [f32; 2],
}
