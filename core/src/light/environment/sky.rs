//! The part of a sky that nothing hides.
//!
//! Above a flat surface most of a sky is open: no geometry is there. What comes from there needs neither
//! samples nor shadow rays, since the irradiance by a part of the sky is the integral of radiance times
//! direction, times the normal; only the rest is sampled, with a density that knows the normal.
//!
//! The map is divided as its table is, into the coarse nodes; a part that crosses the horizon counts as
//! hidden.

use super::table::{EnvironmentTable, Levels, Lobe, Weigh};
use super::{EnvironmentMap, LightSample};
use crate::Rgb;
use crate::num;
use glam::{Vec2, Vec3};

/// Nodes of the level that is the last to know the receiver's cosine, at most. Each level more halves what
/// its blocks waste below the horizon, and adds a step to every sample.
pub(crate) const MOST_LEAVES: usize = 64 * 32;

/// All coarse nodes, at most: each level has half of the columns and rows of the one below, rounded up.
const MOST_NODES: usize = MOST_LEAVES + MOST_LEAVES / 2;

/// Nodes that wait while the tree is walked: three on each level, and the last four.
const WAITING: usize = 3 * 16 + 1;

/// The parts of a sky that are known to be open, as seen from some points of a flat surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ClearSky {
    leaves: [u32; MOST_LEAVES / 32],
}

/// A part of the sky, as directions in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SkyPart {
    /// Every direction `d` of the part has `outward · d ≤ 0`.
    pub outward: [Vec3; 4],
    /// Unit direction in its middle.
    pub axis: Vec3,
    /// Sine of the half-angle of a cone around it.
    pub sin_radius: f32,
}

/// A sky as a surface with one normal sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct SkyView {
    irradiance: Rgb,
    weights: [f32; MOST_NODES],
}

impl SkyView {
    /// Irradiance by the part that is open (W m⁻²).
    #[must_use]
    pub const fn irradiance(&self) -> Rgb {
        self.irradiance
    }

    /// True when nothing else of the sky is above the horizon.
    #[must_use]
    pub const fn is_all(&self) -> bool {
        !(self.weights[0] > 0.0)
    }
}

/// By what was worked out before.
impl Weigh for SkyView {
    const KNOWS_LOBES: bool = true;

    #[inline]
    fn weight(&self, index: usize, mass: f32, lobe: Option<&Lobe>) -> f32 {
        if lobe.is_none() { mass } else { self.weights.get(index).copied().unwrap_or(0.0) }
    }
}

/// A coarse node.
#[derive(Debug, Clone, Copy, Default)]
struct Node {
    level: u32,
    at: [u32; 2],
    /// Index of the first node of its level.
    first: usize,
}

/// The coarse nodes of a table.
#[derive(Debug, Clone, Copy)]
struct Coarse<'t> {
    table: &'t EnvironmentTable<'t>,
    levels: Levels,
    leaf: u32,
}

impl<'t> Coarse<'t> {
    /// `None` when the table has none, or more than there is place for.
    fn new(table: &'t EnvironmentTable<'t>, levels: Levels) -> Option<Self> {
        let nodes = table.lobes.len();
        let leaf = (1..=levels.top).find(|&level| levels.len_down_to(level) == nodes)?;
        let fits = levels.len(leaf) <= MOST_LEAVES && nodes <= MOST_NODES;
        fits.then_some(Self { table, levels, leaf })
    }

    fn index(&self, node: &Node) -> usize {
        node.first + node.at[1] as usize * self.levels.size(node.level)[0] as usize + node.at[0] as usize
    }

    /// Number of a leaf among the leaves.
    fn leaf_of(&self, at: [u32; 2]) -> usize {
        at[1] as usize * self.levels.size(self.leaf)[0] as usize + at[0] as usize
    }

    /// Visits nodes from the top; `descend` says whether to go on below one.
    fn walk(&self, mut descend: impl FnMut(&Node, &Lobe) -> bool) {
        let mut waiting = [Node::default(); WAITING];
        (waiting[0], waiting[0].level) = (Node::default(), self.levels.top);
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let Some(node) = waiting.get(count).copied() else { return };
            let Some(lobe) = self.table.lobes.get(self.index(&node)) else { return };
            if !descend(&node, lobe) || node.level == self.leaf {
                continue;
            }
            let (level, first) = (node.level - 1, node.first + self.levels.len(node.level));
            let [columns, rows] = self.levels.size(level);
            for (dx, dy) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let at = [2 * node.at[0] + dx, 2 * node.at[1] + dy];
                if at[0] < columns
                    && at[1] < rows
                    && let Some(place) = waiting.get_mut(count)
                {
                    *place = Node { level, at, first };
                    count += 1;
                }
            }
        }
    }

    /// Luminance that a node sends, times the gain of the table, about: without how its directions differ;
    /// infinite where `f32` cannot hold it.
    fn flux(&self, index: usize) -> f32 {
        let EnvironmentTable { moments, masses, gain, .. } = *self.table;
        let flux = Rgb::from(moments[index].map(|m| (m * gain).length())).luminance();
        let is_held = flux.is_finite() && (flux > 0.0 || !(masses[index] > 0.0));
        if is_held { flux } else { f32::INFINITY }
    }

    /// Adds the weights of the leaves to those of the nodes above them.
    fn add_up(&self, weights: &mut [f32; MOST_NODES]) {
        let mut first = self.table.lobes.len();
        for level in self.leaf..self.levels.top {
            let ([columns, rows], parents) = (self.levels.size(level), self.levels.size(level + 1)[0]);
            first -= self.levels.len(level);
            let above = first - self.levels.len(level + 1);
            for (x, y) in (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))) {
                let weight = weights[first + (y * columns + x) as usize];
                weights[above + (y / 2 * parents + x / 2) as usize] += weight;
            }
        }
    }

    /// The leaves below a node.
    fn leaves(&self, node: &Node) -> impl Iterator<Item = usize> + use<'_> {
        let down = node.level - self.leaf;
        let size = self.levels.size(self.leaf);
        let range = |i: usize, at: u32| (at << down)..((at + 1) << down).min(size[i]);
        let (columns, rows) = (range(0, node.at[0]), range(1, node.at[1]));
        rows.flat_map(move |y| columns.clone().map(move |x| self.leaf_of([x, y])))
    }
}

impl ClearSky {
    /// True for a leaf that is known to be open.
    fn holds(&self, leaf: usize) -> bool {
        self.leaves.get(leaf / 32).is_some_and(|word| word >> (leaf % 32) & 1 == 1)
    }
}

impl EnvironmentMap<'_> {
    /// The coarse nodes; `None` for a map whose density does not know the receiver's cosine.
    fn coarse(&self) -> Option<Coarse<'_>> {
        Coarse::new(self.table.as_ref()?, Levels::new(&self.grid))
    }

    /// Finds out which parts of the map are open above a surface; `None` when that cannot be said of this map.
    ///
    /// * `normal` – unit normal of the surface
    /// * `may_hide` – whether something may be in a part, as seen from the surface
    #[must_use]
    pub fn clear(&self, normal: Vec3, mut may_hide: impl FnMut(&SkyPart) -> bool) -> Option<ClearSky> {
        let coarse = self.coarse()?;
        let (normal, to_world) = (self.to_local * normal, self.to_local.transpose());
        let mut clear = ClearSky { leaves: [0; MOST_LEAVES / 32] };
        coarse.walk(|node, lobe| {
            if lobe.largest_cosine(normal) <= 0.0 {
                return false;
            }
            let is_above = lobe.largest_cosine(-normal) <= 0.0;
            let is_open = |part: SkyPart| {
                let part = SkyPart {
                    outward: part.outward.map(|n| to_world * n),
                    axis: to_world * part.axis,
                    ..part
                };
                !may_hide(&part)
            };
            if !(is_above && lobe.part().is_some_and(is_open)) {
                return true;
            }
            for leaf in coarse.leaves(node) {
                clear.leaves[leaf / 32] |= 1 << (leaf % 32);
            }
            false
        });
        Some(clear)
    }

    /// True for a direction toward a part of the map that is known to be open.
    #[must_use]
    pub fn is_clear(&self, clear: &ClearSky, direction: Vec3) -> bool {
        self.coarse().is_some_and(|coarse| {
            let place = self.grid.place(self.to_local * direction);
            clear.holds(coarse.leaf_of([place.x >> coarse.leaf, place.y >> coarse.leaf]))
        })
    }

    /// The map as a surface sees it above which parts of it are `clear`.
    ///
    /// * `normal` – unit normal of the surface, for which `clear` was found
    #[must_use]
    pub fn view(&self, normal: Vec3, clear: &ClearSky) -> Option<SkyView> {
        let coarse = self.coarse()?;
        let normal = self.to_local * normal;
        let mut view = SkyView { irradiance: Rgb::BLACK, weights: [0.0; MOST_NODES] };
        let (mut by_flux, mut by_size) = (0.0, 0.0);
        coarse.walk(|node, lobe| {
            if node.level == coarse.leaf {
                let index = coarse.index(node);
                let flux = coarse.flux(index);
                if clear.holds(coarse.leaf_of(node.at)) {
                    // Where `f32` does not hold the moment, the closed form says nothing.
                    let toward =
                        |m: Vec3| if flux < f32::INFINITY { num::larger(normal.dot(m), 0.0) } else { flux };
                    view.irradiance += Rgb::from(coarse.table.moments[index].map(toward));
                } else {
                    let cosine = lobe.cosine(normal);
                    view.weights[index] = cosine * flux;
                    by_flux += cosine * flux;
                    by_size += cosine * lobe.size();
                }
            }
            lobe.largest_cosine(normal) > 0.0
        });
        // Source: Hesterberg 1995, *Weighted Average Importance Sampling and Defensive Mixture Distributions*,
        // section 2: half of the directions do not rely on what is bright, which may be hidden.
        let even = by_flux / by_size;
        coarse.walk(|node, lobe| {
            let index = coarse.index(node);
            if node.level == coarse.leaf && view.weights[index] > 0.0 {
                view.weights[index] += even * (lobe.cosine(normal) * lobe.size());
            }
            lobe.largest_cosine(normal) > 0.0
        });
        coarse.add_up(&mut view.weights);
        view.irradiance *= self.scale;
        (view.irradiance.is_finite() && view.weights[0].is_finite()).then_some(view)
    }

    /// Draws a direction toward what is not known to be open, in proportion to what counts at the surface
    /// that the view is of; `None` when nothing is there.
    ///
    /// * `u` – two independent uniforms, each in `[0, 1)`
    #[inline]
    #[must_use]
    pub fn sample_rest(&self, view: &SkyView, u: [f32; 2]) -> Option<LightSample> {
        self.sample_by(self.table.as_ref()?, view, u)
    }
}

impl Lobe {
    /// About its solid angle (sr).
    fn size(&self) -> f32 {
        let ([west, east], [north, south]) = (self.columns, self.rows);
        let across = if west == east { num::TAU } else { west.distance(east) };
        across * num::larger(north.x - south.x, 0.0)
    }

    /// The node as directions in the map's space; `None` for one that is too wide.
    ///
    /// Derived: between two meridians a direction at the elevation `e` and `ψ` beside the middle one is
    /// below the plane of the inclination `ε` when `tan e ≤ tan ε cos ψ`.
    fn part(&self) -> Option<SkyPart> {
        let ([west, east], [north, south]) = (self.columns, self.rows);
        let middle = (west + east).try_normalize().filter(|_| west != east && self.sin_radius < 1.0)?;
        let aside = middle.dot(west).min(middle.dot(east));
        // Cosine and sine of the angle from the zenith.
        let plane = |row: Vec2, narrowest: f32| {
            let level = middle * -row.x;
            Vec3::new(level.x, row.y * narrowest, level.y)
        };
        let above = plane(north, if north.x > 0.0 { aside } else { 1.0 });
        let below = -plane(south, if south.x < 0.0 { aside } else { 1.0 });
        let outward = [above, below, Vec3::new(west.y, 0.0, -west.x), Vec3::new(-east.y, 0.0, east.x)];
        let along = (north + south).try_normalize()?;
        let axis = Vec3::new(along.y * middle.x, along.x, along.y * middle.y);
        Some(SkyPart { outward, axis, sin_radius: self.sin_radius })
    }
}

#[cfg(all(test, feature = "build"))]
mod tests;
