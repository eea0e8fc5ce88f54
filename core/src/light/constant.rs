//! The same radiance from everywhere.

use super::error::check_emission;
use super::{Density, Emitter, LightError, LightSample, Receiver, SurfaceDensity};
use crate::Rgb;
use crate::geom::Frame;
use crate::num::PI;
use crate::warp;
use glam::Vec3;

/// An environment of constant radiance around the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constant {
    radiance: Rgb,
}

impl Constant {
    /// An environment that sends `radiance` (W m⁻² sr⁻¹) from each direction.
    ///
    /// # Errors
    /// When the radiance is negative, NaN or infinite.
    pub fn new(radiance: Rgb) -> Result<Self, LightError> {
        Ok(Self { radiance: check_emission("the radiance", radiance)? })
    }

    /// A light that was checked before: for constants; see [`crate::Scene::baked`].
    ///
    /// * `radiance` (W m⁻² sr⁻¹)
    #[must_use]
    pub const fn baked(radiance: Rgb) -> Self {
        Self { radiance }
    }
}

impl Emitter for Constant {
    /// Cosine about the receiver's normal, `cos θ / π` (sr⁻¹): the only directions that count, each
    /// as often as it counts.
    #[inline]
    fn sample(&self, from: &Receiver, _: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        let local = warp::cosine_hemisphere(u);
        let wi = Frame::from_normal(from.normal).to_world(local);
        let pdf = self.pdf_escaping(from, wi);
        (pdf > 0.0).then_some(LightSample {
            wi,
            distance: f32::INFINITY,
            incident: self.radiance,
            density: Density::SolidAngle(pdf),
        })
    }

    #[inline]
    fn pdf_escaping(&self, from: &Receiver, wi: Vec3) -> f32 {
        warp::cosine_hemisphere_pdf(from.normal.dot(wi))
    }

    #[inline]
    fn radiance_escaping(&self, _wi: Vec3) -> Rgb {
        self.radiance
    }

    /// `π L`.
    fn unshadowed_irradiance(&self, _from: &Receiver) -> Option<Rgb> {
        Some(self.radiance * PI).filter(|irradiance| irradiance.is_finite())
    }

    fn is_environment(&self) -> bool {
        true
    }

    /// `4π² R² L`: what enters the sphere around the scene.
    fn power(&self, scene_radius: f32) -> f32 {
        4.0 * PI * PI * scene_radius * scene_radius * self.radiance.average()
    }

    fn check(&self) -> Result<(), LightError> {
        Self::new(self.radiance).map(drop)
    }
}
