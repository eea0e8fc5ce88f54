//! From an owned description of a scene to the borrowed scene that the kernel renders (std).

mod auto;
mod bound;
mod buffers;
mod description;
mod environment;
mod error;
mod light_tree;
mod painted;
mod parts;
mod primitives;
mod relight;
mod sky;
mod surroundings;
mod texture;
mod tree;

pub use auto::FEW_LIGHTS;
pub use bound::BoundScene;
pub use buffers::{SceneBuffers, SceneStats};
pub use description::{
    CameraDescription, Description, Emission, EnvironmentDescription, FovAxis, Geometry, Image,
    IntegratorDescription, Material, Mesh, Object, PathDescription, ProjectionDescription,
};
pub use environment::EnvironmentTables;
pub use error::BuildError;
pub use light_tree::LightTreeBuffers;
pub use sky::{Sky, SkyError};
pub use texture::{MaterialTextures, TexelBuffer, TextureDescription};
pub use tree::{Tree, build_tree};
