//! Sampling a sphere: its whole surface, or the cone that it fills.

use super::{
    AreaView, NoView, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceSample, SurfaceView, UseView,
    View,
};
use crate::geom::{Frame, unit};
use crate::num;
use crate::shape::{Sphere, SurfacePoint};
use crate::warp;
use glam::Vec3;

/// The cone in which a sphere is seen from outside: uniform over solid angle,
/// `1 / (2π (1 − cos θ_max))` (sr⁻¹).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphereCone {
    sphere: Sphere,
    frame: Frame,
    /// Distance to the centre (m).
    distance: f32,
    /// `sin² θ_max`.
    sin2_max: f32,
    /// `1 − cos θ_max`.
    one_minus_cos_max: f32,
}

impl SphereCone {
    /// `None` from inside, and from the surface as far as rounding places its points: one of the
    /// inner wall must not take itself for an outer one.
    #[inline(always)]
    fn new(sphere: &Sphere, from: Vec3) -> Option<Self> {
        let v = sphere.centre() - from;
        let axis = unit(v)?;
        let distance = v.dot(axis);
        let rounding = num::gamma(16) * (sphere.centre().abs().max_element() + sphere.radius());
        if distance <= sphere.radius() + rounding {
            return None;
        }
        let sin_max = sphere.radius() / distance;
        let sin2_max = sin_max * sin_max;
        // 1 − cos θ_max = s² / (1 + √(1 − s²)): no cancellation for any size.
        let one_minus_cos_max = sin2_max / (1.0 + num::sqrt(1.0 - sin2_max));
        let frame = Frame::from_normal(axis);
        Some(Self { sphere: *sphere, frame, distance, sin2_max, one_minus_cos_max })
    }

    /// Outward normal of the sphere where the local direction `d` first meets it.
    ///
    /// * `reach` – distance to there, in radii
    ///
    /// Source: Pharr, Jakob, Humphreys 2023, section 6.2.4: with `β` the angle at the centre,
    /// `cos β = sin² θ / s + cos θ √(1 − sin² θ / s²)`, s = sin θ_max. Differs: `sin β` is
    /// `sin θ reach` by the law of sines, which keeps its digits for a sphere that is almost touched.
    #[inline(always)]
    fn normal_at(&self, d: Vec3, reach: f32) -> Vec3 {
        let sin2 = d.x * d.x + d.y * d.y;
        let sin_max = num::sqrt(self.sin2_max);
        let cos_beta = sin2 / sin_max + d.z * num::sqrt(1.0 - sin2 / self.sin2_max);
        self.frame.to_world(Vec3::new(d.x * reach, d.y * reach, -cos_beta))
    }

    /// Distance to the sphere along the local direction `d`:
    /// `d cos θ − √(r² − d² sin² θ)`, rearranged to its product form.
    #[inline(always)]
    fn near_distance(&self, d: Vec3) -> f32 {
        let sin2 = d.x * d.x + d.y * d.y;
        let radius = self.sphere.radius();
        let half_chord = radius * num::sqrt(1.0 - sin2 / self.sin2_max);
        let (gap, far) = (self.distance - radius, self.distance * d.z + half_chord);
        // Product of both distances along a ray: the power of the point, (d − r)(d + r).
        gap * ((self.distance + radius) / far)
    }

    /// The sample in the local direction `d` of the cone.
    #[inline(always)]
    fn toward(&self, d: Vec3) -> Option<SurfaceSample> {
        // Not from the difference of the points, which cancels for a distant sphere.
        let distance = self.near_distance(d);
        let n = unit(self.normal_at(d, distance / self.sphere.radius()))?;
        Some(SurfaceSample { at: self.sphere.point(n), wi: self.frame.to_world(d), distance })
    }
}

impl SurfaceView for SphereCone {
    /// Uniform in the cone, and the point where that direction first meets the sphere.
    #[inline(always)]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        self.toward(warp::cone(u, self.one_minus_cos_max))
    }

    #[inline(always)]
    fn pdf_solid_angle(&self, _: &SurfacePoint, _: Vec3, _: f32) -> Option<f32> {
        Some(warp::cone_pdf(self.one_minus_cos_max)).filter(|p| p.is_finite())
    }

    fn invert(&self, _: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        let [s, t] = warp::cone_inverse(self.frame.to_local(wi), self.one_minus_cos_max);
        Some([s.min(num::ONE_MINUS_EPSILON), t])
    }
}

impl SampledShape for Sphere {
    type View = View<Self, SphereCone, NoView>;

    /// Density `1 / (4π r²)` (m⁻²): half of the points are on the far side.
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        self.point(warp::uniform_sphere(u))
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        warp::uniform_sphere_inverse(unit(point - self.centre()).unwrap_or(Vec3::Z))
    }

    /// From outside, the far side is hidden.
    #[inline]
    fn hides(&self, from: Vec3, at: &SurfacePoint) -> bool {
        let outward = if self.is_inward() { -at.normal } else { at.normal };
        outward.dot(from - at.point) < 0.0
            && self.centre().distance_squared(from) > self.radius() * self.radius()
    }

    /// From inside and from the surface itself, by area.
    #[inline(always)]
    fn with_view<U: UseView<Self::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        _: Sides,
        then: U,
    ) -> Option<U::Output> {
        let cone = if method == SurfaceDensity::Area { None } else { SphereCone::new(self, from.point) };
        match cone {
            Some(cone) => then.with(cone, View::SolidAngle),
            None => then.with(AreaView::new(*self, from), View::Area),
        }
    }
}
