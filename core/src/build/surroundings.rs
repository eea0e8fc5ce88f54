//! Pictures of the light from all around, owned, with the tables by which they are sampled.

use super::{BuildError, EnvironmentDescription, EnvironmentTables};
use crate::light::{EnvironmentMap, LightError};
use core::mem::size_of_val;
use std::string::ToString;
use std::sync::Arc;

/// What an environment map borrows from.
#[derive(Debug, Clone)]
pub(super) struct EnvironmentBuffer {
    description: EnvironmentDescription,
    tables: EnvironmentTables,
    /// The map without what it borrows: to check it takes a look at every texel.
    checked: EnvironmentMap<'static>,
}

fn refused(source: LightError) -> BuildError {
    BuildError::Light { object: "the environment map".to_string(), source }
}

impl EnvironmentBuffer {
    /// Makes the tables of an environment.
    ///
    /// # Errors
    /// When its picture, its transform or its scale is none.
    pub(super) fn new(description: &EnvironmentDescription) -> Result<Self, BuildError> {
        let EnvironmentDescription { image, to_world, scale, density } = description;
        let tables = EnvironmentTables::new(image, *density);
        let checked = EnvironmentMap::new(&image.texels, image.width, image.height, *to_world)
            .and_then(|map| tables.table().map_or(Ok(map), |table| map.with_table(table)))
            .and_then(|map| map.scaled(*scale))
            .map_err(refused)?
            .over(&[], None);
        Ok(Self { description: description.clone(), tables, checked })
    }

    /// The map, borrowed.
    pub(super) fn bound(&self) -> EnvironmentMap<'_> {
        self.checked.over(&self.description.image.texels, self.tables.table())
    }

    /// True when another description differs in its turn and its scale at most: the tables are right for both.
    pub(super) fn suits(&self, wanted: &EnvironmentDescription) -> bool {
        let EnvironmentDescription { image, density, .. } = &self.description;
        Arc::ptr_eq(&wanted.image, image) && wanted.density == *density
    }

    /// Turns and scales the map as a description wants it that it [suits](Self::suits).
    ///
    /// # Errors
    /// When the transform or the scale is none; then nothing changes.
    pub(super) fn follow(&mut self, wanted: &EnvironmentDescription) -> Result<(), BuildError> {
        let EnvironmentDescription { to_world, scale, .. } = self.description;
        let mut map = self.bound();
        if wanted.to_world != to_world {
            map = map.turned(wanted.to_world).map_err(refused)?;
        }
        if wanted.scale != scale {
            map = map.scaled(wanted.scale).map_err(refused)?;
        }
        self.checked = map.over(&[], None);
        (self.description.to_world, self.description.scale) = (wanted.to_world, wanted.scale);
        Ok(())
    }

    /// Bytes of its picture and its tables.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.description.image.texels) + self.tables.bytes()
    }
}
