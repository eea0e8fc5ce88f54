//! `contact`: lamps that all but touch what they light.

use super::author::{Author, BuiltinError, Shot};
use super::mesh::{Pose, append, arc, lathe, rounded_box, sheet};
use crate::build::{Description, Geometry, Mesh};
use crate::shape::{AnyShape, Cylinder, Disk, Rectangle, Sphere};
use glam::{Vec2, Vec3};
use std::vec::Vec;

/// Warm white, and a cooler one.
const WARM: [f32; 3] = [1.0, 0.62, 0.34];
const COOL: [f32; 3] = [0.62, 0.80, 1.0];

pub(super) fn make() -> Result<Description, BuiltinError> {
    let mut author = Author::default();
    let plaster = author.matte("plaster", [0.68, 0.66, 0.63])?;
    let oak = author.glossy("oak", [0.34, 0.20, 0.10], 0.04, 60.0)?;
    let slate = author.glossy("slate", [0.09, 0.10, 0.11], 0.12, 120.0)?;
    let chalk = author.matte("chalk", [0.74, 0.72, 0.68])?;
    let floor = [Vec2::new(6.0, 0.0), Vec2::new(0.0, 0.0), Vec2::new(0.0, 4.0)];
    author.mesh("room", sheet(&floor, 5.0), plaster);
    eclipse(&mut author, slate)?;
    bench(&mut author, oak, chalk)?;
    // A ball that lies on the floor: it touches in a point.
    let ball = Sphere::new(Vec3::new(0.28, 0.1701, 0.75), 0.17)?;
    author.lamp("ball", Geometry::Shape(AnyShape::Sphere(ball)), WARM.map(|c| 13.0 * c))?;
    // A tube along the wall, 2 mm in front of it.
    let tube = Cylinder::new(Vec3::new(-1.52, 0.25, 0.014), Vec3::new(0.0, 1.75, 0.0), 0.012)?;
    author.lamp("tube", Geometry::Shape(AnyShape::Cylinder(tube)), COOL.map(|c| 34.0 * c))?;
    let shot = Shot::perspective(Vec3::new(0.0, 1.12, 4.9), Vec3::new(0.0, 0.93, 0.0), 42.0);
    author.scene("contact", shot)
}

/// A round plate with a lamp behind it that faces the wall, 2 cm away.
fn eclipse(author: &mut Author, material: usize) -> Result<(), BuiltinError> {
    let (centre, radius) = (Vec3::new(-0.42, 1.3, 0.0), 0.36);
    let plate = [(0.0, 0.0), (radius, 0.0), (radius, 0.02), (0.0, 0.02)].map(Vec2::from);
    let pose = Pose::at(centre.x, centre.y, 0.021).turned(Vec3::X, 90.0);
    author.mesh("plate", pose.apply(&lathe(&plate, 160)), material);
    let r = radius - 0.01;
    let lamp = Disk::new(centre.with_z(0.02), Vec3::Y * r, Vec3::X * r)?;
    author.lamp("eclipse", Geometry::Shape(AnyShape::Disk(lamp)), WARM.map(|c| 90.0 * c))
}

/// A bench on the wall with a strip of light along its back edge, and things on it.
fn bench(author: &mut Author, board: usize, things: usize) -> Result<(), BuiltinError> {
    let (x, y) = (1.05, 0.78);
    let plank = rounded_box(Vec3::new(0.62, 0.03, 0.2), 0.008, 3);
    author.mesh("board", Pose::at(x, y, 0.201).apply(&plank), board);
    let strip = Rectangle::new(Vec3::new(x, y + 0.031, 0.012), Vec3::Z * 0.008, Vec3::X * 0.58)?;
    author.lamp("strip", Geometry::Shape(AnyShape::Rectangle(strip)), COOL.map(|c| 160.0 * c))?;
    author.mesh("things", figures(x, y + 0.0299), things);
    Ok(())
}

/// Two bottles and a ball.
fn figures(x: f32, y: f32) -> Mesh {
    let mut mesh = Mesh::default();
    for (dx, scale) in [(-0.36, 1.0), (-0.14, 0.72)] {
        append(&mut mesh, &Pose::at(x + dx, y, 0.2).scaled(scale).apply(&lathe(&flask(), 64)));
    }
    let mut half = arc(Vec2::ZERO, 0.09, -90.0, 90.0, 32);
    if let [first, .., last] = half.as_mut_slice() {
        (first.x, last.x) = (0.0, 0.0);
    }
    append(&mut mesh, &Pose::at(x + 0.28, y + 0.09, 0.2).apply(&lathe(&half, 64)));
    mesh
}

/// A flask with a long neck.
fn flask() -> Vec<Vec2> {
    let mut p: Vec<Vec2> = std::vec![Vec2::ZERO, Vec2::new(0.06, 0.0)];
    p.extend(super::mesh::spline(
        &[
            (0.06, 0.0),
            (0.085, 0.03),
            (0.09, 0.08),
            (0.055, 0.15),
            (0.022, 0.21),
            (0.02, 0.34),
            (0.028, 0.36),
        ]
        .map(Vec2::from),
        6,
    ));
    p.push(Vec2::new(0.0, 0.355));
    p
}
