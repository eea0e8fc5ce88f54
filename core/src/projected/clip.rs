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

/// A convex polygon above a receiver's horizon, in units in which the largest coordinate is 1.
///
/// The frame's third axis is the normal. Its handedness is such that the polygon's corners, which
/// run counter-clockwise in the plane's coordinates, do so around the zenith as well.
#[derive(Debug, Clone, Copy)]
pub(super) struct Above<const N: usize> {
    pub(super) frame: Frame,
    /// One unit (m).
    pub(super) unit: f32,
    /// The determinant of the plane's origin and axes; above 0.
    pub(super) volume: f64,
    /// The zenith in the plane's homogeneous coordinates, times the volume.
    pub(super) zenith: DVec3,
    corners: [Corner; N],
    len: usize,
}

impl<const N: usize> Above<N> {
    /// `None` when nothing is above the horizon, or the receiver is in the plane.
    #[inline]
    pub(super) fn new(normal: Vec3, chart: &Chart, places: &[Vec2]) -> Option<Self> {
        let largest = |v: DVec3| v.abs().max_element();
        let unit = largest(chart.origin).max(largest(chart.u)).max(largest(chart.v));
        let per_unit = 1.0 / unit;
        let mut frame = Frame::from_normal(normal);
        let (s, t, n) = (frame.s.as_dvec3(), frame.t.as_dvec3(), frame.n.as_dvec3());
        let volume = chart.volume() * per_unit * per_unit * per_unit;
        if !(volume.abs() > 0.0 && volume.abs() < f64::INFINITY) {
            return None;
        }
        let (turned, volume) = (volume < 0.0, volume.abs());
        let t = if turned { -t } else { t };
        frame.t = if turned { -frame.t } else { frame.t };
        let local = |v: DVec3| DVec3::new(v.dot(s), v.dot(t), v.dot(n)) * per_unit;
        let (r, u, v) = (local(chart.origin), local(chart.u), local(chart.v));
        let across = |a: DVec3, b: DVec3| a.truncate().perp_dot(b.truncate());
        let zenith = DVec3::new(across(v, r), across(r, u), across(u, v));
        let corner = |place: &Vec2| {
            let place = place.as_dvec2();
            Corner { place, point: r + u * place.x + v * place.y }
        };
        let unit = unit as f32;
        let mut above = Self { frame, unit, volume, zenith, corners: [Corner::ZERO; N], len: 0 };
        above.clip(places, corner);
        (above.len > 2).then_some(above)
    }

    /// Keeps what is above the horizon.
    ///
    /// Source: Sutherland and Hodgman 1974, *Reentrant Polygon Clipping*, CACM 17(1), for one plane.
    #[inline]
    fn clip(&mut self, places: &[Vec2], corner: impl Fn(&Vec2) -> Corner) {
        let Some(last) = places.last() else { return };
        let mut before = corner(last);
        for place in places {
            let here = corner(place);
            let (za, zb) = (before.point.z, here.point.z);
            if (za > 0.0) != (zb > 0.0) {
                let t = za / (za - zb);
                let point = before.point + (here.point - before.point) * t;
                let place = before.place + (here.place - before.place) * t;
                self.push(Corner { place, point: DVec3 { z: 0.0, ..point } });
            }
            if zb > 0.0 {
                self.push(here);
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

    /// 1 where `b` is counter-clockwise of `a`, −1 clockwise, 0 as far as rounding can tell.
    #[inline]
    pub(super) fn turn(&self, a: &Corner, b: &Corner) -> i8 {
        let cross = cross(a.place, b.place);
        let (x, rounding) = (self.zenith.dot(cross), ROUNDING * self.zenith.abs().dot(cross.abs()));
        i8::from(x > rounding) - i8::from(x < -rounding)
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
