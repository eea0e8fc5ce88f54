//! Finding what a region of space may meet.

use super::Bvh;
use super::node::{Child, Node, WIDTH, decode};
use crate::geom::Region;
use glam::Vec4;

impl<const STACK: usize> Bvh<'_, STACK> {
    /// True when `ask` says so of a primitive whose leaf may meet the region. In which order they are asked
    /// is not defined.
    pub fn any_in(&self, region: &Region, mut ask: impl FnMut(u32) -> bool) -> bool {
        let mut stack = [0_u32; STACK];
        let mut height = 0;
        let mut current = 0_u32;
        loop {
            let Some(node) = self.nodes.get(current as usize) else { return false };
            let mut mask = children_in(node, region);
            // One child is walked next and does not wait, as in `any_hit`.
            let mut next = None;
            while mask != 0 {
                let lane = mask.trailing_zeros() as usize % WIDTH;
                mask &= mask - 1;
                match decode(node.slots[lane]) {
                    Child::Node(index) => {
                        if let Some(waiting) = next.replace(index)
                            && let Some(place) = stack.get_mut(height)
                        {
                            *place = waiting;
                            height += 1;
                        }
                    }
                    Child::Leaf { first, count } => {
                        if (first..first + count).any(&mut ask) {
                            return true;
                        }
                    }
                    Child::Empty => {}
                }
            }
            current = match next {
                Some(index) => index,
                None => {
                    height = height.wrapping_sub(1);
                    let Some(&waiting) = stack.get(height) else { return false };
                    waiting
                }
            };
        }
    }
}

/// Which boxes of a node may meet a region: a bit for each.
fn children_in(node: &Node, region: &Region) -> u32 {
    let bounds = region.bounds();
    let row = |axis: usize| Vec4::from_array(node.planes[axis]);
    // The boxes, as far as they are in the region's: so that no number is larger than the slack allows for.
    let lower: [Vec4; 3] = core::array::from_fn(|axis| row(axis).max(Vec4::splat(bounds.min[axis])));
    let upper: [Vec4; 3] = core::array::from_fn(|axis| row(axis + 3).min(Vec4::splat(bounds.max[axis])));
    let overlap = |axis: usize| lower[axis].cmple(upper[axis]);
    let inside = overlap(0) & overlap(1) & overlap(2);
    region.cuts().iter().fold(inside.bitmask(), |mask, cut| {
        // The corner that is least far along the normal.
        let least = |axis: usize| {
            let n = cut.normal[axis];
            (if n > 0.0 { lower[axis] } else { upper[axis] }) * n
        };
        mask & (least(0) + least(1) + least(2)).cmple(Vec4::splat(cut.offset)).bitmask()
    })
}
