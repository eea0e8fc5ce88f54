//! `lanterns`: a courtyard at night under strings of lanterns.

use super::author::{Author, BuiltinError, Channels, Shot};
use super::mesh::{Pose, Tube, append, arc, cuboid, lathe, portal, rounded_box, tube};
use crate::build::{Description, Geometry, Mesh};
use crate::light::{AnyLight, Constant};
use crate::num;
use crate::shape::{AnyShape, Sphere};
use glam::{Vec2, Vec3};
use std::format;
use std::vec::Vec;

/// Strings across the yard, and lanterns on each.
const STRINGS: u32 = 9;
const PER_STRING: u32 = 7;
/// Half the width of the yard, and its far end [m].
const SIDE: f32 = 4.5;
const END: f32 = -12.0;

/// Radiance of the lanterns [W m⁻² sr⁻¹].
const GLOW: [Channels; 5] =
    [[10.0, 3.6, 0.65], [11.0, 1.2, 0.40], [8.5, 1.0, 1.1], [10.5, 5.4, 1.6], [0.7, 4.0, 4.8]];

pub(super) fn make() -> Result<Description, BuiltinError> {
    let mut author = Author::default();
    let paving = author.matte("paving", [0.54, 0.51, 0.49])?;
    let stucco = author.matte("stucco", [0.70, 0.62, 0.54])?;
    let rope = author.matte("rope", [0.10, 0.08, 0.06])?;
    author.mesh("paving", paving_stones(), paving);
    author.mesh("arcades", arcades(), stucco);
    guests(&mut author)?;
    let mut ropes = Mesh::default();
    for string in 0..STRINGS {
        let line = |t: f32| hang(string, t);
        let path: Vec<(Vec3, f32)> = (0..=32).map(|i| (line(i as f32 / 32.0), 0.012)).collect();
        append(&mut ropes, &tube(&path, Tube { sides: 6, closed: false }));
        for i in 0..PER_STRING {
            let number = string * PER_STRING + i;
            let noise = |n: u32| num::unit_f32(num::hash2(number, n));
            let radius = 0.12 + 0.07 * noise(1);
            let at = line((i as f32 + 0.5) / PER_STRING as f32) - Vec3::Y * (radius + 0.01);
            let lantern = Geometry::Shape(AnyShape::Sphere(Sphere::new(at, radius)?));
            let glow = GLOW[(noise(2) * GLOW.len() as f32) as usize % GLOW.len()];
            author.lamp(&format!("lantern-{}", number + 1), lantern, glow)?;
        }
    }
    // What is left of the day.
    author.light(AnyLight::Constant(Constant::new([0.030, 0.055, 0.13].into())?));
    author.mesh("ropes", ropes, rope);
    let shot = Shot::perspective(Vec3::new(-0.8, 1.72, 6.3), Vec3::new(0.1, 1.95, -4.0), 56.0);
    author.scene("lanterns", shot)
}

/// The place at `t` along a string: from wall to wall, criss-cross, sagging.
fn hang(string: u32, t: f32) -> Vec3 {
    let z = 2.2 - 1.5 * string as f32;
    let slant = if string.is_multiple_of(2) { 0.9 } else { -0.9 };
    let x = 2.0 * t - 1.0;
    Vec3::new(SIDE * x, 3.55 - 0.75 * (1.0 - x * x), z + slant * x)
}

/// Large stones with joints.
fn paving_stones() -> Mesh {
    let mut mesh = Pose::at(0.0, -0.56, -3.0).apply(&cuboid(Vec3::new(8.0, 0.5, 12.0)));
    let stone = rounded_box(Vec3::new(0.49, 0.05, 0.49), 0.015, 1);
    for row in 0..20 {
        for column in 0..11 {
            let wobble = num::unit_f32(num::hash2(row, column)) * 0.012;
            let place = Pose::at(column as f32 - 5.0, -0.05 - wobble, 6.0 - row as f32);
            append(&mut mesh, &place.apply(&stone));
        }
    }
    mesh
}

/// Arches along three sides, with a cornice.
fn arcades() -> Mesh {
    let mut mesh = Mesh::default();
    let arch = portal(1.0, 3.9, 0.68, 1.9, 0.25);
    for i in 0..9 {
        let z = 5.5 - 2.0 * i as f32;
        for side in [-1.0, 1.0] {
            let place = Pose::at(side * (SIDE + 0.25), -0.05, z).turned(Vec3::Y, 90.0);
            append(&mut mesh, &place.apply(&arch));
        }
    }
    for i in 0..5 {
        append(&mut mesh, &Pose::at(2.0 * i as f32 - 4.0, -0.05, END).apply(&arch));
    }
    let cornice = |half: Vec3| rounded_box(half, 0.03, 2);
    for side in [-1.0, 1.0] {
        let place = Pose::at(side * (SIDE + 0.22), 3.95, -3.0);
        append(&mut mesh, &place.apply(&cornice(Vec3::new(0.36, 0.1, 9.3))));
    }
    append(&mut mesh, &Pose::at(0.0, 3.96, END + 0.05).apply(&cornice(Vec3::new(5.2, 0.1, 0.36))));
    // Closed behind: the walls of the walk around the yard.
    for side in [-1.0, 1.0] {
        append(&mut mesh, &Pose::at(side * 7.2, 2.0, -4.0).apply(&cuboid(Vec3::new(0.1, 2.2, 11.0))));
    }
    append(&mut mesh, &Pose::at(0.0, 2.0, END - 2.4).apply(&cuboid(Vec3::new(8.0, 2.3, 0.1))));
    mesh
}

/// Guests in groups, as (x, z, scale), dressed in a few colours.
fn guests(author: &mut Author) -> Result<(), BuiltinError> {
    const PLACES: [(f32, f32, f32); 17] = [
        (-2.3, 1.5, 1.0),
        (-1.75, 1.05, 0.93),
        (-2.55, 0.75, 1.05),
        (1.5, 2.3, 0.98),
        (2.15, 2.0, 1.04),
        (0.2, -0.6, 0.62),
        (0.65, -0.9, 1.0),
        (1.1, -0.35, 0.94),
        (3.0, -1.6, 1.0),
        (-3.2, -2.4, 1.03),
        (-2.7, -2.9, 0.96),
        (-0.9, -3.9, 1.0),
        (-0.3, -4.3, 0.94),
        (2.2, -4.6, 1.02),
        (2.7, -5.0, 0.6),
        (-1.9, -6.8, 1.0),
        (0.9, -7.4, 0.97),
    ];
    const CLOTHES: [(&str, Channels); 4] = [
        ("linen", [0.72, 0.68, 0.60]),
        ("indigo", [0.10, 0.14, 0.30]),
        ("madder", [0.46, 0.10, 0.09]),
        ("sage", [0.30, 0.38, 0.24]),
    ];
    let figure = lathe(&figure(), 26);
    for (first, (name, colour)) in CLOTHES.into_iter().enumerate() {
        let material = author.glossy(name, colour, 0.06, 30.0)?;
        let mut group = Mesh::default();
        for (x, z, scale) in PLACES.into_iter().skip(first).step_by(CLOTHES.len()) {
            append(&mut group, &Pose::at(x, 0.0, z).scaled(scale).apply(&figure));
        }
        author.mesh(&format!("guests-in-{name}"), group, material);
    }
    Ok(())
}

/// A figure like a pawn, 1.7 m tall.
fn figure() -> Vec<Vec2> {
    let mut p: Vec<Vec2> = std::vec![Vec2::ZERO, Vec2::new(0.34, 0.0)];
    let robe =
        [(0.34, 0.0), (0.36, 0.03), (0.33, 0.1), (0.22, 0.55), (0.15, 1.0), (0.11, 1.28), (0.15, 1.36)];
    p.extend(super::mesh::spline(&robe.map(Vec2::from), 3));
    p.extend([Vec2::new(0.155, 1.375), Vec2::new(0.075, 1.395)]);
    p.extend(arc(Vec2::new(0.0, 1.54), 0.165, -61.0, 90.0, 12));
    if let Some(tip) = p.last_mut() {
        tip.x = 0.0;
    }
    p
}
