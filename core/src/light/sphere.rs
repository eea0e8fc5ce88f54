//! Sampling a sphere: its whole surface, or the cone that it fills.

use super::{Receiver, SampledShape, SurfaceDensity, SurfaceSample};
use crate::geom::{Frame, unit};
use crate::measure::area_to_solid_angle;
use crate::num;
use crate::shape::{Shape, Sphere, SurfacePoint};
use crate::warp;
use glam::Vec3;

/// The cone in which a sphere is seen from outside.
struct Cone {
    axis: Vec3,
    /// Distance to the centre (m).
    distance: f32,
    /// `sin² θ_max`.
    sin2_max: f32,
}

impl Cone {
    /// `None` from inside, and from the surface as far as rounding places its points: one of the
    /// inner wall must not take itself for an outer one.
    #[inline]
    fn new(sphere: &Sphere, from: Vec3) -> Option<Self> {
        let v = sphere.centre() - from;
        let axis = unit(v)?;
        let distance = v.dot(axis);
        let rounding = num::gamma(16) * (sphere.centre().abs().max_element() + sphere.radius());
        if distance <= sphere.radius() + rounding {
            return None;
        }
        let sin_max = sphere.radius() / distance;
        Some(Self { axis, distance, sin2_max: sin_max * sin_max })
    }

    /// `1 − cos θ_max = s² / (1 + √(1 − s²))`: no cancellation for any size.
    #[inline]
    fn one_minus_cos_max(&self) -> f32 {
        self.sin2_max / (1.0 + num::sqrt(1.0 - self.sin2_max))
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
        let local = Vec3::new(d.x * reach, d.y * reach, -cos_beta);
        Frame::from_normal(self.axis).to_world(local)
    }
}

impl SampledShape for Sphere {
    /// Density `1 / (4π r²)` (m⁻²): half of the points are on the far side.
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        self.point(warp::uniform_sphere(u))
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        warp::uniform_sphere_inverse(unit(point - self.centre()).unwrap_or(Vec3::Z))
    }

    /// By solid angle: uniform in the cone `1 / (2π (1 − cos θ_max))`, and the point where that
    /// direction first meets the sphere. From inside and from the surface itself, by area.
    #[inline]
    fn sample_surface(&self, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) -> Option<SurfaceSample> {
        match (method, Cone::new(self, from.point)) {
            (SurfaceDensity::SolidAngle, Some(cone)) => {
                let local = warp::cone(u, cone.one_minus_cos_max());
                // Not from the difference of the points, which cancels for a distant sphere.
                let distance = cone.near_distance(local, self.radius());
                let n = unit(cone.normal_at(local, distance / self.radius()))?;
                let wi = Frame::from_normal(cone.axis).to_world(local);
                let at = self.point(n);
                Some(SurfaceSample { at, wi, distance })
            }
            _ => SurfaceSample::toward(from.point, self.sample_area(u)),
        }
    }

    #[inline]
    fn pdf_solid_angle(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        at: &SurfacePoint,
        cos_light: f32,
    ) -> Option<f32> {
        match (method, Cone::new(self, from.point)) {
            (SurfaceDensity::SolidAngle, Some(cone)) => {
                Some(warp::cone_pdf(cone.one_minus_cos_max())).filter(|p| p.is_finite())
            }
            _ => area_to_solid_angle(1.0 / self.area(), at.point.distance_squared(from.point), cos_light),
        }
    }
}

impl Cone {
    /// Distance to the sphere along the local direction `d`:
    /// `d cos θ − √(r² − d² sin² θ)`, rearranged to its product form.
    #[inline]
    fn near_distance(&self, d: Vec3, radius: f32) -> f32 {
        let sin2 = d.x * d.x + d.y * d.y;
        let half_chord = radius * num::sqrt(1.0 - sin2 / self.sin2_max);
        let (gap, far) = (self.distance - radius, self.distance * d.z + half_chord);
        // Product of both distances along a ray: the power of the point, (d − r)(d + r).
        gap * ((self.distance + radius) / far)
    }
}
