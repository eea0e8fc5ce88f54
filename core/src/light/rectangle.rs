//! Sampling a rectangle.

use super::{
    AreaView, FlatShape, NoView, ProjectedView, Receiver, SampledShape, Sides, SurfaceDensity, View,
    flat_projected_solid_angle,
};
use crate::num::ONE_MINUS_EPSILON;
use crate::projected::Chart;
use crate::shape::{Rectangle, SurfacePoint};
use glam::{Vec2, Vec3};

impl SampledShape for Rectangle {
    type View = View<Self, NoView, ProjectedView<Self, 8>>;

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
    fn view(&self, from: &Receiver, method: SurfaceDensity, sides: Sides) -> Option<Self::View> {
        let radius = (self.half_u() + self.half_v()).length();
        match method.required(from, self.centre(), radius, SurfaceDensity::Area) {
            SurfaceDensity::Projected => ProjectedView::new(self, from, sides).map(View::Projected),
            _ => Some(View::Area(AreaView::new(*self, from))),
        }
    }

    fn projected_solid_angle(&self, from: &Receiver, sides: Sides) -> Option<f32> {
        Some(flat_projected_solid_angle::<_, 8>(self, from, sides))
    }
}

impl FlatShape for Rectangle {
    #[inline]
    fn chart(&self, from: Vec3) -> Chart {
        Chart::from_axes(from, self.centre(), self.half_u(), self.half_v())
    }

    #[inline]
    fn corners(&self) -> impl AsRef<[Vec2]> {
        [Vec2::NEG_ONE, Vec2::new(1.0, -1.0), Vec2::ONE, Vec2::new(-1.0, 1.0)]
    }

    #[inline]
    fn point_at(&self, place: Vec2) -> SurfacePoint {
        self.point(place.x, place.y)
    }

    fn place_of(&self, point: Vec3) -> Vec2 {
        self.coordinates(point).into()
    }
}
