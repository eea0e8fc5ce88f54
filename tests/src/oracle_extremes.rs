//! Closed forms in double precision that keep their digits at the extremes: for lights a million
//! sizes away, a thousandth of a radian above their plane, or cut to a sliver by the horizon.
//!
//! Radiance is 1 throughout. The tests below compare each with its plainer sister in
//! [`crate::oracle`] where that one is exact too.

use halflight::glam::DVec3;
use std::f64::consts::PI;

/// Solid angle of a convex polygon seen from the front, by its fan of triangles.
///
/// Source: Van Oosterom and Strackee 1983, *The Solid Angle of a Plane Triangle*, equation 8.
/// Differs: the triple product is that of one corner and two edges, which does not cancel for a
/// distant polygon.
#[must_use]
pub fn polygon_solid_angle(point: DVec3, corners: &[DVec3]) -> f64 {
    let triangle = |b: DVec3, c: DVec3| {
        let (ra, rb, rc) = (corners[0] - point, b - point, c - point);
        let (la, lb, lc) = (ra.length(), rb.length(), rc.length());
        let volume = ra.dot((b - corners[0]).cross(c - corners[0]));
        2.0 * volume.abs().atan2(la * lb * lc + ra.dot(rb) * lc + rb.dot(rc) * la + rc.dot(ra) * lb)
    };
    corners[1..].windows(2).map(|pair| triangle(pair[0], pair[1])).sum()
}

/// Irradiance from a polygon, cut at the horizon.
///
/// Source: Lambert 1760; Schröder and Hanrahan 1993. Differs: each edge's cross product is formed
/// from the edge itself, which does not cancel for a distant polygon.
#[must_use]
pub fn polygon_irradiance(point: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let above = above_horizon(point, normal, corners);
    let next = above.iter().cycle().skip(1);
    let edge = |(a, b): (&DVec3, &DVec3)| {
        let across = a.cross(*b - *a);
        let sine = across.length();
        if sine > 0.0 { sine.atan2(a.dot(*b)) * normal.dot(across) / sine } else { 0.0 }
    };
    0.5 * above.iter().zip(next).map(edge).sum::<f64>().abs()
}

/// The part of a polygon above the plane of the receiver, relative to it.
fn above_horizon(point: DVec3, normal: DVec3, corners: &[DVec3]) -> Vec<DVec3> {
    let mut above = Vec::new();
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (a, b) = (*a - point, *b - point);
        let (da, db) = (normal.dot(a), normal.dot(b));
        if da > 0.0 {
            above.push(a);
        }
        if (da > 0.0) != (db > 0.0) {
            above.push(a + (b - a) * (da / (da - db)));
        }
    }
    above
}

/// Irradiance from a sphere seen from outside, cut at the horizon.
///
/// * `s` – sine of its angular radius, below 1
/// * `c` – cosine between the receiver's normal and the direction to its centre
///
/// Source: Snyder 1996, *Area Light Sources for Real-Time Graphics*. Differs: regrouped around
/// `w − atan w`, which is taken from its series where it cancels.
#[must_use]
pub fn sphere_irradiance(s: f64, c: f64) -> f64 {
    if c >= s {
        return PI * s * s * c;
    }
    if c <= -s {
        return 0.0;
    }
    let t = c / s;
    let (r, k) = (((1.0 - t) * (1.0 + t)).sqrt(), ((1.0 - s) * (1.0 + s)).sqrt());
    let w = r * s / k;
    c * s * s * r.atan2(-t * k) + w * s * s - minus_arctangent(w)
}

/// `w − atan w` for `w ≥ 0`, without cancellation.
fn minus_arctangent(w: f64) -> f64 {
    if w > 0.5 {
        return w - w.atan();
    }
    // w³/3 − w⁵/5 + …: 27 terms reach 0.5⁵⁵.
    (1..28).map(|n| -(-1.0_f64).powi(n) * w.powi(2 * n + 1) / f64::from(2 * n + 1)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::oracle;

    #[track_caller]
    fn agree(a: f64, b: f64, tolerance: f64) {
        assert!((a - b).abs() <= tolerance * b.abs(), "{a} {b}");
    }

    #[test]
    fn polygons_are_those_of_the_plain_forms() {
        let corners = [DVec3::new(-1.0, 2.0, 0.4), DVec3::new(2.0, 1.0, 0.6), DVec3::new(0.5, -1.0, 3.0)];
        let p = DVec3::new(0.1, 0.2, -0.5);
        agree(polygon_solid_angle(p, &corners), oracle::triangle_solid_angle(p, corners), 1e-14);
        for n in [DVec3::new(0.1, -0.1, 1.0), DVec3::new(1.0, 0.0, 0.1), DVec3::NEG_Z] {
            let n = n.normalize();
            agree(polygon_irradiance(p, n, &corners), oracle::polygon_irradiance(p, n, &corners), 1e-14);
        }
    }

    #[test]
    fn distant_polygons_are_their_area_over_the_square_of_the_distance() {
        for distance in [1e4, 1e6] {
            let square = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
            let corners = square.map(|(x, y)| DVec3::new(x, y, distance));
            let small = 1.0 / (distance * distance);
            agree(polygon_solid_angle(DVec3::ZERO, &corners), small, 1e-8);
            let n = DVec3::new(0.6, 0.0, 0.8);
            agree(polygon_irradiance(DVec3::ZERO, n, &corners), 0.8 * small, 1e-8);
        }
    }

    #[test]
    fn spheres_are_those_of_the_plain_form_and_of_their_limits() {
        for sigma in [0.2, 0.7, 1.4_f64] {
            for t in [-0.9, -0.3, 0.0, 0.5, 0.99] {
                let c = t * sigma.sin();
                agree(sphere_irradiance(sigma.sin(), c), oracle::sphere(sigma, c), 1e-10);
            }
        }
        // Half of a small sphere: the first moment of half a disk, 2 s³ / 3.
        for s in [1e-3, 1e-6] {
            agree(sphere_irradiance(s, 0.0), 2.0 / 3.0 * s * s * s, 1e-5);
        }
    }
}
