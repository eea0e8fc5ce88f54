//! From an owned description of a scene to the borrowed scene that the kernel renders (std).

mod description;

pub use description::{
    CameraDescription, Description, Emission, FovAxis, Geometry, IntegratorDescription, Material, Mesh,
    Object, ProjectionDescription,
};
