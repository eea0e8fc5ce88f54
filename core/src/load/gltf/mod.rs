//! glTF 2.0: what artists export.
//!
//! Nodes, meshes, cameras, metallic-roughness materials with their textures, and the extensions
//! `KHR_lights_punctual`, `KHR_materials_emissive_strength`, `KHR_mesh_quantization`,
//! `KHR_texture_transform` and `EXT_lights_image_based`. Other extensions are left out with a warning, or refused by name when the file
//! requires them. Nothing in a file is taken at its word: ranges are checked, counts are held against the
//! bytes that there are, and a node is visited once.

mod accessor;
mod animation;
mod camera;
mod container;
mod cube;
mod document;
mod environment;
mod glow;
mod light;
mod log;
mod material;
mod mesh;
mod scene;
mod source;
mod texture;

use super::framing::{FILM, framing_camera};
pub(super) use animation::Moves;

use super::{CameraPath, Files, LoadError, LoadOptions, Loaded};
use crate::Rgb;
use crate::build::{Description, IntegratorDescription};
use crate::light::{AnyLight, Constant};
use container::item;
use log::Log;
use scene::Parts;
use source::Source;
use std::borrow::ToOwned;
use std::format;
use std::path::Path;
use std::vec::Vec;

/// Radiance of the even sky that a scene without light gets (W m⁻² sr⁻¹).
const SKY: f32 = 1.0;

/// Reads a scene and the files that it refers to.
pub(super) fn load(files: &Files, path: &Path, options: &LoadOptions) -> Result<Loaded, LoadError> {
    let bytes = files.read(path).map_err(|source| LoadError::Unreadable { path: path.to_owned(), source })?;
    let container = container::open(path, &bytes, options.lenient)?;
    drop(bytes);
    let mut log = Log::new(path);
    for name in &container.unread {
        log.warn(name, "this extension is not read; what it says is left out");
    }
    for (name, _) in &options.defines {
        log.note(format!("the parameter \"{name}\" is not used: glTF has none"));
    }
    let source = Source::new(files, path, container.document, container.binary)
        .map_err(|(index, problem)| item(path, &format!("buffers[{index}]"), problem))?;
    let parts = Parts::gather(&source, &mut log, options.lenient)?;
    if parts.objects.is_empty() && parts.environment.is_none() {
        return Err(LoadError::Empty { path: path.to_owned() });
    }
    let camera_path = match parts.camera_node {
        Some(node) => {
            let moves = animation::read(&source, &mut log, node);
            moves.map_err(|problem| item(path, "animations", problem))?.map(CameraPath::animated)
        }
        None => None,
    };
    let description = describe(parts, &mut log, path)?;
    Ok(Loaded { description, camera_path, warnings: log.into_warnings() })
}

/// Puts the parts together; a camera and a light where there is none.
fn describe(mut parts: Parts, log: &mut Log<'_>, path: &Path) -> Result<Description, LoadError> {
    let lit = !parts.lights.is_empty() || parts.environment.is_some();
    if !lit && parts.objects.iter().all(|object| object.emission.is_none()) {
        log.warn("nothing emits", "an even white sky lights the scene");
        let sky = Constant::new(Rgb::splat(SKY)).map_err(|e| item(path, "the sky", e.into()))?;
        parts.lights.push(AnyLight::Constant(sky));
    }
    let (camera, width, height) = match parts.camera {
        Some((camera, columns)) => (camera, columns, camera::ROWS),
        None => {
            log.warn("there is no camera", "one that sees the whole scene is used");
            let framing = framing_camera(&parts.objects).map_err(|e| item(path, "the camera", e.into()))?;
            (framing, FILM.width(), FILM.height())
        }
    };
    Ok(Description {
        name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
        camera,
        width,
        height,
        filter: FILM.filter(),
        integrator: IntegratorDescription::default(),
        samples_per_pixel: None,
        materials: parts.materials.list,
        objects: parts.objects,
        lights: parts.lights,
        environments: parts.environment.into_iter().collect(),
        portals: Vec::new(),
    })
}
