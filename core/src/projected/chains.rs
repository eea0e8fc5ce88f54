//! The two boundaries of a polygon, as a sweep over the azimuth meets them.

use super::clip::Above;
use super::meridian::Cut;

/// Edges in one direction around the zenith.
#[derive(Debug, Clone, Copy)]
struct Chain {
    /// The corner that the sweep has reached.
    at: usize,
    /// Edges that remain.
    left: usize,
}

/// The outer and the inner boundary of a polygon that is not around the zenith, from the smallest
/// azimuth to the greatest.
#[derive(Debug, Clone, Copy)]
pub(super) struct Chains<'a, const N: usize> {
    above: &'a Above<N>,
    outer: Chain,
    inner: Chain,
}

/// How a polygon lies about the zenith.
#[derive(Debug, Clone, Copy)]
pub(super) enum Layout<'a, const N: usize> {
    /// The zenith is inside or on an edge.
    Around,
    /// It is outside.
    Beside(Chains<'a, N>),
}

impl<'a, const N: usize> Layout<'a, N> {
    /// `None` for a polygon that rounding has turned inside out, or that has no width.
    #[inline]
    pub(super) fn of(above: &'a Above<N>) -> Option<Self> {
        let corners = above.corners();
        let n = corners.len();
        let (mut forward, mut backward) = (0_u32, 0_u32);
        for (i, corner) in corners.iter().enumerate() {
            let (x, rounding) = above.azimuth_and_rounding(corner, &corners[next(i, n)]);
            forward |= u32::from(x > rounding) << i;
            backward |= u32::from(x < -rounding) << i;
        }
        if forward == 0 {
            return None;
        }
        if backward == 0 {
            return Some(Self::Around);
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
        Some(Self::Beside(Chains { above, outer, inner }))
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
    /// [`Above::azimuth`] by the corners' indices.
    #[inline]
    pub(super) fn azimuth_between(&self, i: usize, j: usize) -> f64 {
        self.azimuth(&self.corners()[i], &self.corners()[j])
    }

    /// The meridian at corner `k`, cut by the edge from `i` to `j`, counter-clockwise in azimuth.
    ///
    /// * `outward` – true when the corner is the outer end
    ///
    /// Derived: with X the cross products of azimuths, the edge has the azimuth vector of k at
    /// `(X_kj p_i + X_ik p_j) / X_ij`, and is `det(p_i, p_j, p_k) / X_ij` below it; the determinant
    /// is the plane's times that of the places.
    #[inline]
    fn meridian(&self, k: usize, [i, j]: [usize; 2], outward: bool) -> Cut {
        let corners = self.corners();
        let (a, b, c) = (&corners[i], &corners[j], &corners[k]);
        if k == i || k == j {
            return Cut::point(k, c);
        }
        let per_width = 1.0 / self.azimuth(a, b);
        let wa = self.azimuth(c, b).max(0.0) * per_width;
        let wb = self.azimuth(a, c).max(0.0) * per_width;
        let doubled_area = (b.place - a.place).perp_dot(c.place - a.place);
        let rise = self.volume * doubled_area.abs() * per_width;
        let cut = a.homogeneous() * wa as f32 + b.homogeneous() * wb as f32;
        if outward {
            Cut { corner: k, outer: c.point, rise, outer_place: c.homogeneous(), inner_place: cut }
        } else {
            let outer = a.point * wa + b.point * wb;
            Cut { corner: k, outer, rise, outer_place: cut, inner_place: c.homogeneous() }
        }
    }

    /// The meridians from each corner to the zenith, all around.
    #[inline]
    pub(super) fn around(&self) -> impl Iterator<Item = Cut> {
        let corners = self.corners().iter().enumerate();
        corners.clone().chain(corners.take(1)).map(|(i, corner)| Cut::point(i, corner))
    }
}

impl<const N: usize> Chains<'_, N> {
    /// The meridians through each corner, in the order of azimuth.
    #[inline]
    pub(super) fn meridians(mut self) -> impl Iterator<Item = Cut> {
        let n = self.above.corners().len();
        let edge = [self.inner.at, previous(self.inner.at, n)];
        let first = self.above.meridian(self.outer.at, edge, true);
        core::iter::once(first).chain(core::iter::from_fn(move || self.advance()))
    }

    /// The next corner in the order of azimuth, and the meridian through it.
    #[inline]
    fn advance(&mut self) -> Option<Cut> {
        if self.outer.left == 0 || self.inner.left == 0 {
            return None;
        }
        let n = self.above.corners().len();
        let (outer, inner) = (next(self.outer.at, n), previous(self.inner.at, n));
        let (outer_edge, inner_edge) = ([self.outer.at, outer], [self.inner.at, inner]);
        let inner_first =
            self.inner.left > 1 && (self.outer.left == 1 || self.above.azimuth_between(inner, outer) > 0.0);
        if inner_first {
            self.inner = Chain { at: inner, left: self.inner.left - 1 };
            Some(self.above.meridian(inner, outer_edge, false))
        } else {
            self.outer = Chain { at: outer, left: self.outer.left - 1 };
            Some(self.above.meridian(outer, inner_edge, true))
        }
    }
}
