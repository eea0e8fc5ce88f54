//! Sampling a disk or an ellipse.

use super::{
    AreaView, NoView, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceSample, SurfaceView, UseView,
    View,
};
use crate::geom::unit;
use crate::irradiance;
use crate::num;
use crate::shape::{Disk, SurfacePoint};
use crate::solid_angle::{FromEnd, Span, Sweep};
use crate::warp;
use glam::{Vec2, Vec3};

/// A disk or ellipse, close to uniform over its solid angle: the plane's angle about an axis that
/// passes through the receiver, parallel to the disk and across the way to its centre, is drawn from
/// a table; the elevation's sine uniformly over the chord that is seen at that angle.
///
/// Derived: no elementary map is uniform over a disk's solid angle (its solid angle is an elliptic
/// integral); this one is within a percent of it, and its density is exact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiskSlab {
    disk: Disk,
    /// Unit vectors: along the axis, from the foot of the receiver to the centre, to the plane.
    axes: [Vec3; 3],
    /// Distance of the receiver from the plane, and of its foot from the centre (m).
    height: f32,
    offset: f32,
    /// Half of the disk's width along the second axis, and of its chord in the middle (m).
    reach: f32,
    half_chord: f32,
    /// How far a chord's middle moves along the first axis for each metre along the second.
    shear: f32,
    /// The second axis in units of the semi-axes, as a unit vector.
    along: Vec2,
    sweep: Sweep,
}

/// A line across the disk.
struct Line {
    /// Offset along the second axis, in units of the reach; in `[−1, 1]`.
    s: f32,
    /// Sine and cosine of the plane's angle, from the plane's normal.
    sin: f32,
    cos: f32,
    span: Span,
}

impl DiskSlab {
    /// `None` from within the disk's plane, and where rounding leaves no solid angle.
    fn new(disk: &Disk, from: &Receiver) -> Option<Self> {
        let to_centre = disk.centre() - from.point;
        let (u, v) = (unit(disk.axis_u())?, unit(disk.axis_v())?);
        let normal = disk.normal();
        let rise = num::sum_of_products(normal.to_array(), to_centre.to_array());
        let (p, q) = (to_centre.dot(u), to_centre.dot(v));
        let offset = num::sqrt(p * p + q * q);
        let g = if offset > 0.0 { Vec2::new(p / offset, q / offset) } else { Vec2::X };
        let (a, b) = (disk.axis_u().length(), disk.axis_v().length());
        let reach = num::sqrt(a * a * g.x * g.x + b * b * g.y * g.y);
        let height = rise.abs();
        if !(height > 0.0 && reach > 0.0) {
            return None;
        }
        let mut slab = Self {
            disk: *disk,
            axes: [u * g.y - v * g.x, u * g.x + v * g.y, normal * 1.0_f32.copysign(rise)],
            height,
            offset,
            reach,
            half_chord: a * (b / reach),
            shear: ((a - b) / reach) * ((a + b) / reach) * (g.x * g.y),
            along: Vec2::new(a * g.x / reach, b * g.y / reach),
            sweep: Sweep::EMPTY,
        };
        let (low, high) = (slab.angle(-1.0), slab.angle(1.0));
        slab.sweep = Sweep::new(low, high, |angle| slab.line_at(angle).span.extent())?;
        Some(slab)
    }

    /// Plane's angle of a line, counted from the centre's (rad).
    #[inline]
    fn angle(&self, s: f32) -> f32 {
        let (h, d, eta) = (self.height, self.offset, s * self.reach);
        num::atan2(eta * h, h * h + d * (d + eta))
    }

    /// The same counted from the edge.
    #[inline]
    fn angle_from_edge(&self, s: f32) -> FromEnd {
        let (edge, y) = (self.offset + self.reach.copysign(s), self.offset + s * self.reach);
        let between = (1.0 - s.abs()) * self.reach;
        let angle = num::atan2(between * self.height, self.height * self.height + edge * y);
        FromEnd { angle, low: s < 0.0 }
    }

    /// The line at a plane's angle, counted from the centre's.
    #[inline]
    fn line_at(&self, angle: f32) -> Line {
        let (h, d) = (self.height, self.offset);
        let (sin, cos) = num::sin_cos(angle);
        let far = num::sqrt(h * h + d * d);
        // Below this, the line would be beyond the disk.
        let least = h * (h / (h + d + self.reach));
        let forward = (h * cos - d * sin).max(least);
        let eta = far * far * (sin / forward);
        let away = h * (far / forward);
        self.line((eta / self.reach).clamp(-1.0, 1.0), (d * cos + h * sin) / far, forward / far, away)
    }

    /// The line through a point of the disk.
    #[inline]
    fn line_through(&self, s: f32) -> Line {
        let y = self.offset + s * self.reach;
        let away = num::sqrt(self.height * self.height + y * y);
        self.line(s, y / away, self.height / away, away)
    }

    #[inline]
    fn line(&self, s: f32, sin: f32, cos: f32, away: f32) -> Line {
        let half = self.half_chord * num::sqrt((1.0 - s) * (1.0 + s));
        let span = Span { start: self.shear * (s * self.reach) - half, length: 2.0 * half, away };
        Line { s, sin, cos, span }
    }

    /// A point of the disk in units of the chords: offset, and fraction of its chord.
    #[inline]
    fn place(&self, at: &SurfacePoint) -> (f32, f32) {
        let (u, v) = self.disk.coordinates(at.point);
        let (s, k) = (u * self.along.x + v * self.along.y, u * self.along.y - v * self.along.x);
        let s = s.clamp(-1.0, 1.0);
        let half = num::sqrt((1.0 - s) * (1.0 + s));
        (s, if half > 0.0 { (0.5 + 0.5 * (k / half)).clamp(0.0, 1.0) } else { 0.5 })
    }
}

impl SurfaceView for DiskSlab {
    #[inline]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        let line = self.line_at(self.sweep.sample(u[0]));
        let (x, fraction) = line.span.at(u[1]);
        // In units of the semi-axes a chord of the ellipse is one of the unit circle.
        let k = (2.0 * fraction - 1.0) * num::sqrt((1.0 - line.s) * (1.0 + line.s));
        let (e, s) = (self.along, line.s);
        let at = self.disk.point(s * e.x + k * e.y, s * e.y - k * e.x);
        let away = line.span.away;
        let distance = num::sqrt(x * x + away * away);
        let plane = self.axes[1] * line.sin + self.axes[2] * line.cos;
        let wi = unit(self.axes[0] * (x / distance) + plane * (away / distance))?;
        (distance > 0.0 && distance.is_finite()).then_some(SurfaceSample { at, wi, distance })
    }

    #[inline]
    fn pdf_solid_angle(&self, at: &SurfacePoint, _: Vec3, _: f32) -> Option<f32> {
        let (s, _) = self.place(at);
        let pdf = self.sweep.pdf(self.angle_from_edge(s)) / self.line_through(s).span.extent();
        (pdf > 0.0 && pdf.is_finite()).then_some(pdf)
    }

    fn invert(&self, at: &SurfacePoint, _: Vec3) -> Option<[f32; 2]> {
        let (s, fraction) = self.place(at);
        let u = [self.sweep.share(self.angle_from_edge(s)), self.line_through(s).span.share(fraction)];
        u.iter().all(|x| x.is_finite()).then(|| u.map(|x| x.clamp(0.0, num::ONE_MINUS_EPSILON)))
    }
}

/// True when a side that emits faces the receiver.
#[inline]
fn is_seen(disk: &Disk, from: &Receiver, sides: Sides) -> bool {
    let to_centre = disk.centre() - from.point;
    let rise = num::sum_of_products(disk.normal().to_array(), to_centre.to_array());
    rise < 0.0 || (sides == Sides::Both && rise > 0.0)
}

impl SampledShape for Disk {
    type View = View<Self, DiskSlab, NoView>;

    /// Density `1 / (π a b)` (m⁻²); the concentric map, stretched along the axes.
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        let p = warp::square_to_disk(u);
        self.point(p.x, p.y)
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (a, b) = self.coordinates(point);
        // A thousandth of a nanometre beside a needle is many of its widths.
        let u = warp::disk_to_square(Vec2::new(a.clamp(-1.0, 1.0), b.clamp(-1.0, 1.0)));
        u.map(|x| x.clamp(0.0, num::ONE_MINUS_EPSILON))
    }

    #[inline(always)]
    fn with_view<U: UseView<Self::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        sides: Sides,
        then: U,
    ) -> Option<U::Output> {
        if !is_seen(self, from, sides) {
            return None;
        }
        let radius = num::sqrt(self.axis_u().length_squared().max(self.axis_v().length_squared()));
        match method.required(from, self.centre(), radius, SurfaceDensity::Area) {
            SurfaceDensity::Area => then.with(AreaView::new(*self, from), View::Area),
            _ => then.with(DiskSlab::new(self, from)?, View::SolidAngle),
        }
    }

    fn projected_solid_angle(&self, from: &Receiver, sides: Sides) -> Option<f32> {
        if is_seen(self, from, sides) { irradiance::disk(from, self) } else { Some(0.0) }
    }
}
