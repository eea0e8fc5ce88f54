//! Flat convex polygons. Corners stay in the light's own coordinates: relative to a distant receiver
//! they would lose the width of a needle.

use super::adaptive::Place;
use super::outlook::{Amounts, Edges, find, graded};
use halflight::glam::DVec3;

/// A plane `axis · p = at` for polygons to be cut by.
#[derive(Debug, Clone, Copy)]
struct Plane {
    axis: DVec3,
    at: f64,
}

/// A height below this share of the corners' distance is none: it is the noise of the plane.
const FLAT: f64 = 1e-14;

/// A convex polygon, the cells of its plane, and where it is looked at from.
#[derive(Debug, Clone)]
pub(super) struct Flat {
    corners: Vec<DVec3>,
    point: DVec3,
    normal: DVec3,
    axes: [DVec3; 2],
    edges: [Edges; 2],
}

impl Flat {
    pub(super) fn new(corners: &[DVec3], point: DVec3) -> Self {
        let normal = doubled_area(corners).normalize();
        let x = (corners[1] - corners[0]).normalize();
        let axes = [x, normal.cross(x)];
        let height = normal.dot(point - corners[0]).abs();
        let range = axes.map(|axis| {
            let along = corners.iter().map(|c| axis.dot(*c));
            along.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)])
        });
        let at = axes.map(|axis| axis.dot(point));
        let edges = [0, 1].map(|i| {
            // How far the receiver is from the nearest line along this axis.
            let ([low, high], beside) = (range[1 - i], at[1 - i]);
            let beside = (low - beside).max(beside - high).max(0.0);
            graded(range[i][0], range[i][1], at[i], height.hypot(beside))
        });
        Self { corners: corners.to_vec(), point, normal, axes, edges }
    }

    pub(super) fn area(&self) -> f64 {
        0.5 * doubled_area(&self.corners).length()
    }

    /// The cell of a place relative to the receiver.
    pub(super) fn cell(&self, place: DVec3) -> [usize; 2] {
        [0, 1].map(|i| find(&self.edges[i], self.axes[i].dot(place + self.point)))
    }

    /// What is seen of a cell from `offset` beside the point.
    pub(super) fn seen(&self, offset: DVec3, normal: DVec3, cell: [usize; 2]) -> Amounts {
        let mut amounts = Amounts::default();
        let point = self.point + offset;
        let way = point - self.corners[0];
        let extent = self.corners[1].distance(self.corners[0]);
        if self.normal.dot(way) <= FLAT * (way.length() + extent) {
            return amounts;
        }
        let mut part = self.corners.clone();
        for ((&axis, edges), k) in self.axes.iter().zip(&self.edges).zip(cell) {
            if k > 0 {
                part = cut(&part, Plane { axis, at: edges[k] });
            }
            if k + 2 < edges.len() {
                part = cut(&part, Plane { axis: -axis, at: -edges[k + 1] });
            }
        }
        let lit = cut(&part, Plane { axis: normal, at: normal.dot(point) });
        if lit == part {
            fan(&part, point, self.normal, |map| amounts.add(normal, &map));
        } else {
            fan(&part, point, self.normal, |map| amounts.add_facing(&map));
            fan(&lit, point, self.normal, |map| amounts.add_lit(normal, &map));
        }
        amounts
    }
}

/// The part of a polygon beyond a plane.
fn cut(corners: &[DVec3], plane: Plane) -> Vec<DVec3> {
    let mut beyond = Vec::new();
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let [da, db] = [a, b].map(|c| plane.axis.dot(*c) - plane.at);
        if da > 0.0 {
            beyond.push(*a);
        }
        if (da > 0.0) != (db > 0.0) {
            beyond.push(*a + (*b - *a) * (da / (da - db)));
        }
    }
    beyond
}

/// The vector area of a polygon, twice.
fn doubled_area(corners: &[DVec3]) -> DVec3 {
    let Some(first) = corners.first() else { return DVec3::ZERO };
    let pairs = corners.iter().zip(corners.iter().skip(1));
    pairs.map(|(a, b)| (*a - *first).cross(*b - *first)).sum()
}

/// A part of a triangle seen from a point, as a map of the unit square.
fn fan(corners: &[DVec3], point: DVec3, normal: DVec3, mut f: impl FnMut(&dyn Fn(f64, f64) -> Place)) {
    let Some(&a) = corners.first() else { return };
    for (&b, &c) in corners[1..].iter().zip(corners.iter().skip(2)) {
        let (way, ab, bc) = (a - point, b - a, c - b);
        let area = ab.cross(bc).length();
        if area > 0.0 {
            f(&move |s, t| (way + (ab + bc * t) * s, normal, area * s));
        }
    }
}
