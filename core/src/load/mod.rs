//! Reads and writes scenes (std).
//!
//! Scenes are Mitsuba 3 XML with PLY, OBJ and serialized meshes, or glTF 2.0: the part of them that halflight
//! renders. What is outside of that part is an error that says where it is and what is supported, or, when
//! asked for, a warning.

pub mod builtin;
mod error;
mod export;
mod files;
mod framing;
mod gltf;
mod image;
mod mesh;
mod mesh_error;
mod mitsuba;
mod obj;
mod path;
mod ply;
mod serialized;
mod suggest;

pub use error::{LoadError, Position, Problem, Warning};
pub use export::{ExportError, export_bytes, export_mitsuba, export_rust, rust_source, scene_bytes};
pub use files::Files;
pub use image::{
    Encoding, ImageError, MAX_TEXELS, read_image, read_image_from, read_texels, srgb_to_linear, write_exr,
};
pub use mesh_error::MeshError;
pub use path::CameraPath;

use crate::build::Description;
use std::path::Path;
use std::string::String;
use std::vec::Vec;

/// How a scene is read.
#[derive(Debug, Clone, Default)]
pub struct LoadOptions {
    /// Parameters, name and value, that replace the file's `<default>`s.
    pub defines: Vec<(String, String)>,
    /// Leaves out what is not supported, with a warning, instead of refusing the scene.
    pub lenient: bool,
}

/// A scene that was read.
#[derive(Debug, Clone)]
pub struct Loaded {
    /// The scene.
    pub description: Description,
    /// The way of a camera that moves: through the sensors of a Mitsuba scene, or by glTF's animation.
    pub camera_path: Option<CameraPath>,
    /// What was read, but not as written.
    pub warnings: Vec<Warning>,
}

/// Reads a scene; its format follows from the file's extension.
///
/// # Errors
/// When the file or one that it refers to cannot be read, is malformed, or asks for what is not
/// supported.
pub fn load(path: &Path, options: &LoadOptions) -> Result<Loaded, LoadError> {
    load_from(&Files::on_disk(), path, options)
}

/// Reads a scene as [`load`] does, from files wherever they are.
///
/// # Errors
/// As [`load`].
pub fn load_from(files: &Files, path: &Path, options: &LoadOptions) -> Result<Loaded, LoadError> {
    match path.extension() {
        Some(extension) if extension.eq_ignore_ascii_case("xml") => mitsuba::load(files, path, options),
        Some(extension) if ["gltf", "glb"].iter().any(|known| extension.eq_ignore_ascii_case(known)) => {
            gltf::load(files, path, options)
        }
        _ => Err(LoadError::Format { path: path.into() }),
    }
}
