//! The two boundaries of a polygon, as a sweep over the azimuth meets them.

use super::clip::Above;
use super::meridian::Cut;

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
#[derive(Debug, Clone, Copy)]
pub(super) struct Step {
    corner: usize,
    /// The ends of the edge on the other boundary, counter-clockwise in azimuth.
    edge: [usize; 2],
    /// True when the corner is on the outer boundary.
    outward: bool,
}

impl Layout {
    /// `None` for a polygon that rounding has turned inside out, or that has no width.
    #[inline(always)]
    pub(super) fn of<const N: usize>(above: &Above<N>) -> Option<Self> {
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
    #[inline(always)]
    pub(super) fn first(&self, n: usize) -> Step {
        match self {
            Self::Around(all) => Step::alone(all.at),
            Self::Beside(outer, inner) => {
                Step { corner: outer.at, edge: [inner.at, previous(inner.at, n)], outward: true }
            }
        }
    }

    /// The next corner in the order of azimuth.
    #[inline(always)]
    pub(super) fn advance<const N: usize>(&mut self, above: &Above<N>) -> Option<Step> {
        let n = above.corners().len();
        match self {
            Self::Around(all) if all.left == 0 => None,
            Self::Around(all) => {
                all.go(next(all.at, n));
                Some(Step::alone(all.at))
            }
            Self::Beside(outer, inner) if outer.left == 0 || inner.left == 0 => None,
            Self::Beside(outer, inner) => {
                let [from, to] = [[outer.at, inner.at], [next(outer.at, n), previous(inner.at, n)]];
                let inner_first =
                    inner.left > 1 && (outer.left == 1 || above.azimuth_between(to[1], to[0]) > 0.0);
                let (k, chain) = if inner_first { (1, inner) } else { (0, outer) };
                chain.go(to[k]);
                Some(Step { corner: to[k], edge: [from[1 - k], to[1 - k]], outward: !inner_first })
            }
        }
    }
}

impl Chain {
    #[inline(always)]
    fn go(&mut self, to: usize) {
        *self = Self { at: to, left: self.left - 1 };
    }
}

impl Step {
    #[inline(always)]
    fn alone(corner: usize) -> Self {
        Self { corner, edge: [corner; 2], outward: true }
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

    /// The meridian at a corner.
    ///
    /// Derived: with X the cross products of azimuths, the edge from i to j has the azimuth vector of
    /// the corner k at `(X_kj p_i + X_ik p_j) / X_ij`, and is `det(p_i, p_j, p_k) / X_ij` below it; the
    /// determinant is the plane's times that of the places.
    #[inline(always)]
    pub(super) fn cut(&self, step: &Step) -> Cut {
        let Step { corner, edge: [i, j], outward } = *step;
        let corners = self.corners();
        let c = &corners[corner];
        let place = c.homogeneous();
        if corner == i || corner == j {
            return Cut { corner, outer: c.point, rise: 0.0, outer_place: place, inner_place: place };
        }
        let (a, b) = (&corners[i], &corners[j]);
        let per_width = 1.0 / self.azimuth(a, b);
        let wa = self.azimuth(c, b).max(0.0) * per_width;
        let wb = self.azimuth(a, c).max(0.0) * per_width;
        let doubled_area = (b.place - a.place).perp_dot(c.place - a.place);
        let rise = self.volume * doubled_area.abs() * per_width;
        let cut = a.homogeneous() * wa as f32 + b.homogeneous() * wb as f32;
        if outward {
            Cut { corner, outer: c.point, rise, outer_place: place, inner_place: cut }
        } else {
            let outer = a.point * wa + b.point * wb;
            Cut { corner, outer, rise, outer_place: cut, inner_place: place }
        }
    }
}
