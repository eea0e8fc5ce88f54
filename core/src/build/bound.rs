//! The tables of a scene, bound to one another.

use super::{BuildError, SceneBuffers};
use crate::bsdf::{AnyBsdf, TwoSided};
use crate::bvh::Bvh;
use crate::light::{AnyLight, EnvironmentMap};
use crate::scene::{AnyScene, Scene, Tables};
use crate::shape::AnyShape;
use std::borrow::Cow;
use std::string::ToString;

/// What a scene borrows from: lights that point to their pictures. Where nothing points to anything,
/// the buffers' own tables, uncopied.
#[derive(Debug, Clone)]
pub struct BoundScene<'a> {
    buffers: &'a SceneBuffers,
    lights: Cow<'a, [AnyLight<'a>]>,
    bvh: Bvh<'a>,
}

impl<'a> BoundScene<'a> {
    pub(super) fn new(buffers: &'a SceneBuffers) -> Result<Self, BuildError> {
        let mut lights: Cow<'a, [AnyLight<'a>]> = Cow::Borrowed(&buffers.lights);
        for environment in &buffers.environments {
            let image = &environment.image;
            let map = EnvironmentMap::new(&image.texels, image.width, image.height, environment.to_world)
                .map_err(|source| BuildError::Light { object: "the environment map".to_string(), source })?;
            lights.to_mut().push(AnyLight::EnvironmentMap(map));
        }
        let bound = Self { buffers, lights, bvh: Bvh::new(&buffers.nodes, buffers.surfaces.len())? };
        Scene::new(bound.bvh, bound.tables())?;
        Ok(bound)
    }

    fn tables(&self) -> Tables<'_, AnyShape, AnyLight<'_>, TwoSided<AnyBsdf>> {
        Tables {
            surfaces: &self.buffers.surfaces,
            normals: &self.buffers.normals,
            uvs: &[],
            lights: &self.lights,
            materials: &self.buffers.materials,
        }
    }

    /// The scene, borrowed.
    ///
    /// # Panics
    /// Never: this very scene was made once when the tables were bound.
    #[must_use]
    pub fn scene(&self) -> AnyScene<'_> {
        Scene::new(self.bvh, self.tables()).expect("checked when the tables were bound")
    }
}
