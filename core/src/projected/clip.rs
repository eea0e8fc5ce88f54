//! The part of a polygon above a horizon.

use super::Chart;
use crate::geom::Frame;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// The outline of a convex polygon in its plane, and what turns places into azimuths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Outline<const N: usize> {
    /// The zenith in the plane's homogeneous coordinates, times the volume (m²).
    pub(super) zenith: DVec3,
    /// Where the corners are in the plane's coordinates.
    places: [DVec2; N],
    len: usize,
}

/// A convex polygon above a receiver's horizon.
///
/// The frame's third axis is the normal. Its handedness is such that the polygon's corners, which
/// run counter-clockwise in the plane's coordinates, do so around the zenith as well.
#[derive(Debug, Clone, Copy)]
pub(super) struct Above<const N: usize> {
    /// The determinant of the plane's origin and axes (m³); above 0.
    pub(super) volume: f64,
    pub(super) outline: Outline<N>,
    /// The corners in the receiver's frame (m).
    points: [DVec3; N],
}

impl<const N: usize> Above<N> {
    /// No corners.
    pub(super) const EMPTY: Self = Self { volume: 0.0, outline: Outline::EMPTY, points: [DVec3::ZERO; N] };

    /// Adds the corners at `places`, and turns the frame; none when the receiver is in the plane.
    ///
    /// True when all are above the horizon.
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[cfg_attr(feature = "small", inline(never))]
    pub(super) fn fill(&mut self, frame: &mut Frame, chart: &Chart, places: &[Vec2]) -> bool {
        self.volume = chart.volume().abs();
        if !(self.volume > 0.0 && self.volume < f64::INFINITY) {
            return false;
        }
        frame.t = if chart.volume() < 0.0 { -frame.t } else { frame.t };
        let (s, t, n) = (frame.s.as_dvec3(), frame.t.as_dvec3(), frame.n.as_dvec3());
        let local = |v: DVec3| DVec3::new(v.dot(s), v.dot(t), v.dot(n));
        let (r, u, v) = (local(chart.origin), local(chart.u), local(chart.v));
        // Cross products before they are turned: of a needle along an axis they lose nothing.
        let pole = s.cross(t);
        let Chart { origin, u: first, v: second, .. } = *chart;
        let across = |a: DVec3, b: DVec3| pole.dot(a.cross(b));
        self.outline.zenith =
            DVec3::new(across(second, origin), across(origin, first), across(first, second));
        let mut lowest = f64::INFINITY;
        for place in places {
            let place = place.as_dvec2();
            let point = r + u * place.x + v * place.y;
            lowest = lowest.min(point.z);
            self.push(place, point);
        }
        lowest > 0.0
    }

    /// Keeps what is above the horizon: fewer than three corners when that is nothing.
    ///
    /// Source: Sutherland and Hodgman 1974, *Reentrant Polygon Clipping*, CACM 17(1), for one plane.
    #[cfg_attr(not(feature = "small"), inline)]
    #[cfg_attr(feature = "small", inline(never))]
    pub(super) fn clip(&mut self) {
        let whole = *self;
        self.outline.len = 0;
        let corners = || whole.outline.places().iter().zip(&whole.points);
        let Some((mut place_before, mut before)) = corners().next_back() else { return };
        for (place, here) in corners() {
            let (za, zb) = (before.z, here.z);
            if (za > 0.0) != (zb > 0.0) {
                let t = za / (za - zb);
                let point = before + (here - before) * t;
                self.push(place_before + (place - place_before) * t, DVec3 { z: 0.0, ..point });
            }
            if zb > 0.0 {
                self.push(*place, *here);
            }
            (place_before, before) = (place, here);
        }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn push(&mut self, place: DVec2, point: DVec3) {
        let i = self.outline.len;
        if i < N {
            self.outline.places[i] = place;
            self.points[i] = point;
            self.outline.len = i + 1;
        }
    }

    /// The corner with the index `i` in the receiver's frame (m).
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn point(&self, i: usize) -> DVec3 {
        entry(&self.points, i)
    }
}

impl<const N: usize> Outline<N> {
    /// No corners.
    pub(super) const EMPTY: Self = Self { zenith: DVec3::ZERO, places: [DVec2::ZERO; N], len: 0 };

    /// The corners above the horizon and on it, in the plane's coordinates.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn places(&self) -> &[DVec2] {
        self.places.get(..self.len).unwrap_or_default()
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn place(&self, i: usize) -> DVec2 {
        entry(&self.places, i)
    }

    /// Cross product of the azimuths of two corners, positive when that of index `j` is
    /// counter-clockwise of that of index `i`.
    ///
    /// Derived: `n · (p_i × p_j)` is `det(zenith, i, j)` in the plane's homogeneous coordinates, by
    /// cofactors. Rounding of the zenith's coordinates then is one of the plane's, however long, narrow
    /// and far the polygon.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn azimuth(&self, i: usize, j: usize) -> f64 {
        self.zenith.dot(cross(self.place(i), self.place(j)))
    }

    /// [`Outline::azimuth`], and how far it may be off.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn azimuth_and_rounding(&self, i: usize, j: usize) -> (f64, f64) {
        let [x, y, z] = (self.zenith * cross(self.place(i), self.place(j))).to_array();
        (x + y + z, ROUNDING * (x.abs() + y.abs() + z.abs()))
    }

    /// The corner with the index `i` in homogeneous coordinates of the plane.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn homogeneous(&self, i: u8) -> Vec3 {
        self.place(i.into()).as_vec2().extend(1.0)
    }

    /// Twice the area of the triangle between three corners.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn doubled_area(&self, i: usize, j: usize, k: usize) -> f64 {
        let first = self.place(i);
        (self.place(j) - first).perp_dot(self.place(k) - first).abs()
    }
}

/// The entry with the index `i`: the last one for what is beyond, where no index is, so that no code is for a
/// panic.
#[cfg_attr(not(feature = "small"), inline(always))]
pub(super) fn entry<T: Copy, const N: usize>(entries: &[T; N], i: usize) -> T {
    entries[i.min(N - 1)]
}

/// Sets an entry, if there is one with that index.
#[cfg_attr(not(feature = "small"), inline(always))]
pub(super) fn set_entry<T, const N: usize>(entries: &mut [T; N], i: usize, value: T) {
    if let Some(entry) = entries.get_mut(i) {
        *entry = value;
    }
}

/// Cross product of two places in homogeneous coordinates.
#[cfg_attr(not(feature = "small"), inline(always))]
fn cross(a: DVec2, b: DVec2) -> DVec3 {
    let d = b - a;
    DVec3::new(-d.y, d.x, a.perp_dot(d))
}

/// Relative rounding of [`Outline::azimuth`].
const ROUNDING: f64 = 8.0 * f64::EPSILON;
