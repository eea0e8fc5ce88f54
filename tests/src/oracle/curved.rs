//! Ellipses, spheres and tubes about a receiver at the origin, in coordinates `(s, t)` of which `t`
//! is a turn: points are of first degree in `cos t` and `sin t`.

use super::adaptive::Place;
use super::outlook::{Amounts, Edges, find, graded};
use super::{PI, TAU};
use halflight::glam::DVec3;

/// A surface; places are relative to the receiver (m).
#[derive(Debug, Clone, Copy)]
pub(super) enum Curved {
    /// `s` is the radius in `[0, 1]`, `t` the turn from `u` to `v`.
    Ellipse { centre: DVec3, u: DVec3, v: DVec3 },
    /// `s` is the angle at the centre from the axis (rad), which points to the receiver; `t` turns
    /// about it.
    Sphere { centre: DVec3, axes: [DVec3; 3], radius: f64 },
    /// `s` is the height in `[0, 1]`, `t` the turn about the axis from the receiver's side.
    Tube { base: DVec3, axis: DVec3, across: [DVec3; 2], radius: f64 },
}

impl Curved {
    pub(super) fn sphere(centre: DVec3, radius: f64) -> Self {
        let z = (-centre).normalize_or(DVec3::Z);
        let x = z.any_orthonormal_vector();
        Self::Sphere { centre, axes: [x, z.cross(x), z], radius }
    }

    pub(super) fn tube(base: DVec3, axis: DVec3, radius: f64) -> Self {
        let z = axis.normalize();
        let x = (base.dot(z) * z - base).normalize_or(z.any_orthonormal_vector());
        Self::Tube { base, axis, across: [x, z.cross(x)], radius }
    }

    /// The same seen from `offset`. A sphere's axis stays where it was.
    fn from(self, offset: DVec3) -> Self {
        match self {
            Self::Ellipse { centre, u, v } => Self::Ellipse { centre: centre - offset, u, v },
            Self::Sphere { centre, radius, .. } => Self::sphere(centre - offset, radius),
            Self::Tube { base, axis, radius, .. } => Self::tube(base - offset, axis, radius),
        }
    }

    fn at(&self, s: f64, t: f64) -> Place {
        let (sin, cos) = t.sin_cos();
        match *self {
            Self::Ellipse { centre, u, v } => {
                let n = u.cross(v);
                (centre + (u * cos + v * sin) * s, n.normalize(), n.length() * s)
            }
            Self::Sphere { centre, axes: [x, y, z], radius } => {
                let (across, along) = s.sin_cos();
                let n = z * along + (x * cos + y * sin) * across;
                (centre + n * radius, n, radius * radius * across)
            }
            Self::Tube { base, axis, across: [x, y], radius } => {
                let n = x * cos + y * sin;
                (base + axis * s + n * radius, n, radius * axis.length())
            }
        }
    }

    /// What faces the receiver, as ranges of `s` and `t`; `None` when nothing does.
    fn facing(&self) -> Option<[[f64; 2]; 2]> {
        match *self {
            Self::Ellipse { centre, u, v } => {
                (u.cross(v).dot(centre) < 0.0).then_some([[0.0, 1.0], [0.0, TAU]])
            }
            Self::Sphere { centre, radius, .. } => {
                tangent(centre.length(), radius).map(|s| [[0.0, s], [0.0, TAU]])
            }
            Self::Tube { base, axis, radius, .. } => {
                let z = axis.normalize();
                tangent((base - z * base.dot(z)).length(), radius).map(|t| [[0.0, 1.0], [-t, t]])
            }
        }
    }

    /// True when all of it is above the horizon, surely.
    fn is_above(&self, normal: DVec3) -> bool {
        match *self {
            Self::Ellipse { centre, u, v } => normal.dot(centre) > normal.dot(u).hypot(normal.dot(v)),
            Self::Sphere { centre, radius, .. } => normal.dot(centre) > radius,
            Self::Tube { base, axis, radius, .. } => normal.dot(base).min(normal.dot(base + axis)) > radius,
        }
    }

    /// Edges of cells along `s` and `t`, in shares of what faces the receiver.
    fn cells(&self) -> [Edges; 2] {
        let quarters = graded(0.0, 1.0, 0.5, 1e6);
        match *self {
            Self::Ellipse { centre, u, v } => {
                let n = u.cross(v).normalize();
                let p = self.coordinates(n * n.dot(centre));
                let height = (n.dot(centre).abs() / u.length()).hypot((p[0] - 1.0).max(0.0));
                [graded(0.0, 1.0, p[0].min(1.0), height), quarters]
            }
            Self::Sphere { centre, radius, .. } => {
                let gap = centre.length() - radius;
                let rim = tangent(centre.length(), radius).unwrap_or(1.0);
                [graded(0.0, 1.0, 0.0, gap / (radius * rim)), quarters]
            }
            Self::Tube { base, axis, radius, .. } => {
                let z = axis.normalize();
                let gap = (base - z * base.dot(z)).length() - radius;
                let rim = tangent(gap + radius, radius).unwrap_or(1.0);
                let height = -base.dot(z) / axis.length();
                let turns = graded(0.0, 1.0, 0.5, 0.5 * gap / (radius * rim));
                [graded(0.0, 1.0, height, gap / axis.length()), turns]
            }
        }
    }

    /// Surface coordinates of a place.
    fn coordinates(&self, place: DVec3) -> [f64; 2] {
        match *self {
            Self::Ellipse { centre, u, v } => {
                let r = place - centre;
                let (a, b) = (r.dot(u) / u.length_squared(), r.dot(v) / v.length_squared());
                [a.hypot(b), b.atan2(a).rem_euclid(TAU)]
            }
            Self::Sphere { centre, axes: [x, y, z], .. } => {
                let [a, b, c] = [x, y, z].map(|axis| axis.dot(place - centre));
                [a.hypot(b).atan2(c), b.atan2(a).rem_euclid(TAU)]
            }
            Self::Tube { base, axis, across: [x, y], .. } => {
                let r = place - base;
                [r.dot(axis) / axis.length_squared(), r.dot(y).atan2(r.dot(x))]
            }
        }
    }

    /// Where between `a` and `b` the horizon cuts the line of constant `t`.
    fn horizon(&self, normal: DVec3, t: f64, [a, b]: [f64; 2]) -> f64 {
        let above = |s: f64| normal.dot(self.at(s, t).0);
        match *self {
            Self::Sphere { centre, axes: [x, y, _], radius } => {
                // On one side of the axis the horizon is one direction, at α from the axis.
                let (sin, cos) = t.sin_cos();
                let (along, across) = (normal.dot(centre), normal.dot(x * cos + y * sin));
                let alpha = (along.abs() / centre.length()).atan2(across.abs());
                let sin_at_surface = (centre.length() / radius * alpha.sin()).min(1.0);
                (sin_at_surface.asin() - alpha).clamp(a, b)
            }
            _ => {
                let (at_a, at_b) = (above(a), above(b));
                a + (b - a) * (at_a / (at_a - at_b)).clamp(0.0, 1.0)
            }
        }
    }
}

/// Angle between the way to the receiver and to where its view touches a circle; `None` from inside.
fn tangent(distance: f64, radius: f64) -> Option<f64> {
    let square = (distance - radius) * (distance + radius);
    (distance > radius).then(|| square.sqrt().atan2(radius))
}

/// A curved surface and its cells.
#[derive(Debug, Clone)]
pub(super) struct Round {
    shape: Curved,
    cells: [Edges; 2],
}

impl Round {
    pub(super) fn new(shape: Curved) -> Self {
        Self { shape, cells: shape.cells() }
    }

    pub(super) fn cell(&self, place: DVec3) -> [usize; 2] {
        let Some(ranges) = self.shape.facing() else { return [0; 2] };
        let at = self.shape.coordinates(place);
        [0, 1].map(|i| {
            let [low, high] = ranges[i];
            find(&self.cells[i], (at[i] - low) / (high - low))
        })
    }

    /// What is seen of a cell from `offset`.
    pub(super) fn seen(&self, offset: DVec3, normal: DVec3, cell: [usize; 2]) -> Amounts {
        let mut amounts = Amounts::default();
        let shape = self.shape.from(offset);
        let Some(ranges) = shape.facing() else { return amounts };
        let [s, t] = [0, 1].map(|i| {
            let ([low, high], k) = (ranges[i], cell[i]);
            [k, k + 1].map(|k| low + (high - low) * self.cells[i][k])
        });
        if s[0] >= s[1] || t[0] >= t[1] {
            return amounts;
        }
        let (ds, dt) = (s[1] - s[0], t[1] - t[0]);
        let whole = |x: f64, y: f64| {
            let (p, n, area) = shape.at(s[0] + ds * x, t[0] + dt * y);
            (p, n, area * ds * dt)
        };
        if shape.is_above(normal) {
            amounts.add(normal, &whole);
            return amounts;
        }
        amounts.add_facing(&whole);
        let breaks = breaks(&shape, normal, s, t);
        for piece in breaks.windows(2) {
            add_piece(&mut amounts, &shape, normal, s, [piece[0], piece[1]]);
        }
        amounts
    }
}

/// The turns between `t[0]` and `t[1]` at which the horizon leaves a cell through its ends, with both
/// bounds: between two of them it is met on each line of constant `t`, or on none. About the short
/// axis of an ellipse there are more: there the cut runs from the rim to the centre within a turn
/// that is as small as the ellipse is narrow.
fn breaks(shape: &Curved, normal: DVec3, s: [f64; 2], t: [f64; 2]) -> Vec<f64> {
    let mut breaks = vec![t[0], t[1]];
    for end in s {
        // Height above the horizon along this end: m + a cos t + b sin t.
        let above = |t: f64| normal.dot(shape.at(end, t).0);
        let (front, back) = (above(0.0), above(PI));
        let m = 0.5 * (front + back);
        let (a, b) = (0.5 * (front - back), above(0.5 * PI) - m);
        let cosine = -m / a.hypot(b);
        if cosine.abs() <= 1.0 {
            let (middle, off) = (b.atan2(a), cosine.acos());
            for root in [middle - off, middle + off] {
                let turned = t[0] + (root - t[0]).rem_euclid(TAU);
                if turned < t[1] {
                    breaks.push(turned);
                }
            }
        }
    }
    if let Curved::Ellipse { u, v, .. } = shape {
        let (ratio, short) = (u.length() / v.length(), if u.length() > v.length() { 0.5 * PI } else { 0.0 });
        let mut off = 0.5;
        while off > 0.1 * ratio.min(1.0 / ratio) {
            for root in [short - off, short + off, short + PI - off, short + PI + off] {
                let turned = t[0] + (root - t[0]).rem_euclid(TAU);
                if turned < t[1] {
                    breaks.push(turned);
                }
            }
            off *= 0.5;
        }
    }
    breaks.sort_by(f64::total_cmp);
    breaks
}

/// Parts of a piece that the horizon cuts: its map is no longer of low degree.
const PARTS: usize = 4;

/// Takes in what is above the horizon between two breaks.
fn add_piece(amounts: &mut Amounts, shape: &Curved, normal: DVec3, s: [f64; 2], t: [f64; 2]) {
    let dt = t[1] - t[0];
    let middle = t[0] + 0.5 * dt;
    let [low, high] = s.map(|s| normal.dot(shape.at(s, middle).0) > 0.0);
    if dt <= 0.0 || !(low || high) {
        return;
    }
    if low && high {
        let ds = s[1] - s[0];
        return amounts.add_lit(normal, &|x, y| {
            let (p, n, area) = shape.at(s[0] + ds * x, t[0] + dt * y);
            (p, n, area * ds * dt)
        });
    }
    for part in 0..PARTS {
        amounts.add_lit(normal, &|x, y| {
            // Slow at both ends, where the horizon may leave the cell with a vertical tangent.
            let y = (part as f64 + y) / PARTS as f64;
            let t = t[0] + dt * y * y * (3.0 - 2.0 * y);
            let rate = 6.0 * y * (1.0 - y) * dt / PARTS as f64;
            let horizon = shape.horizon(normal, t, s);
            let (from, to) = if low { (s[0], horizon) } else { (horizon, s[1]) };
            let (p, n, area) = shape.at(from + (to - from) * x, t);
            (p, n, area * rate * (to - from))
        });
    }
}
