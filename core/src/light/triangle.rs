//! Sampling a triangle.

use super::{
    Cone, FlatShape, ProjectedView, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceSample,
    SurfaceView, UseView, View, flat_projected_solid_angle, is_near,
};
use crate::projected::Chart;
use crate::shape::{SurfacePoint, Triangle};
use crate::solid_angle::{SphericalTriangle, TrianglePlace};
use crate::warp;
use glam::{Vec2, Vec3};

/// As in [`crate::projected::ProjectedPolygon`]; with feature `small` the code is that of a rectangle.
const ROOM: usize = if cfg!(feature = "small") { 6 } else { 5 };

impl SampledShape for Triangle {
    type View = View<Self, TriangleSolidAngle, ProjectedView<Self, ROOM>>;

    /// Density `1 / area` (m⁻²).
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        let [b1, b2] = warp::square_to_triangle(u);
        self.point(b1, b2)
    }

    fn normals(&self) -> Cone {
        Cone { axis: self.normal(), angle: 0.0 }
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (b1, b2) = self.coordinates(point);
        warp::triangle_to_square([b1, b2])
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn with_view<U: UseView<Self::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        sides: Sides,
        then: U,
    ) -> Option<U::Output> {
        self.with_flat_view(from, method, sides, then)
    }

    fn projected_solid_angle(&self, from: &Receiver, sides: Sides) -> Option<f32> {
        Some(flat_projected_solid_angle::<_, ROOM>(self, from, sides))
    }
}

impl FlatShape for Triangle {
    type SolidAngle = TriangleSolidAngle;

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn solid_angle_view(&self, from: Vec3, _: &Chart) -> Option<TriangleSolidAngle> {
        TriangleSolidAngle::new(*self, from)
    }

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

/// A triangle with the density `1 / solid angle` (sr⁻¹) at every distance and angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TriangleSolidAngle {
    shape: Triangle,
    seen: SphericalTriangle,
}

impl TriangleSolidAngle {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn new(shape: Triangle, from: Vec3) -> Option<Self> {
        Some(Self { shape, seen: SphericalTriangle::new(from, &shape.corners())? })
    }
}

impl SurfaceView for TriangleSolidAngle {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        let TrianglePlace { barycentric: [b1, b2], direction: wi, distance } = self.seen.sample(u)?;
        Some(SurfaceSample { at: self.shape.point(b1 as f32, b2 as f32), wi, distance })
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn pdf_solid_angle(&self, _: &SurfacePoint, _: Vec3, _: f32) -> Option<f32> {
        Some(1.0 / self.seen.solid_angle())
    }

    fn invert(&self, at: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        let met = self.seen.meet(wi)?;
        let barycentric = if is_near(at, wi, met.distance) {
            met.barycentric
        } else {
            <[f32; 2]>::from(self.shape.coordinates(at.point)).map(f64::from)
        };
        Some(self.seen.invert(barycentric))
    }
}
