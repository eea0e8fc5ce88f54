//! Sampling a triangle.

use super::{
    AreaView, FlatShape, NoView, ProjectedView, Receiver, SampledShape, Sides, SurfaceDensity, View,
    flat_projected_solid_angle,
};
use crate::projected::Chart;
use crate::shape::{SurfacePoint, Triangle};
use crate::warp;
use glam::{Vec2, Vec3};

impl SampledShape for Triangle {
    type View = View<Self, NoView, ProjectedView<Self, 7>>;

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
    fn view(&self, from: &Receiver, method: SurfaceDensity, sides: Sides) -> Option<Self::View> {
        let [a, b, c] = Triangle::corners(self);
        let centre = (a + b + c) / 3.0;
        let radius = a.distance(centre).max(b.distance(centre)).max(c.distance(centre));
        match method.required(from, centre, radius, SurfaceDensity::Area) {
            SurfaceDensity::Projected => ProjectedView::new(self, from, sides).map(View::Projected),
            _ => Some(View::Area(AreaView::new(*self, from))),
        }
    }

    fn projected_solid_angle(&self, from: &Receiver, sides: Sides) -> Option<f32> {
        Some(flat_projected_solid_angle::<_, 7>(self, from, sides))
    }
}

impl FlatShape for Triangle {
    #[inline]
    fn chart(&self, from: Vec3) -> Chart {
        Chart::from_corners(from, Triangle::corners(self))
    }

    #[inline]
    fn corners(&self) -> impl AsRef<[Vec2]> {
        [Vec2::ZERO, Vec2::X, Vec2::Y]
    }

    #[inline]
    fn point_at(&self, place: Vec2) -> SurfacePoint {
        self.point(place.x, place.y)
    }

    fn place_of(&self, point: Vec3) -> Vec2 {
        self.coordinates(point).into()
    }
}
