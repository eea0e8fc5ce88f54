//! Flat lights with straight edges: their choice of a density, and the one over projected solid angle.

use super::{
    AreaView, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceSample, SurfaceView, UseView, View,
};
use crate::num;
use crate::projected::{Chart, ProjectedPolygon};
use crate::shape::SurfacePoint;
use glam::{Vec2, Vec3};

/// A convex polygon that lights can have as their surface.
pub trait FlatShape: SampledShape {
    /// Uniform over solid angle.
    type SolidAngle: SurfaceView;

    /// Centre and radius of a sphere that holds the shape (m).
    #[inline]
    fn sphere(&self) -> (Vec3, f32) {
        let bounds = self.bounds();
        ((bounds.min + bounds.max) * 0.5, (bounds.max - bounds.min).length() * 0.5)
    }

    /// The density over solid angle; `None` where rounding leaves none.
    ///
    /// * `chart` – the shape's, from the receiver
    fn solid_angle_view(&self, from: Vec3, chart: &Chart) -> Option<Self::SolidAngle>;

    /// The shape's plane as it is seen from a point (m); the normal is along `u × v`.
    fn chart(&self, from: Vec3) -> Chart;

    /// The corners in the chart, convex and counter-clockwise.
    fn corners(&self) -> impl AsRef<[Vec2]>;

    /// The point of the surface at a place of the chart.
    fn point_at(&self, place: Vec2) -> SurfacePoint;

    /// The place of a point of the surface in the chart.
    fn place_of(&self, point: Vec3) -> Vec2;

    /// [`SampledShape::with_view`] of every flat shape.
    ///
    /// * `N` – as in [`ProjectedPolygon`]
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn with_flat_view<const N: usize, U>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        sides: Sides,
        then: U,
    ) -> Option<U::Output>
    where
        U: UseView<View<Self, Self::SolidAngle, ProjectedView<Self, N>>>,
    {
        let chart = self.chart(from.point);
        if !faces(&chart, sides) {
            return None;
        }
        // Only then is the sphere asked for.
        let method = if method == SurfaceDensity::Auto {
            let (centre, radius) = self.sphere();
            method.required(from, centre, radius, SurfaceDensity::Area)
        } else {
            method
        };
        match method {
            SurfaceDensity::Area => then.with(AreaView::new(*self, from), View::Area),
            SurfaceDensity::SolidAngle => with_solid_angle(self, from, &chart, then),
            _ => ProjectedView::with(self, from, &chart, |view| {
                then.with(view, |view: &ProjectedView<Self, N>| View::Projected(*view))
            }),
        }
    }
}

/// Hands the view by solid angle to `then`.
#[cfg_attr(not(feature = "small"), inline(always))]
#[cfg_attr(feature = "small", inline(never))]
fn with_solid_angle<S: FlatShape, const N: usize, U>(
    shape: &S,
    from: &Receiver,
    chart: &Chart,
    then: U,
) -> Option<U::Output>
where
    U: UseView<View<S, S::SolidAngle, ProjectedView<S, N>>>,
{
    then.with(shape.solid_angle_view(from.point, chart)?, View::SolidAngle)
}

/// The part of a polygon above the receiver's horizon: uniform over projected solid angle,
/// `cos θ / E` (sr⁻¹).
///
/// * `N` – as in [`ProjectedPolygon`]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProjectedView<S, const N: usize> {
    shape: S,
    from: Vec3,
    polygon: ProjectedPolygon<N>,
}

impl<S: FlatShape, const N: usize> ProjectedView<S, N> {
    /// Hands the view to `then`; `None` in the plane and when nothing is above the horizon.
    ///
    /// It is made where it stays: moving it out of an `Option` costs as much as a sector.
    ///
    /// * `chart` – the shape's, from the receiver
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[cfg_attr(feature = "small", inline(never))]
    pub fn with<R>(
        shape: &S,
        from: &Receiver,
        chart: &Chart,
        then: impl FnOnce(&Self) -> Option<R>,
    ) -> Option<R> {
        let mut view = Self { shape: *shape, from: from.point, polygon: ProjectedPolygon::EMPTY };
        if !view.polygon.prepare(from.normal, chart, shape.corners().as_ref()) {
            return None;
        }
        then(&view)
    }
}

/// True when the receiver of a chart is on a side that emits.
#[inline]
fn faces(chart: &Chart, sides: Sides) -> bool {
    let volume = chart.volume();
    volume < 0.0 || (sides == Sides::Both && volume > 0.0)
}

/// True where a direction says better than the coordinates of a point of a flat light where in the
/// light's plane it is: the rounding of the coordinates moves it farther than that of the direction.
///
/// * `distance` – from the receiver (m)
#[inline]
pub(super) fn is_near(at: &SurfacePoint, wi: Vec3, distance: f32) -> bool {
    // Rounded coordinates turn the way by their whole error to the side, and by the cosine of it up or
    // down; which counts depends on how the light lies, so the geometric mean of both decides.
    let turned = at.error.max_element() * num::sqrt(at.normal.dot(wi).abs());
    turned > num::gamma(8) * distance
}

/// Projected solid angle of what `from` sees of the emitting sides above its horizon (sr).
pub(super) fn flat_projected_solid_angle<S: FlatShape, const N: usize>(
    shape: &S,
    from: &Receiver,
    sides: Sides,
) -> f32 {
    let chart = shape.chart(from.point);
    if !faces(&chart, sides) {
        return 0.0;
    }
    let mut polygon = ProjectedPolygon::<N>::EMPTY;
    let is_seen = polygon.prepare(from.normal, &chart, shape.corners().as_ref());
    if is_seen { polygon.projected_solid_angle() } else { 0.0 }
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
        Some(if is_near(at, wi, at.point.distance(self.from)) {
            self.polygon.invert_direction(wi)
        } else {
            self.polygon.invert(self.shape.place_of(at.point))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{SurfaceDensity, View};
    use crate::shape::{Rectangle, Triangle};

    fn at(point: Vec3) -> Receiver {
        Receiver { point, normal: Vec3::new(0.0, 0.6, 0.8) }
    }

    fn check<S: FlatShape<View = View<S, W, P>>, W: SurfaceView, P: SurfaceView>(shape: S) {
        let view = |from: &Receiver, sides| shape.view(from, SurfaceDensity::Projected, sides);
        let (below, above) = (at(Vec3::ZERO), at(Vec3::Z * 3.0));
        assert!(view(&above, Sides::Front).is_none() && view(&at(Vec3::Z), Sides::Both).is_none());
        assert_eq!(shape.projected_solid_angle(&above, Sides::Front), Some(0.0));
        let (front, e) = (view(&below, Sides::Front), shape.projected_solid_angle(&below, Sides::Front));
        let (front, e) = (front.expect("a view"), e.expect("a closed form"));
        for i in 0..100_u8 {
            let u = [f32::from(i % 10) * 0.1 + 0.03, f32::from(i / 10) * 0.1 + 0.05];
            let drawn = front.sample(u).expect("a sample");
            let pdf = front.pdf_solid_angle(&drawn.at, drawn.wi, 1.0).expect("a density");
            assert!((below.normal.dot(drawn.wi) / (pdf * e) - 1.0).abs() < 1e-6);
            assert!((drawn.wi * drawn.distance - drawn.at.point).length() < 1e-6);
            let v = front.invert(&drawn.at, drawn.wi).expect("uniforms");
            assert!((u[0] - v[0]).abs().max((u[1] - v[1]).abs()) < 5e-5, "{u:?} {v:?}");
            assert_eq!(front.pdf_solid_angle(&drawn.at, -drawn.wi, 1.0), None);
        }
    }

    #[test]
    fn views_are_consistent_and_dark_from_behind_and_in_the_plane() {
        check(Rectangle::new(Vec3::new(0.1, 0.3, 1.0), Vec3::Y, Vec3::X * 0.6).unwrap());
        check(
            Triangle::new(Vec3::new(-1.0, -1.0, 1.0), Vec3::new(0.2, 2.0, 1.0), Vec3::new(1.0, 0.0, 1.0))
                .unwrap(),
        );
    }
}
