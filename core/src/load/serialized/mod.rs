//! Mitsuba's `.serialized` files, versions 3 and 4: meshes one after the other, each compressed by
//! zlib, and at the end of the file where each of them starts.
//!
//! Source: the format's description in the documentation of Mitsuba 3's plugin `serialized`. Differs:
//! names and vertex colours are skipped, and a mesh has at most 2³² corners.

use super::{Files, MeshError};
use crate::build::Mesh;
use flate2::bufread::ZlibDecoder;
use glam::{Vec2, Vec3};
use std::format;
use std::io::{self, BufReader, ErrorKind, Read, Seek, SeekFrom};
use std::path::Path;
use std::string::{String, ToString};
use std::vec::Vec;

const MAGIC: u16 = 0x041c;

/// What the bits of a mesh's first word say.
mod flag {
    pub(super) const NORMALS: u32 = 0x0001;
    pub(super) const UVS: u32 = 0x0002;
    pub(super) const COLOURS: u32 = 0x0008;
    pub(super) const DOUBLE: u32 = 0x2000;
}

/// The most by which DEFLATE makes anything smaller, and some bytes for what is very small.
///
/// Source: RFC 1951, section 3.2.5: 258 bytes from two codes of one bit each.
const MOST_COMPRESSION: u64 = 1032;
const SLACK: u64 = 1024;

/// Vertices or triangles that are reserved before they have been seen.
const MOST_RESERVED: u64 = 1 << 20;

/// Reads the mesh with the given index, from 0.
///
/// # Errors
/// The outer error is about the file, the inner one about what is in it.
pub(super) fn read(files: &Files, path: &Path, index: u32) -> io::Result<Result<Mesh, MeshError>> {
    let (file, bytes) = files.open(path)?;
    Ok(parse(file, bytes, index))
}

/// Reads a mesh from a file of `bytes` bytes.
fn parse<R: Read + Seek>(mut file: BufReader<R>, bytes: u64, index: u32) -> Result<Mesh, MeshError> {
    let version = header(&mut file)?;
    if index > 0 {
        let start = start_of(&mut file, bytes, version, index)?;
        file.seek(SeekFrom::Start(start)).map_err(broken)?;
        header(&mut file)?;
    }
    Stream { from: ZlibDecoder::new(file), most: bytes.saturating_mul(MOST_COMPRESSION) + SLACK }
        .mesh(version)
}

/// Checks the first four bytes; the version.
fn header(file: &mut impl Read) -> Result<u16, MeshError> {
    let [a, b, c, d] = array(file)?;
    if u16::from_le_bytes([a, b]) != MAGIC {
        return Err(malformed("the file is not one of serialized meshes"));
    }
    match u16::from_le_bytes([c, d]) {
        version @ (3 | 4) => Ok(version),
        version => Err(malformed(&format!("version {version} is not read; 3 and 4 are"))),
    }
}

/// Where a mesh starts: the end of the file has the starts of all, in words of 4 or 8 bytes, and their
/// number.
fn start_of<R: Read + Seek>(
    file: &mut BufReader<R>,
    bytes: u64,
    version: u16,
    index: u32,
) -> Result<u64, MeshError> {
    file.seek(SeekFrom::End(-4)).map_err(broken)?;
    let count = u32::from_le_bytes(array(file)?);
    if index >= count {
        return Err(malformed(&format!("there is no mesh {index}: the file has {count}, from 0")));
    }
    let word = if version == 3 { 4 } else { 8 };
    let back = 4 + word * u64::from(count - index);
    let place =
        bytes.checked_sub(back).ok_or_else(|| malformed("the list of meshes is longer than the file"))?;
    file.seek(SeekFrom::Start(place)).map_err(broken)?;
    if version == 3 {
        array(file).map(u32::from_le_bytes).map(u64::from)
    } else {
        array(file).map(u64::from_le_bytes)
    }
}

/// A compressed mesh.
struct Stream<R> {
    from: R,
    /// The most bytes that can come out of the file.
    most: u64,
}

impl<R: Read> Stream<R> {
    fn mesh(mut self, version: u16) -> Result<Mesh, MeshError> {
        let flags = u32::from_le_bytes(array(&mut self.from)?);
        if version == 4 {
            while array(&mut self.from)? != [0] {}
        }
        let vertices = u64::from_le_bytes(array(&mut self.from)?);
        let triangles = u64::from_le_bytes(array(&mut self.from)?);
        let has = |bit: u32| flags & bit != 0;
        let scalar = if has(flag::DOUBLE) { 8 } else { 4 };
        let scalars = 3
            + if has(flag::NORMALS) { 3 } else { 0 }
            + if has(flag::UVS) { 2 } else { 0 }
            + if has(flag::COLOURS) { 3 } else { 0 };
        self.check("vertex", vertices, scalar * scalars)?;
        self.check("triangle", triangles, 12)?;
        let mut mesh = Mesh { positions: self.vectors(vertices, scalar)?, ..Mesh::default() };
        if has(flag::NORMALS) {
            mesh.normals = self.vectors(vertices, scalar)?;
        }
        if has(flag::UVS) {
            mesh.uvs = self.list(vertices, |s, vertex| {
                Ok(Vec2::new(s.number(scalar, vertex)?, s.number(scalar, vertex)?))
            })?;
        }
        if has(flag::COLOURS) {
            self.skip(vertices * 3 * scalar)?;
        }
        mesh.triangles = self.list(triangles, |s, face| {
            let corners = [s.index(vertices, face)?, s.index(vertices, face)?, s.index(vertices, face)?];
            Ok(corners)
        })?;
        Ok(mesh)
    }

    /// Refuses a count that cannot have been compressed into the file, or that indices cannot hold.
    fn check(&self, element: &str, count: u64, bytes_each: u64) -> Result<(), MeshError> {
        if count <= u64::from(u32::MAX) && count.saturating_mul(bytes_each) <= self.most {
            return Ok(());
        }
        let bytes = self.most / MOST_COMPRESSION;
        Err(MeshError::Count { element: String::from(element), count, bytes })
    }

    /// As many of something as are promised; room is made when they come.
    fn list<T>(
        &mut self,
        count: u64,
        mut one: impl FnMut(&mut Self, usize) -> Result<T, MeshError>,
    ) -> Result<Vec<T>, MeshError> {
        let mut list = Vec::with_capacity(count.min(MOST_RESERVED) as usize);
        for i in 0..count {
            list.push(one(self, i as usize)?);
        }
        Ok(list)
    }

    fn vectors(&mut self, count: u64, scalar: u64) -> Result<Vec<Vec3>, MeshError> {
        self.list(count, |s, vertex| {
            let [x, y, z] = [s.number(scalar, vertex)?, s.number(scalar, vertex)?, s.number(scalar, vertex)?];
            Ok(Vec3::new(x, y, z))
        })
    }

    /// A finite number.
    fn number(&mut self, scalar: u64, vertex: usize) -> Result<f32, MeshError> {
        let number = if scalar == 8 {
            f64::from_le_bytes(array(&mut self.from)?) as f32
        } else {
            f32::from_le_bytes(array(&mut self.from)?)
        };
        if number.is_finite() { Ok(number) } else { Err(MeshError::NotFinite { vertex }) }
    }

    /// The index of a corner.
    fn index(&mut self, vertices: u64, face: usize) -> Result<u32, MeshError> {
        let index = u32::from_le_bytes(array(&mut self.from)?);
        if u64::from(index) < vertices {
            return Ok(index);
        }
        Err(MeshError::Index { face, index: index.into(), vertices: vertices as usize })
    }

    fn skip(&mut self, bytes: u64) -> Result<(), MeshError> {
        let skipped = io::copy(&mut (&mut self.from).take(bytes), &mut io::sink()).map_err(broken)?;
        if skipped == bytes { Ok(()) } else { Err(broken(ErrorKind::UnexpectedEof.into())) }
    }
}

/// The next bytes.
fn array<const N: usize>(from: &mut impl Read) -> Result<[u8; N], MeshError> {
    let mut bytes = [0; N];
    from.read_exact(&mut bytes).map_err(broken)?;
    Ok(bytes)
}

fn malformed(what: &str) -> MeshError {
    MeshError::Malformed { line: None, what: what.to_string() }
}

fn broken(error: io::Error) -> MeshError {
    match error.kind() {
        ErrorKind::UnexpectedEof => malformed("the file ends in the middle of a mesh"),
        _ => malformed(&format!("the compressed data cannot be read: {error}")),
    }
}

#[cfg(test)]
mod tests;
