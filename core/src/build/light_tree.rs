//! Building the light tree: from the root down, where the surface area orientation heuristic says.

use crate::choose::{DARK, EVERYWHERE, LightNode, LightTree, LightTreeError, MAX_DEPTH};
use crate::geom::Aabb;
use crate::light::{Emitter, LightBounds};
use core::mem::size_of_val;
use glam::Vec3;
use std::vec;
use std::vec::Vec;

/// Where the box of the centres is cut on trial, along each axis.
const BINS: usize = 12;

/// So deep, nodes are halved: what follows is at most log₂ n deep.
const HALVED_FROM: usize = MAX_DEPTH - 32;

/// The tables of a [`LightTree`], owned.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LightTreeBuffers {
    /// Nodes in depth-first order.
    pub nodes: Vec<LightNode>,
    /// The leaf of each light.
    pub leaves: Vec<u32>,
    /// Lights without a place.
    pub everywhere: Vec<u32>,
}

/// A light on its way into the tree.
#[derive(Clone, Copy)]
struct Item {
    bounds: LightBounds,
    light: u32,
}

impl LightTreeBuffers {
    /// Builds the tree over the lights of a scene.
    #[must_use]
    pub fn new(lights: &[impl Emitter]) -> Self {
        let mut buffers = Self { leaves: vec![DARK; lights.len()], ..Self::default() };
        let mut items = Vec::with_capacity(lights.len());
        for (i, light) in lights.iter().enumerate() {
            match light.bounds() {
                Some(bounds) if bounds.intensity > 0.0 => {
                    items.push(Item { bounds, light: i as u32 });
                }
                Some(_) => {}
                None => {
                    buffers.leaves[i] = EVERYWHERE;
                    buffers.everywhere.push(i as u32);
                }
            }
        }
        buffers.nodes.reserve_exact((2 * items.len()).saturating_sub(1));
        if !items.is_empty() {
            buffers.add(&mut items, 0);
        }
        buffers
    }

    /// The tree, borrowed.
    ///
    /// # Errors
    /// Never for what [`LightTreeBuffers::new`] has made.
    pub fn tree(&self) -> Result<LightTree<'_>, LightTreeError> {
        LightTree::new(&self.nodes, &self.leaves, &self.everywhere)
    }

    /// Bytes of all tables.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.nodes) + size_of_val(&*self.leaves) + size_of_val(&*self.everywhere)
    }

    /// Appends the subtree over some lights, at least one; what bounds them.
    fn add(&mut self, items: &mut [Item], depth: usize) -> LightBounds {
        let index = self.nodes.len();
        if let [item] = items {
            self.leaves[item.light as usize] = index as u32;
            self.nodes.push(LightNode::new(&item.bounds, item.light));
            return item.bounds;
        }
        let middle = split(items, depth);
        let (first, second) = items.split_at_mut(middle);
        // Overwritten when the children are known.
        self.nodes.push(LightNode::new(&first[0].bounds, 0));
        let first = self.add(first, depth + 1);
        let middle = self.nodes.len() as u32;
        let bounds = first.union(self.add(second, depth + 1));
        self.nodes[index] = LightNode::new(&bounds, middle);
        bounds
    }
}

/// Orders the lights of a node, at least two, so that those of the first child come first; how many
/// these are.
fn split(items: &mut [Item], depth: usize) -> usize {
    let half = items.len() / 2;
    if items.len() == 2 {
        return half;
    }
    let centres = items
        .iter()
        .fold(Aabb::EMPTY, |b, i| Aabb { min: b.min.min(i.bounds.centre), max: b.max.max(i.bounds.centre) });
    let cut = if depth < HALVED_FROM { best_cut(items, &centres) } else { None };
    let Some((axis, bin)) = cut else {
        let widest = centres.max - centres.min;
        let axis = (0..3).max_by(|&a, &b| widest[a].total_cmp(&widest[b])).unwrap_or(0);
        items.select_nth_unstable_by(half, |a, b| a.bounds.centre[axis].total_cmp(&b.bounds.centre[axis]));
        return half;
    };
    let bins = Bins::new(&centres, items.len(), axis);
    let (mut first, mut behind) = (0, items.len());
    while first < behind {
        if bins.of(items[first].bounds.centre) <= bin {
            first += 1;
        } else {
            behind -= 1;
            items.swap(first, behind);
        }
    }
    first
}

/// Equal parts of a box along an axis.
#[derive(Clone, Copy)]
struct Bins {
    axis: usize,
    count: usize,
    start: f32,
    scale: f32,
}

impl Bins {
    fn new(centres: &Aabb, items: usize, axis: usize) -> Self {
        let count = items.clamp(2, BINS);
        let (start, end) = (centres.min[axis], centres.max[axis]);
        Self { axis, count, start, scale: count as f32 / (end - start) }
    }

    /// The bin of a centre; all in the first one where the box is flat.
    #[inline]
    fn of(&self, centre: Vec3) -> usize {
        (((centre[self.axis] - self.start) * self.scale) as usize).min(self.count - 1)
    }
}

/// Sums over the lights of a bin.
#[derive(Clone, Copy)]
struct Sums {
    region: Aabb,
    /// Mean normals.
    normals: Vec3,
    intensity: f32,
    count: u32,
}

impl Sums {
    const NONE: Self = Self { region: Aabb::EMPTY, normals: Vec3::ZERO, intensity: 0.0, count: 0 };

    #[inline]
    fn union(self, other: Self) -> Self {
        Self {
            region: self.region.union(other.region),
            normals: self.normals + other.normals,
            intensity: self.intensity + other.intensity,
            count: self.count + other.count,
        }
    }

    #[inline]
    fn of(item: &Item) -> Self {
        let b = &item.bounds;
        // Which of the two sides is the front is the same to a light with two.
        let turned = b.two_sided && b.normal.dot(Vec3::new(1.0, 0.6, 0.3)) < 0.0;
        let normals = if turned { -b.normal } else { b.normal };
        Self { region: b.region, normals, intensity: b.intensity, count: 1 }
    }

    /// Intensity times the squared diagonal of the box, times a measure of how far the normals spread.
    ///
    /// Source: Conty Estevez, Kulla 2018, section 4.4. Differs: the squared diagonal instead of the
    /// surface of the box, because the importance knows only a sphere, and lights in a row have no surface;
    /// the spread from the mean of the normals instead of from the cone around them, which is costlier to
    /// find: both are 1 for equal normals and 4 for normals in all directions.
    #[inline]
    fn cost(&self) -> f32 {
        let diagonal = self.region.max - self.region.min;
        let mean = self.normals.length() / self.count as f32;
        self.intensity * diagonal.length_squared() * (4.0 - 3.0 * mean)
    }
}

/// The axis and the last bin of the first child for the cheapest cut; `None` when no cut parts the lights.
fn best_cut(items: &[Item], centres: &Aabb) -> Option<(usize, usize)> {
    let extent = centres.max - centres.min;
    let mut best = None;
    for axis in 0..3 {
        if !(extent[axis] > 0.0) {
            continue;
        }
        let bins = Bins::new(centres, items.len(), axis);
        let mut sums = [Sums::NONE; BINS];
        for item in items {
            let sum = &mut sums[bins.of(item.bounds.centre)];
            *sum = sum.union(Sums::of(item));
        }
        // Long boxes are cut across.
        let shape = extent.max_element() / extent[axis];
        for (bin, cost) in cut_costs(&sums[..bins.count]) {
            let cost = cost * shape;
            if best.is_none_or(|(_, _, least)| cost < least) {
                best = Some((axis, bin, cost));
            }
        }
    }
    best.map(|(axis, bin, _)| (axis, bin))
}

/// What each cut costs that leaves something on both sides.
fn cut_costs(sums: &[Sums]) -> impl Iterator<Item = (usize, f32)> {
    let mut behind = [Sums::NONE; BINS];
    for i in (0..sums.len() - 1).rev() {
        behind[i] = behind[i + 1].union(sums[i + 1]);
    }
    let mut before = Sums::NONE;
    sums[..sums.len() - 1].iter().enumerate().filter_map(move |(i, sum)| {
        before = before.union(*sum);
        let parts = before.count > 0 && behind[i].count > 0;
        parts.then(|| (i, before.cost() + behind[i].cost()))
    })
}
