//! Files that a page was given.

use crate::Scene;
use crate::lights::places;
use crate::rigid::Turn;
use crate::scene::{Res, thrown};
use halflight::build::{EnvironmentDescription, Image};
use halflight::glam::Mat3;
use halflight::light::{Emitter, EnvironmentMap};
use halflight::load::{Encoding, LoadOptions, Loaded, load_from, read_image_from};
use std::path::{Path, PathBuf};
use wasm_bindgen::prelude::*;

/// Files in memory, by path.
#[wasm_bindgen]
#[derive(Debug, Clone, Default)]
pub struct Files(Vec<(PathBuf, Vec<u8>)>);

#[wasm_bindgen]
impl Files {
    /// None yet.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new() -> Files {
        Self::default()
    }

    /// Adds one.
    pub fn add(&mut self, path: &str, bytes: Vec<u8>) {
        self.0.push((path.into(), bytes));
    }
}

impl Files {
    fn in_memory(&self) -> halflight::load::Files {
        halflight::load::Files::in_memory(self.0.iter().cloned())
    }

    /// Reads one of them as a scene.
    pub(crate) fn scene(&self, path: &str) -> Res<Loaded> {
        Ok(load_from(&self.in_memory(), Path::new(path), &LoadOptions::default())?)
    }

    /// Reads one of them as light from all around.
    pub(crate) fn sky(&self, path: &str) -> Res<EnvironmentDescription> {
        let image: Image = read_image_from(&self.in_memory(), Path::new(path), Encoding::Srgb)
            .map_err(|e| format!("{path}: {e}"))?;
        EnvironmentMap::new(&image.texels, image.width, image.height, Mat3::IDENTITY)
            .map_err(|e| format!("{path}: {e}"))?;
        Ok(EnvironmentDescription::new(image, Mat3::IDENTITY))
    }
}

#[wasm_bindgen]
impl Scene {
    /// A scene from files: Mitsuba 3 XML or glTF 2.0, with its meshes and pictures.
    ///
    /// * `path` – of the scene among the files
    ///
    /// # Errors
    /// When it cannot be read; the text says where and what would do instead.
    pub fn read(path: &str, files: &Files) -> Result<Scene, JsError> {
        files.scene(path).and_then(Self::loaded).map_err(thrown)
    }

    /// Puts a picture of the light from all around in place of the scene's own surroundings.
    ///
    /// * `path` – of a `.hdr` or `.exr` among the files, in longitude and latitude
    ///
    /// # Errors
    /// When it cannot be read.
    pub fn surround(&mut self, path: &str, files: &Files) -> Result<(), JsError> {
        self.put_sky(path, files).map_err(thrown)
    }
}

impl Scene {
    fn loaded(loaded: Loaded) -> Res<Self> {
        let mut warnings: Vec<_> = loaded.warnings.iter().map(ToString::to_string).collect();
        if loaded.description.integrator.path.is_some() {
            warnings
                .push("only direct light is rendered here; the command line has indirect light too".into());
        }
        Self::new(loaded.description, warnings)
    }

    fn put_sky(&mut self, path: &str, files: &Files) -> Res<()> {
        let sky = files.sky(path)?;
        self.description.lights.retain(|light| !light.is_environment());
        self.description.environments = vec![sky];
        self.turns = self.description.environments.iter().map(Turn::none).collect();
        self.places = places(&self.description);
        self.homes.clear();
        let density = self.choices.environment(&self.description);
        self.description.environments.iter_mut().for_each(|map| map.density = density);
        self.build()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_scene_in_memory_finds_its_mesh_and_says_what_is_missing() {
        let xml = br#"<scene version="3.0.0"><shape type="ply"><string name="filename" value="meshes/t.ply"/></shape>
            <emitter type="constant"/></scene>"#;
        let ply = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
            element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
        let mut files = Files::new();
        files.add("s.xml", xml.to_vec());
        let missing = files.scene("s.xml").unwrap_err().to_string();
        assert!(missing.contains("t.ply") && missing.contains("not among those"), "{missing}");
        files.add("t.ply", ply.to_vec());
        assert_eq!(files.scene("s.xml").unwrap().description.triangle_count(), 1);
        let broken = files.sky("t.ply").unwrap_err().to_string();
        assert!(broken.starts_with("t.ply: ") && broken.contains(".exr"), "{broken}");
    }
}
