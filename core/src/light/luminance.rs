//! A density over the unit square in proportion to the luminance of a picture.

use crate::choose::PowerTable;
use crate::num;

/// The most cells along a side: of a larger picture, some texels share one.
const MOST_CELLS: usize = 1024;

/// How a picture's texels share cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LuminanceGrid {
    /// Texels along each axis.
    texels: [u32; 2],
    /// Cells along each axis, at most as many.
    cells: [u32; 2],
}

impl LuminanceGrid {
    /// For a picture of `columns × rows` texels, each at least 1.
    #[must_use]
    pub fn new(columns: u32, rows: u32) -> Self {
        let texels = [columns.max(1), rows.max(1)];
        Self { texels, cells: texels.map(|n| n.min(MOST_CELLS as u32)) }
    }

    /// Length of the table: the ends of the rows' shares, then those of the cells in each row.
    #[must_use]
    pub fn table_len(&self) -> usize {
        self.rows() * (1 + self.columns())
    }

    fn columns(&self) -> usize {
        self.cells[0] as usize
    }

    fn rows(&self) -> usize {
        self.cells[1] as usize
    }

    /// The first texel of a cell.
    fn start(&self, axis: usize, cell: usize) -> usize {
        // Neither of them is 0.
        (cell * self.texels[axis] as usize).checked_div(self.cells[axis] as usize).unwrap_or(0)
    }

    /// The cell of a texel: the inverse of [`LuminanceGrid::start`].
    fn cell_of(&self, axis: usize, texel: usize) -> usize {
        ((texel + 1) * self.cells[axis] as usize - 1).checked_div(self.texels[axis] as usize).unwrap_or(0)
    }

    /// The cell of a place in `[0, 1]`.
    fn cell_at(&self, axis: usize, place: f32) -> usize {
        let texels = self.texels[axis];
        self.cell_of(axis, ((place * texels as f32) as u32).min(texels - 1) as usize)
    }

    /// Where a cell begins and how far it reaches, in `[0, 1]`.
    fn reach(&self, axis: usize, cell: usize) -> (f32, f32) {
        let (from, to) = (self.start(axis, cell), self.start(axis, cell + 1));
        let per_texel = 1.0 / self.texels[axis] as f32;
        (from as f32 * per_texel, (to - from) as f32 * per_texel)
    }

    /// Fills the table; false when all is black.
    ///
    /// Bilinear interpolation is bilinear in each quarter of a texel: four looks give a texel's
    /// integral exactly, and none is missed that is black only in its middle.
    ///
    /// * `table` – [`LuminanceGrid::table_len`] entries
    /// * `luminance` – at a place of the unit square; finite and 0 or more
    pub fn fill(&self, table: &mut [f32], luminance: impl Fn([f32; 2]) -> f32) -> bool {
        let [width, height] = self.texels.map(|n| n as f32);
        let (ends, cells) = table.split_at_mut(self.rows());
        let sum_of = |row: usize, column: usize| -> f64 {
            let quarters = |axis, cell| 2 * self.start(axis, cell)..2 * self.start(axis, cell + 1);
            let place = |i: usize, n: f32| (i as f32 + 0.5) / (2.0 * n);
            let look = |y, x| f64::from(luminance([place(x, width), place(y, height)]));
            quarters(1, row).map(|y| quarters(0, column).map(|x| look(y, x)).sum::<f64>()).sum()
        };
        for (row, line) in cells.chunks_exact_mut(self.columns()).enumerate() {
            let mut total = 0.0;
            for (column, cell) in line.iter_mut().enumerate() {
                let sum = sum_of(row, column);
                total += sum;
                *cell = sum as f32;
            }
            ends[row] = total as f32;
            PowerTable::accumulate(line);
        }
        PowerTable::accumulate(ends)
    }
}

/// A filled table, borrowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct LuminanceTable<'a> {
    grid: &'a LuminanceGrid,
    table: &'a [f32],
}

impl<'a> LuminanceTable<'a> {
    /// `None` unless the table has the grid's length.
    pub(super) fn new(grid: &'a LuminanceGrid, table: &'a [f32]) -> Option<Self> {
        (table.len() == grid.table_len()).then_some(Self { grid, table })
    }

    fn row(&self, row: usize) -> &'a [f32] {
        let start = self.grid.rows() + row * self.grid.columns();
        self.table.get(start..start + self.grid.columns()).unwrap_or_default()
    }

    fn ends(&self) -> &'a [f32] {
        self.table.get(..self.grid.rows()).unwrap_or_default()
    }

    /// A place of the unit square; `None` when all is black.
    pub(super) fn sample(&self, u: [f32; 2]) -> Option<[f32; 2]> {
        let (row, v) = draw(self.ends(), u[1])?;
        let (column, u) = draw(self.row(row), u[0])?;
        let place = |axis, cell, within: f32| {
            let (start, length) = self.grid.reach(axis, cell);
            // Not beyond the cell, where the density may be another one.
            num::clamp_unit(start + length * within)
        };
        Some([place(0, column, u), place(1, row, v)])
    }

    /// Density at a place of the unit square, with respect to its area.
    pub(super) fn pdf(&self, [x, y]: [f32; 2]) -> f32 {
        let (column, row) = (self.grid.cell_at(0, x), self.grid.cell_at(1, y));
        let pmf = share(self.ends(), row) * share(self.row(row), column);
        let ((_, width), (_, height)) = (self.grid.reach(0, column), self.grid.reach(1, row));
        pmf / (width * height)
    }
}

/// The entry whose share `u` falls into, and where in it, in `[0, 1)`.
fn draw(ends: &[f32], u: f32) -> Option<(usize, f32)> {
    let index = ends.partition_point(|end| *end <= u);
    let (start, end) = (before(ends, index), *ends.get(index)?);
    Some((index, num::clamp_unit((u - start) / (end - start))))
}

fn share(ends: &[f32], index: usize) -> f32 {
    ends.get(index).map_or(0.0, |end| end - before(ends, index))
}

/// Where an entry begins: 0 for the first.
fn before(ends: &[f32], index: usize) -> f32 {
    ends.get(index.wrapping_sub(1)).copied().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::{hash2, unit_f32};
    use std::vec::Vec;

    fn filled(columns: u32, rows: u32, luminance: impl Fn([f32; 2]) -> f32) -> (LuminanceGrid, Vec<f32>) {
        let grid = LuminanceGrid::new(columns, rows);
        let mut table = std::vec![0.0; grid.table_len()];
        assert!(grid.fill(&mut table, luminance));
        (grid, table)
    }

    #[test]
    fn places_come_as_often_as_their_density_says() {
        let bright = |[x, y]: [f32; 2]| if x < 0.5 && y > 0.5 { 0.0 } else { x * x + 0.1 * y };
        for (columns, rows) in [(1, 1), (4, 8), (5, 3), (2000, 2)] {
            let (grid, table) = filled(columns, rows, bright);
            let table = LuminanceTable::new(&grid, &table).unwrap();
            let (n, mut sum, mut squares, mut counts) = (200_000_u32, 0.0_f64, 0.0, [0.0_f64; 4]);
            for i in 0..n {
                let place = table.sample([unit_f32(hash2(i, 1)), unit_f32(hash2(i, 2))]).unwrap();
                let reciprocal = 1.0 / f64::from(table.pdf(place));
                assert!(reciprocal.is_finite() && reciprocal > 0.0, "{place:?}");
                sum += reciprocal;
                squares += reciprocal * reciprocal;
                counts[usize::from(place[0] >= 0.5) + 2 * usize::from(place[1] >= 0.5)] += 1.0;
            }
            // The mean of 1 / p is the area where p is positive.
            let (mean, n) = (sum / f64::from(n), f64::from(n));
            let error = ((squares / n - mean * mean).max(0.0) / n).sqrt();
            let area = if columns % 2 == 0 && rows % 2 == 0 { 0.75 } else { mean };
            assert!((mean - area).abs() <= 5.0 * error + 1e-6, "{columns}×{rows}: {mean} {error}");
            if columns % 2 == 0 && rows % 2 == 0 {
                assert_eq!(counts[2], 0.0, "nothing is drawn where it is black");
                // A density that is 2 % off is noticed.
                assert!((mean / 1.02 - area).abs() > 5.0 * error);
            }
        }
    }

    #[test]
    fn every_texel_is_in_the_cell_that_starts_before_it() {
        for n in [1, 2, 7, 1023, 1024, 1025, 2047, 5000] {
            let grid = LuminanceGrid::new(n, 1);
            for texel in 0..n as usize {
                let cell = grid.cell_of(0, texel);
                assert!(
                    grid.start(0, cell) <= texel && texel < grid.start(0, cell + 1),
                    "{n} {texel} {cell}"
                );
            }
        }
    }

    #[test]
    fn black_has_no_density() {
        let grid = LuminanceGrid::new(3, 2);
        let mut table = std::vec![0.0; grid.table_len()];
        assert!(!grid.fill(&mut table, |_| 0.0));
        assert_eq!(LuminanceTable::new(&grid, &table).unwrap().sample([0.5, 0.5]), None);
        assert_eq!(LuminanceTable::new(&grid, &table[1..]), None);
    }
}
