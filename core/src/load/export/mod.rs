//! Writes a scene as Mitsuba 3 XML with binary PLY meshes, and pictures as PNG or OpenEXR; or as Rust
//! source or bytes, for programs without files.
//!
//! The XML that is written loads in Mitsuba, and loads here to the same scene, except for what Mitsuba does
//! not have: surfaces that emit from both sides, the Phong model, and the metallic-roughness model of glTF.
//! Those are written in the spelling that this crate reads, with a remark.

mod bsdf;
mod bytes;
mod error;
mod file;
mod names;
mod parts;
mod ply;
mod rust;
mod textures;
mod xml;

pub use bytes::{export_bytes, scene_bytes};
pub use error::ExportError;
pub use rust::{export_rust, rust_source};

use crate::build::{Description, Geometry, Mesh, Object};
use crate::load::write_exr;
use crate::shape::AnyShape;
use file::write_whole;
use names::{Names, file_name};
use std::borrow::Cow;
use std::format;
use std::io::{self, Write};
use std::path::Path;
use std::string::String;
use std::vec::Vec;
use textures::Pictures;
use xml::Xml;

/// Writes a scene to `path`, and beside it its meshes as `<stem>-<object>.ply`, its textures as
/// `<stem>-texture.png` or `.exr`, numbered, and a picture of its environment as
/// `<stem>-environment.exr`. A file is written
/// under another name and renamed when it is complete.
///
/// # Errors
/// When a file cannot be written, an object has no material, or a light has a surface without being
/// an object.
pub fn export_mitsuba(description: &Description, path: &Path) -> Result<(), ExportError> {
    let stem = path.file_stem().ok_or_else(|| ExportError::Path { path: path.into() })?;
    let stem = file_name(&stem.to_string_lossy());
    let mut ids = Names::default();
    let mut files = Names::default();
    let mut pictures = Pictures::new(path, &stem);
    let mut xml = Xml::new();
    parts::integrator(&mut xml, description);
    parts::sensor(&mut xml, description);
    let materials = materials(&mut xml, &mut ids, &mut pictures, description)?;
    for (index, object) in description.objects.iter().enumerate() {
        let material = materials.get(object.material).ok_or(ExportError::Material { object: index })?;
        let mesh = as_mesh(&object.geometry);
        let file =
            mesh.as_ref().map(|_| files.unique(&format!("{stem}-{}", file_name(&object.name))) + ".ply");
        if let Some((mesh, file)) = mesh.as_deref().zip(file.as_deref()) {
            write_whole(&path.with_file_name(file), |out| ply::write(out, mesh))?;
        }
        shape(&mut xml, &mut ids, &mut pictures, object, file.as_deref(), material)?;
    }
    for light in &description.lights {
        parts::light(&mut xml, light)?;
    }
    for (index, portal) in description.portals.iter().enumerate() {
        parts::portal(&mut xml, portal, index);
    }
    for map in &description.environments {
        let file = files.unique(&format!("{stem}-environment")) + ".exr";
        write_whole(&path.with_file_name(&file), |out| write_exr(&map.image, out).map_err(io::Error::other))?;
        parts::environment(&mut xml, map, &file);
    }
    let text = xml.finish();
    write_whole(path, |out| out.write_all(text.as_bytes()))
}

/// How shapes refer to each material: by the id under which it is written, or by repeating it.
fn materials(
    xml: &mut Xml,
    ids: &mut Names,
    pictures: &mut Pictures<'_>,
    description: &Description,
) -> Result<Vec<String>, ExportError> {
    description
        .materials
        .iter()
        .map(|material| {
            let mut inner = Xml::nested();
            if material.name.is_empty() {
                bsdf::write(&mut inner, pictures, material, None)?;
                return Ok(inner.into_body());
            }
            let id = ids.unique(&names::id(&material.name));
            bsdf::write(xml, pictures, material, Some(&id))?;
            inner.empty("ref", &[("id", &id)]);
            Ok(inner.into_body())
        })
        .collect()
}

/// The triangles of what is written as a mesh file.
fn as_mesh(geometry: &Geometry) -> Option<Cow<'_, Mesh>> {
    match geometry {
        Geometry::Mesh(mesh) => Some(Cow::Borrowed(mesh)),
        Geometry::Shape(AnyShape::Triangle(triangle)) => Some(Cow::Owned(Mesh {
            positions: triangle.corners().to_vec(),
            triangles: [[0, 1, 2]].to_vec(),
            ..Mesh::default()
        })),
        Geometry::Shape(_) => None,
    }
}

/// Writes an object. Its id is left out when it is only the name of its kind.
fn shape(
    xml: &mut Xml,
    ids: &mut Names,
    pictures: &mut Pictures<'_>,
    object: &Object,
    file: Option<&str>,
    material: &str,
) -> Result<(), ExportError> {
    let kind = parts::shape_kind(&object.geometry);
    let named = !object.name.is_empty() && object.name != kind;
    let id = named.then(|| ids.unique(&names::id(&object.name)));
    xml.open_plugin("shape", kind, id.as_deref());
    match (file, &object.geometry) {
        (Some(file), geometry) => {
            xml.property("string", "filename", file);
            let flat = !matches!(geometry, Geometry::Mesh(mesh) if !mesh.normals.is_empty());
            if flat {
                xml.property("boolean", "face_normals", "true");
            }
        }
        (None, Geometry::Shape(shape)) => match &object.object_space {
            Some(space) => parts::in_object_space(xml, shape, space),
            None => parts::analytic(xml, shape),
        },
        (None, Geometry::Mesh(_)) => {}
    }
    xml.raw(material);
    if let Some(emission) = &object.emission {
        parts::emission(xml, pictures, emission)?;
    }
    xml.close("shape");
    Ok(())
}

/// Digits of a coordinate: those of single precision when it is one.
fn digits(v: f64) -> String {
    let single = v as f32;
    if f64::from(single) == v { format!("{single:?}") } else { format!("{v:?}") }
}
