//! The layout of a node.

use crate::geom::Aabb;
use glam::Vec3;

/// Children of a node.
pub const WIDTH: usize = 4;

/// Most primitives that one leaf holds.
pub const MAX_LEAF: usize = 15;

/// Most primitives that one tree holds: leaves keep their first primitive in 27 bits.
pub const MAX_PRIMITIVES: usize = 1 << 27;

/// What a slot of a node leads to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Child {
    /// Nothing.
    Empty,
    /// Another node, by index.
    Node(u32),
    /// `count` primitives from `first` on.
    Leaf {
        /// Index of the first primitive.
        first: u32,
        /// How many, from 1 to [`MAX_LEAF`].
        count: u32,
    },
}

/// Four boxes, side by side, and what they hold: 112 bytes, the same on every target.
///
/// Bit layout of a slot: `0xffff_ffff` is empty; bit 31 set is a leaf with its count in bits 27–30
/// and its first primitive in bits 0–26; otherwise the index of a node.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "bytes", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C, align(16))]
pub struct Node {
    /// Lower x, y, z, then upper x, y, z, of the four children.
    pub(super) planes: [[f32; WIDTH]; 6],
    pub(super) slots: [u32; WIDTH],
}

const EMPTY: u32 = u32::MAX;
const LEAF: u32 = 1 << 31;
const FIRST: u32 = (1 << 27) - 1;

impl Node {
    /// A node without children.
    pub const EMPTY: Self = Self {
        planes: [
            [f32::INFINITY; 4],
            [f32::INFINITY; 4],
            [f32::INFINITY; 4],
            [f32::NEG_INFINITY; 4],
            [f32::NEG_INFINITY; 4],
            [f32::NEG_INFINITY; 4],
        ],
        slots: [EMPTY; WIDTH],
    };

    /// Puts a child and its box into a slot below [`WIDTH`]; an empty one has a box that no ray enters,
    /// whatever is given. A leaf's count and first primitive must be in range; what is not is refused
    /// by [`super::Bvh::new`].
    #[must_use]
    pub const fn with_child(mut self, slot: usize, child: Child, bounds: Aabb) -> Self {
        let bounds = if let Child::Empty = child { Aabb::EMPTY } else { bounds };
        let (min, max) = (bounds.min.to_array(), bounds.max.to_array());
        let mut axis = 0;
        while axis < 3 {
            self.planes[axis][slot] = min[axis];
            self.planes[axis + 3][slot] = max[axis];
            axis += 1;
        }
        self.slots[slot] = match child {
            Child::Empty => EMPTY,
            Child::Node(index) => index & !LEAF,
            Child::Leaf { first, count } => LEAF | ((count & 15) << 27) | (first & FIRST),
        };
        self
    }

    /// What a slot leads to, counted modulo [`WIDTH`].
    #[inline]
    #[must_use]
    pub const fn child(&self, slot: usize) -> Child {
        decode(self.slots[slot % WIDTH])
    }

    /// The box of a slot, counted modulo [`WIDTH`].
    #[must_use]
    pub const fn child_bounds(&self, slot: usize) -> Aabb {
        let (p, slot) = (&self.planes, slot % WIDTH);
        Aabb {
            min: Vec3::new(p[0][slot], p[1][slot], p[2][slot]),
            max: Vec3::new(p[3][slot], p[4][slot], p[5][slot]),
        }
    }

    /// The box around all children.
    #[must_use]
    pub fn bounds(&self) -> Aabb {
        (0..WIDTH)
            .filter(|&slot| self.child(slot) != Child::Empty)
            .fold(Aabb::EMPTY, |b, slot| b.union(self.child_bounds(slot)))
    }
}

/// The meaning of a slot's bits.
#[inline]
pub(super) const fn decode(bits: u32) -> Child {
    if bits & LEAF == 0 {
        Child::Node(bits)
    } else if bits == EMPTY {
        Child::Empty
    } else {
        Child::Leaf { first: bits & FIRST, count: (bits >> 27) & 15 }
    }
}
