//! Sampling a triangle.

use super::{AreaView, NoView, Receiver, SampledShape, Sides, SurfaceDensity, View};
use crate::shape::{SurfacePoint, Triangle};
use crate::warp;
use glam::Vec3;

impl SampledShape for Triangle {
    type View = View<Self, NoView, NoView>;

    /// Density `1 / area` (m⁻²).
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        let [b1, b2] = warp::square_to_triangle(u);
        self.point(b1, b2)
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (b1, b2) = self.coordinates(point);
        warp::triangle_to_square([b1, b2])
    }

    #[inline]
    fn view(&self, from: &Receiver, _: SurfaceDensity, _: Sides) -> Option<Self::View> {
        Some(View::Area(AreaView::new(*self, from)))
    }
}
