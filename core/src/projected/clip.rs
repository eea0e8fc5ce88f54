//! The part of a polygon above a horizon.

use super::Chart;
use crate::geom::Frame;
use glam::{DVec2, DVec3, Vec2, Vec3};

/// A corner of a polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Corner {
    /// Where it is in the plane's coordinates.
    pub(super) place: DVec2,
    /// Where it is in the receiver's frame.
    pub(super) point: DVec3,
}

impl Corner {
    const ZERO: Self = Self { place: DVec2::ZERO, point: DVec3::ZERO };

    /// The place in homogeneous coordinates.
    #[inline]
    pub(super) fn homogeneous(&self) -> Vec3 {
        self.place.as_vec2().extend(1.0)
    }
}

/// A convex polygon above a receiver's horizon.
///
/// The frame's third axis is the normal. Its handedness is such that the polygon's corners, which
/// run counter-clockwise in the plane's coordinates, do so around the zenith as well.
#[derive(Debug, Clone, Copy)]
pub(super) struct Above<const N: usize> {
    pub(super) frame: Frame,
    /// The determinant of the plane's origin and axes (m³); above 0.
    pub(super) volume: f64,
    /// The zenith in the plane's homogeneous coordinates, times the volume (m²).
    pub(super) zenith: DVec3,
    corners: [Corner; N],
    len: usize,
}

impl<const N: usize> Above<N> {
    /// Fewer than three corners when nothing is above the horizon, none when the receiver is in the plane.
    #[inline]
    pub(super) fn new(normal: Vec3, chart: &Chart, places: &[Vec2]) -> Self {
        let (turned, volume) = (chart.volume() < 0.0, chart.volume().abs());
        let mut frame = Frame::from_normal(normal);
        frame.t = if turned { -frame.t } else { frame.t };
        let (s, t, n) = (frame.s.as_dvec3(), frame.t.as_dvec3(), frame.n.as_dvec3());
        let local = |v: DVec3| DVec3::new(v.dot(s), v.dot(t), v.dot(n));
        let (r, u, v) = (local(chart.origin), local(chart.u), local(chart.v));
        // Cross products before they are turned: of a needle along an axis they lose nothing.
        let pole = s.cross(t);
        let Chart { origin, u: first, v: second, .. } = *chart;
        let across = |a: DVec3, b: DVec3| pole.dot(a.cross(b));
        let zenith = DVec3::new(across(second, origin), across(origin, first), across(first, second));
        let mut above = Self { frame, volume, zenith, corners: [Corner::ZERO; N], len: 0 };
        if !(volume > 0.0 && volume < f64::INFINITY) {
            return above;
        }
        let mut lowest = f64::INFINITY;
        for place in places {
            let place = place.as_dvec2();
            let point = r + u * place.x + v * place.y;
            lowest = lowest.min(point.z);
            above.push(Corner { place, point });
        }
        if !(lowest > 0.0) {
            above.clip();
        }
        above
    }

    /// Keeps what is above the horizon.
    ///
    /// Source: Sutherland and Hodgman 1974, *Reentrant Polygon Clipping*, CACM 17(1), for one plane.
    fn clip(&mut self) {
        let whole = *self;
        self.len = 0;
        let Some(mut before) = whole.corners().last() else { return };
        for here in whole.corners() {
            let (za, zb) = (before.point.z, here.point.z);
            if (za > 0.0) != (zb > 0.0) {
                let t = za / (za - zb);
                let point = before.point + (here.point - before.point) * t;
                let place = before.place + (here.place - before.place) * t;
                self.push(Corner { place, point: DVec3 { z: 0.0, ..point } });
            }
            if zb > 0.0 {
                self.push(*here);
            }
            before = here;
        }
    }

    #[inline]
    fn push(&mut self, corner: Corner) {
        if let Some(slot) = self.corners.get_mut(self.len) {
            *slot = corner;
            self.len += 1;
        }
    }

    /// The corners above the horizon and on it.
    #[inline]
    pub(super) fn corners(&self) -> &[Corner] {
        &self.corners[..self.len]
    }

    /// Cross product of the azimuths of two corners, positive when `b` is counter-clockwise of `a`.
    ///
    /// Derived: `n · (p_a × p_b)` is `det(zenith, a, b)` in the plane's homogeneous coordinates, by
    /// cofactors. Rounding of the zenith's coordinates then is one of the plane's, however long, narrow
    /// and far the polygon.
    #[inline]
    pub(super) fn azimuth(&self, a: &Corner, b: &Corner) -> f64 {
        self.zenith.dot(cross(a.place, b.place))
    }

    /// [`Above::azimuth`], and how far it may be off.
    #[inline]
    pub(super) fn azimuth_and_rounding(&self, a: &Corner, b: &Corner) -> (f64, f64) {
        let cross = cross(a.place, b.place);
        (self.zenith.dot(cross), ROUNDING * self.zenith.abs().dot(cross.abs()))
    }
}

/// Cross product of two places in homogeneous coordinates.
#[inline]
fn cross(a: DVec2, b: DVec2) -> DVec3 {
    let d = b - a;
    DVec3::new(-d.y, d.x, a.perp_dot(d))
}

/// Relative rounding of [`Above::azimuth`].
const ROUNDING: f64 = 8.0 * f64::EPSILON;
