//! Choosing by what the lights are expected to send to the receiver.

use super::node::LightNode;
use crate::light::Receiver;
use crate::num;
use core::fmt;

/// Deepest tree that a choice walks; [`LightTree::new`] refuses a deeper one.
pub const MAX_DEPTH: usize = 64;

/// What stands in the table of leaves for a light that is dark and never chosen.
pub const DARK: u32 = u32::MAX;

/// What stands there for a light without a place, which is sampled besides the chosen one.
pub const EVERYWHERE: u32 = u32::MAX - 1;

/// Least probability of a child that may matter: what an estimate that is wrong can cost.
const LEAST: f32 = 1.0 / 1024.0;

/// A path that has become less likely than this goes on with a second uniform: the first has not bits
/// enough for both.
const SECOND: f32 = 1.0 / 4096.0;

/// A tree over the lights that have a place, in the caller's slices. Each choice walks it once from
/// the root, so that its cost grows with the logarithm of their number.
///
/// Nodes are in depth-first order: the first child follows its parent, the second one is where the
/// parent's link says, and a leaf is what has no room for children.
///
/// Source: Conty Estevez, Kulla 2018, *Importance Sampling of Many Lights with Adaptive Tree Splitting*,
/// Proc. ACM Comput. Graph. Interact. Tech. 1(2), section 5; without the splitting.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightTree<'a> {
    nodes: &'a [LightNode],
    leaves: &'a [u32],
    everywhere: &'a [u32],
}

/// Nodes `from..to`: a subtree.
#[derive(Clone, Copy)]
struct Subtree {
    from: usize,
    to: usize,
}

impl<'a> LightTree<'a> {
    /// Borrows a tree.
    ///
    /// * `nodes` – in depth-first order
    /// * `leaves` – for each light the index of its leaf, [`DARK`] or [`EVERYWHERE`]
    /// * `everywhere` – the indices of those without a place, in ascending order
    ///
    /// # Errors
    /// When a choice could fail, or be reported with a wrong probability; see [`LightTreeError`].
    pub fn new(
        nodes: &'a [LightNode],
        leaves: &'a [u32],
        everywhere: &'a [u32],
    ) -> Result<Self, LightTreeError> {
        let count = check_structure(nodes, leaves)?;
        let placed = leaves.iter().filter(|&&leaf| leaf < EVERYWHERE).count();
        if placed != count {
            return Err(LightTreeError::Count { leaves: count, lights: placed });
        }
        let all = leaves.iter().enumerate().filter(|&(_, &leaf)| leaf == EVERYWHERE).map(|(i, _)| i);
        if !all.eq(everywhere.iter().map(|&i| i as usize)) {
            return Err(LightTreeError::Everywhere);
        }
        Ok(Self { nodes, leaves, everywhere })
    }

    /// The lights that are sampled besides the chosen one.
    #[inline]
    #[must_use]
    pub fn everywhere(&self) -> &'a [u32] {
        self.everywhere
    }

    /// A light for `from`, and its probability; `None` when none has a place.
    ///
    /// * `u` – a uniform in `[0, 1)`
    /// * `more` – a second one, for lights so improbable that the first has not bits enough
    #[inline]
    #[must_use]
    pub fn choose(&self, from: &Receiver, mut u: f32, more: impl FnOnce() -> f32) -> Option<(usize, f32)> {
        let (mut left, mut more) = (1.0, Some(more));
        let (leaf, pmf) = self.walk(from, |p, _| {
            let first = u < p;
            let part = if first { p } else { 1.0 - p };
            u = num::clamp_unit(if first { u / p } else { (u - p) / part });
            left *= part;
            if left < SECOND
                && let Some(more) = more.take()
            {
                u = more();
            }
            first
        });
        self.nodes.get(leaf).map(|node| (node.link() as usize, pmf))
    }

    /// Probability with which [`LightTree::choose`] chooses `light` for `from`, the same to the last bit;
    /// 1 for a light without a place, 0 for a dark one.
    #[inline]
    #[must_use]
    pub fn pmf(&self, from: &Receiver, light: usize) -> f32 {
        match self.leaves.get(light) {
            Some(&EVERYWHERE) => 1.0,
            None | Some(&DARK) => 0.0,
            Some(&leaf) => self.walk(from, |_, second| (leaf as usize) < second).1,
        }
    }

    /// Goes from the root to a leaf; its index, and the probability of the way.
    ///
    /// * `is_first` – whether to go to the first child, which has the given probability, rather than to
    ///   the second, which has the given index
    ///
    /// Two steps are taken at a time, by the importance of the grandchildren: smaller nodes are better
    /// known. On the peers' scene `many` that halves the variance, at the same number of nodes.
    #[inline]
    fn walk(&self, from: &Receiver, mut is_first: impl FnMut(f32, usize) -> bool) -> (usize, f32) {
        let (mut tree, mut pmf) = (Subtree { from: 0, to: self.nodes.len() }, 1.0);
        let mut step = |second: Subtree, a: f32, b: f32| {
            let p = share(a, b);
            let is_first = is_first(p, second.from);
            pmf = times(pmf, if is_first { p } else { 1.0 - p });
            is_first
        };
        while let Some(halves) = self.children(tree) {
            let (a, b) = (self.importances(from, halves.0), self.importances(from, halves.1));
            let (half, [a, b]) =
                if step(halves.1, a[0] + a[1], b[0] + b[1]) { (halves.0, a) } else { (halves.1, b) };
            tree = match self.children(half) {
                Some(quarters) if step(quarters.1, a, b) => quarters.0,
                Some(quarters) => quarters.1,
                None => half,
            };
        }
        (tree.from, pmf)
    }

    /// Importance of the children; of a leaf, its own.
    #[inline]
    fn importances(&self, from: &Receiver, tree: Subtree) -> [f32; 2] {
        let importance = |node: Subtree| self.nodes.get(node.from).map_or(0.0, |node| node.importance(from));
        match self.children(tree) {
            Some((first, second)) => [importance(first), importance(second)],
            None => [importance(tree), 0.0],
        }
    }

    /// The two halves of a subtree; `None` at a leaf.
    #[inline]
    fn children(&self, Subtree { from, to }: Subtree) -> Option<(Subtree, Subtree)> {
        if to <= from + 1 {
            return None;
        }
        let middle = self.nodes.get(from)?.link() as usize;
        Some((Subtree { from: from + 1, to: middle }, Subtree { from: middle, to }))
    }
}

/// Probability of the first of two children: its share of their importance, but at least [`LEAST`] for
/// each that may matter. Where neither does, a half.
#[inline]
fn share(a: f32, b: f32) -> f32 {
    match (a > 0.0, b > 0.0) {
        (true, true) => num::clamp(a / (a + b), LEAST, 1.0 - LEAST),
        (true, false) => 1.0,
        (false, true) => 0.0,
        (false, false) => 0.5,
    }
}

/// A product of probabilities; one that is not 0 stays so.
#[inline]
fn times(a: f32, b: f32) -> f32 {
    if b > 0.0 { num::larger(a * b, f32::MIN_POSITIVE) } else { 0.0 }
}

/// Checks that the nodes are one tree in depth-first order and that each leaf is known as its light's;
/// counts the leaves.
fn check_structure(nodes: &[LightNode], leaves: &[u32]) -> Result<usize, LightTreeError> {
    // Where the subtrees end that are still open, the innermost last, and the depth of what follows.
    let mut open = [(0, 0); MAX_DEPTH + 1];
    open[0] = (nodes.len(), 0);
    let (mut innermost, mut depth, mut count) = (0, 0, 0);
    for (index, node) in nodes.iter().enumerate() {
        let (end, _) = open[innermost];
        if end == index + 1 {
            let light = node.link() as usize;
            if leaves.get(light) != Some(&(index as u32)) {
                return Err(LightTreeError::Leaf { node: index });
            }
            count += 1;
            depth = open[innermost].1;
            innermost = innermost.saturating_sub(1);
            continue;
        }
        let middle = node.link() as usize;
        if middle <= index + 1 || middle >= end {
            return Err(LightTreeError::Child { node: index });
        }
        depth += 1;
        if depth > MAX_DEPTH {
            return Err(LightTreeError::TooDeep { node: index });
        }
        innermost += 1;
        open[innermost] = (middle, depth);
    }
    Ok(count)
}

/// Why a light tree was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum LightTreeError {
    /// The second child of a node is not behind the first one and within the parent.
    Child {
        /// Which node.
        node: usize,
    },
    /// A node is deeper than [`MAX_DEPTH`].
    TooDeep {
        /// Which node.
        node: usize,
    },
    /// A leaf names a light that does not name the leaf.
    Leaf {
        /// Which node.
        node: usize,
    },
    /// There are more or fewer leaves than lights with a place.
    Count {
        /// Leaves of the tree.
        leaves: usize,
        /// Lights that name a leaf.
        lights: usize,
    },
    /// The list of lights without a place differs from what the table of leaves says.
    Everywhere,
}

impl fmt::Display for LightTreeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Child { node } => {
                write!(f, "the second child of node {node} is not between the first one and its end")
            }
            Self::TooDeep { node } => write!(f, "node {node} is deeper than {MAX_DEPTH}; balance the tree"),
            Self::Leaf { node } => {
                write!(f, "the leaf at node {node} names a light that does not name it")
            }
            Self::Count { leaves, lights } => {
                write!(f, "the tree has {leaves} leaves for {lights} lights with a place")
            }
            Self::Everywhere => {
                write!(f, "the lights without a place are not those that the table of leaves marks")
            }
        }
    }
}

impl core::error::Error for LightTreeError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Emitter, Point};
    use crate::{Rgb, num};
    use glam::Vec3;
    use std::vec;
    use std::vec::Vec;

    fn node(link: u32) -> LightNode {
        let light = Point::new(Vec3::X * num::unit_f32(num::hash(link)), Rgb::WHITE).unwrap();
        LightNode::new(&light.bounds().unwrap(), link)
    }

    /// A tree in which every first child is a leaf, or every second one.
    fn chain(leaves: u32, first: bool) -> (Vec<LightNode>, Vec<u32>) {
        let (mut nodes, mut places) = (Vec::new(), vec![0; leaves as usize]);
        let mut leaf = |nodes: &mut Vec<LightNode>, light: u32| {
            places[light as usize] = nodes.len() as u32;
            nodes.push(node(light));
        };
        for light in 0..leaves - 1 {
            let index = nodes.len() as u32;
            // As many nodes as are left below.
            nodes.push(node(if first { index + 2 } else { 2 * (leaves - 1 - light) + index }));
            if first {
                leaf(&mut nodes, light);
            }
        }
        leaf(&mut nodes, leaves - 1);
        if !first {
            (0..leaves - 1).rev().for_each(|light| leaf(&mut nodes, light));
        }
        (nodes, places)
    }

    #[test]
    fn chains_are_trees_until_they_are_too_deep() {
        for first in [true, false] {
            let (nodes, leaves) = chain(MAX_DEPTH as u32 + 1, first);
            let tree = LightTree::new(&nodes, &leaves, &[]).unwrap();
            let from = Receiver { point: Vec3::Y, normal: Vec3::NEG_Y };
            for i in 0..1000 {
                let (light, pmf) = tree.choose(&from, i as f32 / 1000.0, || 0.5).unwrap();
                assert!(pmf > 0.0 && pmf == tree.pmf(&from, light));
            }
            let (nodes, leaves) = chain(MAX_DEPTH as u32 + 2, first);
            let refused = LightTree::new(&nodes, &leaves, &[]);
            assert!(matches!(refused, Err(LightTreeError::TooDeep { .. })), "{refused:?}");
        }
    }

    #[test]
    fn nodes_that_are_no_tree_are_refused() {
        use LightTreeError::{Child, Count, Everywhere, Leaf};
        assert!(LightTree::new(&[], &[DARK, EVERYWHERE], &[1]).is_ok());
        assert_eq!(LightTree::new(&[], &[EVERYWHERE], &[]), Err(Everywhere));
        assert_eq!(LightTree::new(&[], &[0], &[]), Err(Count { leaves: 0, lights: 1 }));
        let three = [node(2), node(0), node(1)];
        assert!(LightTree::new(&three, &[1, 2], &[]).is_ok());
        assert_eq!(LightTree::new(&three, &[2, 1], &[]), Err(Leaf { node: 1 }));
        assert_eq!(LightTree::new(&three, &[1], &[]), Err(Leaf { node: 2 }));
        assert_eq!(LightTree::new(&three, &[1, 2, 2], &[]), Err(Count { leaves: 2, lights: 3 }));
        for link in [0, 1, 3, u32::MAX] {
            let bad = [node(link), node(0), node(1)];
            assert_eq!(LightTree::new(&bad, &[1, 2], &[]), Err(Child { node: 0 }));
        }
        // A node that never gets its second child.
        assert_eq!(LightTree::new(&three[..2], &[1, 2], &[]), Err(Child { node: 0 }));
    }
}
