//! Primitives of meshes: which corners, and what is known of each.

use super::accessor::Elements;
use super::container::malformed;
use super::document::Primitive;
use super::source::Source;
use crate::build::Mesh;
use crate::load::Problem;
use glam::{Vec2, Vec3};
use std::borrow::ToOwned;
use std::format;
use std::vec::Vec;

/// Modes of primitives that have a surface.
const TRIANGLES: u32 = 4;
const STRIP: u32 = 5;
const FAN: u32 = 6;

/// True when a primitive is a surface, not points or lines.
pub(super) fn is_surface(primitive: &Primitive) -> bool {
    (TRIANGLES..=FAN).contains(&primitive.mode.unwrap_or(TRIANGLES))
}

/// A primitive's corners in the space of its node, those only that a triangle has.
///
/// * `uv_set` – which texture coordinates to read
pub(super) fn read(source: &Source<'_>, primitive: &Primitive, uv_set: Option<u32>) -> Result<Mesh, Problem> {
    let attribute = |name: &str, kind| {
        primitive.attributes.get(name).map(|index| Elements::new(source, *index, kind)).transpose()
    };
    let positions = attribute("POSITION", "VEC3")?
        .ok_or_else(|| Problem::Missing { what: "the attribute POSITION".to_owned() })?;
    let normals = attribute("NORMAL", "VEC3")?;
    let uvs = match uv_set {
        Some(set) => {
            let name = format!("TEXCOORD_{set}");
            let missing = || Problem::Missing { what: format!("{name}, which the textures need,") };
            Some(attribute(&name, "VEC2")?.ok_or_else(missing)?)
        }
        None => None,
    };
    for other in [&normals, &uvs].into_iter().flatten() {
        if other.len() != positions.len() {
            let what = format!("{} positions, but {} of another attribute", positions.len(), other.len());
            return Err(malformed(what));
        }
    }
    let mut triangles = triangles(source, primitive, positions.len())?;
    let used = renumber(&mut triangles);
    let all = |elements: &Elements<'_>| -> Vec<Vec3> {
        used.iter().map(|&i| Vec3::from_array(elements.get(i as usize))).collect()
    };
    Ok(Mesh {
        positions: all(&positions),
        normals: normals.as_ref().map(all).unwrap_or_default(),
        uvs: uvs
            .map(|uvs| used.iter().map(|&i| Vec2::from_array(uvs.get(i as usize))).collect())
            .unwrap_or_default(),
        triangles,
    })
}

/// The triangles of a primitive with so many vertices.
fn triangles(source: &Source<'_>, primitive: &Primitive, vertices: usize) -> Result<Vec<[u32; 3]>, Problem> {
    let Ok(vertices) = u32::try_from(vertices) else { return Err(malformed("too many vertices")) };
    let indices = match primitive.indices {
        Some(index) => Some(Elements::new(source, index, "SCALAR")?),
        None => None,
    };
    if indices.is_some_and(|i| !i.are_indices()) {
        return Err(malformed("its indices are not unsigned whole numbers"));
    }
    let count = indices.map_or(vertices as usize, |i| i.len());
    let corner = |i: usize| indices.map_or(i as u32, |indices| indices.index(i));
    if let Some(wrong) = (0..count).map(corner).find(|index| *index >= vertices) {
        return Err(malformed(format!("index {wrong} of a corner, where there are {vertices} vertices")));
    }
    // Source: glTF 2.0 Specification, section 3.7.2.1.
    let ends = count.saturating_sub(2);
    Ok(match primitive.mode.unwrap_or(TRIANGLES) {
        STRIP => (0..ends).map(|i| [i, i + 1 + i % 2, i + 2 - i % 2].map(corner)).collect(),
        FAN => (0..ends).map(|i| [i + 1, i + 2, 0].map(corner)).collect(),
        _ => (0..count / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2].map(corner)).collect(),
    })
}

/// Numbers the corners that triangles have from 0 on; their old numbers, which grow.
pub(super) fn renumber(triangles: &mut [[u32; 3]]) -> Vec<u32> {
    let mut used: Vec<u32> = triangles.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    for corner in triangles.as_flattened_mut() {
        *corner = used.partition_point(|old| *old < *corner) as u32;
    }
    used
}
