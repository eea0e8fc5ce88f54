//! What scenes there are, and what one holds.

use wasm_bindgen::prelude::*;

/// A built-in scene.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug, Clone)]
pub struct BuiltinScene {
    /// What it is asked for by.
    pub name: String,
    /// What it shows, in one line.
    pub about: String,
}

/// What a scene holds.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug, Clone)]
pub struct Facts {
    /// Its name.
    pub name: String,
    /// Columns of its author's picture.
    pub width: u32,
    /// Rows of its author's picture.
    pub height: u32,
    /// Triangles.
    pub triangles: u32,
    /// Rectangles, disks, spheres and cylinders.
    pub analytic: u32,
    /// Lights, counting each emitting triangle.
    pub lights: u32,
    /// Environment maps among them.
    pub environments: u32,
    /// Bytes of all tables.
    pub bytes: u32,
    /// Radius of a sphere that holds it (m).
    pub radius: f32,
    /// What was read, but not as written.
    pub warnings: Vec<String>,
}
