//! `<shape>`: surfaces.

use super::context::Context;
use super::element::Element;
use super::properties::Properties;
use super::{cube, fit};
use crate::build::{Geometry, Mesh};
use crate::load::mesh::{Placement, place};
use crate::load::{LoadError, Problem, obj, ply, serialized};
use crate::texture::ObjectSpace;
use glam::{DMat4, DVec3};
use std::borrow::ToOwned;
use std::format;
use std::path::PathBuf;

const NAMES: [&str; 8] = ["rectangle", "disk", "sphere", "cylinder", "cube", "obj", "ply", "serialized"];

/// The form of a shape.
#[derive(Debug)]
pub(super) struct Form {
    /// In world space.
    pub(super) geometry: Geometry,
    /// What gives it texture coordinates, when it is analytic.
    pub(super) object_space: Option<ObjectSpace>,
}

impl From<Mesh> for Form {
    fn from(mesh: Mesh) -> Self {
        Self { geometry: Geometry::Mesh(mesh), object_space: None }
    }
}

/// The form of a shape; its material and emission are left in the properties.
pub(super) fn read(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<Form, LoadError> {
    let kind = element.plugin("shape", &NAMES)?;
    let (at, m) = properties.transform("to_world")?.unwrap_or((element, DMat4::IDENTITY));
    let flip = properties.flag("flip_normals")?;
    let (form, unit) = match kind {
        "rectangle" => (fit::rectangle(&m, flip), m),
        "disk" => (fit::disk(&m, flip), m),
        "sphere" => {
            let centre = properties.vector("center")?.unwrap_or(DVec3::ZERO);
            let radius = properties.float_or("radius", 1.0)?;
            let unit = DMat4::from_translation(centre) * DMat4::from_scale(DVec3::splat(radius));
            (fit::sphere(&m, centre, radius, flip), m * unit)
        }
        "cylinder" => {
            let ends = [
                properties.vector("p0")?.unwrap_or(DVec3::ZERO),
                properties.vector("p1")?.unwrap_or(DVec3::Z),
            ];
            let radius = properties.float_or("radius", 1.0)?;
            (fit::cylinder(&m, ends, radius, flip), m * fit::unit_cylinder(ends, radius))
        }
        "cube" => {
            // A mirrored cube still faces outward.
            let flip_normals = (m.determinant() < 0.0) != flip;
            let placement = Placement { to_world: m, face_normals: true, flip_normals };
            return place_mesh(context, element, None, cube::mesh(), &placement);
        }
        _ => return mesh_file(context, element, properties, &m, flip),
    };
    let geometry = form.map_err(|problem| match problem {
        Problem::Transform { .. } => at.error(problem),
        _ => element.error(problem),
    })?;
    let object_space = matches!(geometry, Geometry::Shape(_)).then(|| fit::object_space(&unit));
    Ok(Form { geometry, object_space })
}

fn mesh_file(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
    to_world: &DMat4,
    flip_normals: bool,
) -> Result<Form, LoadError> {
    let (_, name) = properties
        .text("filename")?
        .ok_or_else(|| element.error(Problem::Missing { what: "the property \"filename\"".to_owned() }))?;
    let kind = element.attribute("type").unwrap_or_default();
    let is_serialized = kind == "serialized";
    let index = if is_serialized { properties.count("shape_index")?.unwrap_or(0) } else { 0 };
    // Rows of OBJ textures count from the bottom.
    let flip_uvs = !is_serialized && properties.flag_or("flip_tex_coords", kind == "obj")?;
    let face_normals = properties.flag("face_normals")?;
    let (files, path) = (&context.document.files, context.find(element, name));
    let read = match kind {
        "obj" => obj::read(files, &path),
        "serialized" => serialized::read(files, &path, index),
        _ => ply::read(files, &path),
    };
    let mut mesh = read
        .map_err(|source| element.error(Problem::File { path: path.clone(), source }))?
        .map_err(|source| element.error(Problem::Mesh { path: path.clone(), source }))?;
    if flip_uvs {
        mesh.uvs.iter_mut().for_each(|uv| uv.y = 1.0 - uv.y);
    }
    let placement = Placement { to_world: *to_world, face_normals, flip_normals };
    place_mesh(context, element, Some(path), mesh, &placement)
}

fn place_mesh(
    context: &mut Context<'_>,
    element: &Element,
    path: Option<PathBuf>,
    mesh: Mesh,
    placement: &Placement,
) -> Result<Form, LoadError> {
    if !(placement.to_world.determinant().abs() > 0.0) {
        return Err(element.error(Problem::Transform { must: "have an inverse: no scale of 0" }));
    }
    let (mesh, dropped) = place(mesh, placement).map_err(|source| {
        let path = path.unwrap_or_else(|| element.title().into());
        element.error(Problem::Mesh { path, source })
    })?;
    if dropped > 0 {
        context.warn(element, &format!("{dropped} triangles without area are left out"));
    }
    Ok(mesh.into())
}
