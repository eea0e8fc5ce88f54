//! The tables of a scene, bound to one another.

use super::{BuildError, SceneBuffers};
use crate::bvh::Bvh;
use crate::light::{AnyLight, Emitter, Portal, Portals};
use crate::material::AnyMaterial;
use crate::scene::{AnyScene, Scene, Tables};
use crate::shape::AnyShape;
use std::borrow::Cow;

/// What a scene borrows from: lights and materials that point to their pictures. Where nothing points to anything,
/// the buffers' own tables, uncopied.
#[derive(Debug, Clone)]
pub struct BoundScene<'a> {
    buffers: &'a SceneBuffers,
    lights: Cow<'a, [AnyLight<'a>]>,
    materials: Cow<'a, [AnyMaterial<'a>]>,
    bvh: Bvh<'a>,
}

/// Puts the lights that fill the sky behind the portals.
fn behind<'a>(light: AnyLight<'a>, portals: &'a [Portal]) -> AnyLight<'a> {
    match light {
        AnyLight::Constant(light) => AnyLight::ConstantPortals(Portals::new(light, portals)),
        AnyLight::EnvironmentMap(light) => AnyLight::EnvironmentPortals(Portals::new(light, portals)),
        other => other,
    }
}

impl<'a> BoundScene<'a> {
    /// Binds tables that nobody has checked yet.
    ///
    /// # Errors
    /// When they contradict one another.
    pub(super) fn checked(buffers: &'a SceneBuffers) -> Result<Self, BuildError> {
        let bound = Self::new(buffers, Bvh::new(&buffers.nodes, buffers.surfaces.len())?)?;
        Scene::new(bound.bvh, bound.tables())?;
        Ok(bound)
    }

    /// Binds tables that are known to fit: in a time that does not grow with the surfaces and the texels.
    pub(super) fn new(buffers: &'a SceneBuffers, bvh: Bvh<'a>) -> Result<Self, BuildError> {
        let mut lights: Cow<'a, [AnyLight<'a>]> = Cow::Borrowed(&buffers.lights);
        for painted in &buffers.painted {
            lights.to_mut()[painted.light] = painted.bound();
        }
        for environment in &buffers.environments {
            lights.to_mut().push(AnyLight::EnvironmentMap(environment.bound()));
        }
        if !buffers.portals.is_empty() && lights.iter().any(Emitter::is_environment) {
            lights.to_mut().iter_mut().for_each(|light| *light = behind(*light, &buffers.portals));
        }
        let mut materials: Cow<'a, [AnyMaterial<'a>]> = Cow::Borrowed(&buffers.materials);
        for (index, material) in &buffers.textured {
            materials.to_mut()[*index] = material.bound()?;
        }
        Ok(Self { buffers, lights, materials, bvh })
    }

    fn tables(&self) -> Tables<'_, AnyShape, AnyLight<'_>, AnyMaterial<'_>> {
        Tables {
            surfaces: &self.buffers.surfaces,
            normals: &self.buffers.normals,
            uvs: &self.buffers.uvs,
            object_spaces: &self.buffers.object_spaces,
            lights: &self.lights,
            materials: &self.materials,
        }
    }

    /// The scene, borrowed.
    ///
    /// # Panics
    /// Never: this very scene was made once when the buffers were.
    #[must_use]
    pub fn scene(&self) -> AnyScene<'_> {
        Scene::known_to_fit(self.bvh, self.tables()).expect("checked when the buffers were made")
    }
}
