//! Outlines: chains of points in the plane, and their normals.

use crate::num;
use glam::Vec2;
use std::vec::Vec;

/// Cosine of the turn beyond which two neighbouring edges meet in a crease: 32°.
const CREASE_COS: f32 = 0.848;

/// `steps + 1` points on an arc around `centre`, from one angle to another [degrees from the x axis].
pub(crate) fn arc(centre: Vec2, radius: f32, from: f32, to: f32, steps: u32) -> Vec<Vec2> {
    (0..=steps)
        .map(|i| {
            let angle = from + (to - from) * (i as f32 / steps as f32);
            let (sin, cos) = num::sin_cos(angle.to_radians());
            centre + Vec2::new(cos, sin) * radius
        })
        .collect()
}

/// A smooth curve through the points, `steps` edges between any two.
///
/// Source: Catmull and Rom 1974, *A Class of Local Interpolating Splines*; the ends are doubled.
pub(crate) fn spline(points: &[Vec2], steps: u32) -> Vec<Vec2> {
    let Some((&first, &last)) = points.first().zip(points.last()) else { return Vec::new() };
    let at = |i: usize| if i == 0 { first } else { points.get(i - 1).copied().unwrap_or(last) };
    let mut curve = Vec::new();
    for i in 1..points.len() {
        let [p0, p1, p2, p3] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
        for k in 0..steps {
            let t = k as f32 / steps as f32;
            let linear = (p2 - p0) * t;
            let square = (p0 * 2.0 - p1 * 5.0 + p2 * 4.0 - p3) * (t * t);
            let cube = (p1 * 3.0 - p0 - p2 * 3.0 + p3) * (t * t * t);
            curve.push(p1 + (linear + square + cube) * 0.5);
        }
    }
    curve.push(last);
    curve
}

/// An edge of an outline with the normals at its two ends.
#[derive(Debug, Clone, Copy)]
pub(super) struct Edge {
    pub(super) ends: [Vec2; 2],
    pub(super) normals: [Vec2; 2],
}

/// The edges of an open outline, without those of no length. Normals point to the right of the
/// direction of travel, smooth except at creases.
pub(super) fn edges(points: &[Vec2]) -> Vec<Edge> {
    let flat: Vec<Edge> = points
        .windows(2)
        .filter_map(|w| {
            let along = (w[1] - w[0]).try_normalize()?;
            Some(Edge { ends: [w[0], w[1]], normals: [Vec2::new(along.y, -along.x); 2] })
        })
        .collect();
    let shared = |a: &Edge, b: &Edge| {
        let (n, m) = (a.normals[0], b.normals[0]);
        if n.dot(m) > CREASE_COS { (n + m).try_normalize() } else { None }
    };
    let mut smooth = flat.clone();
    for i in 1..flat.len() {
        if let Some(n) = shared(&flat[i - 1], &flat[i]) {
            smooth[i - 1].normals[1] = n;
            smooth[i].normals[0] = n;
        }
    }
    smooth
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splines_pass_through_their_points() {
        let points = [Vec2::ZERO, Vec2::new(1.0, 2.0), Vec2::new(3.0, 1.0)];
        let curve = spline(&points, 8);
        assert_eq!(curve.len(), 17);
        assert!(points.iter().enumerate().all(|(i, p)| (curve[8 * i] - *p).length() < 1e-6));
        assert!(spline(&[], 8).is_empty());
    }

    #[test]
    fn arcs_are_smooth_and_corners_are_not() {
        let round = edges(&arc(Vec2::ZERO, 1.0, -90.0, 90.0, 16));
        for e in &round[1..15] {
            assert!((e.normals[0] - e.ends[0]).length() < 1e-3, "{e:?}");
        }
        let corner = edges(&[Vec2::ZERO, Vec2::X, Vec2::X, Vec2::ONE]);
        assert_eq!(corner.len(), 2);
        assert_eq!(corner[0].normals[1], Vec2::NEG_Y);
        assert_eq!(corner[1].normals[0], Vec2::X);
    }
}
