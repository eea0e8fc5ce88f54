//! Why a scene could not be built.

use crate::bvh::BvhError;
use crate::choose::LightTreeError;
use crate::light::LightError;
use crate::scene::SceneError;
use crate::texture::TextureError;
use core::fmt;
use std::string::String;

/// Why a description could not be turned into a scene.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum BuildError {
    /// An object's emission was refused.
    Light {
        /// The object's name.
        object: String,
        /// Why.
        source: LightError,
    },
    /// An object names a material that does not exist.
    NoMaterial {
        /// The object's name.
        object: String,
        /// The index that it names.
        material: usize,
    },
    /// A mesh names a corner that does not exist, or has another number of normals or texture
    /// coordinates than of corners.
    Mesh {
        /// The object's name.
        object: String,
        /// The first triangle at fault.
        triangle: usize,
    },
    /// A texture was refused.
    Texture {
        /// The name of the material or the object that it is of.
        of: String,
        /// Why.
        source: TextureError,
    },
    /// The tree was refused.
    Bvh(BvhError),
    /// The tree of the lights was refused.
    LightTree(LightTreeError),
    /// The tables do not fit one another.
    Scene(SceneError),
}

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Light { object, source } => write!(f, "{object}: {source}"),
            Self::NoMaterial { object, material } => {
                write!(f, "{object} names material {material}, which the scene does not have")
            }
            Self::Mesh { object, triangle } => write!(
                f,
                "{object}: triangle {triangle} names a corner that the mesh does not have, or one without a normal or texture coordinates"
            ),
            Self::Texture { of, source } => write!(f, "{of}: {source}"),
            Self::Bvh(e) => write!(f, "the tree over the scene was refused: {e}"),
            Self::LightTree(e) => write!(f, "the tree over the lights was refused: {e}"),
            Self::Scene(e) => write!(f, "the scene was refused: {e}"),
        }
    }
}

impl core::error::Error for BuildError {}

impl From<BvhError> for BuildError {
    fn from(e: BvhError) -> Self {
        Self::Bvh(e)
    }
}

impl From<LightTreeError> for BuildError {
    fn from(e: LightTreeError) -> Self {
        Self::LightTree(e)
    }
}

impl From<SceneError> for BuildError {
    fn from(e: SceneError) -> Self {
        Self::Scene(e)
    }
}
