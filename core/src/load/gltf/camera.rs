//! Cameras.

use super::container::malformed;
use super::document::Camera;
use crate::build::{CameraDescription, FovAxis, ProjectionDescription};
use crate::camera::{CameraError, View};
use crate::load::Problem;
use glam::DMat4;

/// Rows of the picture; glTF says nothing of it but its proportions.
pub(super) const ROWS: u32 = 576;

/// A camera at a node, along whose negative z axis it looks, and the columns of its picture.
pub(super) fn place(camera: &Camera, to_world: &DMat4) -> Result<(CameraDescription, u32), Problem> {
    let view = view(to_world)?;
    let (projection, aspect, near, far) = match (&camera.perspective, &camera.orthographic) {
        (Some(p), _) => {
            let fov = p.yfov.to_degrees();
            let projection = ProjectionDescription::Perspective { fov, axis: FovAxis::Y };
            (projection, p.aspect_ratio.unwrap_or(4.0 / 3.0), p.znear, p.zfar.unwrap_or(f32::INFINITY))
        }
        (None, Some(o)) => {
            let projection = ProjectionDescription::Orthographic { half_width: o.xmag };
            (projection, o.xmag / o.ymag, o.znear, o.zfar)
        }
        (None, None) => return Err(malformed("it is neither perspective nor orthographic")),
    };
    if !(aspect > 0.0 && aspect.is_finite()) {
        return Err(malformed("the proportions of its picture are not positive"));
    }
    // Beyond these proportions the picture is cut off at the sides.
    let columns = (aspect * ROWS as f32).round().clamp(1.0, 16384.0) as u32;
    let description = CameraDescription { view, projection, near, far };
    description.camera(columns, ROWS)?;
    Ok((description, columns))
}

/// Place and directions; scales are no matter.
fn view(m: &DMat4) -> Result<View, Problem> {
    let [up, back, origin] = [m.y_axis, m.z_axis, m.w_axis].map(|axis| axis.truncate());
    let forward = (-back).try_normalize();
    let right = forward.and_then(|forward| forward.cross(up).try_normalize());
    let (Some(forward), Some(right)) = (forward, right) else { return Err(CameraError::Direction.into()) };
    let up = right.cross(forward);
    let [origin, right, up, forward] = [origin, right, up, forward].map(|v| v.as_vec3());
    Ok(View { origin, right, up, forward })
}
