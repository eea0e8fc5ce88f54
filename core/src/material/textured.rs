//! A BSDF with parameters from textures.

use super::{Material, Parameters, Parametric};
use crate::Rgb;
use crate::bsdf::BsdfError;
use crate::texture::{Texture, TextureError};
use glam::Vec2;

/// The textures that give a BSDF its parameters; `None` leaves the BSDF's own value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ParameterTextures<'a> {
    /// Diffuse reflectance; of a [`crate::bsdf::MetallicRoughness`] the factor on its base colour.
    pub diffuse: Option<Texture<'a>>,
    /// Specular reflectance.
    pub specular: Option<Texture<'a>>,
    /// Roughness, as the luminance of the texture; of a [`crate::bsdf::MetallicRoughness`] the factor on
    /// its roughness, in green, and on its metalness, in blue.
    pub roughness: Option<Texture<'a>>,
    /// What reflectances from textures are multiplied with.
    pub scale: f32,
}

impl ParameterTextures<'_> {
    /// No texture.
    pub const NONE: Self = Self { diffuse: None, specular: None, roughness: None, scale: 1.0 };
}

/// A BSDF some of whose parameters come from textures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Textured<'a, B> {
    base: B,
    textures: ParameterTextures<'a>,
}

/// The most that is taken for 1: with the roundings of a lookup it stays below what BSDFs take for it.
const ONE: f32 = 1.0 + f32::EPSILON;

impl<'a, B: Parametric> Textured<'a, B> {
    /// A BSDF with textures for some of its parameters.
    ///
    /// # Errors
    /// When a texture is for a parameter that the BSDF does not have, or the reflectances exceed 1,
    /// alone or together.
    pub fn new(base: B, textures: ParameterTextures<'a>) -> Result<Self, TextureError> {
        let has = base.parameters();
        for (parameter, given, known) in [
            ("diffuse reflectance", textures.diffuse.is_some(), has.diffuse.is_some()),
            ("specular reflectance", textures.specular.is_some(), has.specular.is_some()),
            ("roughness", textures.roughness.is_some(), has.roughness.is_some()),
        ] {
            if given && !known {
                return Err(TextureError::NoParameter { parameter });
            }
        }
        let scale = textures.scale;
        let most = |texture: Option<Texture<'_>>, own: Option<Rgb>| {
            texture.map_or(own.unwrap_or(Rgb::BLACK), |t| t.largest() * scale)
        };
        let (diffuse, specular) =
            (most(textures.diffuse, has.diffuse), most(textures.specular, has.specular));
        for (parameter, largest) in [
            ("the diffuse reflectance", diffuse),
            ("the specular reflectance", specular),
            ("the sum of the reflectances", if base.adds_up() { diffuse + specular } else { diffuse }),
        ] {
            if !(largest.max_component() <= ONE) {
                return Err(TextureError::TooBright { parameter, largest });
            }
        }
        Ok(Self { base, textures })
    }

    /// The BSDF where no texture says otherwise.
    #[must_use]
    pub const fn base(&self) -> &B {
        &self.base
    }

    /// The textures.
    #[must_use]
    pub const fn textures(&self) -> &ParameterTextures<'a> {
        &self.textures
    }
}

impl<B: Parametric> Material for Textured<'_, B> {
    type Bsdf<'m>
        = B
    where
        Self: 'm;

    #[inline]
    fn at(&self, uv: impl FnOnce() -> Vec2) -> B {
        let (uv, textures) = (uv(), &self.textures);
        // A blend of texels may be a rounding above the largest of them.
        let reflectance = |texture: Texture<'_>| (texture.at(uv) * textures.scale).map(|c| c.min(1.0));
        self.base.with_parameters(&Parameters {
            diffuse: textures.diffuse.map(reflectance),
            specular: textures.specular.map(reflectance),
            roughness: textures.roughness.map(|t| t.at(uv)),
        })
    }

    fn check_bsdfs(&self) -> Result<(), BsdfError> {
        self.base.check()
    }
}
