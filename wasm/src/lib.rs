//! halflight in the browser.
//!
//! A thin layer: what JavaScript says becomes a [`halflight::build::Description`] and choices, and what
//! the core answers becomes numbers in typed arrays. Pixels are those of the command line, bit for bit.
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
//! One [`Scene`] belongs to one thread; several workers each have their own, and render parts of one
//! picture: a pixel does not depend on who renders it.

mod camera;
mod choices;
mod light;
mod probe;
mod render;
mod scene;

pub use camera::View;
pub use light::Light;
pub use probe::{Probe, ProbedLight};
pub use scene::{BuiltinScene, Facts, Progress, Scene};
