//! OBJ files: positions, normals, texture coordinates and faces; everything else in them is left to
//! others.
//!
//! All groups and objects of a file become one mesh, as in Mitsuba 3, so that computed normals are
//! smooth across them. A corner is shared where faces give the same position, texture coordinate and
//! normal.

use super::{Files, MeshError};
use crate::build::Mesh;
use glam::{Vec2, Vec3};
use std::collections::HashMap;
use std::io::{self, BufRead};
use std::path::Path;
use std::string::{String, ToString};
use std::vec::Vec;

/// Reads a mesh. Polygons become fans of triangles.
///
/// # Errors
/// The outer error is about the file, the inner one about what is in it.
pub(super) fn read(files: &Files, path: &Path) -> io::Result<Result<Mesh, MeshError>> {
    let (mut reader, _) = files.open(path)?;
    let (mut obj, mut line) = (Obj::default(), Vec::new());
    while reader.read_until(b'\n', &mut line)? > 0 {
        obj.line += 1;
        // Names may be in any encoding; numbers are ASCII.
        if let Err(error) = obj.take(&String::from_utf8_lossy(&line)) {
            return Ok(Err(error));
        }
        line.clear();
    }
    Ok(obj.finish())
}

/// Position, texture coordinate and normal of a corner; −1 where there is none.
type Corner = [i64; 3];

/// What has been read so far.
#[derive(Debug, Default)]
struct Obj {
    line: usize,
    positions: Vec<Vec3>,
    uvs: Vec<Vec2>,
    normals: Vec<Vec3>,
    corners: HashMap<Corner, u32>,
    mesh: Mesh,
    /// True when a corner has no normal.
    without_normal: bool,
    /// True when a corner has texture coordinates.
    with_uvs: bool,
}

impl Obj {
    fn take(&mut self, line: &str) -> Result<(), MeshError> {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let position = self.vector(words)?;
                self.positions.push(position);
            }
            Some("vn") => {
                let normal = self.vector(words)?;
                self.normals.push(normal);
            }
            Some("vt") => {
                let [u, v] = self.numbers(words, "two texture coordinates are needed")?;
                self.uvs.push(Vec2::new(u, v));
            }
            Some("f") => self.face(words)?,
            _ => {}
        }
        Ok(())
    }

    fn malformed(&self, what: &str) -> MeshError {
        MeshError::Malformed { line: Some(self.line), what: what.to_string() }
    }

    fn vector<'w>(&self, words: impl Iterator<Item = &'w str>) -> Result<Vec3, MeshError> {
        self.numbers(words, "three coordinates are needed").map(Vec3::from_array)
    }

    /// The first `N` numbers of a line.
    fn numbers<'w, const N: usize>(
        &self,
        words: impl Iterator<Item = &'w str>,
        needed: &str,
    ) -> Result<[f32; N], MeshError> {
        let numbers: Vec<f32> = words
            .take(N)
            .map(|w| w.parse().ok().filter(|v: &f32| v.is_finite()))
            .collect::<Option<_>>()
            .ok_or_else(|| self.malformed("a coordinate is not a finite number"))?;
        numbers.try_into().map_err(|_| self.malformed(needed))
    }

    fn face<'w>(&mut self, words: impl Iterator<Item = &'w str>) -> Result<(), MeshError> {
        let corners = words.map(|w| self.corner(w)).collect::<Result<Vec<u32>, _>>()?;
        if corners.len() < 3 {
            return Err(self.malformed("a face needs at least 3 corners"));
        }
        let fan = corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]);
        self.mesh.triangles.extend(fan);
        Ok(())
    }

    /// The mesh's index of a corner, written `v`, `v/vt`, `v//vn` or `v/vt/vn`.
    fn corner(&mut self, word: &str) -> Result<u32, MeshError> {
        let lengths = [self.positions.len(), self.uvs.len(), self.normals.len()];
        let mut corner = [-1; 3];
        let mut parts = word.split('/');
        for (index, length) in corner.iter_mut().zip(lengths) {
            if let Some(part) = parts.next().filter(|p| !p.is_empty()) {
                *index = self.index(part, length)?;
            }
        }
        if parts.next().is_some() || corner[0] < 0 {
            return Err(self.malformed("a corner must be v, v/vt, v//vn or v/vt/vn"));
        }
        if let Some(known) = self.corners.get(&corner) {
            return Ok(*known);
        }
        let new = u32::try_from(self.corners.len()).map_err(|_| self.malformed("too many corners"))?;
        self.corners.insert(corner, new);
        self.mesh.positions.push(self.positions[corner[0] as usize]);
        // A corner without them is at the origin of textures; Mitsuba leaves it undefined.
        self.mesh.uvs.push(usize::try_from(corner[1]).map_or(Vec2::ZERO, |uv| self.uvs[uv]));
        self.with_uvs |= corner[1] >= 0;
        match usize::try_from(corner[2]) {
            Ok(normal) => self.mesh.normals.push(self.normals[normal]),
            Err(_) => self.without_normal = true,
        }
        Ok(new)
    }

    /// An index from 0, from one that counts from 1, or backward from −1.
    fn index(&self, text: &str, length: usize) -> Result<i64, MeshError> {
        let written: i64 = text.parse().map_err(|_| self.malformed("a corner's index is not a number"))?;
        let length = length as i64;
        let index = if written < 0 { written.saturating_add(length) } else { written - 1 };
        if (0..length).contains(&index) {
            Ok(index)
        } else {
            Err(self.malformed(&std::format!("index {written} of a corner, where there are {length}")))
        }
    }

    fn finish(mut self) -> Result<Mesh, MeshError> {
        if self.without_normal {
            // Some corners have none: all are computed.
            self.mesh.normals = Vec::new();
        }
        if !self.with_uvs {
            self.mesh.uvs = Vec::new();
        }
        if self.mesh.triangles.is_empty() {
            return Err(MeshError::Missing { what: "faces (lines that start with f) are" });
        }
        Ok(self.mesh)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Mesh, MeshError> {
        let mut obj = Obj::default();
        for line in text.lines() {
            obj.line += 1;
            obj.take(line)?;
        }
        obj.finish()
    }

    const SQUARE: &str = "o a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\n";

    #[test]
    fn polygons_become_fans_and_groups_one_mesh() {
        let mesh = parse(&(SQUARE.to_string() + "g x\nf 1 2 3 4\ng y\nf -4 -3 -1\n")).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 1, 3]]);
        assert!(mesh.normals.is_empty());
    }

    #[test]
    fn corners_with_different_normals_are_different() {
        let mesh = parse(&(SQUARE.to_string() + "vn 1 0 0\nf 1//1 2//1 3//1\nf 1//2 3//1 4//1\n")).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [3, 2, 4]]);
        assert_eq!(mesh.normals[3], Vec3::X);
        assert_eq!(mesh.positions[0], mesh.positions[3]);
    }

    #[test]
    fn normals_for_some_corners_only_are_not_used() {
        assert!(parse(&(SQUARE.to_string() + "f 1//1 2 3\n")).unwrap().normals.is_empty());
    }

    #[test]
    fn texture_coordinates_belong_to_corners() {
        let mesh = parse(&(SQUARE.to_string() + "vt .5 .25\nvt 1 0 0\nf 1/1 2/2 3\nf 1/2 2/2 3\n")).unwrap();
        assert_eq!(mesh.triangles, [[0, 1, 2], [3, 1, 2]]);
        assert_eq!(mesh.uvs, [Vec2::new(0.5, 0.25), Vec2::X, Vec2::ZERO, Vec2::X]);
        assert!(parse(&(SQUARE.to_string() + "vt .5 .25\nf 1 2 3\n")).unwrap().uvs.is_empty());
    }

    #[test]
    fn bad_lines_are_refused_with_their_number() {
        for bad in [
            "f 1 2 5",
            "f 0 1 2",
            "f 1 2 -5",
            "f 1 2 9223372036854775807",
            "f 1 2 -9223372036854775808",
            "f 1//3 2 3",
            "f 1/1/6148914691236517205 2 3",
            "f 1 2",
            "f 1 2 x",
            "f /1 2 3",
            "f 1/1/1/1 2 3",
            "v 1 2",
            "v 1 nan 2",
            "v inf 0 0",
            "vn 0 0",
            "vt 0",
            "vt nan 0",
        ] {
            let result = parse(&(SQUARE.to_string() + bad + "\nf 1 2 3\n"));
            assert!(matches!(result, Err(MeshError::Malformed { line: Some(7), .. })), "{bad}: {result:?}");
        }
        assert!(matches!(parse(SQUARE), Err(MeshError::Missing { .. })));
    }
}
