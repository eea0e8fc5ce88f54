//! Sampling a rectangle.

use super::{AreaView, NoView, Receiver, SampledShape, Sides, SurfaceDensity, View};
use crate::num::ONE_MINUS_EPSILON;
use crate::shape::{Rectangle, SurfacePoint};
use glam::Vec3;

impl SampledShape for Rectangle {
    type View = View<Self, NoView, NoView>;

    /// Density `1 / (w h)` (m⁻²).
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        self.point(2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0)
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (a, b) = self.coordinates(point);
        [a, b].map(|x| (0.5 * x + 0.5).clamp(0.0, ONE_MINUS_EPSILON))
    }

    #[inline]
    fn view(&self, from: &Receiver, _: SurfaceDensity, _: Sides) -> Option<Self::View> {
        Some(View::Area(AreaView::new(*self, from)))
    }
}
