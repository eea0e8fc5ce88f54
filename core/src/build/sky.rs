//! A clear sky by day, and the sun in it.

use super::{Description, EnvironmentDescription, Image};
use crate::Rgb;
use crate::light::{AnyLight, DistantDisk, Emitter, LightError};
use core::f64::consts::{FRAC_PI_2, PI, TAU};
use core::fmt;
use glam::{DVec3, Mat3};
use std::vec::Vec;

/// Columns and rows of the picture of a sky: a texel is 0.7°, and the middle row is the horizon.
const SIZE: [u32; 2] = [512, 257];

/// Angular radius of the sun (rad).
const SUN_RADIUS: f64 = 0.2665 / 180.0 * PI;

/// Light that a unit of white radiance stands for, per 1000 cd/m²: 1000 over the efficacy of
/// equal-energy white, 179 lm/W (Ward 1994, *The RADIANCE Lighting Simulation and Rendering System*).
const PER_KILOCANDELA: f64 = 1000.0 / 179.0;

/// Illuminance of the sun outside of the atmosphere, on a surface that faces it (klx).
const SOLAR_ILLUMINANCE: f64 = 127.5;

/// Wavelengths that stand for red, green and blue (µm).
const WAVELENGTHS: [f64; 3] = [0.61, 0.55, 0.465];

/// A clear sky.
///
/// Source: Preetham, Shirley, Smits 1999, *A Practical Analytic Model for Daylight*, SIGGRAPH 99,
/// appendix A. Differs: the sun's light is weakened by air and haze alone (its equations for ozone,
/// mixed gases and water vapour are left out), at one wavelength for each channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sky {
    elevation: f64,
    azimuth: f64,
    turbidity: f64,
    scale: f64,
}

/// Why there is no such sky.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum SkyError {
    /// The sun is not above the horizon.
    Elevation(f64),
    /// The azimuth is no number.
    Azimuth(f64),
    /// The model does not hold for this haze.
    Turbidity(f64),
}

impl fmt::Display for SkyError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Elevation(v) => write!(f, "the sun's elevation must be from 0 to 90 degrees; it is {v}"),
            Self::Azimuth(v) => write!(f, "the sun's azimuth must be a number of degrees; it is {v}"),
            Self::Turbidity(v) => {
                write!(f, "the turbidity must be from 2 (clear) to 10 (hazy); it is {v}")
            }
        }
    }
}

impl core::error::Error for SkyError {}

impl Sky {
    /// Turbidity of a clear day.
    pub const CLEAR: f64 = 3.0;

    /// Brings a sunny noon near 1: for pictures that are looked at without exposing them.
    pub const EXPOSED: f64 = 1.0 / 200.0;

    /// The sky with the sun at an elevation (degrees, 0 to 90) and an azimuth (degrees from `−z`
    /// toward `+x`), through an atmosphere of a turbidity (2 to 10); `y` is up.
    ///
    /// # Errors
    /// When a number is outside of its range.
    pub fn new(elevation: f64, azimuth: f64, turbidity: f64) -> Result<Self, SkyError> {
        if !(0.0..=90.0).contains(&elevation) {
            return Err(SkyError::Elevation(elevation));
        }
        if !azimuth.is_finite() {
            return Err(SkyError::Azimuth(azimuth));
        }
        if !(2.0..=10.0).contains(&turbidity) {
            return Err(SkyError::Turbidity(turbidity));
        }
        let (elevation, azimuth) = (elevation.to_radians(), (azimuth % 360.0).to_radians());
        Ok(Self { elevation, azimuth, turbidity, scale: 1.0 })
    }

    /// The same sky with every radiance multiplied.
    #[must_use]
    pub const fn scaled(self, scale: f64) -> Self {
        Self { scale: self.scale * scale, ..self }
    }

    /// Unit direction toward the sun.
    #[must_use]
    pub fn toward_sun(&self) -> DVec3 {
        let ((sin, cos), (up, level)) = (libm::sincos(self.azimuth), libm::sincos(self.elevation));
        DVec3::new(level * sin, up, -level * cos)
    }

    /// Radiance from a unit direction (W m⁻² sr⁻¹), without the sun; black below the horizon.
    #[must_use]
    pub fn radiance(&self, toward: DVec3) -> Rgb {
        if toward.y < 0.0 {
            return Rgb::BLACK;
        }
        let theta_sun = FRAC_PI_2 - self.elevation;
        let sun = self.toward_sun();
        let gamma = libm::atan2(toward.cross(sun).length(), toward.dot(sun));
        let zenith = self.zenith(theta_sun);
        let [y, chroma_x, chroma_y] = core::array::from_fn(|i| {
            let c = self.distribution(i);
            zenith[i] * perez(c, toward.y, gamma) / perez(c, 1.0, theta_sun)
        });
        let luminance = y.max(0.0) * PER_KILOCANDELA * self.scale;
        let xyz = [chroma_x, chroma_y, 1.0 - chroma_x - chroma_y].map(|c| c * luminance / chroma_y);
        linear_srgb(xyz)
    }

    /// Luminance (kcd/m²) and chromaticity of the zenith, for the sun's angle from it (rad).
    fn zenith(&self, theta: f64) -> [f64; 3] {
        const X: [[f64; 4]; 3] = [
            [0.00166, -0.00375, 0.00209, 0.0],
            [-0.02903, 0.06377, -0.03202, 0.00394],
            [0.11693, -0.21196, 0.06052, 0.25886],
        ];
        const Y: [[f64; 4]; 3] = [
            [0.00275, -0.00610, 0.00317, 0.0],
            [-0.04214, 0.08970, -0.04153, 0.00516],
            [0.15346, -0.26756, 0.06670, 0.26688],
        ];
        let t = self.turbidity;
        let chroma = |m: [[f64; 4]; 3]| {
            let cubic = |c: [f64; 4]| ((c[0] * theta + c[1]) * theta + c[2]) * theta + c[3];
            (cubic(m[0]) * t + cubic(m[1])) * t + cubic(m[2])
        };
        let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * theta);
        let luminance = (4.0453 * t - 4.9710) * libm::tan(chi) - 0.2155 * t + 2.4192;
        [luminance, chroma(X), chroma(Y)]
    }

    /// Coefficients of the distribution of luminance (0) or of a chromaticity (1, 2).
    fn distribution(&self, quantity: usize) -> [f64; 5] {
        const SLOPE: [[f64; 5]; 3] = [
            [0.1787, -0.3554, -0.0227, 0.1206, -0.0670],
            [-0.0193, -0.0665, -0.0004, -0.0641, -0.0033],
            [-0.0167, -0.0950, -0.0079, -0.0441, -0.0109],
        ];
        const OFFSET: [[f64; 5]; 3] = [
            [-1.4630, 0.4275, 5.3251, -2.5771, 0.3703],
            [-0.2592, 0.0008, 0.2125, -0.8989, 0.0452],
            [-0.2608, 0.0092, 0.2102, -1.6537, 0.0529],
        ];
        core::array::from_fn(|i| SLOPE[quantity][i] * self.turbidity + OFFSET[quantity][i])
    }

    /// The sun.
    ///
    /// # Errors
    /// Never for a scale that leaves its radiance in the range of `f32`.
    pub fn sun(&self) -> Result<DistantDisk, LightError> {
        let theta = FRAC_PI_2 - self.elevation;
        let beyond = 93.885 - theta.to_degrees();
        let mass = 1.0 / (libm::cos(theta) + 0.15 * libm::pow(beyond, -1.253));
        let haze = 0.04608 * self.turbidity - 0.04586;
        let solid_angle = PI * libm::sin(SUN_RADIUS) * libm::sin(SUN_RADIUS);
        let bare = SOLAR_ILLUMINANCE * PER_KILOCANDELA / solid_angle * self.scale;
        let [r, g, b] = WAVELENGTHS.map(|wavelength| {
            let air = 0.008735 * libm::pow(wavelength, -4.08);
            (bare * libm::exp(-mass * (air + haze * libm::pow(wavelength, -1.3)))) as f32
        });
        DistantDisk::new(self.toward_sun().as_vec3(), SUN_RADIUS as f32, Rgb::new(r, g, b))
    }

    /// The sky without its sun in longitude and latitude.
    #[must_use]
    pub fn image(&self) -> Image {
        let [width, height] = SIZE;
        let mut texels = Vec::with_capacity((width * height) as usize);
        for y in 0..height {
            let (sin, cos) = libm::sincos(PI * f64::from(y) / f64::from(height - 1));
            // The rounding of the horizon does not make it ground.
            let up = if 2 * y + 1 == height { 0.0 } else { cos };
            for x in 0..width {
                let (sin_phi, cos_phi) = libm::sincos(TAU * (f64::from(x) + 0.5) / f64::from(width));
                texels.push(self.radiance(DVec3::new(sin * sin_phi, up, -sin * cos_phi)));
            }
        }
        Image { width, height, texels }
    }

    /// Puts the sky and its sun around a scene, in place of what there was.
    ///
    /// # Errors
    /// As [`Sky::sun`].
    pub fn surround(&self, description: &mut Description) -> Result<(), LightError> {
        let sun = self.sun()?;
        description.lights.retain(|light| !light.is_environment());
        description.lights.push(AnyLight::DistantDisk(sun));
        description.environments = [EnvironmentDescription::new(self.image(), Mat3::IDENTITY)].to_vec();
        Ok(())
    }
}

/// The distribution of luminance over the sky.
///
/// * `cos_theta` – of the angle from the zenith
/// * `gamma` – angle from the sun (rad)
///
/// Source: Perez, Seals, Michalsky 1993, *All-Weather Model for Sky Luminance Distribution*, Solar
/// Energy 50(3), equation 1.
fn perez([a, b, c, d, e]: [f64; 5], cos_theta: f64, gamma: f64) -> f64 {
    let cos_gamma = libm::cos(gamma);
    let horizon = 1.0 + a * libm::exp(b / cos_theta.max(1e-3));
    horizon * (1.0 + c * libm::exp(d * gamma) + e * cos_gamma * cos_gamma)
}

/// Linear sRGB of XYZ; what is outside of its gamut is cut off.
///
/// Source: IEC 61966-2-1:1999.
fn linear_srgb([x, y, z]: [f64; 3]) -> Rgb {
    let channel = |a: f64, b: f64, c: f64| ((a * x + b * y + c * z).max(0.0)) as f32;
    Rgb::new(
        channel(3.2406, -1.5372, -0.4986),
        channel(-0.9689, 1.8758, 0.0415),
        channel(0.0557, -0.2040, 1.0570),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    /// Irradiance of level ground from the sky alone (W m⁻²), in green.
    fn diffuse(sky: &Sky) -> f64 {
        let n = 200;
        let cell = |i: u32, j: u32| {
            let (z, phi) = ((f64::from(i) + 0.5) / f64::from(n), TAU * (f64::from(j) + 0.5) / f64::from(n));
            let (sin_phi, cos_phi) = libm::sincos(phi);
            let across = libm::sqrt(1.0 - z * z);
            z * f64::from(sky.radiance(DVec3::new(across * sin_phi, z, across * cos_phi)).g)
        };
        (0..n * n).map(|k| cell(k / n, k % n)).sum::<f64>() * TAU / f64::from(n * n)
    }

    #[test]
    fn noon_is_as_bright_as_measured_and_blue() {
        let sky = Sky::new(60.0, 120.0, Sky::CLEAR).unwrap();
        // Clear skies have 10 to 20 klx from the sky, and the model somewhat more; 80 to 110 from the sun.
        let klx = |w: f64| w / PER_KILOCANDELA;
        let (from_sky, from_sun) = (klx(diffuse(&sky)), klx(f64::from(sky.sun().unwrap().irradiance().g)));
        assert!((10.0..35.0).contains(&from_sky), "{from_sky}");
        assert!((75.0..115.0).contains(&from_sun), "{from_sun}");
        let Rgb { r, g, b } = sky.radiance(DVec3::new(0.0, 0.8, 0.6));
        assert!(b > 1.3 * g && g > r, "{r} {g} {b}");
    }

    #[test]
    fn a_low_sun_is_red_and_weak_and_every_sky_is_finite() {
        let at = |elevation| Sky::new(elevation, 0.0, 4.0).unwrap().sun().unwrap().irradiance();
        let (low, high) = (at(3.0), at(70.0));
        assert!(low.r > 3.0 * low.b && low.g < 0.4 * high.g, "{low:?} {high:?}");
        for elevation in [0.0, 1.0, 30.0, 90.0] {
            for turbidity in [2.0, 6.0, 10.0] {
                let sky = Sky::new(elevation, 77.0, turbidity).unwrap();
                let image = sky.image();
                assert!(image.texels.iter().all(|t| t.is_valid()), "{elevation} {turbidity}");
                let above = &image.texels[..512 * 129];
                assert!(above.iter().all(|t| t.luminance() > 0.0), "{elevation} {turbidity}");
                assert!(image.texels[512 * 129..].iter().all(|t| t.is_black()));
            }
        }
    }

    #[test]
    fn the_brightest_texel_is_next_to_the_sun() {
        let sky = Sky::new(40.0, 250.0, Sky::CLEAR).unwrap();
        let image = sky.image();
        let brightest = (0..image.texels.len())
            .max_by(|&a, &b| image.texels[a].luminance().total_cmp(&image.texels[b].luminance()));
        let index = brightest.unwrap() as u32;
        let (sin, cos) = libm::sincos(PI * f64::from(index / 512) / 256.0);
        let (sin_phi, cos_phi) = libm::sincos(TAU * (f64::from(index % 512) + 0.5) / 512.0);
        assert!(DVec3::new(sin * sin_phi, cos, -sin * cos_phi).dot(sky.toward_sun()) > 0.9999);
        assert!((sky.sun().unwrap().axis() - sky.toward_sun().as_vec3()).length() < 1e-6);
        assert!(sky.toward_sun().x < -0.7 && Vec3::Y.dot(sky.toward_sun().as_vec3()) > 0.6);
    }

    #[test]
    fn skies_out_of_range_are_refused() {
        assert_eq!(Sky::new(-1.0, 0.0, 3.0), Err(SkyError::Elevation(-1.0)));
        assert!(matches!(Sky::new(f64::NAN, 0.0, 3.0), Err(SkyError::Elevation(_))));
        assert!(matches!(Sky::new(10.0, f64::INFINITY, 3.0), Err(SkyError::Azimuth(_))));
        assert_eq!(Sky::new(10.0, 0.0, 1.0), Err(SkyError::Turbidity(1.0)));
    }
}
