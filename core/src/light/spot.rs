//! Spot lights.

use super::bounds::{expected_cosine, positive};
use super::error::{check_emission, check_unit};
use super::point::from_point;
use super::{Cone, Emitter, LightBounds, LightError, LightSample, Receiver, SurfaceDensity};
use crate::Rgb;
use crate::geom::unit;
use crate::num::{self, PI, TAU};
use glam::Vec3;

/// A point that sends its intensity into a cone, falling off linearly in the angle between the
/// beam's edge and the cut-off, as Mitsuba 3's `spot`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    position: Vec3,
    axis: Vec3,
    intensity: Rgb,
    beam: f32,
    cutoff: f32,
}

impl Spot {
    /// A light at `position` (m) that points along `direction`.
    ///
    /// * `intensity` – on the axis (W sr⁻¹)
    /// * `beam`, `cutoff` – half-angles of full intensity and of any intensity (rad)
    ///
    /// # Errors
    /// When a number is NaN or infinite, the intensity negative, the direction without length, or
    /// the angles out of order.
    pub fn new(
        position: Vec3,
        direction: Vec3,
        intensity: Rgb,
        beam: f32,
        cutoff: f32,
    ) -> Result<Self, LightError> {
        if !position.is_finite() {
            return Err(LightError::NotFinite { field: "the position" });
        }
        if !(beam >= 0.0 && beam <= cutoff && cutoff > 0.0 && cutoff <= PI) {
            return Err(LightError::Angles { beam, cutoff });
        }
        let axis = unit(direction).ok_or(LightError::NoDirection)?;
        let intensity = check_emission("the intensity", intensity)?;
        Ok(Self { position, axis, intensity, beam, cutoff })
    }

    /// Position (m).
    #[must_use]
    pub const fn position(&self) -> Vec3 {
        self.position
    }

    /// Unit direction of the beam.
    #[must_use]
    pub const fn axis(&self) -> Vec3 {
        self.axis
    }

    /// Intensity on the axis (W sr⁻¹).
    #[must_use]
    pub const fn intensity(&self) -> Rgb {
        self.intensity
    }

    /// Half-angles of full intensity and of any intensity (rad).
    #[must_use]
    pub const fn angles(&self) -> (f32, f32) {
        (self.beam, self.cutoff)
    }

    /// Fraction of the axial intensity sent in the unit direction `w`.
    #[inline]
    fn falloff(&self, w: Vec3) -> f32 {
        // The angle from the chord keeps narrow beams exact, where acos would not.
        let (sum, difference) = ((w + self.axis).length(), (w - self.axis).length());
        let angle = 2.0 * num::atan2(difference, sum);
        if angle <= self.beam {
            1.0
        } else if angle >= self.cutoff {
            0.0
        } else {
            (self.cutoff - angle) / (self.cutoff - self.beam)
        }
    }

    /// A light that was checked before: for constants; see [`crate::Scene::baked`].
    ///
    /// * `position` (m), `axis` – unit vector, `intensity` (W sr⁻¹), `beam` and `cutoff` (rad)
    #[must_use]
    pub const fn baked(position: Vec3, axis: Vec3, intensity: Rgb, beam: f32, cutoff: f32) -> Self {
        Self { position, axis, intensity, beam, cutoff }
    }
}

impl Emitter for Spot {
    #[inline]
    fn sample(&self, from: &Receiver, _: SurfaceDensity, _: [f32; 2]) -> Option<LightSample> {
        let sample = from_point(from, self.position, self.intensity)?;
        let falloff = self.falloff(-sample.wi);
        (falloff > 0.0).then_some(LightSample { incident: sample.incident * falloff, ..sample })
    }

    fn is_delta(&self) -> bool {
        true
    }

    /// As seen from within the beam; a beam all around is a point light.
    fn bounds(&self) -> Option<LightBounds> {
        let directions = Cone { axis: self.axis, angle: self.cutoff };
        // The mean of the beam's directions; on the axis they count as much as `expected_cosine` says.
        let (_, cos) = num::sin_cos_near(self.beam);
        let along = 0.5 + 0.5 * cos;
        let intensity = positive(self.intensity.average(), 1.0 / expected_cosine(along, along));
        Some(LightBounds::at(self.position, directions, self.axis * along, intensity))
    }

    /// Solid angle of the beam and half of the edge's, times the intensity.
    fn power(&self, _scene_radius: f32) -> f32 {
        let cap = |angle: f32| {
            let (sin, _) = num::sin_cos_near(0.5 * angle);
            2.0 * sin * sin
        };
        TAU * 0.5 * (cap(self.beam) + cap(self.cutoff)) * self.intensity.average()
    }

    fn check(&self) -> Result<(), LightError> {
        check_unit(self.axis)?;
        Self::new(self.position, self.axis, self.intensity, self.beam, self.cutoff).map(drop)
    }
}
