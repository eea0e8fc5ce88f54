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
    let (point, normal) = (from.point.as_dvec3(), from.normal.as_dvec3());
    let mut kept = Vec::new();
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (za, zb) = (normal.dot(*a - point), normal.dot(*b - point));
        if za > 0.0 {
            kept.push(*a);
        }
        if (za > 0.0) != (zb > 0.0) {
            kept.push(*a + (*b - *a) * (za / (za - zb)));
        }
    }
    kept
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

/// Solid angle of the whole (sr).
pub(crate) fn solid_angle_all(from: &Receiver, corners: &[DVec3]) -> f64 {
    let corners: Vec<DVec3> = corners.iter().map(|c| *c - from.point.as_dvec3()).collect();
    (1..corners.len() - 1).map(|i| triangle_solid_angle(corners[0], corners[i], corners[i + 1])).sum()
}

/// Solid angle of the part above the horizon (sr).
pub(crate) fn solid_angle(from: &Receiver, corners: &[DVec3]) -> f64 {
    let point = from.point.as_dvec3();
    let corners: Vec<DVec3> = above(from, corners).iter().map(|c| *c - point).collect();
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

/// Where the direction `wi` is in the polygon above the horizon: the share of the projected solid
/// angle clockwise of its azimuth, seen from the zenith, and the share of `sin² θ` of its meridian
/// that is nearer to the horizon.
pub(crate) fn meridian(from: &Receiver, corners: &[DVec3], _at: DVec3, wi: DVec3) -> (f64, f64) {
    let (point, normal) = (from.point.as_dvec3(), from.normal.as_dvec3());
    let side = normal.cross(wi).normalize();
    let above = above(from, corners);
    let (mut before, mut crossing) = (Vec::new(), Vec::new());
    for (a, b) in above.iter().zip(above.iter().cycle().skip(1)) {
        let (sa, sb) = (side.dot(*a - point), side.dot(*b - point));
        if sa < 0.0 {
            before.push(*a);
        }
        if (sa < 0.0) != (sb < 0.0) {
            let cut = *a + (*b - *a) * (sa / (sa - sb));
            before.push(cut);
            crossing.push((cut - point).normalize());
        }
    }
    let share = projected_solid_angle(from, &before) / projected_solid_angle(from, &above);
    let sin2 = |w: DVec3| w.cross(normal).length_squared();
    // From the horizon's end to the zenith's.
    crossing.sort_by(|a, b| sin2(*b).total_cmp(&sin2(*a)));
    let [outer, inner] = crossing[..] else { return (share, f64::NAN) };
    if outer.cross(normal).dot(inner.cross(normal)) < 0.0 {
        let ahead = if outer.cross(normal).dot(wi.cross(normal)) > 0.0 { outer } else { inner };
        return (f64::NAN, 1.0 - sin2(wi) / sin2(ahead));
    }
    (share, (sin2(outer) - sin2(wi)) / (sin2(outer) - sin2(inner)))
}
