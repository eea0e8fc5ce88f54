//! Finding what a ray meets.
//!
//! [`Bvh::new`] has checked what indices and the stack are asked for here; `get` instead of an index costs
//! the same comparison, and a program without panics can be linked.

use super::Bvh;
use super::node::{Child, WIDTH, decode};
use super::slabs::{Entered, Slabs};
use crate::geom::PreparedRay;

/// A child that waits, with the distance at which the ray enters it.
#[derive(Clone, Copy)]
struct Waiting {
    slot: u32,
    near: f32,
}

impl<const STACK: usize> Bvh<'_, STACK> {
    /// The nearest hit with `t < t_max`.
    ///
    /// `meet(primitive, t_max)` answers for one primitive with the hit's distance and whatever
    /// describes it; it is called at most once for each. A ray that is not valid meets nothing.
    #[inline]
    pub fn closest_hit<H>(
        &self,
        ray: &PreparedRay,
        mut t_max: f32,
        mut meet: impl FnMut(u32, f32) -> Option<(f32, H)>,
    ) -> Option<H> {
        if self.nodes.is_empty() || !ray.ray.is_valid() {
            return None;
        }
        let slabs = Slabs::new(&ray.ray);
        let mut stack = [Waiting { slot: 0, near: 0.0 }; STACK];
        let mut height = 0;
        let mut current = 0_u32;
        let mut found = None;
        loop {
            match decode(current) {
                Child::Node(index) => {
                    let Some(node) = self.nodes.get(index as usize) else { return found };
                    let entered = slabs.enter(node, t_max);
                    if let Some(nearest) = nearest_first(&node.slots, &entered, &mut stack, &mut height) {
                        current = nearest;
                        continue;
                    }
                }
                Child::Leaf { first, count } => {
                    for primitive in first..first + count {
                        if let Some((t, hit)) = meet(primitive, t_max) {
                            t_max = t;
                            found = Some(hit);
                        }
                    }
                }
                Child::Empty => {}
            }
            // The next child that the ray still reaches.
            current = loop {
                // 0 − 1 is beyond the stack, too.
                height = height.wrapping_sub(1);
                match stack.get(height) {
                    None => return found,
                    Some(waiting) if waiting.near < t_max => break waiting.slot,
                    Some(_) => {}
                }
            };
        }
    }

    /// True when anything is met before `t_max`. Which primitive is asked first is not defined.
    #[inline]
    pub fn any_hit(&self, ray: &PreparedRay, t_max: f32, mut meet: impl FnMut(u32) -> bool) -> bool {
        if self.nodes.is_empty() || !ray.ray.is_valid() {
            return false;
        }
        let slabs = Slabs::new(&ray.ray);
        // Any hit will do: no order, and leaves are asked as soon as they are entered.
        let mut stack = [0_u32; STACK];
        let mut height = 0;
        let mut current = 0_u32;
        loop {
            let Some(node) = self.nodes.get(current as usize) else { return false };
            let mut mask = slabs.enter(node, t_max).mask;
            // One child is walked next and does not wait: the others are what `Bvh::new` has counted.
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
                        if (first..first + count).any(&mut meet) {
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

/// Returns the child entered first and lets the others wait, the farthest at the bottom.
#[cfg_attr(not(feature = "small"), inline(always))]
fn nearest_first<const STACK: usize>(
    slots: &[u32; WIDTH],
    entered: &Entered,
    stack: &mut [Waiting; STACK],
    height: &mut usize,
) -> Option<u32> {
    let mut mask = entered.mask;
    if mask == 0 {
        return None;
    }
    let mut take = || {
        let lane = mask.trailing_zeros() as usize % WIDTH;
        mask &= mask - 1;
        (Waiting { slot: slots[lane], near: entered.near[lane] }, mask)
    };
    let (mut nearest, mut rest) = take();
    let bottom = *height;
    while rest != 0 {
        let (mut child, left) = take();
        rest = left;
        if child.near < nearest.near {
            core::mem::swap(&mut child, &mut nearest);
        }
        // Insertion into the at most three that wait, by descending distance.
        let mut at = *height;
        while at > bottom
            && let Some([below, above]) = stack.get_mut(at - 1..at + 1)
            && below.near < child.near
        {
            *above = *below;
            at -= 1;
        }
        if let Some(place) = stack.get_mut(at) {
            *place = child;
        }
        *height += 1;
    }
    Some(nearest.slot)
}
