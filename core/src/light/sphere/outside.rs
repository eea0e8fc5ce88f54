//! The cone that a sphere fills, by solid angle and by projected solid angle.

use crate::geom::{Frame, unit};
use crate::light::{Receiver, SurfaceSample, SurfaceView};
use crate::num;
use crate::projected::ProjectedCap;
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
    /// Distance to the surface (m).
    gap: f32,
    /// `sin² θ_max`.
    sin2_max: f32,
    /// `1 − cos θ_max`.
    one_minus_cos_max: f32,
}

impl SphereCone {
    /// * `gap` – how far outside the receiver is (m), above 0
    #[inline]
    pub(super) fn new(sphere: &Sphere, from: &Receiver, gap: f32) -> Option<Self> {
        let axis = unit(sphere.centre() - from.point)?;
        Some(Self::with_frame(sphere, Frame::from_normal(axis), gap))
    }

    /// * `frame` – whose third axis leads to the centre
    #[inline]
    fn with_frame(sphere: &Sphere, frame: Frame, gap: f32) -> Self {
        let distance = sphere.radius() + gap;
        let sin_max = sphere.radius() / distance;
        let cos_max = num::sqrt(gap / distance) * num::sqrt((gap + 2.0 * sphere.radius()) / distance);
        let sin2_max = sin_max * sin_max;
        // 1 − cos θ_max = s² / (1 + √(1 − s²)): no cancellation for any size.
        let one_minus_cos_max = sin2_max / (1.0 + cos_max);
        Self { sphere: *sphere, frame, distance, gap, sin2_max, one_minus_cos_max }
    }

    /// Outward normal of the sphere where the local direction `d` first meets it.
    ///
    /// * `reach` – distance to there, in radii
    ///
    /// Source: Pharr, Jakob, Humphreys 2023, section 6.2.4: with `β` the angle at the centre,
    /// `cos β = sin² θ / s + cos θ √(1 − sin² θ / s²)`, s = sin θ_max. Differs: `sin β` is
    /// `sin θ reach` by the law of sines, which keeps its digits for a sphere that is almost touched.
    #[inline]
    fn normal_at(&self, d: Vec3, reach: f32) -> Vec3 {
        let sin2 = d.x * d.x + d.y * d.y;
        let sin_max = num::sqrt(self.sin2_max);
        let cos_beta = sin2 / sin_max + d.z * num::sqrt(1.0 - sin2 / self.sin2_max);
        self.frame.to_world(Vec3::new(d.x * reach, d.y * reach, -cos_beta))
    }

    /// Distance to the sphere along the local direction `d`:
    /// `d cos θ − √(r² − d² sin² θ)`, rearranged to its product form.
    #[inline]
    fn near_distance(&self, d: Vec3) -> f32 {
        let sin2 = d.x * d.x + d.y * d.y;
        let radius = self.sphere.radius();
        let half_chord = radius * num::sqrt(1.0 - sin2 / self.sin2_max);
        let far = (self.distance * d.z + half_chord).max(f32::MIN_POSITIVE);
        // Product of both distances along a ray: the power of the point, (d − r)(d + r).
        self.gap * ((self.distance + radius) / far)
    }

    /// The sample in the local direction `d` of the cone.
    #[inline]
    fn toward(&self, d: Vec3) -> Option<SurfaceSample> {
        // Not from the difference of the points, which cancels for a distant sphere.
        let distance = self.near_distance(d);
        if !(distance > 0.0 && distance < f32::INFINITY) {
            return None;
        }
        let n = unit(self.normal_at(d, distance / self.sphere.radius()))?;
        Some(SurfaceSample { at: self.sphere.point(n), wi: self.frame.to_world(d), distance })
    }
}

impl SurfaceView for SphereCone {
    /// Uniform in the cone, and the point where that direction first meets the sphere.
    #[inline]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        self.toward(warp::cone(u, self.one_minus_cos_max))
    }

    #[inline]
    fn pdf_solid_angle(&self, _: &SurfacePoint, _: Vec3, _: f32) -> Option<f32> {
        Some(warp::cone_pdf(self.one_minus_cos_max)).filter(|p| p.is_finite())
    }

    fn invert(&self, _: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        let u = warp::cone_inverse(self.frame.to_local(wi), self.one_minus_cos_max);
        u.iter().all(|x| x.is_finite()).then(|| u.map(num::clamp_unit))
    }
}

/// The part of that cone above the receiver's horizon: uniform over projected solid angle,
/// `cos θ / E` (sr⁻¹).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphereCap {
    cone: SphereCone,
    cap: ProjectedCap,
    normal: Vec3,
}

impl SphereCap {
    /// `None` below the horizon.
    ///
    /// * `gap` – how far outside the receiver is (m), above 0
    #[inline]
    pub(super) fn new(sphere: &Sphere, from: &Receiver, gap: f32) -> Option<Self> {
        let to_centre = sphere.centre() - from.point;
        let (cap, frame) = ProjectedCap::of_sphere(from, to_centre, sphere.radius(), gap)?;
        Some(Self { cone: SphereCone::with_frame(sphere, frame, gap), cap, normal: from.normal })
    }
}

impl SurfaceView for SphereCap {
    #[inline]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        self.cone.toward(self.cap.sample(u))
    }

    #[inline]
    fn pdf_solid_angle(&self, _: &SurfacePoint, wi: Vec3, _: f32) -> Option<f32> {
        let pdf = self.normal.dot(wi) / self.cap.area();
        (pdf > 0.0 && pdf.is_finite()).then_some(pdf)
    }

    fn invert(&self, _: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        let above = self.normal.dot(wi) > 0.0;
        above.then(|| self.cap.invert(self.cone.frame.to_local(wi)))
    }
}
