//! How well a picture is known.

use halflight::estimate::{Convergence, DifferenceSums};
use wasm_bindgen::prelude::*;

/// The record of a picture's passes, and the error that follows from it.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct Progress(Convergence);

#[wasm_bindgen]
impl Progress {
    /// Nothing rendered yet.
    #[wasm_bindgen(constructor)]
    #[must_use]
    pub fn new() -> Progress {
        Self::default()
    }

    /// Records a pass over the whole picture that brought its pixels to `samples` each.
    ///
    /// * `sum`, `values` – what [`crate::Scene::render`] returned, added up over the tiles
    pub fn record(&mut self, samples: u32, sum: f64, values: f64) {
        self.0.record(samples, &DifferenceSums::from_parts((sum, values as u64)));
    }

    /// Estimated relative error √relMSE, as a fraction; `undefined` before the second sample.
    #[must_use]
    pub fn error(&self) -> Option<f64> {
        self.0.estimate().relative_error()
    }
}
