//! Flat convex polygons about a receiver at the origin.

use super::clip;
use super::outlook::{Amounts, Edges, find, graded};
use halflight::glam::DVec3;

/// A convex polygon and the cells of its plane.
#[derive(Debug, Clone)]
pub(super) struct Flat {
    corners: Vec<DVec3>,
    normal: DVec3,
    axes: [DVec3; 2],
    edges: [Edges; 2],
}

impl Flat {
    pub(super) fn new(corners: &[DVec3]) -> Self {
        let [a, b] = [corners[0], corners[1]];
        let normal = doubled_area(corners).normalize();
        let x = (b - a).normalize();
        let axes = [x, normal.cross(x)];
        let height = normal.dot(a).abs();
        let range = axes.map(|axis| {
            let along = corners.iter().map(|c| axis.dot(*c));
            let bounds = (f64::INFINITY, f64::NEG_INFINITY);
            along.fold(bounds, |(low, high), v| (low.min(v), high.max(v)))
        });
        // The receiver is at 0, and this far from the nearest line along the other axis.
        let beside = |(low, high): (f64, f64)| low.max(-high).max(0.0);
        let edges = [0, 1].map(|i| {
            let (low, high) = range[i];
            graded(low, high, 0.0, height.hypot(beside(range[1 - i])))
        });
        Self { corners: corners.to_vec(), normal, axes, edges }
    }

    pub(super) fn area(&self) -> f64 {
        0.5 * doubled_area(&self.corners).length()
    }

    pub(super) fn cell(&self, place: DVec3) -> [usize; 2] {
        [0, 1].map(|i| find(&self.edges[i], self.axes[i].dot(place)))
    }

    /// What is seen of a cell from `offset`.
    pub(super) fn seen(&self, offset: DVec3, normal: DVec3, cell: [usize; 2]) -> Amounts {
        let mut amounts = Amounts::default();
        if self.normal.dot(self.corners[0] - offset) >= 0.0 {
            return amounts;
        }
        let mut part = self.corners.clone();
        for i in 0..2 {
            let (axis, edges, k) = (self.axes[i], &self.edges[i], cell[i]);
            if k > 0 {
                part = beyond(&part, axis, edges[k]);
            }
            if k + 2 < edges.len() {
                part = beyond(&part, -axis, -edges[k + 1]);
            }
        }
        let part: Vec<DVec3> = part.iter().map(|c| *c - offset).collect();
        fan(&part, self.normal, |map| amounts.add_facing(&map));
        fan(&clip(&part, normal), self.normal, |map| amounts.add_lit(normal, &map));
        amounts
    }
}

/// The part of a polygon with `axis · p > bound`.
fn beyond(corners: &[DVec3], axis: DVec3, bound: f64) -> Vec<DVec3> {
    let shift = axis * bound;
    let moved: Vec<DVec3> = corners.iter().map(|c| *c - shift).collect();
    clip(&moved, axis).into_iter().map(|c| c + shift).collect()
}

/// The vector area of a polygon, twice.
fn doubled_area(corners: &[DVec3]) -> DVec3 {
    let Some(first) = corners.first() else { return DVec3::ZERO };
    let pairs = corners.iter().zip(corners.iter().skip(1));
    pairs.map(|(a, b)| (*a - *first).cross(*b - *first)).sum()
}

/// A convex polygon as maps of the unit square onto triangles.
fn fan(corners: &[DVec3], normal: DVec3, mut f: impl FnMut(Box<dyn Fn(f64, f64) -> super::adaptive::Place>)) {
    let Some(&a) = corners.first() else { return };
    for (&b, &c) in corners[1..].iter().zip(corners.iter().skip(2)) {
        let area = (b - a).cross(c - a).length();
        if area > 0.0 {
            f(Box::new(move |s, t| (a + (b - a) * s + (c - b) * (s * t), normal, area * s)));
        }
    }
}
