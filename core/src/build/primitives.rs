//! The primitives of a description, numbered one after the other.

use super::{BuildError, Description, Geometry, Mesh, Object};
use crate::geom::Aabb;
use crate::light::{AnyLight, AreaLight};
use crate::scene::{CornerNormals, CornerUvs};
use crate::shape::{AnyShape, Shape, Triangle};
use crate::texture::{ObjectSpace, SurfaceUvs};
use std::string::ToString;
use std::vec::Vec;

/// One primitive: an analytic shape, or a triangle of a mesh.
#[derive(Clone, Copy)]
pub(super) struct Primitive {
    pub(super) object: u32,
    pub(super) triangle: u32,
}

/// Lists all primitives; triangles without area are left out and counted.
pub(super) fn list(description: &Description) -> Result<(Vec<Primitive>, usize), BuildError> {
    list_where(description, |_| true)
}

/// Lists the primitives of the objects that `wanted` accepts, as [`list`] does.
pub(super) fn list_where(
    description: &Description,
    wanted: impl Fn(&Object) -> bool,
) -> Result<(Vec<Primitive>, usize), BuildError> {
    let most = |object: &Object| match &object.geometry {
        Geometry::Shape(_) => 1,
        Geometry::Mesh(mesh) => mesh.triangles.len(),
    };
    let mut primitives = Vec::with_capacity(description.objects.iter().filter(|o| wanted(o)).map(most).sum());
    let mut degenerate = 0;
    for (index, object) in description.objects.iter().enumerate().filter(|(_, object)| wanted(object)) {
        if object.material >= description.materials.len() {
            return Err(BuildError::NoMaterial { object: object.name.clone(), material: object.material });
        }
        let object_index = index as u32;
        match &object.geometry {
            Geometry::Shape(_) => primitives.push(Primitive { object: object_index, triangle: 0 }),
            Geometry::Mesh(mesh) => {
                for triangle in 0..mesh.triangles.len() {
                    check_triangle(object, mesh, triangle)?;
                    match mesh.triangle(triangle) {
                        Some(_) => {
                            primitives.push(Primitive { object: object_index, triangle: triangle as u32 });
                        }
                        None => degenerate += 1,
                    }
                }
            }
        }
    }
    Ok((primitives, degenerate))
}

fn check_triangle(object: &Object, mesh: &Mesh, triangle: usize) -> Result<(), BuildError> {
    let corners = mesh.positions.len();
    let enough = |len: usize| if len == 0 { corners } else { len };
    let least = corners.min(enough(mesh.normals.len())).min(enough(mesh.uvs.len()));
    let there = mesh.triangles[triangle].iter().all(|&i| (i as usize) < least);
    if there { Ok(()) } else { Err(BuildError::Mesh { object: object.name.to_string(), triangle }) }
}

impl Mesh {
    /// One of its triangles; `None` when it has no area.
    pub(super) fn triangle(&self, triangle: usize) -> Option<Triangle> {
        let [a, b, c] = self.triangles[triangle].map(|i| self.positions[i as usize]);
        Triangle::new(a, b, c).ok()
    }

    /// The shading normals of one of its triangles; `None` when it is flat.
    pub(super) fn corner_normals(&self, triangle: usize) -> Option<CornerNormals> {
        (!self.normals.is_empty())
            .then(|| CornerNormals(self.triangles[triangle].map(|i| self.normals[i as usize])))
    }

    /// The texture coordinates of one of its triangles; `None` when it has none.
    pub(super) fn corner_uvs(&self, triangle: usize) -> Option<CornerUvs> {
        (!self.uvs.is_empty()).then(|| CornerUvs(self.triangles[triangle].map(|i| self.uvs[i as usize])))
    }
}

impl Primitive {
    /// Its form.
    pub(super) fn shape(&self, description: &Description) -> Option<AnyShape> {
        match &description.objects[self.object as usize].geometry {
            Geometry::Shape(shape) => Some(*shape),
            Geometry::Mesh(mesh) => mesh.triangle(self.triangle as usize).map(AnyShape::Triangle),
        }
    }

    /// Its box.
    pub(super) fn bounds(&self, description: &Description) -> Aabb {
        match &description.objects[self.object as usize].geometry {
            Geometry::Shape(shape) => shape.bounds(),
            Geometry::Mesh(mesh) => {
                Aabb::around(&mesh.triangles[self.triangle as usize].map(|i| mesh.positions[i as usize]))
            }
        }
    }

    /// Its shading normals.
    pub(super) fn normals(&self, description: &Description) -> Option<CornerNormals> {
        match &description.objects[self.object as usize].geometry {
            Geometry::Shape(_) => None,
            Geometry::Mesh(mesh) => mesh.corner_normals(self.triangle as usize),
        }
    }

    /// Its texture coordinates, when it is a triangle that has some.
    pub(super) fn uvs(&self, description: &Description) -> Option<CornerUvs> {
        match &description.objects[self.object as usize].geometry {
            Geometry::Shape(_) => None,
            Geometry::Mesh(mesh) => mesh.corner_uvs(self.triangle as usize),
        }
    }

    /// Where its texture coordinates come from, when it is an analytic shape.
    pub(super) fn object_space(&self, description: &Description) -> Option<ObjectSpace> {
        let object = &description.objects[self.object as usize];
        object.object_space.filter(|_| matches!(object.geometry, Geometry::Shape(_)))
    }

    /// Its texture coordinates, wherever they come from.
    pub(super) fn surface_uvs(&self, description: &Description) -> SurfaceUvs {
        match (self.uvs(description), self.object_space(description)) {
            (Some(corners), _) => SurfaceUvs::Corners(corners),
            (None, Some(space)) => SurfaceUvs::Object(space),
            (None, None) => SurfaceUvs::Own,
        }
    }

    /// The light that it is.
    pub(super) fn light(
        &self,
        description: &Description,
        shape: AnyShape,
    ) -> Result<Option<AnyLight<'static>>, BuildError> {
        let object = &description.objects[self.object as usize];
        let Some(emission) =
            object.emission.as_ref().filter(|e| !e.radiance.is_valid() || !e.radiance.is_black())
        else {
            return Ok(None);
        };
        macro_rules! area {
            ($kind:ident, $shape:expr) => {
                AreaLight::new($shape, emission.radiance)
                    .map(|l| AnyLight::$kind(if emission.two_sided { l.two_sided() } else { l }))
            };
        }
        let light = match shape {
            AnyShape::Triangle(s) => area!(Triangle, s),
            AnyShape::Rectangle(s) => area!(Rectangle, s),
            AnyShape::Disk(s) => area!(Disk, s),
            AnyShape::Sphere(s) => area!(Sphere, s),
            AnyShape::Cylinder(s) => area!(Cylinder, s),
        };
        light.map(Some).map_err(|source| BuildError::Light { object: object.name.clone(), source })
    }
}
