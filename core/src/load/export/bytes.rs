//! Writes a scene as bytes, for programs that read it from storage: see [`crate::stored`].

use super::rust::narrow::{light_expression, plain};
use super::{ExportError, write_whole};
use crate::build::{CameraDescription, Description, ProjectionDescription, SceneBuffers};
use crate::camera::{Camera, View};
use crate::film::{Film, Filter};
use crate::scene::AnyScene;
use crate::stored::{Head, MAGIC, StoredLight, StoredMaterial, StoredShape, VERSION, checksum};
use bytemuck::{Zeroable, cast_slice};
use std::io::Write as _;
use std::path::Path;
use std::string::ToString;
use std::vec::Vec;

/// The bytes of a scene, its camera and its film, built and checked. The same pictures come from them, to
/// the last bit; [`crate::stored::StoredScene`] borrows them.
///
/// # Errors
/// When the scene cannot be built, or holds what is not written: textures and pictures of surroundings.
pub fn scene_bytes(description: &Description) -> Result<Vec<u8>, ExportError> {
    let failed = |e: &dyn core::error::Error| ExportError::Scene { message: e.to_string() };
    let buffers = SceneBuffers::new(description).map_err(|e| failed(&e))?;
    let camera = description.camera.camera(description.width, description.height);
    let camera = camera.map_err(|e| failed(&e))?;
    let film = Film::new(description.width, description.height, description.filter);
    let film = film.map_err(|e| failed(&e))?;
    let bound = buffers.bind();
    let (counts, tables) = tables(&bound.scene())?;
    let mut head = Head { magic: MAGIC, version: VERSION, counts, ..view(&description.camera, &camera) };
    (head.size, (head.filter, head.filter_radius)) = ([film.width(), film.height()], filter(&film));
    let mut words: Vec<u32> = cast_slice(&[head]).to_vec();
    words.extend(tables);
    let length = u32::try_from(words.len() * 4).map_err(|_| ExportError::Scene {
        message: "the scene takes more than 4 GiB; leave triangles out".to_string(),
    })?;
    words[2] = length;
    words[3] = checksum(&words[4..]);
    let mut bytes: Vec<u8> = words.iter().flat_map(|word| word.to_le_bytes()).collect();
    // Bytes, not a word.
    bytes[..4].copy_from_slice(&MAGIC);
    Ok(bytes)
}

/// Writes the bytes of [`scene_bytes`] to a file, whole or not at all.
///
/// # Errors
/// As [`scene_bytes`], and when the file cannot be written.
pub fn export_bytes(description: &Description, path: &Path) -> Result<(), ExportError> {
    let bytes = scene_bytes(description)?;
    write_whole(path, |out| out.write_all(&bytes))
}

/// How many entries each table has, and their words.
fn tables(scene: &AnyScene<'_>) -> Result<([u32; 7], Vec<u32>), ExportError> {
    let tables = scene.tables();
    let mut words: Vec<u32> = cast_slice(scene.bvh().nodes()).to_vec();
    for surface in tables.surfaces {
        words.extend_from_slice(cast_slice(&[StoredShape::new(&surface.shape)]));
        words.extend([surface.material, surface.light, surface.normals, surface.uvs]);
    }
    words.extend_from_slice(cast_slice(tables.normals));
    words.extend_from_slice(cast_slice(tables.uvs));
    words.extend_from_slice(cast_slice(tables.object_spaces));
    for light in tables.lights {
        match StoredLight::new(light) {
            Some(light) => words.extend_from_slice(cast_slice(&[light])),
            // Which says why it is not written.
            None => drop(light_expression(light)?),
        }
    }
    for material in tables.materials {
        words.extend_from_slice(cast_slice(&[StoredMaterial::new(&plain(material)?)]));
    }
    let counts = [
        scene.bvh().nodes().len(),
        tables.surfaces.len(),
        tables.normals.len(),
        tables.uvs.len(),
        tables.object_spaces.len(),
        tables.lights.len(),
        tables.materials.len(),
    ];
    Ok((counts.map(|count| count as u32), words))
}

/// The camera, of which the description is another view.
fn view(description: &CameraDescription, camera: &Camera) -> Head {
    let View { origin, right, up, forward } = description.view;
    Head {
        projection: match description.projection {
            ProjectionDescription::Perspective { .. } => 0,
            ProjectionDescription::Orthographic { .. } => 1,
        },
        view: [origin, right, up, forward].map(|v| v.to_array()),
        half_extents: camera.half_extents().into(),
        clip: [description.near, description.far],
        ..Head::zeroed()
    }
}

fn filter(film: &Film) -> (u32, f32) {
    match film.filter() {
        Filter::Box { radius } => (0, radius),
        Filter::Tent { radius } => (1, radius),
        Filter::Gaussian { stddev } => (2, stddev),
    }
}
