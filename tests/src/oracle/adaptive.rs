//! Integrals over smooth pieces of a surface as they are seen from one point.

use crate::quadrature::nodes_of_square;
use halflight::glam::DVec3;

/// How large a box may be against its distance before it is split, as the sum of its sides. The
/// five-point rule then errs by less than 1e-7: the nearest singularity of `1 / d` is some four
/// half-widths away.
const SPLIT: f64 = 1.0;

/// Splits in a row: more than 1e-16 of the piece along each axis.
const DEEPEST: u32 = 120;

/// A point of a surface relative to where it is seen from, the unit normal there, and area for each
/// unit of the coordinates.
pub(super) type Place = (DVec3, DVec3, f64);

/// Part of the unit square.
#[derive(Clone, Copy)]
struct Box2 {
    s: [f64; 2],
    t: [f64; 2],
    depth: u32,
}

impl Box2 {
    /// The two halves along the first or the second axis.
    fn halves(self, along_s: bool) -> [Self; 2] {
        let middle = |[a, b]: [f64; 2]| 0.5 * (a + b);
        let depth = self.depth + 1;
        if along_s {
            let m = middle(self.s);
            [Self { s: [self.s[0], m], depth, ..self }, Self { s: [m, self.s[1]], depth, ..self }]
        } else {
            let m = middle(self.t);
            [Self { t: [self.t[0], m], depth, ..self }, Self { t: [m, self.t[1]], depth, ..self }]
        }
    }

    /// The longest way across along each axis, and the distance from the origin, from nine points.
    fn extent(&self, map: &(impl Fn(f64, f64) -> Place + ?Sized)) -> ([f64; 2], f64) {
        let along = |[a, b]: [f64; 2], k: usize| a + (b - a) * 0.5 * k as f64;
        let at: [[DVec3; 3]; 3] =
            std::array::from_fn(|i| std::array::from_fn(|j| map(along(self.s, i), along(self.t, j)).0));
        let way = |a: DVec3, b: DVec3, c: DVec3| a.distance(b) + b.distance(c);
        let s = (0..3).map(|j| way(at[0][j], at[1][j], at[2][j])).fold(0.0, f64::max);
        let t = (0..3).map(|i| way(at[i][0], at[i][1], at[i][2])).fold(0.0, f64::max);
        let near = at.iter().flatten().map(|p| p.length()).fold(f64::INFINITY, f64::min);
        ([s, t], near)
    }
}

/// Visits the nodes of a quadrature over a piece of a surface, with their share of its area (m²).
///
/// Boxes are halved along their longer side until they are small against their distance from the
/// origin, so that near and grazing surfaces take a few more levels and nothing else.
pub(super) fn visit(map: &(impl Fn(f64, f64) -> Place + ?Sized), mut f: impl FnMut(DVec3, DVec3, f64)) {
    let mut stack = vec![Box2 { s: [0.0, 1.0], t: [0.0, 1.0], depth: 0 }];
    while let Some(part) = stack.pop() {
        let ([s, t], near) = part.extent(map);
        if s + t > SPLIT * near && part.depth < DEEPEST {
            stack.extend(part.halves(s >= t));
            continue;
        }
        let (ds, dt) = (part.s[1] - part.s[0], part.t[1] - part.t[0]);
        nodes_of_square(|x, y, weight| {
            let (point, normal, area) = map(part.s[0] + ds * x, part.t[0] + dt * y);
            f(point, normal, weight * area * ds * dt);
        });
    }
}
