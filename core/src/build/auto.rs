//! What a scene requires, where nobody says otherwise: the same for every frontend.

use super::{Description, IntegratorDescription};
use crate::estimate::{Heuristic, Technique};
use crate::light::{AnyLight, EnvironmentDensity};

/// Up to so many lights are all sampled at each point; of more, one is chosen by a tree. With the first
/// 4, 8 and 16 lights of the peers' scene `many`, relMSE times seconds of all, over that of the tree,
/// were 1.4, 0.24 and 1.4.
pub const FEW_LIGHTS: usize = 8;

impl Description {
    /// Which densities are combined. An author who wants no samples of a kind means the other technique.
    ///
    /// * `integrator` – how many samples of a kind the author wants, as far as nobody says otherwise
    ///
    /// Under an environment map that may hold a sun both are combined everywhere: in the sun's shadow
    /// most samples by luminance are wasted. On the peers' `env` that is a third of relMSE.
    #[must_use]
    pub fn required_technique(&self, integrator: IntegratorDescription, heuristic: Heuristic) -> Technique {
        match integrator {
            IntegratorDescription { light_samples: Some(0), .. } => Technique::Bsdf,
            IntegratorDescription { bsdf_samples: Some(0), .. } => Technique::Light,
            _ if self.hides_a_sun() => Technique::Mis(heuristic),
            _ => Technique::Auto(heuristic),
        }
    }

    /// True with an environment map whose sun, if it has one, is not a light of its own.
    fn hides_a_sun(&self) -> bool {
        let sun = self.lights.iter().any(|light| matches!(light, AnyLight::DistantDisk(_)));
        !self.environments.is_empty() && !sun
    }
}

/// How directions toward environment maps are drawn with a technique.
///
/// BSDF samples, where there are some, are left what they find: on the peers' `env` relMSE at 64 samples
/// is 2.0e-4 so, 2.4e-4 with the product and 3.0e-4 by luminance. Without them the product is best.
#[must_use]
pub const fn required_environment(technique: Technique) -> EnvironmentDensity {
    match technique {
        Technique::Mis(_) => EnvironmentDensity::Compensated,
        _ => EnvironmentDensity::Product,
    }
}
