//! `gallery`: sculptures in a room that the sky lights through four windows.

use super::author::{Author, BuiltinError, Shot};
use super::mesh::{Pose, Tube, append, arc, cuboid, knot, lathe, portal, rounded_box, spline, tube};
use crate::build::{Description, Mesh, Sky};
use crate::light::Portal;
use crate::shape::Rectangle;
use glam::{Vec2, Vec3};
use std::vec::Vec;

/// Half the room's extent inside (m), and its height.
const HALF: [f32; 2] = [3.6, 2.6];
const HEIGHT: f32 = 3.4;
/// Half the thickness of floor and walls (m).
const THICK: f32 = 0.15;

/// The windows: height of their sill, half the width of an opening, from the sill to where its arch
/// begins, and half the distance from one to the next (m).
const SILL: f32 = 0.75;
const RADIUS: f32 = 0.42;
const SPRINGING: f32 = 1.6;
const PITCH: f32 = 0.5 * HALF[1];

pub(super) fn make() -> Result<Description, BuiltinError> {
    let mut author = Author::default();
    let plaster = author.matte("plaster", [0.78, 0.75, 0.70])?;
    let boards = author.matte("boards", [0.46, 0.32, 0.21])?;
    let stone = author.matte("stone", [0.64, 0.62, 0.58])?;
    let marble = author.glossy("marble", [0.74, 0.72, 0.68], 0.08, 80.0)?;
    let bronze = author.metal("bronze", [0.62, 0.42, 0.24], 0.28)?;
    let [x, z] = HALF;
    let slab = |y: f32| Pose::at(0.0, y, 0.0).apply(&cuboid(Vec3::new(x + 0.4, THICK, z + 0.4)));
    author.mesh("floor", slab(-THICK), boards);
    let lawn = author.matte("lawn", [0.20, 0.26, 0.10])?;
    author.mesh("lawn", Pose::at(-40.0, -0.6, 0.0).apply(&cuboid(Vec3::new(36.0, 0.1, 60.0))), lawn);
    author.mesh("walls", walls(slab(HEIGHT + THICK)), plaster);
    author.mesh("plinths", plinths(), stone);
    let ring = tube(&knot(2, 3, [0.27, 0.12], 0.065, 256), Tube { sides: 32, closed: true });
    author.mesh("knot", Pose::at(-1.5, 1.36, -0.3).turned(Vec3::X, 70.0).apply(&ring), bronze);
    author.mesh("vase", Pose::at(0.55, 0.8, -1.5).apply(&lathe(&vase(), 96)), marble);
    author.mesh("ball", Pose::at(0.5, 0.45, 0.55).apply(&lathe(&ball(0.45), 96)), marble);
    let shot = Shot::perspective(Vec3::new(3.3, 1.75, 2.3), Vec3::new(-1.3, 1.15, -0.9), 68.0);
    let mut description = author.scene("gallery", shot)?;
    // A room is darker than a day: the exposure is one for indoors.
    Sky::new(33.0, 247.0, 2.5)?.scaled(6.0 * Sky::EXPOSED).surround(&mut description)?;
    for place in windows() {
        let middle = Vec3::new(-x, SILL + 0.5 * (SPRINGING + RADIUS), place);
        let opening = Rectangle::new(middle, Vec3::Y * (0.5 * (SPRINGING + RADIUS)), Vec3::Z * RADIUS)?;
        description.portals.push(Portal::new(opening)?);
    }
    Ok(description)
}

/// Where along the wall each window is.
fn windows() -> [f32; 4] {
    [-1.5, -0.5, 0.5, 1.5].map(|i: f32| i * PITCH)
}

/// Three walls, the one with the windows, and the ceiling.
fn walls(ceiling: Mesh) -> Mesh {
    let mut mesh = ceiling;
    let [x, z] = HALF;
    let mut block = |[cx, cy, cz]: [f32; 3], half: [f32; 3]| {
        append(&mut mesh, &Pose::at(cx, cy, cz).apply(&cuboid(half.into())));
    };
    let half_height = 0.5 * HEIGHT;
    for side in [-1.0, 1.0] {
        block([0.0, half_height, side * (z + THICK)], [x + 0.4, half_height, THICK]);
    }
    block([x + THICK, half_height, 0.0], [THICK, half_height, z]);
    block([-x - THICK, 0.5 * SILL, 0.0], [THICK, 0.5 * SILL, z]);
    let arch = portal(0.5 * PITCH, HEIGHT - SILL, RADIUS, SPRINGING, THICK);
    for place in windows() {
        append(&mut mesh, &Pose::at(-x - THICK, SILL, place).turned(Vec3::Y, 90.0).apply(&arch));
    }
    mesh
}

/// What the sculptures stand on.
fn plinths() -> Mesh {
    let mut mesh = Mesh::default();
    for ([x, z], half) in [([-1.5, -0.3], [0.3, 0.45, 0.3]), ([0.55, -1.5], [0.32, 0.4, 0.32])] {
        append(&mut mesh, &Pose::at(x, half[1], z).apply(&rounded_box(half.into(), 0.015, 2)));
    }
    mesh
}

/// A tall vase.
fn vase() -> Vec<Vec2> {
    let mut p: Vec<Vec2> = [(0.0, 0.0), (0.13, 0.0), (0.13, 0.03)].map(Vec2::from).to_vec();
    p.extend(spline(
        &[(0.08, 0.08), (0.19, 0.36), (0.22, 0.58), (0.12, 0.82), (0.09, 0.92), (0.14, 1.02)].map(Vec2::from),
        8,
    ));
    p.extend([(0.12, 1.02), (0.07, 0.92), (0.0, 0.9)].map(Vec2::from));
    p
}

/// The outline of a ball.
fn ball(radius: f32) -> Vec<Vec2> {
    let mut half = arc(Vec2::ZERO, radius, -90.0, 90.0, 48);
    if let [first, .., last] = half.as_mut_slice() {
        (first.x, last.x) = (0.0, 0.0);
    }
    half
}
