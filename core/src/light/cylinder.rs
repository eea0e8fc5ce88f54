//! Sampling an open cylinder.

use super::{
    AreaView, NoView, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceSample, SurfaceView, UseView,
    View,
};
use crate::geom::{Frame, unit};
use crate::num::lanes::{self, Lane, Number};
use crate::num::{self, TAU};
use crate::shape::{Cylinder, SurfacePoint};
use crate::solid_angle::{FromEnd, Span, Sweep};
use glam::{DVec3, Vec3};

/// The side of a tube that faces the receiver, close to uniform over its solid angle: the plane's
/// angle about a parallel of the tube's axis through the receiver is drawn from a table; the
/// elevation's sine uniformly over the line of the wall that is seen at that angle.
///
/// Derived: as for a disk, the density is exact whatever the table holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CylinderSlab {
    lines: Lines,
    sweep: Sweep,
}

/// How the tube lies before the receiver, and the lines of its wall.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Lines {
    tube: Cylinder,
    /// Along the tube's axis, to it, and across both.
    axis: Vec3,
    toward: Vec3,
    across: Vec3,
    /// Lower end above the receiver, and length (m).
    start: f32,
    length: f32,
    /// Distance of the receiver from the tube's axis, and from its wall (m); the latter negative inside.
    distance: f32,
    gap: f32,
    /// Whether it is the inner wall that is seen, from within.
    inside: bool,
}

/// A receiver in the coordinates of a tube's axis.
///
/// In double precision: a milliradian above the wall and a thousand lengths away, or close to a wall
/// whose axis is not along one of the coordinates, single precision does not know on which side of it
/// the receiver is.
struct Foot {
    /// Unit vectors along the axis, and to it from the receiver.
    axis: DVec3,
    toward: Option<DVec3>,
    /// Height of the lower end above the receiver, length, and distance from the axis (m).
    start: f64,
    length: f64,
    distance: f64,
}

impl Foot {
    #[inline]
    fn new(tube: &Cylinder, from: &Receiver) -> Self {
        let axis = tube.axis().as_dvec3();
        let length = axis.length();
        let axis = axis / length;
        let to_base = tube.base().as_dvec3() - from.point.as_dvec3();
        let start = axis.dot(to_base);
        let aside = to_base - axis * start;
        let distance = aside.length();
        let toward = (distance > 0.0).then(|| aside / distance);
        Self { axis, toward, start, length, distance }
    }

    /// How far outside of the wall, which goes on for ever, the receiver is (m); negative inside.
    #[inline]
    fn gap(&self, tube: &Cylinder) -> f32 {
        (self.distance - f64::from(tube.radius())) as f32
    }
}

impl CylinderSlab {
    /// * `inside` – whether it is the inner wall that is seen, from within
    #[inline]
    fn new(tube: &Cylinder, foot: &Foot, inside: bool) -> Option<Self> {
        let lines = Lines::new(tube, foot, inside);
        // A right angle from the wall itself; less from afar.
        let tangent = num::sqrt(lines.gap * (lines.distance + tube.radius()));
        let half = if inside { 1.0 } else { tube.radius() / (tangent + lines.distance) };
        let seen = lanes::map(Sweep::turns(half), |turns| lines.seen(half, turns));
        Some(Self { lines, sweep: Sweep::new(half, [seen; 2])? })
    }
}

impl Lines {
    #[inline]
    fn new(tube: &Cylinder, foot: &Foot, inside: bool) -> Self {
        let axis = foot.axis.as_vec3();
        let toward = foot.toward.map_or(Frame::from_normal(axis).s, |v| v.as_vec3());
        let (mut gap, mut distance) = (foot.gap(tube), foot.distance as f32);
        if inside && gap > 0.0 {
            (gap, distance) = (0.0, tube.radius());
        }
        Self {
            tube: *tube,
            axis,
            toward,
            across: axis.cross(toward),
            start: foot.start as f32,
            length: foot.length as f32,
            distance,
            gap,
            inside,
        }
    }

    /// Solid angle per turn at some turns from either end: as [`Lines::angle_at`] and
    /// [`Lines::line_at`], several at a time.
    #[inline]
    fn seen(&self, half: f32, turns: Lane) -> Lane {
        let (d, r) = (self.distance, self.tube.radius());
        let z = Lane::of(half) - turns;
        let scale = (z * z + 1.0).recip() * 2.0;
        let (sin, cos) = (z * scale, (1.0 - z) * (z + 1.0) * 0.5 * scale);
        let (sin, cos, rate) = if self.inside {
            (sin * cos * 2.0, 1.0 - sin * sin * 2.0, scale * 2.0)
        } else {
            (sin, cos, scale)
        };
        let half_chord = ((r - sin * d) * (sin * d + r)).root();
        let (power, middle) = (self.gap * (d + r), cos * d);
        let away = if self.gap > 0.0 {
            power / (middle + half_chord)
        } else {
            middle.if_positive(middle + half_chord, -power / (half_chord - middle))
        };
        Span::extents(Lane::of(self.start), Lane::of(self.length), away) * rate
    }

    /// Sine and cosine of the plane's angle `α` at a turn, and the angle per turn. A turn is
    /// `z = tan(α / 2)`; inside, where `α` goes all the way round, `tan(α / 4)`.
    #[inline]
    fn angle_at(&self, z: f32) -> ([f32; 2], f32) {
        let scale = 2.0 / (1.0 + z * z);
        let (sin, cos) = (z * scale, (1.0 - z) * (1.0 + z) * 0.5 * scale);
        if self.inside {
            ([2.0 * sin * cos, 1.0 - 2.0 * sin * sin], 2.0 * scale)
        } else {
            ([sin, cos], scale)
        }
    }

    /// The line of the wall at the sine and cosine of a plane's angle, and its unit direction from the
    /// tube's axis in the local axes `toward` and `across`.
    #[inline]
    fn line_at(&self, [sin, cos]: [f32; 2]) -> (Span, [f32; 2]) {
        let (d, r) = (self.distance, self.tube.radius());
        let half_chord = num::sqrt((r - d * sin) * (r + d * sin));
        // Product of the distances to both ends of the chord: (d − r)(d + r).
        let power = self.gap * (d + r);
        let middle = d * cos;
        let away = if self.gap > 0.0 {
            power / (middle + half_chord)
        } else if middle > 0.0 {
            middle + half_chord
        } else {
            -power / (half_chord - middle)
        };
        // From the axis: its own direction is t (cos, sin) − (d, 0).
        let side = if self.gap > 0.0 { -half_chord } else { half_chord };
        let out = [(side * cos - d * sin * sin) / r, sin * (away / r)];
        (self.span(away), out)
    }

    #[inline]
    fn span(&self, away: f32) -> Span {
        Span { start: self.start, length: self.length, away }
    }

    /// The line of the wall through a point, its turn, and the angle per turn.
    ///
    /// * `half` – half of the width of the sweep
    #[inline]
    fn line_through(&self, at: &SurfacePoint, half: f32) -> (Span, FromEnd, f32) {
        let n = if self.tube.is_inward() { -at.normal } else { at.normal };
        let (cos, sin) = (-n.dot(self.toward), n.dot(self.across));
        let r = self.tube.radius();
        // d − r cos φ, without its cancellation close to the wall.
        let versine = if cos > 0.0 { sin * sin / (1.0 + cos) } else { 1.0 - cos };
        let (x, y) = (self.gap + r * versine, r * sin);
        let away = num::sqrt(x * x + y * y);
        // Tangent of half the angle, or its inverse.
        let tangent = y.abs() / (away + x.abs());
        let z = match (self.inside, x < 0.0) {
            (false, _) => tangent,
            (true, false) => tangent / (1.0 + num::sqrt(1.0 + tangent * tangent)),
            (true, true) => 1.0 / (tangent + num::sqrt(1.0 + tangent * tangent)),
        };
        let turn = FromEnd { turn: half - z, low: y < 0.0 };
        (self.span(away), turn, self.angle_at(z).1)
    }
}

impl SurfaceView for CylinderSlab {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        let Lines { tube, axis, toward, across, .. } = &self.lines;
        let turn = self.sweep.sample(u[0]);
        let z = self.sweep.half() - turn.turn;
        let ([sin, cos], _) = self.lines.angle_at(if turn.low { -z } else { z });
        let (span, out) = self.lines.line_at([sin, cos]);
        if !(span.away > 0.0) {
            return None;
        }
        let (y, fraction) = span.at(u[1]);
        let n = unit(*toward * out[0] + *across * out[1])?;
        let distance = num::sqrt(y * y + span.away * span.away);
        let plane = *toward * cos + *across * sin;
        let wi = unit(*axis * (y / distance) + plane * (span.away / distance))?;
        Some(SurfaceSample { at: tube.point(fraction, n), wi, distance })
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn pdf_solid_angle(&self, at: &SurfacePoint, _: Vec3, _: f32) -> Option<f32> {
        let (span, turn, rate) = self.lines.line_through(at, self.sweep.half());
        let pdf = self.sweep.pdf(turn) / (span.extent() * rate);
        (pdf > 0.0 && pdf.is_finite()).then_some(pdf)
    }

    fn invert(&self, at: &SurfacePoint, _: Vec3) -> Option<[f32; 2]> {
        let (span, turn, _) = self.lines.line_through(at, self.sweep.half());
        let (fraction, _) = self.lines.tube.coordinates(at.point);
        let u = [self.sweep.share(turn), span.share(fraction.clamp(0.0, 1.0))];
        u.iter().all(|x| x.is_finite()).then(|| u.map(num::clamp_unit))
    }
}

impl SampledShape for Cylinder {
    type View = View<Self, CylinderSlab, NoView>;

    /// Density `1 / (2π r l)` (m⁻²); `u[0]` is the height, `u[1]` the turn around the axis.
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        let frame = Frame::from_normal(self.unit_axis());
        let (sin, cos) = num::sin_cos_near(TAU * u[1]);
        self.point(u[0], frame.s * cos + frame.t * sin)
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (h, n) = self.coordinates(point);
        let frame = Frame::from_normal(self.unit_axis());
        let turn = num::atan2(n.dot(frame.t), n.dot(frame.s)) / TAU;
        let turn = if turn < 0.0 { turn + 1.0 } else { turn };
        [h, turn].map(num::clamp_unit)
    }

    /// By area where the inner wall is seen through an open end, and where both sides emit.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn with_view<U: UseView<Self::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        sides: Sides,
        then: U,
    ) -> Option<U::Output> {
        let foot = Foot::new(self, from);
        let gap = foot.gap(self);
        let outward = !self.is_inward();
        // Its own points do not see an outer wall; an inner one they do, on whichever side they are.
        let reach = self.base().length() + self.axis().length() + self.radius();
        let inside = gap < num::gamma(10) * reach;
        if sides == Sides::Front && outward && !(gap > 0.0) {
            return None;
        }
        let (centre, radius) = (self.base() + self.axis() * 0.5, 0.5 * self.axis().length() + self.radius());
        let method = method.required(from, centre, radius, SurfaceDensity::Area);
        if method == SurfaceDensity::Area || sides == Sides::Both || !(outward || inside) {
            return then.with(AreaView::new(*self, from), View::Area);
        }
        then.with(CylinderSlab::new(self, &foot, !outward)?, View::SolidAngle)
    }
}
