//! What scenes there are, and what one holds.

use wasm_bindgen::prelude::*;

/// A built-in scene.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug, Clone)]
pub struct BuiltinScene {
    /// What it is asked for by.
    #[wasm_bindgen(readonly)]
    pub name: String,
    /// What it shows, in one line.
    #[wasm_bindgen(readonly)]
    pub about: String,
}

/// What a scene holds.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug, Clone)]
pub struct Facts {
    /// Its name.
    #[wasm_bindgen(readonly)]
    pub name: String,
    /// Columns of its author's picture.
    #[wasm_bindgen(readonly)]
    pub width: u32,
    /// Rows of its author's picture.
    #[wasm_bindgen(readonly)]
    pub height: u32,
    /// Triangles.
    #[wasm_bindgen(readonly)]
    pub triangles: u32,
    /// Rectangles, disks, spheres and cylinders.
    #[wasm_bindgen(readonly)]
    pub analytic: u32,
    /// Lights, counting each emitting triangle.
    #[wasm_bindgen(readonly)]
    pub lights: u32,
    /// Environment maps among them.
    #[wasm_bindgen(readonly)]
    pub environments: u32,
    /// Bytes of all tables.
    #[wasm_bindgen(readonly)]
    pub bytes: u32,
    /// Radius of a sphere that holds it (m).
    #[wasm_bindgen(readonly)]
    pub radius: f32,
    /// What was read, but not as written.
    #[wasm_bindgen(readonly)]
    pub warnings: Vec<String>,
}
