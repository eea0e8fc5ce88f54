//! Scenes from a program's constants, checked once.

use super::{Scene, SceneError, Tables};
use crate::bsdf::BsdfError;
use crate::bvh::{Bvh, BvhError, Node};
use crate::light::{Emitter, LightError};
use crate::material::Material;
use crate::shape::{Shape, ShapeError};
use core::fmt;

/// Why a scene in a program's constants was refused: which entry, and what is wrong with it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum BakedError {
    /// The tree does not fit the surfaces, or is none.
    Bvh(BvhError),
    /// The tables do not fit each other.
    Scene(SceneError),
    /// A surface's shape.
    Shape {
        /// Which surface.
        surface: usize,
        /// What its constructor would have said.
        source: ShapeError,
    },
    /// Shading normals that are not finite.
    Normals {
        /// Which entry.
        index: usize,
    },
    /// A light.
    Light {
        /// Which light.
        light: usize,
        /// What its constructor would have said.
        source: LightError,
    },
    /// A material.
    Material {
        /// Which material.
        material: usize,
        /// What its constructor would have said.
        source: BsdfError,
    },
}

impl fmt::Display for BakedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bvh(source) => write!(f, "{source}"),
            Self::Scene(source) => write!(f, "{source}"),
            Self::Shape { surface, source } => write!(f, "surface {surface}: {source}"),
            Self::Normals { index } => write!(f, "shading normals {index} are not finite numbers"),
            Self::Light { light, source } => write!(f, "light {light}: {source}"),
            Self::Material { material, source } => write!(f, "material {material}: {source}"),
        }
    }
}

impl core::error::Error for BakedError {}

impl<'a, S: Shape, L: Emitter, M: Material> Scene<'a, S, L, M> {
    /// Borrows a scene whose entries were made by constructors that check nothing (`baked`), as a program
    /// has them in its flash; `halflight export SCENE --as rust` writes such. Everything is checked here,
    /// once, in time linear in the scene.
    ///
    /// Not checked: that the boxes of the tree hold their primitives (what sticks out is not seen), that
    /// normals are unit vectors (they are made so where they are used), and texture coordinates (any will
    /// do). Nothing worse can follow from those: indices are checked, and the crate has no unsafe code.
    ///
    /// # Errors
    /// When an entry is not what the checking constructors accept, or the tree or the tables do not fit
    /// together.
    pub fn baked(nodes: &'a [Node], tables: Tables<'a, S, L, M>) -> Result<Self, BakedError> {
        Self::baked_with_stack(nodes, tables)
    }
}

impl<'a, S: Shape, L: Emitter, M: Material, const STACK: usize> Scene<'a, S, L, M, STACK> {
    /// [`Scene::baked`], with a traversal stack of `STACK` entries, as in [`Bvh`].
    ///
    /// # Errors
    /// As [`Scene::baked`], and when the tree needs more.
    pub fn baked_with_stack(nodes: &'a [Node], tables: Tables<'a, S, L, M>) -> Result<Self, BakedError> {
        let bvh = Bvh::with_stack(nodes, tables.surfaces.len()).map_err(BakedError::Bvh)?;
        let scene = Self::new(bvh, tables).map_err(BakedError::Scene)?;
        for (surface, entry) in tables.surfaces.iter().enumerate() {
            entry.shape.check().map_err(|source| BakedError::Shape { surface, source })?;
        }
        if let Some(index) = tables.normals.iter().position(|n| !n.0.iter().all(|n| n.is_finite())) {
            return Err(BakedError::Normals { index });
        }
        for (light, entry) in tables.lights.iter().enumerate() {
            entry.check().map_err(|source| BakedError::Light { light, source })?;
        }
        for (material, entry) in tables.materials.iter().enumerate() {
            entry.check_bsdfs().map_err(|source| BakedError::Material { material, source })?;
        }
        Ok(scene)
    }
}
