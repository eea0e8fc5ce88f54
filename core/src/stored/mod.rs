//! Scenes as bytes: for programs that read them from storage and borrow what they have read.
//!
//! `halflight export SCENE --as bytes` writes the format, [`StoredScene::new`] borrows it after a check. Nodes,
//! surfaces, normals and texture coordinates stay where they are; lights and materials, of which there are
//! few, are taken out into room that the program has.
//!
//! ```no_run
//! use halflight::stored::{Aligned, NO_LIGHT, NO_MATERIAL, StoredError, StoredScene};
//!
//! // Or what was read from a card; a reader of storage aligns its buffer the same way.
//! static BYTES: Aligned<[u8; 4]> = Aligned(*b"HLSC");
//!
//! fn main() -> Result<(), StoredError> {
//!     let (mut lights, mut materials) = ([NO_LIGHT; 4], [NO_MATERIAL; 8]);
//!     let stored = StoredScene::new(&BYTES.0)?;
//!     let scene = stored.scene(&mut lights, &mut materials)?;
//!     let (camera, film) = (stored.camera()?, stored.film()?);
//! #   drop((scene, camera, film));
//!     Ok(())
//! }
//! ```
//!
//! # Format
//!
//! Little-endian, in words of four bytes; version 1. First a [`Head`] of 144 bytes, then without gaps the
//! tables: nodes ([`Node`], 112 bytes), surfaces ([`StoredShape`] of 40 bytes and four indices), shading
//! normals (36), texture coordinates of corners (24) and of unit shapes (48), lights ([`StoredLight`], 64)
//! and materials (two [`StoredBsdf`]). The first byte must be at an address that 16 divides.

mod bsdf;
mod error;
mod head;
mod light;
mod shape;

pub use bsdf::{StoredBsdf, StoredMaterial};
pub use error::StoredError;
pub use head::{Head, MAGIC, VERSION, checksum};
pub use light::StoredLight;
pub use shape::StoredShape;

use crate::bsdf::{AnyBsdf, Lambert, TwoSided};
use crate::bvh::Node;
use crate::light::{AnyLight, Constant};
use crate::scene::{CornerNormals, CornerUvs, Scene, Surface, Tables};
use crate::texture::ObjectSpace;
use crate::{Camera, Film, Rgb};
use bytemuck::AnyBitPattern;

/// Bytes at an address that nodes can have.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(16))]
pub struct Aligned<T>(pub T);

/// What fills the room for lights before they are there.
pub const NO_LIGHT: AnyLight<'static> = AnyLight::Constant(Constant::baked(Rgb::BLACK));

/// What fills the room for materials before they are there.
pub const NO_MATERIAL: TwoSided<AnyBsdf> = TwoSided::front_only(AnyBsdf::Lambert(Lambert::baked(Rgb::BLACK)));

/// The scene that is borrowed from bytes.
pub type BorrowedScene<'a> = Scene<'a, StoredShape, AnyLight<'static>, TwoSided<AnyBsdf>>;

/// A scene in bytes, of which the head, the checksum and the lengths of the tables have been checked.
#[derive(Debug, Clone, Copy)]
pub struct StoredScene<'a> {
    head: &'a Head,
    nodes: &'a [Node],
    surfaces: &'a [Surface<StoredShape>],
    normals: &'a [CornerNormals],
    uvs: &'a [CornerUvs],
    object_spaces: &'a [ObjectSpace],
    lights: &'a [StoredLight],
    materials: &'a [StoredMaterial],
}

impl<'a> StoredScene<'a> {
    /// Borrows a scene.
    ///
    /// # Errors
    /// When the bytes are no scene, were changed or cut, or are not at an address that 16 divides.
    pub fn new(bytes: &'a [u8]) -> Result<Self, StoredError> {
        let (head, mut rest) = head::split(bytes)?;
        let [nodes, surfaces, normals, uvs, object_spaces, lights, materials] = head.counts;
        let stored = Self {
            head,
            nodes: take(&mut rest, nodes)?,
            surfaces: take(&mut rest, surfaces)?,
            normals: take(&mut rest, normals)?,
            uvs: take(&mut rest, uvs)?,
            object_spaces: take(&mut rest, object_spaces)?,
            lights: take(&mut rest, lights)?,
            materials: take(&mut rest, materials)?,
        };
        if rest.is_empty() { Ok(stored) } else { Err(StoredError::Tables) }
    }

    /// How many lights and materials there are: the room that [`StoredScene::scene`] needs.
    #[must_use]
    pub const fn room(&self) -> (usize, usize) {
        (self.lights.len(), self.materials.len())
    }

    /// The scene, after the check of [`Scene::baked`]: do this once.
    ///
    /// * `lights`, `materials` – room for them, at least as much as [`StoredScene::room`] says
    ///
    /// # Errors
    /// When there is too little room, or an entry is none that halflight accepts.
    pub fn scene<'b>(
        &self,
        lights: &'b mut [AnyLight<'static>],
        materials: &'b mut [TwoSided<AnyBsdf>],
    ) -> Result<BorrowedScene<'b>, StoredError>
    where
        'a: 'b,
    {
        if let Some(index) = self.surfaces.iter().position(|s| !s.shape.is_known()) {
            return Err(StoredError::Kind { table: "surfaces", index });
        }
        let lights = fill("lights", self.lights, lights, StoredLight::light)?;
        let materials = fill("materials", self.materials, materials, StoredMaterial::material)?;
        let tables = Tables {
            surfaces: self.surfaces,
            normals: self.normals,
            uvs: self.uvs,
            object_spaces: self.object_spaces,
            lights,
            materials,
        };
        Scene::baked(self.nodes, tables).map_err(StoredError::Entry)
    }

    /// What looks at the scene.
    ///
    /// # Errors
    /// When it is no camera.
    pub fn camera(&self) -> Result<Camera, StoredError> {
        self.head.camera()
    }

    /// The picture's raster.
    ///
    /// # Errors
    /// When it is none.
    pub fn film(&self) -> Result<Film, StoredError> {
        self.head.film()
    }
}

/// Takes a table off the front.
fn take<'a, T: AnyBitPattern>(rest: &mut &'a [u8], count: u32) -> Result<&'a [T], StoredError> {
    let bytes = (count as usize).checked_mul(size_of::<T>()).ok_or(StoredError::Tables)?;
    let (table, after) = rest.split_at_checked(bytes).ok_or(StoredError::Tables)?;
    *rest = after;
    bytemuck::try_cast_slice(table).map_err(|_| StoredError::Misaligned)
}

/// Takes entries out into room for them.
fn fill<'b, R, T>(
    table: &'static str,
    records: &[R],
    room: &'b mut [T],
    read: impl Fn(&R) -> Option<T>,
) -> Result<&'b [T], StoredError> {
    let has = room.len();
    let room = room.get_mut(..records.len());
    let Some(room) = room else { return Err(StoredError::Room { table, needed: records.len(), has }) };
    for (index, (place, record)) in room.iter_mut().zip(records).enumerate() {
        *place = read(record).ok_or(StoredError::Kind { table, index })?;
    }
    Ok(room)
}
