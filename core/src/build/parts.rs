//! Cutting many primitives into parts whose trees are built one after the other: building takes several times
//! the memory of the tree that it leaves.

use crate::geom::Aabb;
use core::ops::Range;
use glam::Vec3;
use std::vec;
use std::vec::Vec;

/// Cells of the grid on which parts are told apart, as a power of two.
const CELLS: u32 = 18;

/// A primitive is large when its box has more than this share of the surface of the box around all, and most
/// that may be: a lamp in the box of a part far below would be in the way of all rays above that part.
const LARGE: f32 = 1e-3;
const MOST_LARGE: usize = 1000;

/// Primitives part by part.
pub(super) struct Parts {
    /// The primitives.
    pub(super) order: Vec<u32>,
    /// Where in it each part stands, and its box; none is empty.
    pub(super) parts: Vec<(Range<usize>, Aabb)>,
}

/// Cuts `count` primitives into parts of at most `most`, or of more where they all lie in one cell of a grid
/// of 2¹⁸. Large ones are parts of their own.
///
/// * `all` – holds all of them (m)
///
/// Planes between cells are chosen by the surface area heuristic, with the centres of the boxes counted cell
/// by cell; the same primitives give the same parts.
///
/// Source: Wald 2007, *On fast Construction of SAH-based Bounding Volume Hierarchies*, section 3. Differs: one
/// grid for all cuts, so that primitives are looked at twice, however many parts there are.
pub(super) fn cut(count: usize, all: Aabb, most: usize, bounds: &impl Fn(u32) -> Aabb) -> Parts {
    let grid = Grid::new(all);
    let mut counts = vec![0_u32; 1 << CELLS];
    let mut large_in = Vec::new();
    let mut limit = LARGE * all.half_area();
    for bounds in (0..count as u32).map(bounds) {
        let cell = grid.cell(bounds.centre());
        counts[cell] += 1;
        if bounds.half_area() > limit {
            large_in.push(cell);
            if large_in.len() > MOST_LARGE {
                (limit, large_in) = (f32::INFINITY, Vec::new());
            }
        }
    }
    large_in.into_iter().for_each(|cell| counts[cell] -= 1);
    let (part_of, sizes) = blocks(&grid, &counts, most);
    let mut end = 0;
    let places = sizes.into_iter().map(|size| {
        end += size;
        (end - size..end - size, Aabb::EMPTY)
    });
    let (mut parts, mut order): (Vec<_>, _) = (places.collect(), vec![0; count]);
    for i in 0..count as u32 {
        let bounds = bounds(i);
        if bounds.half_area() > limit {
            // Behind all others.
            order[end] = i;
            parts.push((end..end + 1, bounds));
            end += 1;
            continue;
        }
        let (range, around) = &mut parts[part_of[grid.cell(bounds.centre())] as usize];
        order[range.end] = i;
        range.end += 1;
        *around = around.union(bounds);
    }
    Parts { order, parts }
}
/// The part of each cell, and how many primitives each part has.
fn blocks(grid: &Grid, counts: &[u32], most: usize) -> (Vec<u32>, Vec<usize>) {
    let (mut part_of, mut sizes) = (vec![0; counts.len()], Vec::new());
    let mut waiting = vec![Block { low: [0; 3], high: grid.size }];
    while let Some(block) = waiting.pop() {
        let size: usize = block.cells(grid).map(|cell| counts[cell] as usize).sum();
        match (size > most).then(|| block.halves(grid, counts)).flatten() {
            Some(halves) => waiting.extend(halves),
            None if size == 0 => {}
            None => {
                block.cells(grid).for_each(|cell| part_of[cell] = sizes.len() as u32);
                sizes.push(size);
            }
        }
    }
    (part_of, sizes)
}

/// Cells as near to cubes as doublings let them be.
struct Grid {
    origin: Vec3,
    /// Cells for each metre.
    scale: Vec3,
    /// Sides of a cell (m).
    cell: Vec3,
    /// Cells along each axis.
    size: [usize; 3],
}

impl Grid {
    fn new(all: Aabb) -> Self {
        let (mut cell, mut size) = (all.max - all.min, [1; 3]);
        for _ in 0..CELLS {
            let axis = cell.max_position();
            cell[axis] *= 0.5;
            size[axis] *= 2;
        }
        Self { origin: all.min, scale: cell.recip(), cell, size }
    }

    fn cell(&self, point: Vec3) -> usize {
        let place = (point - self.origin) * self.scale;
        // What is not a number, on an axis without extent, becomes 0.
        let [x, y, z] = [0, 1, 2].map(|axis| (place[axis] as usize).min(self.size[axis] - 1));
        (z * self.size[1] + y) * self.size[0] + x
    }
}

/// Cells from `low` to before `high`.
#[derive(Clone, Copy)]
struct Block {
    low: [usize; 3],
    high: [usize; 3],
}

impl Block {
    fn cells(self, grid: &Grid) -> impl Iterator<Item = usize> {
        let (Self { low, high }, [width, height, _]) = (self, grid.size);
        let rows = (low[2]..high[2]).flat_map(move |z| (low[1]..high[1]).map(move |y| z * height + y));
        rows.flat_map(move |row| row * width + low[0]..row * width + high[0])
    }

    /// Half of the surface area (m²).
    fn half_area(self, grid: &Grid) -> f32 {
        let [x, y, z] = [0, 1, 2].map(|axis| (self.high[axis] - self.low[axis]) as f32 * grid.cell[axis]);
        x * y + y * z + z * x
    }

    /// The best two parts that are not empty; `None` when all is in one cell.
    fn halves(self, grid: &Grid, counts: &[u32]) -> Option<[Self; 2]> {
        let mut best = (f32::INFINITY, None);
        for axis in 0..3 {
            let layer = |at: usize| {
                let mut layer = self;
                (layer.low[axis], layer.high[axis]) = (at, at + 1);
                layer.cells(grid).map(|cell| f64::from(counts[cell])).sum::<f64>()
            };
            let layers: Vec<f64> = (self.low[axis]..self.high[axis]).map(layer).collect();
            let (all, mut below) = (layers.iter().sum::<f64>(), 0.0);
            for (at, layer) in (self.low[axis] + 1..self.high[axis]).zip(&layers) {
                below += layer;
                let (mut low, mut high) = (self, self);
                (low.high[axis], high.low[axis]) = (at, at);
                let cost = low.half_area(grid) * below as f32 + high.half_area(grid) * (all - below) as f32;
                if below > 0.0 && below < all && (best.1.is_none() || cost < best.0) {
                    best = (cost, Some([low, high]));
                }
            }
        }
        best.1
    }
}
