//! The tables by which directions toward an environment map are drawn.

mod moments;

use super::Image;
use crate::Rgb;
use crate::light::environment::grid::Grid;
use crate::light::environment::sky::MOST_LEAVES;
use crate::light::environment::table::Levels;
use crate::light::{DrawsBy, EnvironmentDensity, EnvironmentTable, Lobe};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use core::mem::size_of_val;
use glam::{DVec2, DVec3, Vec3};
use std::vec::Vec;

/// Powers of two by which luminance may be scaled, so that neither it nor its square leaves `f32`.
const MAX_GAIN: i32 = 100;

/// Owned tables of an environment map.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct EnvironmentTables {
    masses: Vec<f32>,
    lobes: Vec<Lobe>,
    moments: Vec<[Vec3; 3]>,
    draws_by: DrawsBy,
    total: f32,
    gain: f32,
    offset: f32,
}

impl EnvironmentTables {
    /// Tables for drawing directions toward `image`. Those of a black map are empty, and so are those of
    /// one that is not a picture. Each sum is formed in double precision.
    #[must_use]
    pub fn new(image: &Image, density: EnvironmentDensity) -> Self {
        let density = density.resolved();
        let largest = image.texels.iter().fold(0.0, |m: f32, t| m.max(t.luminance()));
        let count = u64::from(image.width) * u64::from(image.height);
        let usable = largest > 0.0 && largest.is_finite() && image.texels.len() as u64 == count;
        if !usable {
            return Self::default();
        }
        let exponent = (-libm::ilogb(f64::from(largest))).clamp(-MAX_GAIN, MAX_GAIN);
        let mut tables = Self { gain: libm::ldexp(1.0, exponent) as f32, ..Self::default() };
        let cells = Cells { image, grid: Grid { width: image.width, height: image.height } };
        if density == EnvironmentDensity::Compensated {
            tables.offset = (cells.sum(&tables) / (4.0 * PI)) as f32;
        }
        tables.total = cells.sum(&tables) as f32;
        if !(tables.total > 0.0) {
            return Self::default();
        }
        let levels = Levels::new(&cells.grid);
        tables.masses = cells.pyramid(&levels, &tables);
        tables.lobes = cells.lobes(&levels, &tables);
        tables.moments = moments::of_nodes(image, &cells.grid, &levels, tables.lobes.len());
        tables.draws_by = match density {
            EnvironmentDensity::Cosine => DrawsBy::Cosine,
            EnvironmentDensity::Luminance | EnvironmentDensity::Compensated => DrawsBy::Importance,
            _ => DrawsBy::Product,
        };
        tables
    }

    /// The tables, borrowed; `None` when they are empty.
    #[must_use]
    pub fn table(&self) -> Option<EnvironmentTable<'_>> {
        (self.total > 0.0).then_some(EnvironmentTable {
            masses: &self.masses,
            lobes: &self.lobes,
            moments: &self.moments,
            draws_by: self.draws_by,
            total: self.total,
            gain: self.gain,
            offset: self.offset,
        })
    }

    /// Bytes that they take.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.masses) + size_of_val(&*self.lobes) + size_of_val(&*self.moments)
    }

    /// As the core computes it, to the last bit.
    fn importance(&self, texel: Rgb) -> f32 {
        let table = EnvironmentTable {
            masses: &[],
            lobes: &[],
            moments: &[],
            draws_by: self.draws_by,
            total: self.total,
            gain: self.gain,
            offset: self.offset,
        };
        table.importance(texel)
    }
}

/// The cells of a picture.
struct Cells<'a> {
    image: &'a Image,
    grid: Grid,
}

impl Cells<'_> {
    /// Importance times solid angle of the cells of a row.
    fn row<'a>(&'a self, tables: &'a EnvironmentTables, y: u32) -> impl Iterator<Item = f64> + 'a {
        let area = TAU / f64::from(self.grid.width) * f64::from(self.grid.drop(y));
        (0..self.grid.width).map(move |x| {
            let corners = self.grid.corners(x, y).map(|i| f64::from(tables.importance(self.image.texels[i])));
            0.25 * area * corners.iter().sum::<f64>()
        })
    }

    /// Importance times solid angle of the whole map.
    fn sum(&self, tables: &EnvironmentTables) -> f64 {
        (0..self.grid.rows()).map(|y| self.row(tables, y).sum::<f64>()).sum()
    }

    /// The levels from the whole map down to pairs of cells.
    fn pyramid(&self, levels: &Levels, tables: &EnvironmentTables) -> Vec<f32> {
        let mut masses = [0.0].repeat(levels.len_down_to(1));
        if levels.top == 0 {
            return masses;
        }
        let mut first = masses.len() - levels.len(1);
        let [columns, _] = levels.size(1).map(|n| n as usize);
        let mut pairs = [0.0_f64].repeat(columns);
        for y in 0..self.grid.rows() {
            if y % 2 == 0 {
                pairs.fill(0.0);
            }
            self.row(tables, y).enumerate().for_each(|(x, mass)| pairs[x / 2] += mass);
            let start = first + (y / 2) as usize * columns;
            masses[start..start + columns].iter_mut().zip(&pairs).for_each(|(m, sum)| *m = *sum as f32);
        }
        for level in 2..=levels.top {
            let below = first;
            first -= levels.len(level);
            let ([columns, rows], [of_columns, of_rows]) = (levels.size(level), levels.size(level - 1));
            for (x, y) in (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))) {
                let mass = |(dx, dy): (u32, u32)| {
                    let (x, y) = (2 * x + dx, 2 * y + dy);
                    let inside = x < of_columns && y < of_rows;
                    if inside { f64::from(masses[below + (y * of_columns + x) as usize]) } else { 0.0 }
                };
                let sum: f64 = [(0, 0), (1, 0), (0, 1), (1, 1)].into_iter().map(mass).sum();
                masses[first + (y * columns + x) as usize] = sum as f32;
            }
        }
        masses
    }

    /// Where the light of the coarse nodes comes from.
    fn lobes(&self, levels: &Levels, tables: &EnvironmentTables) -> Vec<Lobe> {
        let Some(leaf) = (1..levels.top).find(|&level| levels.len(level) <= MOST_LEAVES) else {
            return Vec::new();
        };
        let [columns, rows] = levels.size(leaf);
        let mut sums = [DVec3::ZERO].repeat(levels.len(leaf));
        for y in 0..self.grid.rows() {
            for (x, mass) in self.row(tables, y).enumerate() {
                let index = (y >> leaf) * columns + (x as u32 >> leaf);
                sums[index as usize] += self.centre(x as u32, y) * mass;
            }
        }
        let mut lists = Vec::new();
        let mut size = [columns, rows];
        for level in leaf..=levels.top {
            let first = levels.len_down_to(level) - levels.len(level);
            let lobes: Vec<Lobe> = sums
                .iter()
                .enumerate()
                .map(|(i, sum)| {
                    let mass = f64::from(tables.masses[first + i]);
                    let mean = if mass > 0.0 { *sum / mass } else { DVec3::ZERO };
                    self.lobe(mean.clamp_length_max(1.0), level, i as u32 % size[0], i as u32 / size[0])
                })
                .collect();
            lists.push(lobes);
            (sums, size) = halved(&sums, size);
        }
        lists.into_iter().rev().flatten().collect()
    }

    /// The direction of a cell's centre.
    fn centre(&self, x: u32, y: u32) -> DVec3 {
        self.grid.direction([x, y], 0.5, 0.5).as_dvec3()
    }

    /// A node's lobe: its mean direction, and where it is.
    ///
    /// Derived: seen from the middle of a block of latitudes and less than a quarter turn of longitudes
    /// to each side, the farthest point is a corner: along a parallel the distance grows with the
    /// longitude, and along a meridian less than a quarter turn aside it has no maximum.
    fn lobe(&self, mean: DVec3, level: u32, x: u32, y: u32) -> Lobe {
        let (columns, rows) = (self.grid.width, self.grid.rows());
        let share = |i: u32, n: u32| f64::from((i << level).min(n)) / f64::from(n);
        let turn = |i: u32| TAU * (share(i, columns) + 0.5 / f64::from(columns));
        let (west, east) = (turn(x), turn(x + 1));
        let (north, south) = (PI * share(y, rows), PI * share(y + 1, rows));
        let direction = |theta: f64, phi: f64| {
            let ((sin, cos), (sin_phi, cos_phi)) = (libm::sincos(theta), libm::sincos(phi));
            DVec3::new(sin * sin_phi, cos, -sin * cos_phi)
        };
        let axis = direction(0.5 * (north + south), 0.5 * (west + east));
        let corners = [(north, west), (north, east), (south, west), (south, east)];
        let nearest = corners.iter().map(|&(t, p)| axis.dot(direction(t, p))).fold(1.0, f64::min);
        let narrow = 0.5 * (east - west) < 0.99 * FRAC_PI_2 && nearest > 0.0;
        let sin_radius = if narrow { libm::sqrt(1.0 - nearest * nearest) } else { 1.0 };
        let level_at = |phi: f64| DVec2::new(libm::sin(phi), -libm::cos(phi)).as_vec2();
        // Half a turn is told from more of one by its ends; rounding must not make it more.
        let ends = if east - west < 1.000_001 * PI { [west, east] } else { [west, west] };
        let row_at = |theta: f64| DVec2::new(libm::cos(theta), libm::sin(theta)).as_vec2();
        Lobe {
            mean: mean.as_vec3(),
            sin_radius: sin_radius as f32,
            rows: [north, south].map(row_at),
            columns: ends.map(level_at),
        }
    }
}

/// Sums over 2 × 2 nodes.
fn halved(sums: &[DVec3], [columns, rows]: [u32; 2]) -> (Vec<DVec3>, [u32; 2]) {
    let size = [columns.div_ceil(2), rows.div_ceil(2)];
    let mut halved = [DVec3::ZERO].repeat((size[0] * size[1]) as usize);
    for (i, sum) in (0..).zip(sums) {
        halved[(i / columns / 2 * size[0] + i % columns / 2) as usize] += *sum;
    }
    (halved, size)
}

#[cfg(test)]
mod tests;
