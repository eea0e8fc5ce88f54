//! A pyramid of sums over the cells of a map: which cell a sample falls into.
//!
//! Each node is the sum over 2 × 2 nodes of the level below it, from the whole map down to pairs of
//! cells; the cells themselves are computed from their texels. A uniform number chooses between upper
//! and lower half, another between left and right, and what is left of each goes on to the next
//! level: the map is warped, not cut up, so stratified points stay stratified.
//!
//! Two numbers of 24 bits suffice: a map of 8192 columns takes 13 of one of them and leaves 11 for
//! the place inside the cell, and a cell that takes more is drawn as rarely.
//!
//! Source: Clarberg, Jarosz, Akenine-Möller, Jensen 2005, *Wavelet Importance Sampling*, section 4.2
//! (hierarchical sample warping). Differs: sums instead of wavelets, and the cosine of the receiver
//! enters block by block through the mean direction of each node.

use super::grid::Grid;
use crate::num;
use glam::{Vec2, Vec3};

/// Where the light of a node comes from, and where the node is.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct Lobe {
    /// Mean of the directions of the node, each weighted by what it sends; at most of length 1.
    pub mean: Vec3,
    /// Sine of the half-angle of a cone around the node, in `(0, 1]`; 1 for the wide ones.
    pub sin_radius: f32,
    /// Cosine and sine of the angle from the zenith at which the node begins and ends.
    pub rows: [Vec2; 2],
    /// Unit vectors in the plane of `x` and `z` at which the node begins and ends; the same ones for
    /// a node of more than half a turn.
    pub columns: [Vec2; 2],
}

impl Lobe {
    /// How much of the node's light counts for a receiver: the mean of the cosine, but where the
    /// horizon cuts the node at least what is there of an even light. 0 only below the horizon.
    ///
    /// * `normal` – of the receiver, in the map's space
    ///
    /// Derived: the cosine takes each value between the largest, `c`, and some `c − 2 sin r` equally
    /// often, as on a sphere; the mean of its positive part is then `c² / (4 sin r)`.
    #[inline]
    pub(crate) fn cosine(&self, normal: Vec3) -> f32 {
        let largest = self.largest_cosine(normal);
        if largest <= 0.0 {
            return 0.0;
        }
        num::larger(normal.dot(self.mean), 0.25 * largest * largest / self.sin_radius)
    }

    /// The largest cosine between a normal and a direction of the node.
    ///
    /// Derived: along a parallel it is largest at the normal's own longitude, or else at an end; along
    /// a meridian it is `a cos θ + h sin θ`, largest at the normal's own angle or else at an end.
    #[inline]
    pub(super) fn largest_cosine(&self, normal: Vec3) -> f32 {
        let ([west, east], [north, south]) = (self.columns, self.rows);
        let level = Vec2::new(normal.x, normal.z);
        let within = west == east || (west.perp_dot(level) > 0.0 && level.perp_dot(east) > 0.0);
        let across = if within {
            num::sqrt(level.length_squared())
        } else {
            num::larger(west.dot(level), east.dot(level))
        };
        let along = Vec2::new(normal.y, across);
        let has_top = north.perp_dot(along) > 0.0 && along.perp_dot(south) > 0.0;
        // A little more than is true, because both the ends and the normal are rounded.
        let slack = 1e-5;
        if has_top && across > 0.0 {
            num::sqrt(along.length_squared())
        } else {
            num::larger(north.dot(along), south.dot(along)) + slack
        }
    }
}

/// What directions are drawn by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DrawsBy {
    /// The receiver's cosine.
    Cosine,
    /// The importance of the map.
    #[default]
    Importance,
    /// Both; the cosine block by block.
    Product,
}

/// How much a node counts for a receiver.
pub(crate) trait Weigh {
    /// Whether coarse nodes count by more than their mass.
    const KNOWS_LOBES: bool;

    /// Weight of the node with that index.
    ///
    /// * `mass` – its importance times solid angle
    /// * `lobe` – of a coarse node
    fn weight(&self, index: usize, mass: f32, lobe: Option<&Lobe>) -> f32;
}

/// By what it sends, wherever the receiver is.
pub(crate) struct Plain;

impl Weigh for Plain {
    const KNOWS_LOBES: bool = false;

    #[inline]
    fn weight(&self, _: usize, mass: f32, _: Option<&Lobe>) -> f32 {
        mass
    }
}

/// By the cosine at a receiver with that normal, in the map's space.
impl Weigh for Vec3 {
    const KNOWS_LOBES: bool = true;

    #[inline]
    fn weight(&self, _: usize, mass: f32, lobe: Option<&Lobe>) -> f32 {
        lobe.map_or(mass, |lobe| mass * lobe.cosine(*self))
    }
}

/// What [`super::EnvironmentMap`] chooses directions by, borrowed; made by `EnvironmentTables` of
/// the feature `build`.
///
/// The density over a cell is in proportion to the importance of its texels, interpolated: their
/// luminance times `gain` less `offset`, but at least a sixteenth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnvironmentTable<'a> {
    /// Importance times solid angle of the nodes, level by level from the whole map down to pairs of
    /// cells, each row by row.
    pub masses: &'a [f32],
    /// For the coarse nodes, those that come first in `masses`, where their light comes from.
    pub lobes: &'a [Lobe],
    /// For each of them the integral of the radiance times the direction, by channel (W m⁻²): its product
    /// with a normal is the irradiance, where the whole node is above the horizon. Infinite where `f32` cannot
    /// hold it.
    pub moments: &'a [[Vec3; 3]],
    /// What directions are drawn by, where nothing is known of what hides the sky.
    pub draws_by: DrawsBy,
    /// Importance times solid angle of the whole map; positive.
    pub total: f32,
    /// Brings the largest luminance near 1.
    pub gain: f32,
    /// Is taken off the luminance.
    pub offset: f32,
}

/// The pyramid's levels over a number of cells: level `l` has nodes of `2^l × 2^l` cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Levels {
    columns: u32,
    rows: u32,
    /// The level of a single node.
    pub(crate) top: u32,
}

impl Levels {
    pub(crate) fn new(grid: &Grid) -> Self {
        let (columns, rows) = (grid.width, grid.rows());
        let top = u32::BITS - (columns.max(rows) - 1).leading_zeros();
        Self { columns, rows, top }
    }

    /// Columns and rows of a level.
    #[inline]
    pub(crate) const fn size(&self, level: u32) -> [u32; 2] {
        [((self.columns - 1) >> level) + 1, ((self.rows - 1) >> level) + 1]
    }

    /// Nodes of a level.
    #[inline]
    pub(crate) const fn len(&self, level: u32) -> usize {
        let [columns, rows] = self.size(level);
        columns as usize * rows as usize
    }

    /// Nodes of all levels down to this one.
    pub(crate) fn len_down_to(&self, level: u32) -> usize {
        (level..=self.top).map(|l| self.len(l)).sum()
    }
}

/// A choice of one among four, a row of two above another.
#[derive(Debug, Clone, Copy)]
struct Four([f32; 4]);

impl Four {
    /// Chooses one, takes what that cost from the uniforms, and says how likely it was. `None` when
    /// there is nothing to choose.
    #[inline]
    fn choose(&self, u: &mut [f32; 2]) -> Option<([u32; 2], f32)> {
        let Self([a, b, c, d]) = *self;
        if !(a + b + c + d > 0.0) {
            return None;
        }
        let down = spend(&mut u[1], a + b, c + d);
        let (left, right) = if down { (c, d) } else { (a, b) };
        let aside = spend(&mut u[0], left, right);
        let at = [u32::from(aside), u32::from(down)];
        Some((at, self.probability(at)))
    }

    /// Probability with which [`Four::choose`] chooses one; 0 when there is nothing to choose.
    #[inline]
    fn probability(&self, [x, y]: [u32; 2]) -> f32 {
        let sum: f32 = self.0[0] + self.0[1] + self.0[2] + self.0[3];
        if sum > 0.0 { self.0[(2 * y + x) as usize & 3] / sum } else { 0.0 }
    }
}

/// True for the second of two weights, which are not both 0; stretches what is left of the uniform.
#[inline]
fn spend(u: &mut f32, first: f32, second: f32) -> bool {
    let share = first / (first + second);
    let is_second = *u >= share;
    let rest = if is_second { (*u - share) / (1.0 - share) } else { *u / share };
    *u = num::clamp_unit(rest);
    is_second
}

/// A cell, and the factor from its importance to the density over solid angle (sr⁻¹).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Chosen {
    pub(crate) cell: [u32; 2],
    pub(crate) scale: f32,
}

impl EnvironmentTable<'_> {
    /// True when the table fits a map.
    pub(crate) fn fits(&self, levels: &Levels) -> bool {
        let usable = |m: &f32| *m >= 0.0 && m.is_finite();
        let lobes = self.lobes.is_empty()
            || (1..levels.top).any(|level| levels.len_down_to(level) == self.lobes.len());
        self.masses.len() == levels.len_down_to(1)
            && self.masses.iter().all(usable)
            && [self.total, self.gain].iter().all(|v| *v > 0.0 && v.is_finite())
            && usable(&self.offset)
            && lobes
            && self.moments.len() == self.lobes.len()
    }

    /// Weights of the children of a node; `first` is the index of their level's first node.
    #[inline]
    fn children<W: Weigh>(&self, size: [u32; 2], first: usize, [x, y]: [u32; 2], by: &W) -> Four {
        let [columns, rows] = size;
        let weight = |dx: u32, dy: u32| {
            let (x, y) = (2 * x + dx, 2 * y + dy);
            if x >= columns || y >= rows {
                return 0.0;
            }
            let index = first + y as usize * columns as usize + x as usize;
            let mass = self.masses.get(index).copied().unwrap_or(0.0);
            by.weight(index, mass, self.lobes.get(index).filter(|_| W::KNOWS_LOBES))
        };
        Four([weight(0, 0), weight(1, 0), weight(0, 1), weight(1, 1)])
    }

    /// Chooses a cell, and leaves in `u` what places a sample in it.
    ///
    /// * `by` – how much nodes count
    /// * `cell` – importance times solid angle of a cell
    #[inline]
    pub(crate) fn choose<W: Weigh>(
        &self,
        levels: &Levels,
        by: &W,
        u: &mut [f32; 2],
        cell: impl Fn([u32; 2]) -> f32,
    ) -> Option<Chosen> {
        let (mut at, mut first, mut scale) = ([0, 0], 0, 1.0 / self.total);
        let mut probability = 1.0;
        for level in (1..levels.top).rev() {
            first += levels.len(level + 1);
            let size = levels.size(level);
            let (child, share) = self.children(size, first, at, by).choose(u)?;
            at = [2 * at[0] + child[0], 2 * at[1] + child[1]];
            let index = first + at[1] as usize * size[0] as usize + at[0] as usize;
            if W::KNOWS_LOBES && index < self.lobes.len() {
                probability *= share;
                scale = probability / self.masses.get(index)?;
            }
        }
        if levels.top > 0 {
            let [columns, rows] = levels.size(0);
            let weight = |dx: u32, dy: u32| {
                let c = [2 * at[0] + dx, 2 * at[1] + dy];
                if c[0] < columns && c[1] < rows { cell(c) } else { 0.0 }
            };
            let cells = Four([weight(0, 0), weight(1, 0), weight(0, 1), weight(1, 1)]);
            let (child, _) = cells.choose(u)?;
            at = [2 * at[0] + child[0], 2 * at[1] + child[1]];
        }
        Some(Chosen { cell: at, scale })
    }

    /// The factor from importance to density in a cell (sr⁻¹).
    ///
    /// * `by` – how much nodes count
    #[inline]
    pub(crate) fn scale<W: Weigh>(&self, levels: &Levels, by: &W, cell: [u32; 2]) -> f32 {
        let (mut first, mut scale, mut probability) = (0, 1.0 / self.total, 1.0);
        for level in (1..levels.top).rev() {
            first += levels.len(level + 1);
            let (size, at) = (levels.size(level), cell.map(|c| c >> level));
            let index = first + at[1] as usize * size[0] as usize + at[0] as usize;
            if !W::KNOWS_LOBES || index >= self.lobes.len() {
                break;
            }
            let children = self.children(size, first, at.map(|c| c >> 1), by);
            probability *= children.probability(at.map(|c| c & 1));
            // A node without mass is never chosen.
            let mass = self.masses.get(index).filter(|_| probability > 0.0);
            scale = mass.map_or(0.0, |mass| probability / mass);
        }
        scale
    }
}
