//! A picture of the radiance from all directions around the scene.

use super::{Density, Emitter, LightError, LightSample, Receiver, SurfaceDensity};
use crate::Rgb;
use crate::geom::Frame;
use crate::num;
use crate::warp;
use glam::{Mat3, Vec3};

/// An environment map in longitude and latitude, borrowed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EnvironmentMap<'a> {
    texels: &'a [Rgb],
    width: u32,
    height: u32,
    to_local: Mat3,
    mean: f32,
}

impl<'a> EnvironmentMap<'a> {
    /// Borrows a map.
    ///
    /// * `texels` – radiance (W m⁻² sr⁻¹), `width` × `height` of them, row by row from the zenith down
    /// * `to_world` – a rotation
    ///
    /// # Errors
    /// When the number of texels is not `width` × `height`, or one of them is negative or not finite.
    pub fn new(texels: &'a [Rgb], width: u32, height: u32, to_world: Mat3) -> Result<Self, LightError> {
        let count = width as usize * height as usize;
        if count == 0 || texels.len() != count {
            return Err(LightError::TexelCount { width, height, texels: texels.len() });
        }
        if let Some(index) = texels.iter().position(|t| !t.is_valid()) {
            let (x, y) = (index as u32 % width, index as u32 / width);
            return Err(LightError::Texel { x, y, radiance: texels[index] });
        }
        let sum: f64 = texels.iter().map(|t| f64::from(t.average())).sum();
        Ok(Self { texels, width, height, to_local: to_world.transpose(), mean: (sum / count as f64) as f32 })
    }

    /// Radiance from the direction `wi` (W m⁻² sr⁻¹): that of its texel.
    #[inline]
    fn lookup(&self, wi: Vec3) -> Rgb {
        let local = self.to_local * wi;
        let turns = num::atan2(local.x, -local.z) * (0.5 * num::FRAC_1_PI);
        let u = if turns < 0.0 { turns + 1.0 } else { turns };
        let v = num::acos(num::clamp(local.y, -1.0, 1.0)) * num::FRAC_1_PI;
        let x = ((u * self.width as f32) as u32).min(self.width - 1);
        let y = ((v * self.height as f32) as u32).min(self.height - 1);
        self.texels.get((y * self.width + x) as usize).copied().unwrap_or(Rgb::BLACK)
    }
}

impl Emitter for EnvironmentMap<'_> {
    /// Cosine about the receiver's normal, `cos θ / π` (sr⁻¹).
    #[inline]
    fn sample(&self, from: &Receiver, _: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        let wi = Frame::from_normal(from.normal).to_world(warp::cosine_hemisphere(u));
        let pdf = self.pdf_escaping(from, wi);
        (pdf > 0.0).then_some(LightSample {
            wi,
            distance: f32::INFINITY,
            incident: self.lookup(wi),
            density: Density::SolidAngle(pdf),
        })
    }

    #[inline]
    fn pdf_escaping(&self, from: &Receiver, wi: Vec3) -> f32 {
        warp::cosine_hemisphere_pdf(from.normal.dot(wi))
    }

    #[inline]
    fn radiance_escaping(&self, wi: Vec3) -> Rgb {
        self.lookup(wi)
    }

    fn is_environment(&self) -> bool {
        true
    }

    /// `4π² R²` times the mean of the texels.
    fn power(&self, scene_radius: f32) -> f32 {
        4.0 * num::PI * num::PI * scene_radius * scene_radius * self.mean
    }
}
