//! PLY files, text or binary, read element by element.

mod element;

use super::{Files, MeshError};
use crate::build::Mesh;
use element::{Face, Ignored, Vertex};
use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{ElementDef, Encoding, Header, PropertyAccess, PropertyType};
use std::io::{self, BufRead};
use std::path::Path;
use std::string::{String, ToString};

/// Reads a mesh. Polygons become fans of triangles.
///
/// # Errors
/// The outer error is about the file, the inner one about what is in it.
pub(super) fn read(files: &Files, path: &Path) -> io::Result<Result<Mesh, MeshError>> {
    let (file, bytes) = files.open(path)?;
    Ok(parse(file, bytes))
}

/// Reads a mesh from `bytes` bytes.
fn parse<R: BufRead>(reader: R, bytes: u64) -> Result<Mesh, MeshError> {
    let mut reader = Reader::new(reader);
    let header = Parser::<Vertex>::new().read_header(&mut reader).map_err(malformed)?;
    check_header(&header, bytes)?;
    let mut mesh = Mesh::default();
    for (name, definition) in &header.elements {
        match name.as_str() {
            "vertex" => read_vertices(&mut reader, &header, definition, &mut mesh)?,
            "face" => read_faces(&mut reader, &header, definition, &mut mesh)?,
            _ => each::<Ignored, _>(&mut reader, &header, definition, |_, _| Ok(()))?,
        }
    }
    finish(mesh)
}

/// What the faces refer to must exist, whichever of the two comes first in the file.
fn finish(mesh: Mesh) -> Result<Mesh, MeshError> {
    let vertices = mesh.positions.len();
    if let Some((face, index)) = mesh
        .triangles
        .iter()
        .enumerate()
        .find_map(|(face, t)| t.iter().find(|i| **i as usize >= vertices).map(|i| (face, *i)))
    {
        return Err(MeshError::Index { face, index: index.into(), vertices });
    }
    Ok(mesh)
}

/// Refuses counts that the file cannot hold, before anything is reserved for them.
fn check_header(header: &Header, bytes: u64) -> Result<(), MeshError> {
    let has = |element: &str, names: &[&str]| {
        header.elements.get(element).is_some_and(|e| names.iter().all(|n| e.properties.contains_key(*n)))
    };
    if !has("vertex", &["x", "y", "z"]) {
        return Err(MeshError::Missing { what: "the element \"vertex\" with x, y and z is" });
    }
    if !has("face", &["vertex_indices"]) && !has("face", &["vertex_index"]) {
        return Err(MeshError::Missing { what: "the element \"face\" with vertex_indices is" });
    }
    for (name, definition) in &header.elements {
        let least: u64 = definition.properties.values().map(|p| least_bytes(&p.data_type, header)).sum();
        // Without properties an element takes no room, and any number of them would fit.
        if (definition.count as u64).saturating_mul(least.max(1)) > bytes {
            let count = definition.count as u64;
            return Err(MeshError::Count { element: name.clone(), count, bytes });
        }
    }
    Ok(())
}

/// The least number of bytes that a property takes: a digit and a blank, or its binary size.
fn least_bytes(property: &PropertyType, header: &Header) -> u64 {
    use ply_rs_bw::ply::ScalarType::{Char, Double, Float, Int, Short, UChar, UInt, UShort};
    let (PropertyType::Scalar(scalar) | PropertyType::List(scalar, _)) = property;
    match (header.encoding, scalar) {
        (Encoding::Ascii, _) | (_, Short | UShort) => 2,
        (_, Char | UChar) => 1,
        (_, Int | UInt | Float) => 4,
        (_, Double) => 8,
    }
}

/// Hands each of a kind of element to `take`, with its number.
fn each<E: PropertyAccess, R: BufRead>(
    reader: &mut Reader<R>,
    header: &Header,
    definition: &ElementDef,
    mut take: impl FnMut(usize, E) -> Result<(), MeshError>,
) -> Result<(), MeshError> {
    let parser = Parser::<E>::new();
    let mut line = String::new();
    for i in 0..definition.count {
        let source = reader.get_mut();
        let element = match header.encoding {
            Encoding::BinaryLittleEndian => parser.read_little_endian_element(source, definition),
            Encoding::BinaryBigEndian => parser.read_big_endian_element(source, definition),
            Encoding::Ascii => {
                line.clear();
                source.read_line(&mut line).map_err(|e| malformed(e.into()))?;
                parser.read_ascii_element(&line, definition)
            }
        };
        let element = element.map_err(|e| broken(definition, i, &e))?;
        take(i, element)?;
    }
    Ok(())
}

fn malformed(e: ParseError) -> MeshError {
    MeshError::Malformed { line: e.line(), what: first_line(&e.to_string()) }
}

fn broken(definition: &ElementDef, i: usize, e: &ParseError) -> MeshError {
    let ElementDef { name, count, .. } = definition;
    let what = if e.kind() == io::ErrorKind::UnexpectedEof {
        std::format!("the file ends in {name} {i} of {count}")
    } else {
        std::format!("{name} {i} of {count} cannot be read: {}", first_line(&e.to_string()))
    };
    MeshError::Malformed { line: None, what }
}

/// What is wrong, without the number of the line, which stands before it, and the input, which the
/// parser repeats on further lines.
fn first_line(text: &str) -> String {
    let line = text.lines().next().unwrap_or_default();
    line.strip_prefix("Line ").and_then(|l| l.split_once(": ")).map_or(line, |(_, what)| what).to_string()
}

fn read_vertices<R: BufRead>(
    reader: &mut Reader<R>,
    header: &Header,
    definition: &ElementDef,
    mesh: &mut Mesh,
) -> Result<(), MeshError> {
    let has = |names: &[&str]| names.iter().all(|n| definition.properties.contains_key(*n));
    let has_normals = has(&["nx", "ny", "nz"]);
    let has_uvs = has(&["u", "v"]) || has(&["s", "t"]);
    mesh.uvs.reserve_exact(if has_uvs { definition.count } else { 0 });
    mesh.positions.reserve_exact(definition.count);
    mesh.normals.reserve_exact(if has_normals { definition.count } else { 0 });
    each::<Vertex, _>(reader, header, definition, |vertex, v| {
        if !v.position.is_finite() || !v.normal.is_finite() || !v.uv.is_finite() {
            return Err(MeshError::NotFinite { vertex });
        }
        mesh.positions.push(v.position);
        if has_normals {
            mesh.normals.push(v.normal);
        }
        if has_uvs {
            mesh.uvs.push(v.uv);
        }
        Ok(())
    })
}

fn read_faces<R: BufRead>(
    reader: &mut Reader<R>,
    header: &Header,
    definition: &ElementDef,
    mesh: &mut Mesh,
) -> Result<(), MeshError> {
    mesh.triangles.reserve_exact(definition.count);
    each::<Face, _>(reader, header, definition, |face, f| {
        let (corners, vertices) = (f.len(), mesh.positions.len());
        let index = |k: usize| {
            let index = f.corner(k);
            u32::try_from(index).map_err(|_| MeshError::Index { face, index, vertices })
        };
        if corners < 3 {
            return Err(MeshError::Corners { face, corners });
        }
        for k in 2..corners {
            mesh.triangles.push([index(0)?, index(k - 1)?, index(k)?]);
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec2, Vec3};
    use std::format;
    use std::vec::Vec;

    const HEADER: &str = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                          element face 1\nproperty list uchar int vertex_indices\nend_header\n";

    fn parse_text(text: &str) -> Result<Mesh, MeshError> {
        parse(text.as_bytes(), text.len() as u64)
    }

    fn ascii(body: &str) -> Result<Mesh, MeshError> {
        parse_text(&format!("ply\nformat ascii 1.0\n{HEADER}{body}"))
    }

    #[test]
    fn text_is_read() {
        let mesh = ascii("0 0 0\n1 0 0\n0 1e0 0\n3 0 1 2\n").unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2]]);
        assert_eq!(mesh.positions[2], Vec3::Y);
    }

    #[test]
    fn both_byte_orders_and_every_index_type_are_read() {
        for (order, big) in [("little", false), ("big", true)] {
            for (index, size) in [("uchar", 1), ("short", 2), ("ushort", 2), ("int", 4), ("uint", 4)] {
                let bytes = |v: u32, n: usize| -> Vec<u8> {
                    if big { v.to_be_bytes()[4 - n..].to_vec() } else { v.to_le_bytes()[..n].to_vec() }
                };
                let mut file = format!(
                    "ply\nformat binary_{order}_endian 1.0\ncomment x\nelement vertex 4\nproperty double x\n\
                     property float y\nproperty float z\nproperty uchar red\nelement face 1\n\
                     property list int {index} vertex_index\nelement edge 2\nproperty int a\nend_header\n"
                )
                .into_bytes();
                for x in [0.0_f64, 1.0, 2.0, 3.0] {
                    file.extend(if big { x.to_be_bytes() } else { x.to_le_bytes() });
                    file.extend([0; 9]);
                }
                file.extend(bytes(4, 4));
                (0..4).for_each(|i| file.extend(bytes(i, size)));
                file.extend([0; 8]);
                let mesh = parse(&file[..], file.len() as u64).unwrap();
                assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]], "{order} {index}");
                assert_eq!(mesh.positions[3], Vec3::X * 3.0);
            }
        }
    }

    #[test]
    fn texture_coordinates_have_two_pairs_of_names() {
        for names in [["u", "v"], ["s", "t"]] {
            let uv = format!("property float z\nproperty float {}\nproperty float {}\n", names[0], names[1]);
            let text =
                format!("ply\nformat ascii 1.0\n{HEADER}0 0 0 0 0\n1 0 0 1 0\n0 1 0 0.5 0.25\n3 0 1 2\n");
            let mesh = parse_text(&text.replace("property float z\n", &uv)).unwrap();
            assert_eq!(mesh.uvs, [Vec2::ZERO, Vec2::X, Vec2::new(0.5, 0.25)]);
        }
        assert!(ascii("0 0 0\n1 0 0\n0 1e0 0\n3 0 1 2\n").unwrap().uvs.is_empty());
    }

    #[test]
    fn faces_may_come_before_vertices() {
        let text = "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n\
                    element vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n\
                    3 2 1 0\n0 0 0\n1 0 0\n0 1 0\n";
        assert_eq!(parse_text(text).unwrap().triangles, [[2, 1, 0]]);
        let bad = text.replace("3 2 1 0", "3 2 1 3");
        assert_eq!(parse_text(&bad), Err(MeshError::Index { face: 0, index: 3, vertices: 3 }));
    }

    #[test]
    fn indices_out_of_range_are_refused() {
        for (face, index) in [("3 0 1 3", 3), ("3 0 -1 2", -1)] {
            let result = ascii(&format!("0 0 0\n1 0 0\n0 1 0\n{face}\n"));
            assert_eq!(result, Err(MeshError::Index { face: 0, index, vertices: 3 }));
        }
    }

    #[test]
    fn faces_without_three_corners_are_refused() {
        assert_eq!(ascii("0 0 0\n1 0 0\n0 1 0\n2 0 1\n"), Err(MeshError::Corners { face: 0, corners: 2 }));
    }

    #[test]
    fn files_that_end_early_are_refused() {
        let error = ascii("0 0 0\n1 0 0\n").unwrap_err();
        assert!(matches!(error, MeshError::Malformed { .. }), "{error}");
        let text = format!("ply\nformat binary_little_endian 1.0\n{HEADER}{}\x03", "\0".repeat(36));
        let error = parse_text(&text).unwrap_err();
        assert!(error.to_string().contains("ends in face 0 of 1"), "{error}");
        let error = parse_text("ply\nformat ascii 1.0\n").unwrap_err();
        assert!(error.to_string().starts_with("line 3: Unexpected end of file"), "{error}");
        assert!(parse_text("").is_err());
    }

    #[test]
    fn counts_that_the_file_cannot_hold_are_refused_before_memory_is_taken() {
        for count in ["4000000000", "18446744073709551615", "99999999999999999999999"] {
            for properties in ["property float x\nproperty float y\nproperty float z\n", ""] {
                let text = format!(
                    "ply\nformat binary_little_endian 1.0\nelement junk {count}\n{properties}{HEADER}"
                );
                assert!(parse_text(&text).is_err(), "{count} {properties}");
            }
        }
    }

    #[test]
    fn coordinates_that_are_no_numbers_are_refused() {
        assert!(ascii("0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n").is_err());
        assert_eq!(ascii("0 0 1e39\n1 0 0\n0 1 0\n3 0 1 2\n"), Err(MeshError::NotFinite { vertex: 0 }));
    }

    #[test]
    fn a_point_cloud_is_not_a_mesh() {
        let text = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n\
                    property float z\nend_header\n0 0 0\n";
        assert!(matches!(parse_text(text), Err(MeshError::Missing { .. })));
    }
}
