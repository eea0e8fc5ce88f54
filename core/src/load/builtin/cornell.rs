//! `cornell`: the box that renderers are compared in.

use super::author::{Author, BuiltinError, Shot};
use crate::build::{Description, Geometry, Mesh};
use crate::shape::{AnyShape, Rectangle};
use glam::Vec3;

/// Corners of a wall in millimetres, counter-clockwise seen from inside.
///
/// Source: the Cornell Program of Computer Graphics, *Cornell Box Data* (measured).
const WALLS: [(&str, usize, [[f32; 3]; 4]); 5] = [
    ("floor", 0, [[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]]),
    ("ceiling", 0, [[556.0, 548.8, 0.0], [556.0, 548.8, 559.2], [0.0, 548.8, 559.2], [0.0, 548.8, 0.0]]),
    ("back-wall", 0, [[549.6, 0.0, 559.2], [0.0, 0.0, 559.2], [0.0, 548.8, 559.2], [556.0, 548.8, 559.2]]),
    ("right-wall", 1, [[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, 548.8, 0.0], [0.0, 548.8, 559.2]]),
    ("left-wall", 2, [[552.8, 0.0, 0.0], [549.6, 0.0, 559.2], [556.0, 548.8, 559.2], [556.0, 548.8, 0.0]]),
];

/// Corners of the tops of the two blocks in millimetres, counter-clockwise seen from above.
const BLOCKS: [(&str, f32, [[f32; 2]; 4]); 2] = [
    ("short-block", 165.0, [[130.0, 65.0], [82.0, 225.0], [240.0, 272.0], [290.0, 114.0]]),
    ("tall-block", 330.0, [[423.0, 247.0], [265.0, 296.0], [314.0, 456.0], [472.0, 406.0]]),
];

const METRE: f32 = 1e-3;

pub(super) fn make() -> Result<Description, BuiltinError> {
    let mut author = Author::default();
    let white = author.matte("white", [0.740, 0.742, 0.734])?;
    let green = author.matte("green", [0.159, 0.366, 0.087])?;
    let red = author.matte("red", [0.571, 0.043, 0.044])?;
    for (name, material, corners) in WALLS {
        author.mesh(name, quads(&[corners]), [white, green, red][material]);
    }
    for (name, height, top) in BLOCKS {
        author.mesh(name, block(height, top), white);
    }
    // 130 mm × 105 mm in the ceiling; a hair below it, so that it is not the ceiling.
    let lamp = Rectangle::new(
        Vec3::new(278.0, 548.6, 279.5) * METRE,
        Vec3::X * (65.0 * METRE),
        Vec3::Z * (52.5 * METRE),
    )?;
    author.lamp("lamp", Geometry::Shape(AnyShape::Rectangle(lamp)), [62.0, 54.0, 42.0])?;
    let eye = Vec3::new(278.0, 273.0, -800.0) * METRE;
    let fov = 39.3;
    let shot = Shot { size: [640, 640], ..Shot::perspective(eye, eye + Vec3::Z, fov) };
    author.scene("cornell", shot)
}

/// Flat faces from corners in millimetres.
fn quads(faces: &[[[f32; 3]; 4]]) -> Mesh {
    let mut mesh = Mesh::default();
    for face in faces {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(face.map(|c| Vec3::from(c) * METRE));
        mesh.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i| first + i)));
    }
    mesh
}

/// A block from the floor up; all six sides, so that it is closed.
fn block(height: f32, top: [[f32; 2]; 4]) -> Mesh {
    let at = |i: usize, y: f32| [top[i % 4][0], y, top[i % 4][1]];
    let mut faces = std::vec![
        [at(0, height), at(1, height), at(2, height), at(3, height)],
        [at(3, 0.0), at(2, 0.0), at(1, 0.0), at(0, 0.0)],
    ];
    faces.extend((0..4).map(|i| [at(i, 0.0), at(i + 1, 0.0), at(i + 1, height), at(i, height)]));
    quads(&faces)
}
