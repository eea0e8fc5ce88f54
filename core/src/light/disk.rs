//! Sampling a disk or an ellipse.

use super::{AreaView, NoView, Receiver, SampledShape, Sides, SurfaceDensity, UseView, View};
use crate::shape::{Disk, SurfacePoint};
use crate::warp;
use glam::{Vec2, Vec3};

impl SampledShape for Disk {
    type View = View<Self, NoView, NoView>;

    /// Density `1 / (π a b)` (m⁻²); the concentric map, stretched along the axes.
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        let p = warp::square_to_disk(u);
        self.point(p.x, p.y)
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (a, b) = self.coordinates(point);
        warp::disk_to_square(Vec2::new(a, b))
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
