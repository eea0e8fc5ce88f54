//! halflight in the browser.
//!
//! A thin layer: what JavaScript says becomes a [`halflight::build::Description`] and choices, and what
//! the core answers becomes numbers in typed arrays. Pixels are those of the command line, bit for bit:
//! [`Scene::render`] does what `--spp` does, [`Scene::refine`] what `--error` does.
//!
//! ```js
//! import init, { Scene } from './halflight.js';
//! await init();
//! const scene = Scene.builtin('still-life');
//! scene.resize(480, 320);
//! const pixels = new Uint32Array(8 * 480 * 320); // see `Scene.render`
//! for (let n = 0; n < 16; n++) scene.render(0, 0, 480, 320, n, n + 1, pixels);
//! ```
//!
//! Reading files takes as much code as all the rest: the feature `files` adds it, and the page fetches
//! the module that has it when it is handed a file.
//!
//! One [`Scene`] belongs to one thread; several workers each have their own, and render parts of one
//! picture: a pixel does not depend on who renders it.

mod camera;
mod choices;
mod estimator;
mod facts;
#[cfg(feature = "files")]
mod files;
mod light;
mod lights;
mod probe;
mod progress;
mod refinement;
mod render;
mod rigid;
mod scene;

pub use camera::View;
pub use facts::{BuiltinScene, Facts};
#[cfg(feature = "files")]
pub use files::Files;
pub use light::Light;
pub use probe::{Probe, ProbedLight};
pub use progress::Progress;
pub use refinement::Refinement;
pub use scene::Scene;
