use super::*;
use flate2::Compression;
use flate2::write::ZlibEncoder;
use std::io::{Cursor, Write};

/// A square, with what the flags say.
fn body(flags: u32, version: u16) -> Vec<u8> {
    let mut out = flags.to_le_bytes().to_vec();
    if version == 4 {
        out.extend(b"name\0");
    }
    out.extend(4_u64.to_le_bytes());
    out.extend(2_u64.to_le_bytes());
    let mut push = |numbers: &[f32]| {
        for n in numbers {
            if flags & flag::DOUBLE != 0 {
                out.extend(f64::from(*n).to_le_bytes())
            } else {
                out.extend(n.to_le_bytes())
            }
        }
    };
    push(&[0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.]);
    for (bit, numbers) in [
        (flag::NORMALS, [0., 0., 1.].repeat(4)),
        (flag::UVS, [0.25, 0.5].repeat(4)),
        (flag::COLOURS, [7.0; 12].to_vec()),
    ] {
        if flags & bit != 0 {
            push(&numbers);
        }
    }
    out.extend([0_u32, 1, 2, 0, 2, 3].iter().flat_map(|i| i.to_le_bytes()));
    out
}

fn packed(body: &[u8], version: u16) -> Vec<u8> {
    let mut out = MAGIC.to_le_bytes().to_vec();
    out.extend(version.to_le_bytes());
    let mut encoder = ZlibEncoder::new(out, Compression::default());
    encoder.write_all(body).unwrap();
    encoder.finish().unwrap()
}

fn file(meshes: &[Vec<u8>], version: u16) -> Vec<u8> {
    let (mut out, mut starts) = (Vec::new(), Vec::new());
    for mesh in meshes {
        starts.push(out.len() as u64);
        out.extend(mesh);
    }
    for start in starts {
        if version == 3 { out.extend((start as u32).to_le_bytes()) } else { out.extend(start.to_le_bytes()) }
    }
    out.extend((meshes.len() as u32).to_le_bytes());
    out
}

fn parse_bytes(bytes: &[u8], index: u32) -> Result<Mesh, MeshError> {
    parse(BufReader::new(Cursor::new(bytes)), bytes.len() as u64, index)
}

#[test]
fn both_versions_and_precisions_are_read_whatever_a_mesh_has() {
    for version in [3, 4] {
        for double in [0x1000, flag::DOUBLE] {
            let kinds =
                [0, flag::NORMALS, flag::UVS, flag::COLOURS, flag::NORMALS | flag::UVS | flag::COLOURS];
            let meshes: Vec<_> = kinds.iter().map(|k| packed(&body(k | double, version), version)).collect();
            let file = file(&meshes, version);
            for (index, kind) in kinds.iter().enumerate() {
                let mesh = parse_bytes(&file, index as u32).unwrap();
                assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y, Vec3::Y]);
                assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
                assert_eq!(mesh.normals.len(), if kind & flag::NORMALS != 0 { 4 } else { 0 });
                assert!(mesh.uvs.iter().all(|uv| *uv == Vec2::new(0.25, 0.5)));
                assert_eq!(mesh.uvs.len(), if kind & flag::UVS != 0 { 4 } else { 0 });
            }
        }
    }
}

#[test]
fn what_is_wrong_is_named() {
    let good = file(&[packed(&body(0x1000, 4), 4)], 4);
    let refused = |bytes: &[u8], index| parse_bytes(bytes, index).unwrap_err().to_string();
    assert_eq!(refused(&good, 1), "there is no mesh 1: the file has 1, from 0");
    assert!(refused(b"ply\n", 0).contains("not one of serialized meshes"));
    assert!(refused(&[0x1c, 0x04, 2, 0], 0).contains("version 2 is not read"));
    assert!(refused(&[0x1c, 0x04, 4, 0, 1, 2, 3, 4, 5, 6], 0).contains("compressed data cannot be read"));
    assert!(refused(&packed(&body(0x1000, 4)[..60], 4), 0).contains("ends in the middle"));
    assert!(refused(&[0x1c, 0x04], 0).contains("ends in the middle"));
    let starts = [&good[..good.len() - 4], &u32::MAX.to_le_bytes()].concat();
    assert!(refused(&starts, 1).contains("longer than the file"));
    let mut index = body(0x1000, 4);
    let end = index.len();
    index[end - 4..].copy_from_slice(&9_u32.to_le_bytes());
    assert!(refused(&packed(&index, 4), 0).contains("face 1 refers to vertex 9, but there are 4 vertices"));
    let mut nan = body(0x1000, 4);
    nan[29..33].copy_from_slice(&f32::NAN.to_le_bytes());
    assert!(refused(&packed(&nan, 4), 0).contains("vertex 0 is not finite"));
}

#[test]
fn counts_beyond_the_file_are_refused_before_anything_is_reserved() {
    for (place, element) in [(9, "vertex"), (17, "triangle")] {
        for count in [1_u64 << 20, 1 << 31, 1 << 40, u64::MAX] {
            let mut huge = body(0x1000, 4);
            huge[place..place + 8].copy_from_slice(&count.to_le_bytes());
            match parse_bytes(&packed(&huge, 4), 0) {
                Err(MeshError::Count { element: named, count: seen, .. }) => {
                    assert_eq!((named.as_str(), seen), (element, count));
                }
                other => panic!("{other:?}"),
            }
        }
    }
}

#[test]
fn no_damaged_byte_makes_it_panic() {
    let good = file(&[packed(&body(0x1003, 4), 4), packed(&body(0x2000, 4), 4)], 4);
    for at in 0..good.len() {
        for value in [0, 1, 0x7f, 0xff] {
            let mut bytes = good.clone();
            bytes[at] = value;
            let _ = (parse_bytes(&bytes, 0), parse_bytes(&bytes, 1));
        }
        let _ = (parse_bytes(&good[..at], 0), parse_bytes(&good[..at], 1));
    }
}
