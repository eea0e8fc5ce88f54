//! A disk infinitely far away: the sun.

use super::error::{check_emission, check_unit};
use super::{Density, Emitter, LightError, LightSample, Receiver, SurfaceDensity};
use crate::Rgb;
use crate::geom::{Frame, unit};
use crate::irradiance;
use crate::num::{self, PI};
use crate::shape::Sphere;
use crate::warp;
use glam::Vec3;

/// The same radiance from each direction of a narrow cone: what a bright ball sends from so far away
/// that it looks the same from everywhere in the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DistantDisk {
    axis: Vec3,
    sin2_radius: f32,
    radiance: Rgb,
}

impl DistantDisk {
    /// A disk in the direction `toward`, which need not be of unit length.
    ///
    /// * `radius` – angular radius (rad), in `(0, π/4]`
    /// * `radiance` – W m⁻² sr⁻¹
    ///
    /// # Errors
    /// When the direction has no length, the radius is outside of its range, or the radiance is
    /// negative, NaN or infinite.
    pub fn new(toward: Vec3, radius: f32, radiance: Rgb) -> Result<Self, LightError> {
        let axis = unit(toward).ok_or(LightError::NoDirection)?;
        let sin = num::sin_cos_near(radius).0;
        if !(radius > 0.0 && radius <= num::FRAC_PI_4 && sin * sin > 0.0) {
            return Err(LightError::AngularRadius { radius });
        }
        Ok(Self { axis, sin2_radius: sin * sin, radiance: check_emission("the radiance", radiance)? })
    }

    /// Unit direction of the centre.
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.axis
    }

    /// Squared sine of the angular radius.
    #[must_use]
    pub const fn sin2_radius(&self) -> f32 {
        self.sin2_radius
    }

    /// Irradiance on a surface that faces it (W m⁻²).
    #[must_use]
    pub fn irradiance(&self) -> Rgb {
        self.radiance * (PI * self.sin2_radius)
    }

    /// `1 − cos` of the angular radius.
    #[inline]
    fn one_minus_cos(&self) -> f32 {
        self.sin2_radius / (1.0 + num::sqrt(1.0 - self.sin2_radius))
    }

    /// True for the directions that light comes from: what both the radiance and the density go by.
    #[inline]
    fn contains(&self, wi: Vec3) -> bool {
        // From the sine, since the cosine of a narrow cone is 1.
        wi.dot(self.axis) > 0.0 && wi.cross(self.axis).length_squared() <= self.sin2_radius
    }

    /// A light that was checked before: for constants; see [`crate::Scene::baked`].
    ///
    /// * `axis` – unit vector, `sin2_radius` – squared sine of the angular radius, `radiance` (W m⁻² sr⁻¹)
    #[must_use]
    pub const fn baked(axis: Vec3, sin2_radius: f32, radiance: Rgb) -> Self {
        Self { axis, sin2_radius, radiance }
    }
}

impl Emitter for DistantDisk {
    /// Uniform over the cone.
    #[inline]
    fn sample(&self, from: &Receiver, _: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        let wi = Frame::from_normal(self.axis).to_world(warp::cone(u, self.one_minus_cos()));
        let pdf = self.pdf_escaping(from, wi);
        // A direction at the rim may be rounded to the outside: one in 10⁵ of a disk like the sun's.
        (pdf > 0.0).then_some(LightSample {
            wi,
            distance: f32::INFINITY,
            incident: self.radiance,
            density: Density::SolidAngle(pdf),
        })
    }

    #[inline]
    fn pdf_escaping(&self, _from: &Receiver, wi: Vec3) -> f32 {
        if self.contains(wi) { warp::cone_pdf(self.one_minus_cos()) } else { 0.0 }
    }

    #[inline]
    fn radiance_escaping(&self, wi: Vec3) -> Rgb {
        if self.contains(wi) { self.radiance } else { Rgb::BLACK }
    }

    /// That of a ball which fills the cone.
    fn unshadowed_irradiance(&self, from: &Receiver) -> Option<Rgb> {
        let ball = Sphere::new(self.axis, num::sqrt(self.sin2_radius)).ok()?;
        let here = Receiver { point: Vec3::ZERO, normal: from.normal };
        Some(self.radiance * irradiance::sphere(&here, &ball)).filter(|e| e.is_finite())
    }

    fn is_environment(&self) -> bool {
        true
    }

    /// `π R²` times the irradiance on a surface that faces it.
    fn power(&self, scene_radius: f32) -> f32 {
        PI * scene_radius * scene_radius * self.irradiance().average()
    }

    fn check(&self) -> Result<(), LightError> {
        check_unit(self.axis)?;
        // A half is the squared sine of 45°, to rounding.
        if !(self.sin2_radius > 0.0 && self.sin2_radius <= 0.500_001) {
            return Err(LightError::AngularRadius { radius: num::acos(num::sqrt(1.0 - self.sin2_radius)) });
        }
        check_emission("the radiance", self.radiance).map(drop)
    }
}
