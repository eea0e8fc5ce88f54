//! The slab test of a ray against the four boxes of a node.

use super::node::{Node, WIDTH};
use crate::geom::Ray;
use crate::num;
use crate::num::lanes::{LANES, Lane, Number};

/// How much farther than computed a box may reach: the rounding of its three slabs, so that a ray
/// that grazes a box still enters it. Source: Ize 2013, *Robust BVH Ray Traversal*, JCGT 2(2).
const FAR_SLACK: f32 = 1.0 + 2.0 * num::gamma(3);

/// A direction component below this counts as 0: its reciprocal would overflow.
const PARALLEL: f32 = 1e-37;

/// Stands for the reciprocal of 0: finite, so that no product with it is NaN, and so large that
/// any distance times it is beyond every scene.
const STEEP: f32 = 1e38;

/// How far a slab is widened for a ray along it (m): nothing beside any coordinate but 0.
const WIDENED: f32 = 1e-20;

/// A row of a node's planes: an index that needs no check.
#[derive(Clone, Copy)]
enum Plane {
    LowerX,
    LowerY,
    LowerZ,
    UpperX,
    UpperY,
    UpperZ,
}

/// The two planes of each axis.
const AXES: [[Plane; 2]; 3] =
    [[Plane::LowerX, Plane::UpperX], [Plane::LowerY, Plane::UpperY], [Plane::LowerZ, Plane::UpperZ]];

/// A ray as the slab test wants it.
pub(super) struct Slabs {
    /// Which plane of each axis is met first, and which last, as rows of the node.
    near: [Plane; 3],
    far: [Plane; 3],
    near_origin: [Lane; 3],
    far_origin: [Lane; 3],
    near_inverse: [Lane; 3],
    far_inverse: [Lane; 3],
}

/// The children that a ray enters: a bit for each, and the distances.
pub(super) struct Entered {
    pub(super) mask: u32,
    pub(super) near: [f32; WIDTH],
}

impl Slabs {
    #[inline]
    pub(super) fn new(ray: &Ray) -> Self {
        let mut slabs = Self {
            near: AXES.map(|[lower, _]| lower),
            far: AXES.map(|[_, upper]| upper),
            near_origin: [Lane::of(0.0); 3],
            far_origin: [Lane::of(0.0); 3],
            near_inverse: [Lane::of(0.0); 3],
            far_inverse: [Lane::of(0.0); 3],
        };
        let (origin, direction) = (ray.origin.to_array(), ray.direction.to_array());
        for axis in 0..3 {
            let (o, d) = (origin[axis], direction[axis]);
            // A ray along a slab is inside it or not; widened, it is inside up to its very faces.
            let along = d.abs() < PARALLEL;
            let inverse = if along { STEEP } else { 1.0 / d };
            let pad = if along { o.abs() * f32::EPSILON + WIDENED } else { 0.0 };
            if inverse < 0.0 {
                [slabs.far[axis], slabs.near[axis]] = AXES[axis];
            }
            slabs.near_origin[axis] = Lane::of(o + pad);
            slabs.far_origin[axis] = Lane::of(o - pad);
            slabs.near_inverse[axis] = Lane::of(inverse);
            slabs.far_inverse[axis] = Lane::of(inverse * FAR_SLACK);
        }
        slabs
    }

    /// Which children the ray enters before `t_max`. Nothing here can be NaN, so that the minima and
    /// maxima mean the same on every target.
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[cfg_attr(feature = "small", inline(never))]
    pub(super) fn enter(&self, node: &Node, t_max: f32) -> Entered {
        let mut entered = Entered { mask: 0, near: [0.0; WIDTH] };
        for child in (0..WIDTH).step_by(LANES) {
            let (mut enter, mut leave) = (Lane::of(0.0), Lane::of(t_max));
            for axis in 0..3 {
                let near = Lane::load(&node.planes[self.near[axis] as usize], child);
                let far = Lane::load(&node.planes[self.far[axis] as usize], child);
                enter = enter.larger((near - self.near_origin[axis]) * self.near_inverse[axis]);
                leave = leave.smaller((far - self.far_origin[axis]) * self.far_inverse[axis]);
            }
            entered.mask |= enter.not_above(leave) << child;
            enter.store(&mut entered.near, child);
        }
        entered
    }
}
