//! Where the scene is looked at from.

use halflight::build::{CameraDescription, FovAxis, ProjectionDescription};
use halflight::camera::{self, CameraError};
use halflight::glam::Vec3;
use halflight::num;
use wasm_bindgen::prelude::*;

/// A camera as JavaScript sees it.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// The eye, or the middle of the orthographic window: x, y, z (m).
    #[wasm_bindgen(readonly)]
    pub origin: Vec<f32>,
    /// Unit vector to the right in the picture.
    #[wasm_bindgen(readonly)]
    pub right: Vec<f32>,
    /// Unit vector upward in the picture.
    #[wasm_bindgen(readonly)]
    pub up: Vec<f32>,
    /// Unit vector into the picture.
    #[wasm_bindgen(readonly)]
    pub forward: Vec<f32>,
    /// True for parallel rays.
    #[wasm_bindgen(readonly)]
    pub orthographic: bool,
    /// Half of the picture's width: at distance 1, or of the window (m) when orthographic.
    #[wasm_bindgen(readonly)]
    pub half_width: f32,
}

impl View {
    /// What a scene's author has chosen, in a picture of `width` × `height` pixels.
    pub(crate) fn new(description: &CameraDescription, width: u32, height: u32) -> Self {
        let camera::View { origin, right, up, forward } = description.view;
        let array = |v: Vec3| v.to_array().to_vec();
        let (orthographic, half_width) = match description.projection {
            ProjectionDescription::Perspective { fov, axis } => (false, half_width(fov, axis, width, height)),
            ProjectionDescription::Orthographic { half_width } => (true, half_width),
        };
        Self {
            origin: array(origin),
            right: array(right),
            up: array(up),
            forward: array(forward),
            orthographic,
            half_width,
        }
    }
}

/// Half of a perspective picture's width at distance 1.
fn half_width(fov: f32, axis: FovAxis, width: u32, height: u32) -> f32 {
    let aspect = width as f32 / height as f32;
    let tangent = num::tan(0.5 * fov.to_radians());
    match axis {
        FovAxis::X => tangent,
        FovAxis::Y => tangent * aspect,
        FovAxis::Diagonal => tangent * aspect / num::sqrt(1.0 + aspect * aspect),
        FovAxis::Smaller => tangent * aspect.max(1.0),
        FovAxis::Larger => tangent * aspect.min(1.0),
    }
}

/// The camera moved: from `origin` toward `target`, with `up` roughly upward. The projection stays.
///
/// # Errors
/// When the points coincide, or `up` is parallel to the line of sight.
pub(crate) fn look(
    camera: &CameraDescription,
    origin: Vec3,
    target: Vec3,
    up: Vec3,
) -> Result<CameraDescription, CameraError> {
    Ok(CameraDescription { view: camera::View::look_at(origin, target, up)?, ..*camera })
}

/// The camera with another extent of its picture.
///
/// * `half_width` – of the picture at distance 1, or of the window (m) when orthographic
pub(crate) fn zoomed(camera: &CameraDescription, half_width: f32) -> CameraDescription {
    let projection = match camera.projection {
        ProjectionDescription::Perspective { .. } => ProjectionDescription::Perspective {
            fov: 2.0 * num::atan2_in_double(f64::from(half_width), 1.0).to_degrees() as f32,
            axis: FovAxis::X,
        },
        ProjectionDescription::Orthographic { .. } => ProjectionDescription::Orthographic { half_width },
    };
    CameraDescription { projection, ..*camera }
}
