//! Parallel light.

use super::error::{check_emission, check_unit};
use super::{Density, Emitter, LightError, LightSample, Receiver, SurfaceDensity};
use crate::Rgb;
use crate::geom::unit;
use crate::num::PI;
use glam::Vec3;

/// Parallel light from infinitely far away.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Directional {
    direction: Vec3,
    irradiance: Rgb,
}

impl Directional {
    /// Light that travels along `direction` and brings `irradiance` (W m⁻²) to a surface facing it.
    ///
    /// # Errors
    /// When the direction has no length, or the irradiance is negative, NaN or infinite.
    pub fn new(direction: Vec3, irradiance: Rgb) -> Result<Self, LightError> {
        let direction = unit(direction).ok_or(LightError::NoDirection)?;
        Ok(Self { direction, irradiance: check_emission("the irradiance", irradiance)? })
    }

    /// Unit direction in which the light travels.
    #[must_use]
    pub const fn direction(&self) -> Vec3 {
        self.direction
    }

    /// Irradiance on a surface facing the light (W m⁻²).
    #[must_use]
    pub const fn irradiance(&self) -> Rgb {
        self.irradiance
    }

    /// A light that was checked before: for constants; see [`crate::Scene::baked`].
    ///
    /// * `direction` – unit vector, `irradiance` (W m⁻²)
    #[must_use]
    pub const fn baked(direction: Vec3, irradiance: Rgb) -> Self {
        Self { direction, irradiance }
    }
}

impl Emitter for Directional {
    #[inline]
    fn sample(&self, _: &Receiver, _: SurfaceDensity, _: [f32; 2]) -> Option<LightSample> {
        Some(LightSample {
            wi: -self.direction,
            distance: f32::INFINITY,
            incident: self.irradiance,
            density: Density::Delta,
        })
    }

    fn is_delta(&self) -> bool {
        true
    }

    /// `π R² E`: what enters the sphere around the scene.
    fn power(&self, scene_radius: f32) -> f32 {
        PI * scene_radius * scene_radius * self.irradiance.average()
    }

    fn check(&self) -> Result<(), LightError> {
        check_unit(self.direction)?;
        check_emission("the irradiance", self.irradiance).map(drop)
    }
}
