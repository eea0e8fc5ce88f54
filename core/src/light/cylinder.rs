//! Sampling an open cylinder.

use super::{AreaView, NoView, Receiver, SampledShape, Sides, SurfaceDensity, UseView, View};
use crate::geom::Frame;
use crate::num::{self, TAU};
use crate::shape::{Cylinder, SurfacePoint};
use glam::Vec3;

impl SampledShape for Cylinder {
    type View = View<Self, NoView, NoView>;

    /// Density `1 / (2π r l)` (m⁻²); `u[0]` is the height, `u[1]` the turn around the axis.
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        let frame = Frame::from_normal(self.unit_axis());
        let (sin, cos) = num::sin_cos_turns(u[1]);
        self.point(u[0], frame.s * cos + frame.t * sin)
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (h, n) = self.coordinates(point);
        let frame = Frame::from_normal(self.unit_axis());
        let turn = num::atan2(n.dot(frame.t), n.dot(frame.s)) / TAU;
        [h, if turn < 0.0 { turn + 1.0 } else { turn }]
    }

    #[inline(always)]
    fn with_view<U: UseView<Self::View>>(
        &self,
        from: &Receiver,
        _: SurfaceDensity,
        _: Sides,
        then: U,
    ) -> Option<U::Output> {
        then.with(AreaView::new(*self, from), View::Area)
    }
}
