//! Sampling a sphere: its whole surface, or the directions in which it is seen.

mod inside;
mod outside;

use super::{
    AreaView, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceSample, SurfaceView, UseView, View,
};
use crate::geom::unit;
use crate::irradiance;
use crate::num;
use crate::shape::{Sphere, SurfacePoint};
use crate::warp;
use glam::Vec3;
use inside::SphereInside;
use outside::{SphereCap, SphereCone};

/// A sphere from outside, where it fills a cone, or from inside, where it is everywhere.
///
/// * `O` – the view from outside
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SphereView<O> {
    /// The near side, as seen from outside.
    Outside(O),
    /// The far wall, as seen from inside.
    Inside(SphereInside),
}

impl<O: SurfaceView> SurfaceView for SphereView<O> {
    #[inline]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        match self {
            Self::Outside(v) => v.sample(u),
            Self::Inside(v) => v.sample(u),
        }
    }

    #[inline]
    fn pdf_solid_angle(&self, at: &SurfacePoint, wi: Vec3, cos_light: f32) -> Option<f32> {
        match self {
            Self::Outside(v) => v.pdf_solid_angle(at, wi, cos_light),
            Self::Inside(v) => v.pdf_solid_angle(at, wi, cos_light),
        }
    }

    fn invert(&self, at: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        match self {
            Self::Outside(v) => v.invert(at, wi),
            Self::Inside(v) => v.invert(at, wi),
        }
    }
}

/// How far outside the sphere a receiver is taken to be (m), 0 or less from inside; `None` when the
/// emitting side is not seen from there.
///
/// Points of the sphere itself lie on either side of it, as far as [`Sphere::point`] says that they
/// are rounded, and no farther: they are taken to be on the side that emits.
fn clearance(sphere: &Sphere, from: Vec3, sides: Sides) -> Option<f32> {
    let gap = sphere.clearance(from);
    let rounding = num::gamma(8) * (sphere.centre().length() + sphere.radius());
    match (sides, sphere.is_inward()) {
        (Sides::Both, _) => Some(gap),
        (Sides::Front, false) => (gap > -rounding).then_some(gap.max(f32::MIN_POSITIVE)),
        (Sides::Front, true) => (gap < rounding).then_some(gap.min(0.0)),
    }
}

impl SampledShape for Sphere {
    type View = View<Self, SphereView<SphereCone>, SphereView<SphereCap>>;

    /// Density `1 / (4π r²)` (m⁻²): half of the points are on the far side.
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        self.point(warp::uniform_sphere(u))
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let n = unit(point - self.centre()).unwrap_or(Vec3::Z);
        warp::uniform_sphere_inverse(n).map(num::clamp_unit)
    }

    /// From outside, the far side is hidden.
    #[inline]
    fn hides(&self, from: Vec3, at: &SurfacePoint) -> bool {
        let outward = if self.is_inward() { -at.normal } else { at.normal };
        outward.dot(from - at.point) < 0.0 && self.clearance(from) > 0.0
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn with_view<U: UseView<Self::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        sides: Sides,
        then: U,
    ) -> Option<U::Output> {
        let gap = clearance(self, from.point, sides)?;
        match method.required(from, self.centre(), self.radius(), SurfaceDensity::SolidAngle) {
            SurfaceDensity::Area => then.with(AreaView::new(*self, from), View::Area),
            SurfaceDensity::SolidAngle if gap > 0.0 => {
                let cone = SphereCone::new(self, from, gap)?;
                then.with(cone, |v| View::SolidAngle(SphereView::Outside(v)))
            }
            SurfaceDensity::SolidAngle => {
                let inside = SphereInside::new(self, from, gap, false);
                then.with(inside, |v| View::SolidAngle(SphereView::Inside(v)))
            }
            SurfaceDensity::Projected | SurfaceDensity::Auto if gap > 0.0 => {
                let cap = SphereCap::new(self, from, gap)?;
                then.with(cap, |v| View::Projected(SphereView::Outside(v)))
            }
            SurfaceDensity::Projected | SurfaceDensity::Auto => {
                let inside = SphereInside::new(self, from, gap, true);
                then.with(inside, |v| View::Projected(SphereView::Inside(v)))
            }
        }
    }

    fn projected_solid_angle(&self, from: &Receiver, sides: Sides) -> Option<f32> {
        let seen = clearance(self, from.point, sides);
        Some(seen.map_or(0.0, |gap| irradiance::sphere_at(from, self, gap)))
    }
}
