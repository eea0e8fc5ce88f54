//! Point lights.

use super::bounds::positive;
use super::error::check_emission;
use super::{Cone, Density, Emitter, LightBounds, LightError, LightSample, Receiver, SurfaceDensity};
use crate::Rgb;
use crate::geom::unit;
use crate::num::PI;
use glam::Vec3;

/// A point that sends the same intensity everywhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    position: Vec3,
    intensity: Rgb,
}

impl Point {
    /// A light at `position` (m) with `intensity` (W sr⁻¹).
    ///
    /// # Errors
    /// When a number is NaN or infinite, or the intensity negative.
    pub fn new(position: Vec3, intensity: Rgb) -> Result<Self, LightError> {
        if !position.is_finite() {
            return Err(LightError::NotFinite { field: "the position" });
        }
        Ok(Self { position, intensity: check_emission("the intensity", intensity)? })
    }

    /// Position (m).
    #[must_use]
    pub const fn position(&self) -> Vec3 {
        self.position
    }

    /// Intensity (W sr⁻¹).
    #[must_use]
    pub const fn intensity(&self) -> Rgb {
        self.intensity
    }

    /// A light that was checked before: for constants; see [`crate::Scene::baked`].
    ///
    /// * `position` (m), `intensity` (W sr⁻¹)
    #[must_use]
    pub const fn baked(position: Vec3, intensity: Rgb) -> Self {
        Self { position, intensity }
    }
}

/// Irradiance `I / d²` from a point; `None` where `f32` cannot hold it.
#[inline]
pub(super) fn from_point(from: &Receiver, position: Vec3, intensity: Rgb) -> Option<LightSample> {
    let v = position - from.point;
    let wi = unit(v)?;
    let distance = v.dot(wi);
    // Divided twice: d² alone leaves the range of f32 before I / d² does.
    let incident = intensity / distance / distance;
    incident.is_finite().then_some(LightSample { wi, distance, incident, density: Density::Delta })
}

impl Emitter for Point {
    #[inline]
    fn sample(&self, from: &Receiver, _: SurfaceDensity, _: [f32; 2]) -> Option<LightSample> {
        from_point(from, self.position, self.intensity)
    }

    fn is_delta(&self) -> bool {
        true
    }

    fn bounds(&self) -> Option<LightBounds> {
        let intensity = positive(self.intensity.average(), 4.0);
        Some(LightBounds::at(self.position, Cone::ALL, Vec3::ZERO, intensity))
    }

    /// `4π I`.
    fn power(&self, _scene_radius: f32) -> f32 {
        4.0 * PI * self.intensity.average()
    }

    fn check(&self) -> Result<(), LightError> {
        Self::new(self.position, self.intensity).map(drop)
    }
}
