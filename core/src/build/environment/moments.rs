//! Integrals of radiance times direction over the nodes of a map.

use super::Image;
use crate::light::environment::grid::Grid;
use crate::light::environment::table::Levels;
use core::f64::consts::{PI, TAU};
use glam::{DVec3, Vec3};
use std::vec::Vec;

/// Integrals of `(1 − x) f` and of `x f`, where `x` goes from 0 to 1 over an interval.
type Halves = [f64; 2];

/// Those of the sine and of the cosine from `a` to `b`, `a < b`.
///
/// Derived: `∫ x sin = (sin b − sin a) / (b − a) − cos b` and `∫ x cos = (cos b − cos a) / (b − a) + sin b`.
fn sine_and_cosine(a: f64, b: f64) -> (Halves, Halves) {
    let ((sin_a, cos_a), (sin_b, cos_b)) = (libm::sincos(a), libm::sincos(b));
    let (sine, cosine) = (cos_a - cos_b, sin_b - sin_a);
    let second = ((sin_b - sin_a) / (b - a) - cos_b, (cos_b - cos_a) / (b - a) + sin_b);
    ([sine - second.0, second.0], [cosine - second.1, second.1])
}

/// What a row of cells makes of its upper and its lower texels: the integrals of `sin² θ` and of
/// `sin θ cos θ` over the polar angle θ.
fn row(grid: &Grid, y: u32) -> (Halves, Halves) {
    let step = PI / f64::from(grid.rows());
    let (sine, cosine) = sine_and_cosine(2.0 * step * f64::from(y), 2.0 * step * f64::from(y + 1));
    (cosine.map(|c| 0.25 * (step - c)), sine.map(|s| 0.25 * s))
}

/// What a column of cells makes of its left and its right texels: the integrals of the sine, of 1, and of
/// minus the cosine of the longitude.
fn column(grid: &Grid, x: u32) -> [DVec3; 2] {
    let step = TAU / f64::from(grid.width);
    let start = step * (f64::from(x) + 0.5);
    let (sine, cosine) = sine_and_cosine(start, start + step);
    [0, 1].map(|half| DVec3::new(sine[half], 0.5 * step, -cosine[half]))
}

/// The integral of radiance times direction over each of the first `count` nodes of the pyramid, by channel
/// (W m⁻²), exactly: radiance is bilinear in longitude and latitude.
///
/// * `count` – the nodes of all levels down to one
pub(super) fn of_nodes(image: &Image, grid: &Grid, levels: &Levels, count: usize) -> Vec<[Vec3; 3]> {
    let Some(leaf) = (1..=levels.top).find(|&level| levels.len_down_to(level) == count) else {
        return Vec::new();
    };
    let mut sums = [[DVec3::ZERO; 3]].repeat(count);
    let first = count - levels.len(leaf);
    let columns: Vec<_> = (0..grid.width).map(|x| column(grid, x)).collect();
    for y in 0..grid.rows() {
        let (level, upright) = row(grid, y);
        for x in 0..grid.width {
            let at = (y >> leaf) * levels.size(leaf)[0] + (x >> leaf);
            let sum = &mut sums[first + at as usize];
            for (corner, texel) in grid.corners(x, y).into_iter().enumerate() {
                let (below, right) = (corner / 2, corner % 2);
                let flat = columns[x as usize][right];
                let moment = flat * DVec3::new(level[below], upright[below], level[below]);
                let texel = image.texels[texel];
                for (sum, radiance) in sum.iter_mut().zip([texel.r, texel.g, texel.b]) {
                    *sum += moment * f64::from(radiance);
                }
            }
        }
    }
    add_up(&mut sums, levels, leaf);
    sums.into_iter().map(|channels| channels.map(DVec3::as_vec3)).collect()
}

/// Adds the nodes of each level to those above.
fn add_up(sums: &mut [[DVec3; 3]], levels: &Levels, leaf: u32) {
    let mut first = sums.len();
    for level in leaf..levels.top {
        let ([columns, rows], parents) = (levels.size(level), levels.size(level + 1)[0]);
        first -= levels.len(level);
        let above = first - levels.len(level + 1);
        for (x, y) in (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))) {
            let node = sums[first + (y * columns + x) as usize];
            let parent = &mut sums[above + (y / 2 * parents + x / 2) as usize];
            parent.iter_mut().zip(node).for_each(|(sum, channel)| *sum += channel);
        }
    }
}
