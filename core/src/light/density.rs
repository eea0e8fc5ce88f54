//! Which density a light's surface is sampled with.

use super::Receiver;
use glam::Vec3;

/// How a light's surface is sampled.
///
/// A shape that lacks a density takes the one before it in this list, in sampling and in querying
/// alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SurfaceDensity {
    /// Uniform over the whole surface.
    Area,
    /// Uniform over the solid angle that the light fills.
    SolidAngle,
    /// Proportional to the receiver's cosine over that solid angle, and 0 below the receiver's
    /// horizon: uniform over the projected solid angle.
    Projected,
    /// What the configuration requires: the cheapest density where they hardly differ, the projected
    /// one elsewhere. The rule is [`SurfaceDensity::required`].
    #[default]
    Auto,
}

/// How many radii above the receiver's horizon a light must be to be called distant.
const DISTANT: f32 = 8.0;

impl SurfaceDensity {
    /// What `Auto` comes down to for a light in a sphere; the other methods are themselves.
    ///
    /// * `centre`, `radius` – a sphere that holds the light (m)
    /// * `distant` – what is good enough for the shape when it is distant
    ///
    /// It depends on the receiver and the light alone, so that a direction has one density whether
    /// it is sampled or met.
    #[inline]
    #[must_use]
    pub fn required(self, from: &Receiver, centre: Vec3, radius: f32, distant: Self) -> Self {
        match self {
            Self::Auto if from.normal.dot(centre - from.point) >= DISTANT * radius => distant,
            Self::Auto => Self::Projected,
            chosen => chosen,
        }
    }
}
