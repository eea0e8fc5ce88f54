//! `<shape>`: surfaces.

use super::context::Context;
use super::element::Element;
use super::properties::Properties;
use super::{cube, fit};
use crate::build::{Geometry, Mesh};
use crate::load::mesh::{Placement, place};
use crate::load::{LoadError, MeshError, Problem, obj, ply};
use glam::{DMat4, DVec3};
use std::borrow::ToOwned;
use std::path::{Path, PathBuf};
use std::{format, io};

const NAMES: [&str; 7] = ["rectangle", "disk", "sphere", "cylinder", "cube", "obj", "ply"];

/// The form of a shape, in world space; its material and emission are left in the properties.
pub(super) fn read(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<Geometry, LoadError> {
    if element.attribute("type") == Some("serialized") {
        let what = "the format of Mitsuba 0.x".to_owned();
        return Err(element.error(Problem::NotSupported { what, instead: "convert the mesh to .ply" }));
    }
    let kind = element.plugin("shape", &NAMES)?;
    let (at, m) = properties.transform("to_world")?.unwrap_or((element, DMat4::IDENTITY));
    let flip = properties.flag("flip_normals")?;
    let form = match kind {
        "rectangle" => fit::rectangle(&m, flip),
        "disk" => fit::disk(&m, flip),
        "sphere" => {
            let centre = properties.vector("center")?.unwrap_or(DVec3::ZERO);
            fit::sphere(&m, centre, properties.float_or("radius", 1.0)?, flip)
        }
        "cylinder" => {
            let ends = [
                properties.vector("p0")?.unwrap_or(DVec3::ZERO),
                properties.vector("p1")?.unwrap_or(DVec3::Z),
            ];
            fit::cylinder(&m, ends, properties.float_or("radius", 1.0)?, flip)
        }
        "cube" => {
            // A mirrored cube still faces outward.
            let flip_normals = (m.determinant() < 0.0) != flip;
            let placement = Placement { to_world: m, face_normals: true, flip_normals };
            return place_mesh(context, element, None, cube::mesh(), &placement);
        }
        _ => return mesh_file(context, element, properties, &m, flip),
    };
    form.map_err(|problem| match problem {
        Problem::Transform { .. } => at.error(problem),
        _ => element.error(problem),
    })
}

fn mesh_file(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
    to_world: &DMat4,
    flip_normals: bool,
) -> Result<Geometry, LoadError> {
    let (_, name) = properties
        .text("filename")?
        .ok_or_else(|| element.error(Problem::Missing { what: "the property \"filename\"".to_owned() }))?;
    properties.ignore(&["flip_tex_coords"]);
    let face_normals = properties.flag("face_normals")?;
    let path = context.find(element, name);
    let read: fn(&Path) -> io::Result<Result<Mesh, MeshError>> =
        if element.attribute("type") == Some("obj") { obj::read } else { ply::read };
    let mesh = read(&path)
        .map_err(|source| element.error(Problem::File { path: path.clone(), source }))?
        .map_err(|source| element.error(Problem::Mesh { path: path.clone(), source }))?;
    let placement = Placement { to_world: *to_world, face_normals, flip_normals };
    place_mesh(context, element, Some(path), mesh, &placement)
}

fn place_mesh(
    context: &mut Context<'_>,
    element: &Element,
    path: Option<PathBuf>,
    mesh: Mesh,
    placement: &Placement,
) -> Result<Geometry, LoadError> {
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
    Ok(Geometry::Mesh(mesh))
}
