//! Textures of a scene, owned; descriptions share them.

use super::BuildError;
use crate::Rgb;
use crate::bsdf::{AnyBsdf, Bsdf};
use crate::material::{AnyMaterial, Faces, ParameterTextures, Textured};
use crate::texture::{Pattern, Texels, Texture, TextureError};
use std::string::ToString;
use std::sync::Arc;
use std::vec::Vec;

/// Texels in the form in which they take least room, row by row from the top.
#[derive(Debug, Clone, PartialEq)]
pub enum TexelBuffer {
    /// sRGB codes.
    Srgb8(Vec<[u8; 3]>),
    /// Linear values, 0 to 1 in 255 steps.
    Linear8(Vec<[u8; 3]>),
    /// Linear values of any size.
    Float(Vec<Rgb>),
}

impl TexelBuffer {
    /// The texels, borrowed.
    #[must_use]
    pub fn texels(&self) -> Texels<'_> {
        match self {
            Self::Srgb8(codes) => Texels::Srgb8(codes),
            Self::Linear8(codes) => Texels::Linear8(codes),
            Self::Float(values) => Texels::Float(values),
        }
    }

    /// Their size (bytes).
    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Srgb8(codes) | Self::Linear8(codes) => size_of_val(&**codes),
            Self::Float(values) => size_of_val(&**values),
        }
    }
}

/// A texture, owned.
#[derive(Debug, Clone)]
pub struct TextureDescription {
    /// What is done with the coordinates.
    pub pattern: Pattern,
    /// The texels of a picture.
    pub texels: Option<Arc<TexelBuffer>>,
}

impl PartialEq for TextureDescription {
    /// Texels that are shared are not compared one by one.
    fn eq(&self, other: &Self) -> bool {
        let same = match (&self.texels, &other.texels) {
            (Some(a), Some(b)) => Arc::ptr_eq(a, b) || a == b,
            (a, b) => a.is_none() && b.is_none(),
        };
        same && self.pattern == other.pattern
    }
}

impl TextureDescription {
    /// The texture, borrowed.
    ///
    /// # Errors
    /// As [`Texture::new`].
    pub fn texture(&self) -> Result<Texture<'_>, TextureError> {
        Texture::new(self.pattern, self.texels.as_ref().map_or(Texels::NONE, |t| t.texels()))
    }
}

/// The textures of one side of a material; `None` leaves the value of the BSDF.
#[derive(Debug, Clone, PartialEq)]
pub struct MaterialTextures {
    /// Diffuse reflectance; of a [`crate::bsdf::MetallicRoughness`] the factor on its base colour.
    pub diffuse: Option<TextureDescription>,
    /// Specular reflectance.
    pub specular: Option<TextureDescription>,
    /// Roughness, as the luminance of the texture; of a [`crate::bsdf::MetallicRoughness`] the factor on
    /// its roughness, in green, and on its metalness, in blue.
    pub roughness: Option<TextureDescription>,
    /// What reflectances from textures are multiplied with.
    pub scale: f32,
}

impl Default for MaterialTextures {
    fn default() -> Self {
        Self { diffuse: None, specular: None, roughness: None, scale: 1.0 }
    }
}

impl MaterialTextures {
    /// True when there is none.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.diffuse.is_none() && self.specular.is_none() && self.roughness.is_none()
    }

    /// All of them.
    pub(super) fn iter(&self) -> impl Iterator<Item = &TextureDescription> {
        [&self.diffuse, &self.specular, &self.roughness].into_iter().flatten()
    }

    /// A BSDF with these textures.
    fn textured(&self, base: AnyBsdf) -> Result<Textured<'_, AnyBsdf>, TextureError> {
        let borrowed = TextureDescription::texture;
        let textures = ParameterTextures {
            diffuse: self.diffuse.as_ref().map(borrowed).transpose()?,
            specular: self.specular.as_ref().map(borrowed).transpose()?,
            roughness: self.roughness.as_ref().map(borrowed).transpose()?,
            scale: self.scale,
        };
        Textured::new(base, textures)
    }
}

impl super::Material {
    /// True when no texture is in it.
    #[must_use]
    pub fn is_plain(&self) -> bool {
        self.textures.iter().all(MaterialTextures::is_empty)
    }

    /// True when texture coordinates matter: for textures, or for tangents.
    #[must_use]
    pub fn needs_uvs(&self) -> bool {
        !self.is_plain() || self.bsdf.needs_tangent()
    }

    /// The material as the kernel knows it.
    pub(super) fn bound(&self) -> Result<AnyMaterial<'_>, BuildError> {
        if self.is_plain() {
            return Ok(AnyMaterial::Plain(self.bsdf));
        }
        let [front, back] = &self.textures;
        let faces = || {
            let of_front = front.textured(self.bsdf.front)?;
            Ok(match self.bsdf.back {
                None => Faces::Front(of_front),
                Some(b) if b == self.bsdf.front && back == front => Faces::Both(of_front),
                Some(b) => Faces::Each([of_front, back.textured(b)?]),
            })
        };
        faces().map(AnyMaterial::Textured).map_err(|source| {
            let material = if self.name.is_empty() { "a material".to_string() } else { self.name.clone() };
            BuildError::Texture { of: material, source }
        })
    }
}
