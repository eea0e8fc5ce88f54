//! Mitsuba 3 XML: the elements that halflight renders.

mod bsdf;
mod context;
mod cube;
mod document;
mod element;
mod emitter;
mod fit;
mod integrator;
mod ior;
mod material;
mod properties;
mod scene;
mod sensor;
mod shape;
mod texture;
mod transform;
mod value;

pub(super) use document::MAX_INCLUDE_DEPTH;

use super::{Files, LoadError, LoadOptions, Loaded};
use context::Context;
use document::Document;
use std::path::Path;

/// Reads a scene and the files that it refers to.
pub(super) fn load(files: &Files, path: &Path, options: &LoadOptions) -> Result<Loaded, LoadError> {
    let document = Document::read(files, path, options)?;
    let mut context = Context::new(&document, options.lenient)?;
    let (description, camera_path) = scene::read(&mut context, path)?;
    let mut warnings = context.into_warnings();
    warnings.extend(document.unused_defines());
    Ok(Loaded { description, camera_path, warnings })
}
