//! Cameras: from a place in the picture to a ray.

use crate::geom::{Ray, unit};
use core::fmt;
use glam::Vec3;

/// Where a camera is and how it is turned. Three unit vectors at right angles; mirrored pictures
/// have a left-handed `right`, so it is kept rather than derived.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// The eye, or the middle of the orthographic window (m).
    pub origin: Vec3,
    /// To the right in the picture.
    pub right: Vec3,
    /// Upward in the picture.
    pub up: Vec3,
    /// Into the picture.
    pub forward: Vec3,
}

impl View {
    /// Looks from `origin` to `target` with `up` roughly upward.
    ///
    /// # Errors
    /// When the points coincide, or `up` is parallel to the line of sight.
    pub fn look_at(origin: Vec3, target: Vec3, up: Vec3) -> Result<Self, CameraError> {
        let forward = unit(target - origin).ok_or(CameraError::Direction)?;
        let right = unit(forward.cross(up)).ok_or(CameraError::Direction)?;
        Ok(Self { origin, right, up: right.cross(forward), forward })
    }
}

/// Why a camera was refused.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum CameraError {
    /// The view has no direction: points coincide, or `up` is parallel to the line of sight.
    Direction,
    /// The extent of the picture is not a positive finite number.
    Extent(f32),
    /// The field of view (degrees) is not between 0 and 180.
    FieldOfView(f32),
    /// The clipping distances are not `0 ≤ near < far`.
    Clip {
        /// Near distance (m).
        near: f32,
        /// Far distance (m).
        far: f32,
    },
}

impl fmt::Display for CameraError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Direction => write!(
                f,
                "the camera has no direction: origin and target must differ, and up must not be parallel to the view"
            ),
            Self::Extent(v) => write!(f, "the extent of the picture is {v}; it must be positive and finite"),
            Self::FieldOfView(v) => {
                write!(f, "the field of view is {v}°; it must be above 0° and below 180°")
            }
            Self::Clip { near, far } => {
                write!(f, "the clipping distances are {near} and {far}; they must satisfy 0 ≤ near < far")
            }
        }
    }
}

impl core::error::Error for CameraError {}

/// How rays leave the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Projection {
    Perspective,
    Orthographic,
}

/// A camera without a lens: everything is sharp.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    view: View,
    projection: Projection,
    half_width: f32,
    half_height: f32,
    near: f32,
    far: f32,
}

impl Camera {
    /// Rays through one point.
    ///
    /// * `half_width`, `half_height` – of the picture at distance 1: tangents of half the fields of view
    ///
    /// # Errors
    /// When an extent is not positive and finite, or the view not finite.
    pub const fn perspective(view: View, half_width: f32, half_height: f32) -> Result<Self, CameraError> {
        Self::new(view, Projection::Perspective, half_width, half_height)
    }

    /// Parallel rays.
    ///
    /// * `half_width`, `half_height` – of the window (m)
    ///
    /// # Errors
    /// When an extent is not positive and finite, or the view not finite.
    pub const fn orthographic(view: View, half_width: f32, half_height: f32) -> Result<Self, CameraError> {
        Self::new(view, Projection::Orthographic, half_width, half_height)
    }

    const fn new(
        view: View,
        projection: Projection,
        half_width: f32,
        half_height: f32,
    ) -> Result<Self, CameraError> {
        if !(half_width > 0.0 && half_width < f32::INFINITY) {
            return Err(CameraError::Extent(half_width));
        }
        if !(half_height > 0.0 && half_height < f32::INFINITY) {
            return Err(CameraError::Extent(half_height));
        }
        let View { origin, right, up, forward } = view;
        if !(is_finite(origin) && is_finite(right) && is_finite(up) && is_finite(forward)) {
            return Err(CameraError::Direction);
        }
        Ok(Self { view, projection, half_width, half_height, near: 0.0, far: f32::INFINITY })
    }

    /// Shows only what lies between two distances along the line of sight (m).
    ///
    /// # Errors
    /// When they are not `0 ≤ near < far`.
    pub const fn with_clip(self, near: f32, far: f32) -> Result<Self, CameraError> {
        if near >= 0.0 && near < far && near.is_finite() {
            Ok(Self { near, far, ..self })
        } else {
            Err(CameraError::Clip { near, far })
        }
    }

    /// Half of the picture's width and height: at distance 1 where rays go through one point, else in
    /// the world (m).
    #[must_use]
    pub const fn half_extents(&self) -> (f32, f32) {
        (self.half_width, self.half_height)
    }

    /// The ray through a place in the picture, and how far it reaches.
    ///
    /// * `x` – from −1 at the left edge to 1 at the right, `y` – from −1 at the bottom to 1 at the top
    #[inline]
    #[must_use]
    pub fn ray(&self, x: f32, y: f32) -> (Ray, f32) {
        let View { origin, right, up, forward } = self.view;
        let across = right * (x * self.half_width) + up * (y * self.half_height);
        match self.projection {
            Projection::Perspective => {
                let v = forward + across;
                let length = v.length();
                (Ray::new(origin + v * self.near, v / length), (self.far - self.near) * length)
            }
            Projection::Orthographic => {
                (Ray::new(origin + across + forward * self.near, forward), self.far - self.near)
            }
        }
    }

    /// Where a point is in the picture, as [`Camera::ray`] takes it: the inverse. `None` for what is not
    /// in front; clipping is left to the ray.
    ///
    /// * `point` – in the world (m)
    #[must_use]
    pub fn place(&self, point: Vec3) -> Option<(f32, f32)> {
        let View { origin, right, up, forward } = self.view;
        let toward = point - origin;
        let depth = match self.projection {
            Projection::Perspective => toward.dot(forward),
            Projection::Orthographic => 1.0,
        };
        let (x, y) = (toward.dot(right) / depth, toward.dot(up) / depth);
        (depth > 0.0).then_some((x / self.half_width, y / self.half_height))
    }
}

/// [`Vec3::is_finite`], for constants.
const fn is_finite(v: Vec3) -> bool {
    let [x, y, z] = v.to_array();
    x.is_finite() && y.is_finite() && z.is_finite()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn view() -> View {
        View::look_at(Vec3::new(0.0, 0.0, 5.0), Vec3::ZERO, Vec3::Y).unwrap()
    }

    #[test]
    fn right_is_right_and_up_is_up() {
        let (ray, reach) = Camera::perspective(view(), 1.0, 0.5).unwrap().ray(1.0, 1.0);
        assert!((ray.at(1.5) - Vec3::new(1.0, 0.5, 4.0)).length() < 1e-6, "{ray:?}");
        assert_eq!(reach, f32::INFINITY);
        let (ray, _) = Camera::orthographic(view(), 2.0, 1.0).unwrap().ray(-1.0, 0.0);
        assert_eq!(ray, Ray::new(Vec3::new(-2.0, 0.0, 5.0), Vec3::NEG_Z));
    }

    #[test]
    fn a_point_of_a_ray_is_where_the_ray_is() {
        let view = View::look_at(Vec3::new(1.0, 2.0, 5.0), Vec3::ZERO, Vec3::Y).unwrap();
        let cameras = [Camera::perspective(view, 0.7, 0.5), Camera::orthographic(view, 2.0, 1.0)];
        for camera in cameras.map(Result::unwrap) {
            for (x, y) in [(0.0, 0.0), (-1.0, 0.5), (0.9, -0.9)] {
                let (ray, _) = camera.ray(x, y);
                let (found_x, found_y) = camera.place(ray.at(3.0)).unwrap();
                assert!((found_x - x).abs() < 1e-5 && (found_y - y).abs() < 1e-5, "{found_x} {found_y}");
            }
        }
        assert_eq!(Camera::perspective(view, 1.0, 1.0).unwrap().place(Vec3::new(2.0, 4.0, 10.0)), None);
    }

    #[test]
    fn clipping_is_along_the_line_of_sight() {
        let camera = Camera::perspective(view(), 1.0, 1.0).unwrap().with_clip(1.0, 3.0).unwrap();
        let (ray, reach) = camera.ray(1.0, 0.0);
        assert!((ray.origin.z - 4.0).abs() < 1e-6 && (ray.at(reach).z - 2.0).abs() < 1e-5);
    }

    #[test]
    fn impossible_cameras_are_refused() {
        assert_eq!(View::look_at(Vec3::ONE, Vec3::ONE, Vec3::Y), Err(CameraError::Direction));
        assert_eq!(View::look_at(Vec3::ZERO, Vec3::Y, Vec3::Y), Err(CameraError::Direction));
        assert!(Camera::perspective(view(), 0.0, 1.0).is_err());
        assert!(Camera::perspective(view(), f32::NAN, 1.0).is_err());
        assert!(Camera::perspective(view(), 1.0, 1.0).unwrap().with_clip(2.0, 1.0).is_err());
    }
}
