//! Building the tree: obvhs clusters and optimises a binary one, which is then made four wide.

use super::parts::{Parts, cut};
use crate::bvh::{Bvh, BvhError, Child, MAX_LEAF, Node, WIDTH};
use crate::geom::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, SortPrecision};
use std::vec;
use std::vec::Vec;

/// Most primitives per leaf, and what stepping down costs beside testing one of them. Instructions
/// per sample of the built-in still life: 6324, 6343 and 6834 at a cost of 0.5, 1 and 3.
const LEAF: u32 = 4;
const STEP_COST: f32 = 1.0;

/// How far apart, in the order along a curve through space, primitives may be that are joined.
const SEARCH: usize = 6;

/// Most primitives that are built at once: of 170 bytes for each, little then stays but what is kept.
const PART: usize = 1 << 18;

/// Share of the nodes that the optimiser tries to move. Ten times as many save 0.3 % of the
/// instructions of a sample there, and nearly double those of the set-up.
const REINSERTION: f32 = 0.02;

/// An owned tree.
#[derive(Debug, Clone, Default)]
pub struct Tree {
    /// Its nodes; the first is the root.
    pub nodes: Vec<Node>,
    /// Which primitive stands at each place of the leaves.
    pub order: Vec<u32>,
}

/// Builds a tree over boxes. Its leaves count places in [`Tree::order`].
///
/// # Errors
/// When there are more boxes than a tree can hold, or a bound is NaN.
pub fn build_tree(boxes: &[Aabb]) -> Result<Tree, BvhError> {
    build_tree_of(boxes.len(), &|i| boxes[i as usize])
}

/// [`build_tree`] over `count` primitives whose boxes are asked for, several times each, and not kept.
pub(super) fn build_tree_of(count: usize, bounds: &impl Fn(u32) -> Aabb) -> Result<Tree, BvhError> {
    if count == 0 {
        return Ok(Tree::default());
    }
    if count > crate::bvh::MAX_PRIMITIVES {
        return Err(BvhError::TooManyPrimitives { primitives: count });
    }
    let mut all = Aabb::EMPTY;
    for b in (0..count as u32).map(bounds) {
        if b.min.is_nan() || b.max.is_nan() {
            return Err(BvhError::NotANumber { node: 0 });
        }
        all = all.union(b);
    }
    let tree = if count > PART {
        in_parts(&cut(count, all, PART, bounds), all, bounds)
    } else {
        whole(count, all, bounds)
    };
    match Bvh::new(&tree.nodes, count) {
        Ok(_) => Ok(tree),
        // Clustering can chain primitives; a balanced tree is never too deep.
        Err(BvhError::TooDeep { .. }) => Ok(balanced(count, bounds)),
        Err(e) => Err(e),
    }
}

/// A tree that is built at once.
fn whole(count: usize, all: Aabb, bounds: &impl Fn(u32) -> Aabb) -> Tree {
    let mut tree = Tree { nodes: Vec::new(), order: Vec::with_capacity(count) };
    widen(&binary(&mut PlocBuilder::new(), all, (0..count as u32).collect(), LEAF, bounds), &mut tree);
    tree.nodes.shrink_to_fit();
    tree
}

/// A tree whose upper part is one over the boxes of parts, which stand below it one after the other.
fn in_parts(Parts { order, parts }: &Parts, all: Aabb, bounds: &impl Fn(u32) -> Aabb) -> Tree {
    let (mut tree, mut builder) = (Tree::default(), PlocBuilder::new());
    let each = (0..parts.len() as u32).collect();
    widen(&binary(&mut builder, all, each, 1, &|part| parts[part as usize].1), &mut tree);
    let (upper, sequence) = (tree.nodes.len(), tree.order);
    tree.order = Vec::with_capacity(order.len());
    let mut roots = Vec::with_capacity(parts.len());
    for part in sequence {
        let part = &order[parts[part as usize].0.clone()];
        if let [alone] = part {
            roots.push(Child::Leaf { first: tree.order.len() as u32, count: 1 });
            tree.order.push(*alone);
            continue;
        }
        roots.push(Child::Node(tree.nodes.len() as u32));
        widen(&binary(&mut builder, all, part.to_vec(), LEAF, bounds), &mut tree);
    }
    for node in &mut tree.nodes[..upper] {
        for slot in 0..WIDTH {
            if let Child::Leaf { first, .. } = node.child(slot) {
                *node = node.with_child(slot, roots[first as usize], node.child_bounds(slot));
            }
        }
    }
    tree.nodes.shrink_to_fit();
    tree
}

/// A binary tree of good quality.
///
/// * `space` – through which the curve runs that orders them: that of the whole scene, so that parts are joined as
///   they would be without the cuts
/// * `leaf` – most primitives of a leaf
fn binary(
    builder: &mut PlocBuilder,
    space: Aabb,
    order: Vec<u32>,
    leaf: u32,
    bounds: &impl Fn(u32) -> Aabb,
) -> Bvh2 {
    let theirs = |Aabb { min, max }| obvhs::aabb::Aabb::new(min.into(), max.into());
    let leaves = order.iter().zip(0..).map(|(&i, place)| Bvh2Node::new(theirs(bounds(i)), 1, place));
    builder.current_nodes.clear();
    builder.current_nodes.extend(leaves);
    let mut tree = Bvh2::zeroed(order.len());
    tree.primitive_indices = order;
    builder.build_ploc_from_leaves::<SEARCH, false>(&mut tree, theirs(space), SortPrecision::U64, 3);
    ReinsertionOptimizer::default().run(&mut tree, REINSERTION, None);
    collapse(&mut tree, leaf, STEP_COST);
    tree
}

/// Adds four-wide nodes from binary ones, in depth-first order, and their primitives.
fn widen(binary: &Bvh2, tree: &mut Tree) {
    // A binary node to turn into the wide node at an index.
    let mut waiting = vec![(0_usize, tree.nodes.len())];
    tree.nodes.push(Node::EMPTY);
    while let Some((from, to)) = waiting.pop() {
        let mut node = Node::EMPTY;
        for (slot, child) in children(binary, from).into_iter().enumerate() {
            let source = &binary.nodes[child];
            let bounds = Aabb { min: source.min, max: source.max };
            let child = if source.is_leaf() {
                let first = tree.order.len() as u32;
                let places = source.first_index as usize..(source.first_index + source.prim_count) as usize;
                tree.order.extend_from_slice(&binary.primitive_indices[places]);
                Child::Leaf { first, count: source.prim_count }
            } else {
                tree.nodes.push(Node::EMPTY);
                waiting.push((child, tree.nodes.len() - 1));
                Child::Node(tree.nodes.len() as u32 - 1)
            };
            node = node.with_child(slot, child, bounds);
        }
        tree.nodes[to] = node;
    }
}

/// Up to four descendants that stand for a binary node: the largest is opened first.
fn children(binary: &Bvh2, node: usize) -> Vec<usize> {
    let mut open = vec![node];
    while open.len() < WIDTH {
        let largest = (0..open.len()).filter(|&i| !binary.nodes[open[i]].is_leaf()).max_by(|&a, &b| {
            let area = |i: usize| binary.nodes[open[i]].aabb().half_area();
            area(a).total_cmp(&area(b))
        });
        let Some(i) = largest else { break };
        let first = binary.nodes[open[i]].first_index as usize;
        open[i] = first;
        open.push(first + 1);
    }
    open
}

/// A tree by medians, at most log₄ n deep: for what clustering makes too deep.
fn balanced(count: usize, bounds: &impl Fn(u32) -> Aabb) -> Tree {
    let mut order: Vec<u32> = (0..count as u32).collect();
    let mut nodes = vec![Node::EMPTY];
    let mut waiting = vec![(0_usize, 0..count)];
    while let Some((to, range)) = waiting.pop() {
        split_by_median(&mut order[range.clone()], bounds);
        let quarter = range.len().div_ceil(WIDTH).max(1);
        for slot in 0..WIDTH {
            let start = (range.start + slot * quarter).min(range.end);
            let part = start..(start + quarter).min(range.end);
            if part.is_empty() {
                continue;
            }
            let around = order[part.clone()].iter().fold(Aabb::EMPTY, |b, &i| b.union(bounds(i)));
            let child = if part.len() <= MAX_LEAF.min(LEAF as usize) {
                Child::Leaf { first: part.start as u32, count: part.len() as u32 }
            } else {
                nodes.push(Node::EMPTY);
                waiting.push((nodes.len() - 1, part));
                Child::Node(nodes.len() as u32 - 1)
            };
            nodes[to] = nodes[to].with_child(slot, child, around);
        }
    }
    Tree { nodes, order }
}

/// Orders primitives along the longest axis of their centres, as far as quarters need it.
fn split_by_median(order: &mut [u32], bounds: &impl Fn(u32) -> Aabb) {
    let centres = order.iter().fold(Aabb::EMPTY, |b, &i| {
        let c = bounds(i).centre();
        b.union(Aabb { min: c, max: c })
    });
    let extent = centres.max - centres.min;
    let axis = if extent.x >= extent.y && extent.x >= extent.z {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    };
    let key = |i: &u32| bounds(*i).centre()[axis];
    order.sort_unstable_by(|a, b| key(a).total_cmp(&key(b)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn at(p: Vec3) -> Aabb {
        Aabb { min: p, max: p + Vec3::splat(0.5) }
    }

    #[track_caller]
    fn holds_everything_once(tree: &Tree, boxes: &[Aabb]) {
        Bvh::new(&tree.nodes, boxes.len()).unwrap();
        let mut seen = vec![false; boxes.len()];
        tree.order.iter().for_each(|&i| assert!(!core::mem::replace(&mut seen[i as usize], true)));
        assert!(seen.iter().all(|&s| s));
        for node in &tree.nodes {
            for slot in 0..WIDTH {
                let bounds = node.child_bounds(slot);
                let inside = |b: Aabb| assert_eq!(bounds.union(b), bounds);
                match node.child(slot) {
                    Child::Leaf { first, count } => {
                        (first..first + count).for_each(|p| inside(boxes[tree.order[p as usize] as usize]))
                    }
                    Child::Node(child) => inside(tree.nodes[child as usize].bounds()),
                    Child::Empty => {}
                }
            }
        }
    }

    /// A tree in parts of at most so many, but for coincident ones.
    fn parted(boxes: &[Aabb], most: usize) -> Tree {
        let bounds = |i: u32| boxes[i as usize];
        let all = boxes.iter().fold(Aabb::EMPTY, |a, b| a.union(*b));
        let parts = cut(boxes.len(), all, most, &bounds);
        assert_eq!(parts.order.len(), boxes.len());
        if boxes.is_empty() { Tree::default() } else { in_parts(&parts, all, &bounds) }
    }

    #[test]
    fn every_number_of_boxes_is_held() {
        for n in (0..40).chain([1000, 5000]) {
            let boxes: Vec<_> = (0..n)
                .map(|i| {
                    let u = |k| crate::num::unit_f32(crate::num::hash2(i, k)) * 10.0;
                    at(Vec3::new(u(0), u(1), u(2)))
                })
                .collect();
            holds_everything_once(&build_tree(&boxes).unwrap(), &boxes);
            holds_everything_once(&balanced(boxes.len(), &|i| boxes[i as usize]), &boxes);
            for most in [1, 7, 100] {
                holds_everything_once(&parted(&boxes, most), &boxes);
            }
        }
    }

    #[test]
    fn coincident_and_exponentially_spaced_boxes_are_held() {
        let same = vec![at(Vec3::ONE); 10_000];
        holds_everything_once(&build_tree(&same).unwrap(), &same);
        assert_eq!(cut(same.len(), same[0], 100, &|i| same[i as usize]).parts, [(0..same.len(), same[0])]);
        let spaced: Vec<_> = (0..240)
            .map(|i| {
                let s = libm::exp2f(i as f32 * 0.5 - 60.0);
                Aabb { min: Vec3::splat(s), max: Vec3::splat(s * 1.1) }
            })
            .collect();
        holds_everything_once(&build_tree(&spaced).unwrap(), &spaced);
    }

    #[test]
    fn a_bound_that_is_not_a_number_is_refused() {
        let boxes = [Aabb { min: Vec3::NAN, max: Vec3::ONE }];
        assert!(matches!(build_tree(&boxes), Err(BvhError::NotANumber { .. })));
    }
}
