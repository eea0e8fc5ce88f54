//! Sampling a disk or an ellipse.

use super::{
    AreaView, Cone, NoView, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceSample, SurfaceView,
    UseView, View,
};
use crate::geom::unit;
use crate::irradiance;
use crate::num;
use crate::num::lanes::{self, Lane, Number};
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
    lines: Lines,
    sweep: Sweep,
}

/// How the disk lies before the receiver, and its lines parallel to the axis.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Lines {
    disk: Disk,
    /// Unit vectors: along the axis, from the foot of the receiver to the centre, to the plane.
    axes: [Vec3; 3],
    /// The disk's.
    normal: Vec3,
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
    /// The lines at the near edge, through the centre, and at the far edge.
    marks: [Mark; 3],
    /// How many turns the centre is from either edge.
    to_centre: [f32; 2],
}

/// A line that others are measured from.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Mark {
    /// Tangent of half the plane's angle `α` from the normal.
    turn: f32,
    /// `1 − turn²`.
    rest: f32,
    /// Distance of the receiver from the line, plus that from the plane (m).
    sum: f32,
}

impl Mark {
    /// * `y` – offset of the line from the foot (m)
    ///
    /// Derived: `tan(α / 2) = y / (h + r)` with r² = h² + y², and `1 − tan²(α / 2) = 2 h / (h + r)`.
    #[inline]
    fn new(height: f32, y: f32) -> Self {
        let sum = height + num::sqrt(height * height + y * y);
        Self { turn: y / sum, rest: 2.0 * (height / sum), sum }
    }

    /// How many turns two lines are apart that are `across` apart (m).
    ///
    /// Derived: as [`Mark::across`]; on either side of the foot nothing cancels.
    #[inline]
    fn apart(&self, other: &Self, height: f32, across: f32) -> f32 {
        if self.turn * other.turn < 0.0 {
            return (self.turn - other.turn).abs();
        }
        2.0 * across * (height / self.sum / other.sum) / (1.0 + self.turn * other.turn)
    }

    /// How far across the plane a line is (m) that is at the turn `z`, `apart` from this one.
    ///
    /// Derived: `h (tan α₁ − tan α) = 2 h (z₁ − z) (1 + z z₁) / ((1 − z₁²) (1 − z²))`.
    ///
    /// * `rest` – `1 − z²`
    #[inline]
    fn across(&self, height: f32, apart: f32, z: f32, rest: f32) -> f32 {
        apart * (1.0 + z * self.turn) * ((2.0 * height) / self.rest / rest)
    }
}

/// A line across the disk.
struct Line {
    /// Offset along the second axis, in units of the reach, and that of the chord's ends from its
    /// middle, in units of the longest: a cosine and a sine.
    s: f32,
    half: f32,
    /// Offset from the foot (m).
    y: f32,
    /// Squared tangent of half the plane's angle.
    turn2: f32,
    span: Span,
}

impl DiskSlab {
    /// `None` from within the disk's plane, and where rounding leaves no solid angle.
    ///
    /// * `rise` – as [`rise`]
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn new(disk: &Disk, from: &Receiver, normal: Vec3, rise: f32) -> Option<Self> {
        let lines = Lines::new(disk, from, normal, rise)?;
        let half = 0.5 * (lines.to_centre[0] + lines.to_centre[1]);
        let seen = |low| lanes::map(Sweep::turns(half), |turns| lines.seen(half, low, turns));
        Some(Self { lines, sweep: Sweep::new(half, [seen(true), seen(false)])? })
    }
}

impl Lines {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn new(disk: &Disk, from: &Receiver, normal: Vec3, rise: f32) -> Option<Self> {
        let centre = disk.centre() - from.point;
        let (a, b) = (disk.axis_u().length(), disk.axis_v().length());
        let (u, v) = (disk.axis_u() * (1.0 / a), disk.axis_v() * (1.0 / b));
        let (p, q) = (centre.dot(u), centre.dot(v));
        let offset = num::sqrt(p * p + q * q);
        let g = if offset > 0.0 { Vec2::new(p / offset, q / offset) } else { Vec2::X };
        let (ag, bg) = (a * g.x, b * g.y);
        let reach = num::sqrt(ag * ag + bg * bg);
        let height = rise.abs();
        if !(height > 0.0 && reach > 0.0) {
            return None;
        }
        let per_reach = 1.0 / reach;
        let mark = |y: f32| Mark::new(height, y);
        let marks = [mark(offset - reach), mark(offset), mark(offset + reach)];
        let to_centre = |mark: &Mark| mark.apart(&marks[1], height, reach);
        Some(Self {
            disk: *disk,
            axes: [u * g.y - v * g.x, u * g.x + v * g.y, normal * 1.0_f32.copysign(rise)],
            normal,
            height,
            offset,
            reach,
            half_chord: a * (b * per_reach),
            shear: ((a - b) * per_reach) * ((a + b) * per_reach) * (g.x * g.y),
            along: Vec2::new(ag * per_reach, bg * per_reach),
            marks,
            to_centre: [to_centre(&marks[0]), to_centre(&marks[2])],
        })
    }

    /// Solid angle per turn at some turns from an end.
    ///
    /// With less care than [`Lines::line_at`], which a table may take: the distances of a line from
    /// both edges are measured each for itself, so that neither vanishes before the edge.
    #[inline]
    fn seen(&self, half: f32, low: bool, turns: Lane) -> Lane {
        let h = self.height;
        let [near, far] =
            if low { [&self.marks[0], &self.marks[2]] } else { [&self.marks[2], &self.marks[0]] };
        let inward = if low { 1.0 } else { -1.0 };
        let z = turns * inward + near.turn;
        let rest = Lane::of(near.rest) - turns * inward * (z + near.turn);
        // Distances from both edges, in units of the reach.
        let across = |edge: &Mark, apart: Lane| {
            apart * (z * edge.turn + 1.0) * (2.0 * h / edge.rest / self.reach) / rest
        };
        let (m, n) = (across(near, turns), across(far, 2.0 * half - turns));
        let half_length = (m * n).root() * self.half_chord;
        let middle = (m - n) * (0.5 * inward * self.shear * self.reach);
        let turned = z * z + 1.0;
        let away = turned / rest * h;
        Span::extents(middle - half_length, half_length * 2.0, away) * 2.0 / turned
    }

    /// The line at a turn, which is `z = tan(α / 2)`.
    #[inline]
    fn line_at(&self, from: FromEnd) -> Line {
        let h = self.height;
        let (i, inward) = if from.low { (0, 1.0) } else { (1, -1.0) };
        let edge = &self.marks[2 * i];
        let z = edge.turn + inward * from.turn;
        let rest = edge.rest - inward * from.turn * (edge.turn + z);
        let y = 2.0 * h * (z / rest);
        // In units of the reach: from the edge, or from the centre in a form that does not cancel.
        let m = edge.across(h, from.turn, z, rest) / self.reach;
        let s = if m < 0.5 {
            inward * (m - 1.0)
        } else if z < 0.0 {
            (y - self.offset) / self.reach
        } else {
            inward * self.marks[1].across(h, from.turn - self.to_centre[i], z, rest) / self.reach
        };
        let square = if m < 0.5 { m * (2.0 - m) } else { (1.0 - s) * (1.0 + s) };
        let turn2 = z * z;
        let line = self.line(s.clamp(-1.0, 1.0), num::sqrt(square), h * ((1.0 + turn2) / rest));
        Line { y, turn2, ..line }
    }

    /// The line through a point of the disk, and its turn.
    #[inline]
    fn line_through(&self, s: f32) -> (Line, FromEnd) {
        let y = self.offset + s * self.reach;
        let away = num::sqrt(self.height * self.height + y * y);
        let mark = Mark::new(self.height, y);
        let from_end = |low: bool| {
            let (edge, between) = if low { (&self.marks[0], 1.0 + s) } else { (&self.marks[2], 1.0 - s) };
            FromEnd { turn: edge.apart(&mark, self.height, between * self.reach), low }
        };
        let near = from_end(s < 0.0);
        let turn =
            if near.turn > 0.5 * (self.to_centre[0] + self.to_centre[1]) { from_end(s >= 0.0) } else { near };
        let line = self.line(s, num::sqrt((1.0 - s) * (1.0 + s)), away);
        (Line { y, turn2: mark.turn * mark.turn, ..line }, turn)
    }

    #[inline]
    fn line(&self, s: f32, half: f32, away: f32) -> Line {
        let half_length = self.half_chord * half;
        let start = self.shear * (s * self.reach) - half_length;
        Line { s, half, y: 0.0, turn2: 0.0, span: Span { start, length: 2.0 * half_length, away } }
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
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        let Lines { disk, axes, normal, height, along: e, .. } = &self.lines;
        let line = self.lines.line_at(self.sweep.sample(u[0]));
        let (x, fraction) = line.span.at(u[1]);
        // In units of the semi-axes a chord of the ellipse is one of the unit circle.
        let k = (2.0 * fraction - 1.0) * line.half;
        let s = line.s;
        let at = SurfacePoint { normal: *normal, ..disk.point(s * e.x + k * e.y, s * e.y - k * e.x) };
        let way = axes[0] * x + axes[1] * line.y + axes[2] * *height;
        let distance = num::sqrt(x * x + line.span.away * line.span.away);
        (distance > 0.0 && distance.is_finite()).then_some(SurfaceSample { at, wi: unit(way)?, distance })
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn pdf_solid_angle(&self, at: &SurfacePoint, _: Vec3, _: f32) -> Option<f32> {
        let (line, turn) = self.lines.line_through(self.lines.place(at).0);
        let pdf = self.sweep.pdf(turn) * (0.5 * (1.0 + line.turn2)) / line.span.extent();
        (pdf > 0.0 && pdf.is_finite()).then_some(pdf)
    }

    fn invert(&self, at: &SurfacePoint, _: Vec3) -> Option<[f32; 2]> {
        let (s, fraction) = self.lines.place(at);
        let (line, turn) = self.lines.line_through(s);
        let u = [self.sweep.share(turn), line.span.share(fraction)];
        u.iter().all(|x| x.is_finite()).then(|| u.map(num::clamp_unit))
    }
}

/// How far the disk's plane is from the receiver along the normal (m).
///
/// In double precision: at 1 mrad over the plane, single has four digits of it.
#[cfg_attr(not(feature = "small"), inline(always))]
fn rise(disk: &Disk, normal: Vec3, from: &Receiver) -> f32 {
    normal.as_dvec3().dot(disk.centre().as_dvec3() - from.point.as_dvec3()) as f32
}

/// True when a side that emits faces the receiver.
#[inline]
fn faces(rise: f32, sides: Sides) -> bool {
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

    fn normals(&self) -> Cone {
        Cone { axis: self.normal(), angle: 0.0 }
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (a, b) = self.coordinates(point);
        // A thousandth of a nanometre beside a needle is many of its widths.
        let u = warp::disk_to_square(Vec2::new(a.clamp(-1.0, 1.0), b.clamp(-1.0, 1.0)));
        u.map(num::clamp_unit)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn with_view<U: UseView<Self::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        sides: Sides,
        then: U,
    ) -> Option<U::Output> {
        let normal = self.normal();
        let rise = rise(self, normal, from);
        if !faces(rise, sides) {
            return None;
        }
        let radius = num::sqrt(self.axis_u().length_squared().max(self.axis_v().length_squared()));
        match method.required(from, self.centre(), radius, SurfaceDensity::Area) {
            SurfaceDensity::Area => then.with(AreaView::new(*self, from), View::Area),
            _ => then.with(DiskSlab::new(self, from, normal, rise)?, View::SolidAngle),
        }
    }

    fn projected_solid_angle(&self, from: &Receiver, sides: Sides) -> Option<f32> {
        Some(if faces(rise(self, self.normal(), from), sides) { irradiance::disk(from, self) } else { 0.0 })
    }
}
