//! Direct lighting from area and environment lights, to a known accuracy, anywhere.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(any(test, feature = "build"))]
extern crate std;

pub mod bsdf;
#[cfg(feature = "build")]
pub mod build;
pub mod bvh;
pub mod camera;
pub mod choose;
pub mod estimate;
pub mod film;
pub mod geom;
pub mod light;
pub mod measure;
pub mod num;
mod rgb;
pub mod scene;
pub mod sequence;
pub mod shape;
pub mod warp;

pub use camera::Camera;
pub use film::Film;
/// The vector types of the public interface.
pub use glam;
pub use rgb::Rgb;
pub use scene::Scene;
