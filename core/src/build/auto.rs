//! What a scene requires, where nobody says otherwise: the same for every frontend.

use super::{Description, Image, IntegratorDescription};
use crate::estimate::{Heuristic, Technique};
use crate::light::{AnyLight, EnvironmentDensity};
use crate::num;
use std::f64::consts::PI;

/// Up to so many lights are all sampled at each point; of more, one is chosen by a tree. With the first
/// 4, 8 and 16 lights of the peers' scene `many`, relMSE times seconds of all, over that of the tree,
/// were 1.4, 0.24 and 1.4.
pub const FEW_LIGHTS: usize = 8;

/// How many times the square of a map's mean luminance its mean square may be for the map to be even. A
/// hemisphere of one radiance has 2, a clear sky without its sun a little more; with it, thousands.
const EVEN: f64 = 6.0;

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
            _ => Technique::Auto(heuristic),
        }
    }

    /// How directions toward the environment maps are drawn with a technique.
    ///
    /// BSDF samples, where there are some, are left what they find: on the peers' `env` relMSE at 64 samples
    /// is 2.0e-4 so, 2.4e-4 with the product and 3.0e-4 by luminance. Without them the product has the
    /// least noise, but its samples cost more: under the even sky of `morning` those by the cosine alone
    /// are twice as efficient. Portals draw within windows, and take the product there.
    #[must_use]
    pub fn required_environment(&self, technique: Technique) -> EnvironmentDensity {
        let is_even = || self.environments.iter().all(|map| contrast(&map.image) < EVEN);
        match technique {
            Technique::Mis(_) => EnvironmentDensity::Compensated,
            _ if self.portals.is_empty() && is_even() => EnvironmentDensity::Cosine,
            Technique::Auto(_) if self.hides_a_sun() => EnvironmentDensity::Compensated,
            _ => EnvironmentDensity::Product,
        }
    }

    /// True with an environment map whose sun, if it has one, is not a light of its own.
    fn hides_a_sun(&self) -> bool {
        let sun = self.lights.iter().any(|light| matches!(light, AnyLight::DistantDisk(_)));
        !self.environments.is_empty() && !sun
    }
}

/// Mean square of a map's luminance over all directions, in squares of its mean; NaN of a black one.
fn contrast(map: &Image) -> f64 {
    let (mut weights, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for (y, row) in map.texels.chunks(map.width.max(1) as usize).enumerate() {
        let (weight, _) = num::sin_cos_in_double(PI * (y as f64 + 0.5) / f64::from(map.height));
        for luminance in row.iter().map(|texel| f64::from(texel.luminance())) {
            weights += weight;
            sum += weight * luminance;
            squares += weight * luminance * luminance;
        }
    }
    squares * weights / (sum * sum)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rgb;

    #[test]
    fn a_sun_makes_a_map_uneven() {
        let mut map = Image { width: 64, height: 32, texels: std::vec![Rgb::WHITE; 64 * 32] };
        assert!((contrast(&map) - 1.0).abs() < 1e-9);
        map.texels[8 * 64 + 20] = Rgb::splat(1e4);
        assert!(contrast(&map) > EVEN);
    }

    #[cfg(feature = "load")]
    #[test]
    fn a_clear_sky_without_its_sun_is_even() {
        let morning = crate::load::builtin::builtin("morning").unwrap();
        let sky = contrast(&morning.environments[0].image);
        assert!((2.0..EVEN).contains(&sky), "{sky}");
        let technique = Technique::Auto(Heuristic::Power);
        assert_eq!(morning.required_environment(technique), EnvironmentDensity::Cosine);
    }
}
