//! Building the tree: obvhs clusters and optimises a binary one, which is then made four wide.

use crate::bvh::{Bvh, BvhError, Child, MAX_LEAF, Node, WIDTH};
use crate::geom::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::leaf_collapser::collapse;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use std::vec;
use std::vec::Vec;

/// Most primitives per leaf, and what stepping down costs beside testing one of them. Instructions
/// per sample of the built-in still life: 6324, 6343 and 6834 at a cost of 0.5, 1 and 3.
const LEAF: u32 = 4;
const STEP_COST: f32 = 1.0;

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
    if boxes.is_empty() {
        return Ok(Tree::default());
    }
    if boxes.len() > crate::bvh::MAX_PRIMITIVES {
        return Err(BvhError::TooManyPrimitives { primitives: boxes.len() });
    }
    if boxes.iter().any(|b| b.min.is_nan() || b.max.is_nan()) {
        return Err(BvhError::NotANumber { node: 0 });
    }
    let tree = widen(&binary(boxes), boxes);
    match Bvh::new(&tree.nodes, boxes.len()) {
        Ok(_) => Ok(tree),
        // Clustering can chain primitives; a balanced tree is never too deep.
        Err(BvhError::TooDeep { .. }) => Ok(balanced(boxes)),
        Err(e) => Err(e),
    }
}

/// A binary tree of good quality.
fn binary(boxes: &[Aabb]) -> Bvh2 {
    let corners: Vec<_> = boxes.iter().map(|b| obvhs::aabb::Aabb::new(b.min.into(), b.max.into())).collect();
    let order = (0..boxes.len() as u32).collect();
    let mut tree = PlocBuilder::new().build(PlocSearchDistance::Low, &corners, order, SortPrecision::U64, 3);
    drop(corners);
    ReinsertionOptimizer::default().run(&mut tree, REINSERTION, None);
    collapse(&mut tree, LEAF, STEP_COST);
    tree
}

/// Four-wide nodes from binary ones, in depth-first order.
fn widen(binary: &Bvh2, boxes: &[Aabb]) -> Tree {
    let mut tree = Tree { nodes: vec![Node::EMPTY], order: Vec::with_capacity(boxes.len()) };
    // A binary node to turn into the wide node at an index.
    let mut waiting = vec![(0_usize, 0_usize)];
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
    tree
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
fn balanced(boxes: &[Aabb]) -> Tree {
    let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
    let mut nodes = vec![Node::EMPTY];
    let mut waiting = vec![(0_usize, 0..boxes.len())];
    while let Some((to, range)) = waiting.pop() {
        split_by_median(boxes, &mut order[range.clone()]);
        let quarter = range.len().div_ceil(WIDTH).max(1);
        for slot in 0..WIDTH {
            let start = (range.start + slot * quarter).min(range.end);
            let part = start..(start + quarter).min(range.end);
            if part.is_empty() {
                continue;
            }
            let bounds = order[part.clone()].iter().fold(Aabb::EMPTY, |b, &i| b.union(boxes[i as usize]));
            let child = if part.len() <= MAX_LEAF.min(LEAF as usize) {
                Child::Leaf { first: part.start as u32, count: part.len() as u32 }
            } else {
                nodes.push(Node::EMPTY);
                waiting.push((nodes.len() - 1, part));
                Child::Node(nodes.len() as u32 - 1)
            };
            nodes[to] = nodes[to].with_child(slot, child, bounds);
        }
    }
    Tree { nodes, order }
}

/// Orders primitives along the longest axis of their centres, as far as quarters need it.
fn split_by_median(boxes: &[Aabb], order: &mut [u32]) {
    let centres = order.iter().fold(Aabb::EMPTY, |b, &i| {
        let c = boxes[i as usize].centre();
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
    let key = |i: &u32| boxes[*i as usize].centre()[axis];
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
            holds_everything_once(&balanced(&boxes), &boxes);
        }
    }

    #[test]
    fn coincident_and_exponentially_spaced_boxes_are_held() {
        let same = vec![at(Vec3::ONE); 10_000];
        holds_everything_once(&build_tree(&same).unwrap(), &same);
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
