//! Flat lights with straight edges, uniform over projected solid angle.

use super::{Receiver, SampledShape, Sides, SurfaceSample, SurfaceView};
use crate::projected::{Chart, ProjectedPolygon};
use crate::shape::SurfacePoint;
use glam::{Vec2, Vec3};

/// A convex polygon that lights can have as their surface.
pub trait FlatShape: SampledShape {
    /// The shape's plane as it is seen from a point (m); the normal is along `u × v`.
    fn chart(&self, from: Vec3) -> Chart;

    /// The corners in the chart, convex and counter-clockwise.
    fn corners(&self) -> impl AsRef<[Vec2]>;

    /// The point of the surface at a place of the chart.
    fn point_at(&self, place: Vec2) -> SurfacePoint;

    /// The place of a point of the surface in the chart.
    fn place_of(&self, point: Vec3) -> Vec2;
}

/// The part of a polygon above the receiver's horizon: uniform over projected solid angle,
/// `cos θ / E` (sr⁻¹).
///
/// * `N` – as in [`ProjectedPolygon`]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProjectedView<S, const N: usize> {
    shape: S,
    polygon: ProjectedPolygon<N>,
}

impl<S: FlatShape, const N: usize> ProjectedView<S, N> {
    /// `None` in the plane, behind a light that emits from its front, and when nothing is above the
    /// horizon.
    #[inline]
    #[must_use]
    pub fn new(shape: &S, from: &Receiver, sides: Sides) -> Option<Self> {
        Some(Self { shape: *shape, polygon: projected(shape, from, sides)? })
    }
}

/// What a receiver sees of the emitting sides above its horizon.
#[inline]
fn projected<S: FlatShape, const N: usize>(
    shape: &S,
    from: &Receiver,
    sides: Sides,
) -> Option<ProjectedPolygon<N>> {
    let chart = shape.chart(from.point);
    if sides == Sides::Front && !(chart.volume() < 0.0) {
        return None;
    }
    ProjectedPolygon::new(from.normal, &chart, shape.corners().as_ref())
}

/// Projected solid angle of what `from` sees of the emitting sides above its horizon (sr).
pub(super) fn flat_projected_solid_angle<S: FlatShape, const N: usize>(
    shape: &S,
    from: &Receiver,
    sides: Sides,
) -> f32 {
    projected::<S, N>(shape, from, sides).map_or(0.0, |polygon| polygon.projected_solid_angle())
}

impl<S: FlatShape, const N: usize> SurfaceView for ProjectedView<S, N> {
    #[inline]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        let drawn = self.polygon.sample(u)?;
        Some(SurfaceSample { at: self.shape.point_at(drawn.place), wi: drawn.wi, distance: drawn.distance })
    }

    #[inline]
    fn pdf_solid_angle(&self, _: &SurfacePoint, wi: Vec3, _: f32) -> Option<f32> {
        self.polygon.pdf_solid_angle(wi)
    }

    fn invert(&self, at: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        self.polygon.pdf_solid_angle(wi)?;
        Some(self.polygon.invert(self.shape.place_of(at.point)))
    }
}
