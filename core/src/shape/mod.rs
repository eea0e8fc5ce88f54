//! Shapes that rays meet: one file each, with its geometry, intersection and area.
//!
//! How a shape is sampled as a light is in [`crate::light`].

mod cylinder;
mod disk;
mod error;
mod planar;
mod polygon;
mod rectangle;
mod sphere;
mod triangle;

pub use cylinder::Cylinder;
pub use disk::Disk;
pub use error::ShapeError;
pub use polygon::Polygon;
pub use rectangle::Rectangle;
pub use sphere::Sphere;
pub use triangle::Triangle;

use crate::geom::{Aabb, PreparedRay, Ray};
use crate::num;
use glam::{Vec2, Vec3};

/// Where a ray meets a shape, in the shape's own coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeHit {
    /// Ray parameter, above 0.
    pub t: f32,
    /// First surface coordinate: barycentric `b1` of a triangle, first axis of a flat shape.
    pub u: f32,
    /// Second surface coordinate.
    pub v: f32,
}

/// A point on a surface with a bound on how far off it may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfacePoint {
    /// The point (m).
    pub point: Vec3,
    /// Bound on its absolute error, per axis (m).
    pub error: Vec3,
    /// Geometric unit normal on the front side.
    pub normal: Vec3,
}

/// A surface that rays can meet.
pub trait Shape: Copy {
    /// The smallest box around the shape, or one slightly larger; never smaller.
    fn bounds(&self) -> Aabb;

    /// Surface area of the side that the normal points to (m²).
    fn area(&self) -> f32;

    /// The nearest intersection with `0 < t < t_max`. A ray that starts on the shape, moved off by
    /// [`crate::geom::offset_origin`], does not meet it again there.
    fn intersect(&self, ray: &PreparedRay, t_max: f32) -> Option<ShapeHit>;

    /// True when the shape hides a point of its own surface from the ray's origin.
    ///
    /// * `reach` – distance to the point along the ray, or slightly less (m)
    ///
    /// A shadow ray to a light asks the light's own surface this instead of [`Shape::intersect`],
    /// whose rounding is more than any fixed slack where the ray grazes the surface or is about to
    /// touch it.
    #[inline]
    fn hides_itself(&self, ray: &PreparedRay, reach: f32) -> bool {
        self.intersect(ray, reach).is_some()
    }

    /// True for a part of a plane without holes or dents: what is between four of its points belongs to it.
    fn is_flat(&self) -> bool {
        false
    }

    /// The corners of a flat shape that has three or four, in order; of three, the last comes twice.
    fn outline(&self) -> Option<[Vec3; 4]> {
        None
    }

    /// The largest `direction · (x − origin)` of its points `x`, or more: the support function of its hull.
    ///
    /// * `direction` – of any length
    fn support(&self, origin: Vec3, direction: Vec3) -> f32 {
        let Aabb { min, max } = self.bounds();
        ((min - origin) * direction).max((max - origin) * direction).element_sum()
    }

    /// The surface point of a hit that [`Shape::intersect`] has found.
    fn surface_point(&self, ray: &Ray, hit: &ShapeHit) -> SurfacePoint;

    /// The point of the unit shape that a surface point is the image of, as far as the shape itself
    /// knows: [`crate::texture::ObjectSpace`] knows more.
    fn unit_point(&self, point: Vec3) -> Vec3;

    /// Texture coordinates of a point of the unit shape; those of Mitsuba 3.
    fn uv(&self, unit: Vec3) -> Vec2;

    /// Direction on the unit shape in which the first of them grows, of any length.
    fn unit_tangent(&self, unit: Vec3) -> Vec3 {
        let _ = unit;
        Vec3::X
    }

    /// Directions in which the shape's own two texture coordinates grow at a point of it, as in Mitsuba
    /// 3; of any length and either sign, but for a triangle, which gives its edges. Zero where there are
    /// none.
    fn tangents(&self, point: Vec3) -> [Vec3; 2];

    /// Checks a shape that was made without checks, as those in a program's constants are.
    ///
    /// # Errors
    /// What the checking constructor says. A shape without another constructor has nothing to check.
    fn check(&self) -> Result<(), ShapeError> {
        Ok(())
    }
}

/// Angle of a point about the third axis, in turns from the first, in `[0, 1]`.
#[inline]
fn turn(unit: Vec3) -> f32 {
    let turns = num::atan2(unit.y, unit.x) * (0.5 * num::FRAC_1_PI);
    if turns < 0.0 { turns + 1.0 } else { turns }
}

/// Any of the shapes: what a frontend that reads arbitrary scenes uses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AnyShape {
    /// A triangle.
    Triangle(Triangle),
    /// A rectangle.
    Rectangle(Rectangle),
    /// A disk or ellipse.
    Disk(Disk),
    /// A sphere.
    Sphere(Sphere),
    /// An open cylinder.
    Cylinder(Cylinder),
}

/// The only list of variants; every method goes through it.
macro_rules! each_shape {
    ($shape:expr, $inner:ident => $body:expr) => {
        match $shape {
            AnyShape::Triangle($inner) => $body,
            AnyShape::Rectangle($inner) => $body,
            AnyShape::Disk($inner) => $body,
            AnyShape::Sphere($inner) => $body,
            AnyShape::Cylinder($inner) => $body,
        }
    };
}

impl AnyShape {
    #[inline(never)]
    fn intersect_out_of_line(&self, ray: &PreparedRay, t_max: f32) -> Option<ShapeHit> {
        each_shape!(self, s => s.intersect(ray, t_max))
    }
}

impl Shape for AnyShape {
    #[inline]
    fn bounds(&self) -> Aabb {
        each_shape!(self, s => s.bounds())
    }

    #[inline]
    fn area(&self) -> f32 {
        each_shape!(self, s => s.area())
    }

    // Most of what rays are tested against are triangles: they are tested in line.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn intersect(&self, ray: &PreparedRay, t_max: f32) -> Option<ShapeHit> {
        match self {
            Self::Triangle(triangle) => triangle.intersect(ray, t_max),
            other => other.intersect_out_of_line(ray, t_max),
        }
    }

    #[inline]
    fn hides_itself(&self, ray: &PreparedRay, reach: f32) -> bool {
        each_shape!(self, s => s.hides_itself(ray, reach))
    }

    fn is_flat(&self) -> bool {
        each_shape!(self, s => s.is_flat())
    }

    fn outline(&self) -> Option<[Vec3; 4]> {
        each_shape!(self, s => s.outline())
    }

    fn support(&self, origin: Vec3, direction: Vec3) -> f32 {
        each_shape!(self, s => s.support(origin, direction))
    }

    #[inline]
    fn surface_point(&self, ray: &Ray, hit: &ShapeHit) -> SurfacePoint {
        each_shape!(self, s => s.surface_point(ray, hit))
    }

    fn unit_point(&self, point: Vec3) -> Vec3 {
        each_shape!(self, s => s.unit_point(point))
    }

    fn uv(&self, unit: Vec3) -> Vec2 {
        each_shape!(self, s => s.uv(unit))
    }

    fn unit_tangent(&self, unit: Vec3) -> Vec3 {
        each_shape!(self, s => s.unit_tangent(unit))
    }

    fn tangents(&self, point: Vec3) -> [Vec3; 2] {
        each_shape!(self, s => s.tangents(point))
    }

    fn check(&self) -> Result<(), ShapeError> {
        each_shape!(self, s => s.check())
    }
}
