//! Checking a tree once, so that no query needs to.

use super::node::{Child, Node, WIDTH};
use core::fmt;

/// Why a tree was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum BvhError {
    /// More primitives than a leaf can name.
    TooManyPrimitives {
        /// How many there are.
        primitives: usize,
    },
    /// A slot names a node that does not exist.
    NodeOutOfRange {
        /// The node whose slot it is.
        node: usize,
    },
    /// A leaf is empty or names primitives that do not exist.
    LeafOutOfRange {
        /// The node whose slot it is.
        node: usize,
    },
    /// A bound is NaN.
    NotANumber {
        /// The node whose bound it is.
        node: usize,
    },
    /// A node is reached twice, or by itself.
    Shared {
        /// The node after which it shows.
        node: usize,
    },
    /// A node is not reached at all.
    Unreachable {
        /// How many nodes are reached.
        reached: usize,
    },
    /// A ray could need more stack than a query has.
    TooDeep {
        /// Entries that it could need.
        needed: usize,
        /// Entries that there are.
        available: usize,
    },
}

impl fmt::Display for BvhError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyPrimitives { primitives } => {
                write!(f, "{primitives} primitives; a tree holds at most {}", super::MAX_PRIMITIVES)
            }
            Self::NodeOutOfRange { node } => write!(f, "node {node} names a child that does not exist"),
            Self::LeafOutOfRange { node } => {
                write!(f, "node {node} has a leaf that is empty or names primitives that do not exist")
            }
            Self::NotANumber { node } => write!(f, "node {node} has a bound that is not a number"),
            Self::Shared { node } => write!(f, "the tree reaches a node twice (seen at node {node})"),
            Self::Unreachable { reached } => write!(f, "only {reached} nodes can be reached from the first"),
            Self::TooDeep { needed, available } => {
                write!(f, "the tree needs a stack of {needed} entries; queries have {available}")
            }
        }
    }
}

impl core::error::Error for BvhError {}

/// Walks the tree once with the stack of a query; returns the entries that the worst ray could need.
///
/// A ray visits the children of a node in any order, and each may wait on the stack while another
/// is walked: a node with `k` children needs `k − 1` entries more than are waiting when it is
/// reached. More visits than nodes mean that a node is shared or its own descendant.
pub(super) fn check<const STACK: usize>(nodes: &[Node], primitives: usize) -> Result<usize, BvhError> {
    let mut stack = [(0_u32, 0_u32); STACK];
    let (mut height, mut visits, mut needed) = (0_usize, 0, 0);
    let mut current = (0, 0);
    loop {
        let (index, waiting) = (current.0 as usize, current.1 as usize);
        let Some(node) = nodes.get(index) else { return Err(BvhError::NodeOutOfRange { node: index }) };
        visits += 1;
        if visits > nodes.len() {
            return Err(BvhError::Shared { node: index });
        }
        let children = (0..WIDTH).filter(|&slot| node.child(slot) != Child::Empty).count();
        let below = waiting + children.saturating_sub(1);
        needed = needed.max(below);
        let too_deep = BvhError::TooDeep { needed: below, available: STACK };
        if below > STACK {
            return Err(too_deep);
        }
        let mut next = None;
        for slot in 0..WIDTH {
            check_slot(node, slot, index, nodes.len(), primitives)?;
            if let Child::Node(child) = node.child(slot)
                && let Some(waits) = next.replace((child, below as u32))
            {
                // In range: what waits here is among the `below` of the worst ray.
                *stack.get_mut(height).ok_or(too_deep)? = waits;
                height += 1;
            }
        }
        // 0 − 1 is beyond the stack, too.
        let top = height.wrapping_sub(1);
        current = match next.or_else(|| stack.get(top).copied().inspect(|_| height = top)) {
            Some(next) => next,
            None if visits < nodes.len() => return Err(BvhError::Unreachable { reached: visits }),
            None => return Ok(needed),
        };
    }
}

/// Checks one slot of one node.
fn check_slot(
    node: &Node,
    slot: usize,
    index: usize,
    nodes: usize,
    primitives: usize,
) -> Result<(), BvhError> {
    let bounds = node.child_bounds(slot);
    if bounds.min.is_nan() || bounds.max.is_nan() {
        return Err(BvhError::NotANumber { node: index });
    }
    match node.child(slot) {
        Child::Empty => {}
        Child::Node(child) => {
            if child as usize >= nodes {
                return Err(BvhError::NodeOutOfRange { node: index });
            }
        }
        Child::Leaf { first, count } => {
            if count == 0 || first as usize + count as usize > primitives {
                return Err(BvhError::LeafOutOfRange { node: index });
            }
        }
    }
    Ok(())
}
