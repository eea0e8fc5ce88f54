//! Shapes as numbers.

use crate::geom::{Aabb, PreparedRay, Ray};
use crate::shape::{
    AnyShape, Cylinder, Disk, Rectangle, Shape, ShapeError, ShapeHit, Sphere, SurfacePoint, Triangle,
};
use bytemuck::{Pod, Zeroable};
use glam::{Vec2, Vec3};

/// Any of the shapes, as ten words; it is made a shape again for each use.
///
/// | kind | shape | numbers |
/// |---|---|---|
/// | 0 | triangle | three corners |
/// | 1 | rectangle | centre, two half-edges |
/// | 2 | disk | centre, two semi-axes |
/// | 3 | sphere | centre, radius, 1 when its normals point inward |
/// | 4 | cylinder | base, axis, radius, 1 when its normals point inward |
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct StoredShape {
    kind: u32,
    numbers: [f32; 9],
}

/// Vectors and numbers, one after the other.
fn numbers(vectors: &[Vec3], rest: &[f32]) -> [f32; 9] {
    let mut all = [0.0; 9];
    let given = vectors.iter().flat_map(|v| v.to_array()).chain(rest.iter().copied());
    all.iter_mut().zip(given).for_each(|(place, number)| *place = number);
    all
}

impl StoredShape {
    /// The numbers of a shape.
    #[must_use]
    pub fn new(shape: &AnyShape) -> Self {
        let flag = |inward: bool| f32::from(u8::from(inward));
        let (kind, numbers) = match shape {
            AnyShape::Triangle(t) => (0, numbers(&t.corners(), &[])),
            AnyShape::Rectangle(r) => (1, numbers(&[r.centre(), r.half_u(), r.half_v()], &[])),
            AnyShape::Disk(d) => (2, numbers(&[d.centre(), d.axis_u(), d.axis_v()], &[])),
            AnyShape::Sphere(s) => (3, numbers(&[s.centre()], &[s.radius(), flag(s.is_inward())])),
            AnyShape::Cylinder(c) => (4, numbers(&[c.base(), c.axis()], &[c.radius(), flag(c.is_inward())])),
        };
        Self { kind, numbers }
    }

    /// The words that follow the kind, for a light that has the shape.
    pub(super) const fn from_parts(kind: u32, numbers: [f32; 9]) -> Self {
        Self { kind, numbers }
    }

    pub(super) const fn parts(&self) -> (u32, [f32; 9]) {
        (self.kind, self.numbers)
    }

    /// True for the kinds that there are; others are taken for cylinders.
    #[must_use]
    pub const fn is_known(&self) -> bool {
        self.kind <= 4
    }

    /// The shape, unchecked.
    #[inline]
    #[must_use]
    pub fn shape(&self) -> AnyShape {
        let [ax, ay, az, bx, by, bz, cx, cy, cz] = self.numbers;
        let (a, b, c) = (Vec3::new(ax, ay, az), Vec3::new(bx, by, bz), Vec3::new(cx, cy, cz));
        match self.kind {
            0 => AnyShape::Triangle(Triangle::baked([a, b, c])),
            1 => AnyShape::Rectangle(Rectangle::baked(a, b, c)),
            2 => AnyShape::Disk(Disk::baked(a, b, c)),
            3 => {
                let sphere = Sphere::baked(a, bx);
                AnyShape::Sphere(if by == 0.0 { sphere } else { sphere.flipped() })
            }
            _ => {
                let cylinder = Cylinder::baked(a, b, cx);
                AnyShape::Cylinder(if cy == 0.0 { cylinder } else { cylinder.flipped() })
            }
        }
    }
}

impl Shape for StoredShape {
    fn bounds(&self) -> Aabb {
        self.shape().bounds()
    }

    fn area(&self) -> f32 {
        self.shape().area()
    }

    #[inline]
    fn intersect(&self, ray: &PreparedRay, t_max: f32) -> Option<ShapeHit> {
        self.shape().intersect(ray, t_max)
    }

    #[inline]
    fn hides_itself(&self, ray: &PreparedRay, reach: f32) -> bool {
        self.shape().hides_itself(ray, reach)
    }

    fn surface_point(&self, ray: &Ray, hit: &ShapeHit) -> SurfacePoint {
        self.shape().surface_point(ray, hit)
    }

    fn unit_point(&self, point: Vec3) -> Vec3 {
        self.shape().unit_point(point)
    }

    fn uv(&self, unit: Vec3) -> Vec2 {
        self.shape().uv(unit)
    }

    fn unit_tangent(&self, unit: Vec3) -> Vec3 {
        self.shape().unit_tangent(unit)
    }

    fn tangents(&self, point: Vec3) -> [Vec3; 2] {
        self.shape().tangents(point)
    }

    fn check(&self) -> Result<(), ShapeError> {
        self.shape().check()
    }
}
