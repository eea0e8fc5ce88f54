//! Where texture coordinates come from.

use crate::scene::CornerUvs;
use crate::shape::Shape;
use glam::{Mat3, Vec2, Vec3};

/// The space of the unit shape that a shape in the world is an image of: shapes keep no turn about
/// their own axes, which only textures show.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "bytes", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(C)]
pub struct ObjectSpace {
    /// Image of the unit shape's origin, in the world (m).
    pub origin: Vec3,
    /// From differences of world points (m) to those of the unit shape.
    pub to_object: Mat3,
}

impl ObjectSpace {
    /// The point of the unit shape that a point of the world is the image of.
    #[inline]
    #[must_use]
    pub fn unit_point(&self, point: Vec3) -> Vec3 {
        self.to_object * (point - self.origin)
    }
}

/// The texture coordinates of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum SurfaceUvs {
    /// Those of the shape itself.
    #[default]
    Own,
    /// Those between the corners of a triangle.
    Corners(CornerUvs),
    /// Those of the unit shape.
    Object(ObjectSpace),
}

impl SurfaceUvs {
    /// Texture coordinates of a point of the surface (m).
    #[inline]
    #[must_use]
    pub fn at(&self, shape: &impl Shape, point: Vec3) -> Vec2 {
        match self {
            Self::Own => shape.uv(shape.unit_point(point)),
            Self::Corners(corners) => {
                let unit = shape.unit_point(point);
                corners.at(unit.x, unit.y)
            }
            Self::Object(space) => shape.uv(space.unit_point(point)),
        }
    }
}
