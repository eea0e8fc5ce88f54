//! A four-wide bounding volume hierarchy: node layout, a checked borrowed view, and two queries.
//!
//! The tree knows no shapes: a query hands each primitive that its ray may meet to a closure.

mod error;
mod node;
mod overlap;
mod query;
mod slabs;

pub use error::BvhError;
pub use node::{Child, MAX_LEAF, MAX_PRIMITIVES, Node, WIDTH};

/// Entries of the traversal stack, unless a program asks for fewer. A tree that could need more is refused.
///
/// An entry takes 8 bytes while the nearest hit is looked for, and 4 for any hit.
pub const STACK: usize = 64;

/// A view of a tree in the caller's slice.
///
/// [`Bvh::new`] has checked that child indices are in range, that a query visits each node at most
/// once, that leaves name existing primitives, that every bound is a number, and that no ray can need
/// more than [`STACK`] entries. The fields are private so that it stays true.
///
/// * `STACK` – entries of the traversal stack: fewer where there is little memory
#[derive(Debug, Clone, Copy)]
pub struct Bvh<'a, const STACK: usize = { self::STACK }> {
    nodes: &'a [Node],
    stack_needed: usize,
}

impl<'a> Bvh<'a> {
    /// Checks a tree over `primitives` primitives. No nodes, no primitives met.
    ///
    /// # Errors
    /// When the tree could make a query fail, loop, or miss what it holds; see [`BvhError`].
    pub fn new(nodes: &'a [Node], primitives: usize) -> Result<Self, BvhError> {
        Self::with_stack(nodes, primitives)
    }
}

impl<'a, const STACK: usize> Bvh<'a, STACK> {
    /// [`Bvh::new`], with a traversal stack of `STACK` entries.
    ///
    /// # Errors
    /// As [`Bvh::new`].
    pub fn with_stack(nodes: &'a [Node], primitives: usize) -> Result<Self, BvhError> {
        if primitives > MAX_PRIMITIVES {
            return Err(BvhError::TooManyPrimitives { primitives });
        }
        let stack_needed = if nodes.is_empty() { 0 } else { error::check::<STACK>(nodes, primitives)? };
        Ok(Self { nodes, stack_needed })
    }

    /// A tree that was checked before, which takes a look at every node.
    ///
    /// * `stack_needed` – what [`Bvh::stack_needed`] said of it
    #[cfg(feature = "build")]
    pub(crate) const fn known_to_fit(nodes: &'a [Node], stack_needed: usize) -> Self {
        Self { nodes, stack_needed }
    }

    /// Stack entries that the worst ray could need, at most [`STACK`].
    #[must_use]
    pub const fn stack_needed(&self) -> usize {
        self.stack_needed
    }

    /// The nodes.
    #[must_use]
    pub fn nodes(&self) -> &'a [Node] {
        self.nodes
    }

    /// The box around everything; empty when there is nothing.
    #[must_use]
    pub fn bounds(&self) -> crate::geom::Aabb {
        self.nodes.first().map_or(crate::geom::Aabb::EMPTY, Node::bounds)
    }
}
