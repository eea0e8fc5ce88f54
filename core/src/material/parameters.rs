//! Parameters of BSDFs that may differ from place to place.

use crate::Rgb;
use crate::bsdf::{AnyBsdf, Bsdf, GgxConductor, Lambert, MetallicRoughness, Phong, RoughPlastic};
use crate::num;

/// What textures say about a place; `None` leaves the BSDF's own value.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Parameters {
    /// Diffuse reflectance, each channel in `[0, 1]`; of a [`MetallicRoughness`] the factor on its base
    /// colour.
    pub diffuse: Option<Rgb>,
    /// Specular reflectance, each channel in `[0, 1]`.
    pub specular: Option<Rgb>,
    /// Roughness `α` as a luminance; of a [`MetallicRoughness`] the factors on its roughness, in green, and
    /// on its metalness, in blue.
    pub roughness: Option<Rgb>,
}

/// A BSDF whose parameters can be given place by place.
pub trait Parametric: Bsdf {
    /// The BSDF with other parameters. A roughness is brought into the range of the model; the BSDF
    /// stays as it is where it has no such parameter, or not for these values.
    #[must_use]
    fn with_parameters(&self, parameters: &Parameters) -> Self;

    /// Its parameters; `None` for one that it does not have.
    fn parameters(&self) -> Parameters;

    /// True when its two reflectances must not exceed 1 together.
    fn adds_up(&self) -> bool {
        false
    }
}

impl Parametric for Lambert {
    #[inline]
    fn with_parameters(&self, parameters: &Parameters) -> Self {
        Self::new(parameters.diffuse.unwrap_or(self.reflectance())).unwrap_or(*self)
    }

    fn parameters(&self) -> Parameters {
        Parameters { diffuse: Some(self.reflectance()), ..Parameters::default() }
    }
}

impl Parametric for Phong {
    #[inline]
    fn with_parameters(&self, parameters: &Parameters) -> Self {
        let diffuse = parameters.diffuse.unwrap_or(self.diffuse());
        let specular = parameters.specular.unwrap_or(self.specular());
        Self::new(diffuse, specular, self.exponent()).unwrap_or(*self)
    }

    fn parameters(&self) -> Parameters {
        Parameters { diffuse: Some(self.diffuse()), specular: Some(self.specular()), roughness: None }
    }

    fn adds_up(&self) -> bool {
        true
    }
}

impl Parametric for GgxConductor {
    #[inline]
    fn with_parameters(&self, parameters: &Parameters) -> Self {
        let alpha = parameters.roughness.map(|a| [num::clamp(a.luminance(), Self::MIN_ALPHA, 1.0); 2]);
        self.with_reflectance(parameters.specular.unwrap_or(self.reflectance()))
            .and_then(|bsdf| bsdf.with_alpha(alpha.unwrap_or(self.alpha())))
            .unwrap_or(*self)
    }

    fn parameters(&self) -> Parameters {
        let roughness = Some(Rgb::splat(self.alpha()[0]));
        Parameters { diffuse: None, specular: Some(self.reflectance()), roughness }
    }
}

impl Parametric for RoughPlastic {
    #[inline]
    fn with_parameters(&self, parameters: &Parameters) -> Self {
        self.with_diffuse(parameters.diffuse.unwrap_or(self.diffuse()))
            .and_then(|bsdf| bsdf.with_specular(parameters.specular.unwrap_or(self.specular())))
            .unwrap_or(*self)
    }

    fn parameters(&self) -> Parameters {
        Parameters { diffuse: Some(self.diffuse()), specular: Some(self.specular()), roughness: None }
    }
}

impl Parametric for MetallicRoughness {
    #[inline]
    fn with_parameters(&self, parameters: &Parameters) -> Self {
        let base_color = self.base_color() * parameters.diffuse.unwrap_or(Rgb::WHITE);
        let Rgb { g, b, .. } = parameters.roughness.unwrap_or(Rgb::WHITE);
        let share = |own: f32, factor: f32| num::clamp(own * factor, 0.0, 1.0);
        Self::new(base_color, share(self.metallic(), b), share(self.roughness(), g)).unwrap_or(*self)
    }

    /// Factors of 1.
    fn parameters(&self) -> Parameters {
        Parameters { diffuse: Some(Rgb::WHITE), specular: None, roughness: Some(Rgb::WHITE) }
    }
}

impl Parametric for AnyBsdf {
    #[inline]
    fn with_parameters(&self, parameters: &Parameters) -> Self {
        match self {
            Self::Lambert(b) => Self::Lambert(b.with_parameters(parameters)),
            Self::Phong(b) => Self::Phong(b.with_parameters(parameters)),
            Self::GgxConductor(b) => Self::GgxConductor(b.with_parameters(parameters)),
            Self::RoughPlastic(b) => Self::RoughPlastic(b.with_parameters(parameters)),
            Self::MetallicRoughness(b) => Self::MetallicRoughness(b.with_parameters(parameters)),
        }
    }

    fn parameters(&self) -> Parameters {
        match self {
            Self::Lambert(b) => b.parameters(),
            Self::Phong(b) => b.parameters(),
            Self::GgxConductor(b) => b.parameters(),
            Self::RoughPlastic(b) => b.parameters(),
            Self::MetallicRoughness(b) => b.parameters(),
        }
    }

    fn adds_up(&self) -> bool {
        matches!(self, Self::Phong(_))
    }
}
