//! Finding what a ray meets.

use super::node::{Child, Node, WIDTH, decode};
use super::{Bvh, STACK};
use crate::geom::PreparedRay;
use crate::num;

/// How much farther than computed a box may reach: the rounding of its three slabs, so that a ray
/// that grazes a box still enters it. Source: Ize 2013, *Robust BVH Ray Traversal*, JCGT 2(2).
const FAR_SLACK: f32 = 1.0 + 2.0 * num::gamma(3);

/// A child that waits, with the distance at which the ray enters it.
#[derive(Clone, Copy)]
struct Waiting {
    slot: u32,
    near: f32,
}

/// The ray as the slab test wants it: which plane of each axis is met first follows from the sign.
struct Slabs {
    near: [usize; 3],
    far: [usize; 3],
    origin: [f32; 3],
    inverse: [f32; 3],
    inverse_far: [f32; 3],
}

impl Slabs {
    #[inline]
    fn new(ray: &PreparedRay) -> Self {
        let inverse = ray.inverse.to_array();
        let backward = inverse.map(f32::is_sign_negative);
        Self {
            near: [0, 1, 2].map(|axis| if backward[axis] { axis + 3 } else { axis }),
            far: [0, 1, 2].map(|axis| if backward[axis] { axis } else { axis + 3 }),
            origin: ray.ray.origin.to_array(),
            inverse,
            inverse_far: inverse.map(|i| i * FAR_SLACK),
        }
    }

    /// Where the ray enters each child's box, infinite where it misses it.
    ///
    /// A ray in the plane of a face gives 0 · ∞ = NaN; the comparisons are written such that a NaN
    /// leaves the interval as it is, which is the conservative answer.
    #[inline]
    fn enter(&self, node: &Node, t_max: f32) -> [f32; WIDTH] {
        let (mut enter, mut leave) = ([0.0_f32; WIDTH], [t_max; WIDTH]);
        for axis in 0..3 {
            let near = &node.planes[self.near[axis]];
            let far = &node.planes[self.far[axis]];
            let origin = self.origin[axis];
            let (inverse, inverse_far) = (self.inverse[axis], self.inverse_far[axis]);
            for lane in 0..WIDTH {
                let t_near = (near[lane] - origin) * inverse;
                let t_far = (far[lane] - origin) * inverse_far;
                enter[lane] = if t_near > enter[lane] { t_near } else { enter[lane] };
                leave[lane] = if t_far < leave[lane] { t_far } else { leave[lane] };
            }
        }
        let mut result = [f32::INFINITY; WIDTH];
        for lane in 0..WIDTH {
            if enter[lane] <= leave[lane] {
                result[lane] = enter[lane];
            }
        }
        result
    }
}

impl Bvh<'_> {
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
        let mut found = None;
        self.walk(ray, t_max, |first, count| {
            for primitive in first..first + count {
                if let Some((t, hit)) = meet(primitive, t_max) {
                    t_max = t;
                    found = Some(hit);
                }
            }
            Some(t_max)
        });
        found
    }

    /// True when anything is met before `t_max`.
    #[inline]
    pub fn any_hit(&self, ray: &PreparedRay, t_max: f32, mut meet: impl FnMut(u32) -> bool) -> bool {
        let mut blocked = false;
        self.walk(ray, t_max, |first, count| {
            blocked = (first..first + count).any(&mut meet);
            (!blocked).then_some(t_max)
        });
        blocked
    }

    /// Visits the leaves that the ray enters, nearer children first. `leaf` returns how far the ray
    /// still reaches, or `None` to stop.
    #[inline]
    fn walk(&self, ray: &PreparedRay, mut t_max: f32, mut leaf: impl FnMut(u32, u32) -> Option<f32>) {
        if self.nodes.is_empty() || !ray.ray.is_valid() {
            return;
        }
        let slabs = Slabs::new(ray);
        let mut stack = [Waiting { slot: 0, near: 0.0 }; STACK];
        let mut height = 0;
        let mut current = 0_u32;
        loop {
            match decode(current) {
                Child::Node(index) => {
                    let node = &self.nodes[index as usize];
                    let enter = slabs.enter(node, t_max);
                    if let Some(next) = nearest_first(node, enter, &mut stack, &mut height) {
                        current = next;
                        continue;
                    }
                }
                Child::Leaf { first, count } => match leaf(first, count) {
                    Some(reach) => t_max = reach,
                    None => return,
                },
                Child::Empty => {}
            }
            // The next child that the ray still reaches.
            loop {
                if height == 0 {
                    return;
                }
                height -= 1;
                let waiting = stack[height];
                if waiting.near < t_max {
                    current = waiting.slot;
                    break;
                }
            }
        }
    }
}

/// Returns the child entered first and lets the others wait, the farthest at the bottom.
#[inline]
fn nearest_first(
    node: &Node,
    enter: [f32; WIDTH],
    stack: &mut [Waiting; STACK],
    height: &mut usize,
) -> Option<u32> {
    let bottom = *height;
    let mut nearest = None::<Waiting>;
    for (slot, near) in node.slots.into_iter().zip(enter) {
        if near == f32::INFINITY {
            continue;
        }
        let child = Waiting { slot, near };
        let farther = match nearest {
            None => {
                nearest = Some(child);
                continue;
            }
            Some(best) if child.near < best.near => {
                nearest = Some(child);
                best
            }
            Some(_) => child,
        };
        // Insertion into the at most three that wait, by descending distance.
        let mut at = *height;
        while at > bottom && stack[at - 1].near < farther.near {
            stack[at] = stack[at - 1];
            at -= 1;
        }
        stack[at] = farther;
        *height += 1;
    }
    nearest.map(|child| child.slot)
}
