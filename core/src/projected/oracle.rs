//! The truth in double precision, for tests.

use crate::light::Receiver;
use glam::{DVec3, Vec3};
use std::vec::Vec;

/// Nodes and weights of Gauss's rule with five points on `[0, 1]`.
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_095),
    (0.230_765_344_947_158, 0.239_314_335_249_683),
    (0.5, 0.284_444_444_444_444),
    (0.769_234_655_052_842, 0.239_314_335_249_683),
    (0.953_089_922_969_332, 0.118_463_442_528_095),
];

/// The part of the polygon above the receiver's horizon.
fn above(from: &Receiver, corners: &[DVec3]) -> Vec<DVec3> {
    beside(from.point.as_dvec3(), from.normal.as_dvec3(), corners)
}

/// Projected solid angle of a polygon (sr), to eight digits.
///
/// The sum over the edges (Lambert 1760), or for a small one, where that cancels, the integral over
/// the surface.
pub(crate) fn projected_solid_angle(from: &Receiver, corners: &[DVec3]) -> f64 {
    let corners = above(from, corners);
    let (point, normal) = (from.point.as_dvec3(), from.normal.as_dvec3());
    let next = corners.iter().cycle().skip(1);
    let edges = corners.iter().zip(next).map(|(a, b)| edge(normal, *a - point, *b - *a));
    let sum = 0.5 * edges.sum::<f64>().abs();
    if sum > 1e-5 {
        return sum;
    }
    let integral = |i: usize| {
        let edges = [corners[i - 1] - corners[0], corners[i] - corners[0]];
        integral(normal, corners[0] - point, edges, 40)
    };
    (2..corners.len()).map(integral).sum()
}

fn edge(normal: DVec3, a: DVec3, along: DVec3) -> f64 {
    let across = a.cross(along);
    let length = across.length();
    if length > 0.0 { length.atan2(a.dot(a + along)) * normal.dot(across) / length } else { 0.0 }
}

/// `∫ cos θ cos θ' / d² dA` over a triangle with a corner at `a` and the edges from there.
fn integral(normal: DVec3, a: DVec3, [u, v]: [DVec3; 2], depth: u32) -> f64 {
    let (lu, lv, lw) = (u.length(), v.length(), (u - v).length());
    let longest = lu.max(lv).max(lw);
    if longest > 0.3 * ((a + (u + v) / 3.0).length() - longest) && depth > 0 {
        let halves = if longest == lw {
            let m = (u + v) * 0.5;
            [(a, [u, m]), (a, [m, v])]
        } else if longest == lu {
            [(a, [u * 0.5, v]), (a + u * 0.5, [u * 0.5, v - u * 0.5])]
        } else {
            [(a, [u, v * 0.5]), (a + v * 0.5, [u - v * 0.5, v * 0.5])]
        };
        return halves.into_iter().map(|(a, edges)| integral(normal, a, edges, depth - 1)).sum();
    }
    let volume = a.dot(u.cross(v)).abs();
    let mut sum = 0.0;
    for (s, ws) in GAUSS {
        for (t, wt) in GAUSS {
            let p = a + u * s + (v - u) * (s * t);
            sum += ws * wt * s * normal.dot(p) / p.length_squared().powi(2);
        }
    }
    sum * volume
}

/// Solid angle of the whole, above the horizon and below (sr).
pub(crate) fn solid_angle(from: &Receiver, corners: &[DVec3]) -> f64 {
    let point = from.point.as_dvec3();
    let corners: Vec<DVec3> = corners.iter().map(|c| *c - point).collect();
    (2..corners.len()).map(|i| triangle_solid_angle(corners[0], corners[i - 1], corners[i])).sum()
}

/// Source: Van Oosterom and Strackee 1983.
fn triangle_solid_angle(a: DVec3, b: DVec3, c: DVec3) -> f64 {
    let volume = a.dot((b - a).cross(c - a)).abs();
    let (la, lb, lc) = (a.length(), b.length(), c.length());
    2.0 * volume.atan2(la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb)
}

/// Corners in double precision.
pub(crate) fn double(corners: &[Vec3]) -> Vec<DVec3> {
    corners.iter().map(|c| c.as_dvec3()).collect()
}

/// The part of a polygon on the side of a plane through `point` that `side` points to.
fn beside(point: DVec3, side: DVec3, corners: &[DVec3]) -> Vec<DVec3> {
    let mut kept = Vec::new();
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (da, db) = (side.dot(*a - point), side.dot(*b - point));
        if da > 0.0 {
            kept.push(*a);
        }
        if (da > 0.0) != (db > 0.0) {
            kept.push(*a + (*b - *a) * (da / (da - db)));
        }
    }
    kept
}

/// Share of the projected solid angle whose azimuth is from `start` on to that of `wi`, counter-clockwise
/// about the normal; from the first edge on when the polygon is beside the zenith.
pub(crate) fn share_before(from: &Receiver, corners: &[DVec3], start: DVec3, wi: DVec3) -> f64 {
    let (point, normal) = (from.point.as_dvec3(), from.normal.as_dvec3());
    let above = above(from, corners);
    let share = |part: &[DVec3]| projected_solid_angle(from, part) / projected_solid_angle(from, &above);
    let before = beside(point, -normal.cross(wi), &above);
    if !is_around(from, &above) {
        return share(&before);
    }
    let after_start = normal.cross(start);
    if after_start.dot(wi) > 0.0 {
        share(&beside(point, after_start, &before))
    } else {
        1.0 - share(&beside(point, -after_start, &beside(point, normal.cross(wi), &above)))
    }
}

/// Whether the normal meets the polygon.
fn is_around(from: &Receiver, corners: &[DVec3]) -> bool {
    let (point, normal) = (from.point.as_dvec3(), from.normal.as_dvec3());
    let next = corners.iter().cycle().skip(1);
    let turns = corners.iter().zip(next).map(|(a, b)| normal.dot((*a - point).cross(*b - *a)));
    let (low, high) = turns.fold((0.0_f64, 0.0_f64), |(low, high), t| (low.min(t), high.max(t)));
    low == 0.0 || high == 0.0
}

/// `sin² θ` at the lower end of the polygon's part of the meridian of `wi`, and at its upper end.
pub(crate) fn meridian(from: &Receiver, corners: &[DVec3], wi: DVec3) -> [f64; 2] {
    let (point, normal) = (from.point.as_dvec3(), from.normal.as_dvec3());
    let above = above(from, corners);
    let (side, ahead) = (normal.cross(wi), normal.cross(wi).cross(normal));
    let mut ends = Vec::new();
    for (a, b) in above.iter().zip(above.iter().cycle().skip(1)) {
        let (a, b) = (*a - point, *b - point);
        let (da, db) = (side.dot(a), side.dot(b));
        let cut = (a + (b - a) * (da / (da - db))).normalize();
        if (da > 0.0) != (db > 0.0) && ahead.dot(cut) > 0.0 {
            ends.push(cut.cross(normal).length_squared());
        }
    }
    if is_around(from, &above) {
        ends.push(0.0);
    }
    [ends.iter().copied().fold(0.0, f64::max), ends.iter().copied().fold(1.0, f64::min)]
}
