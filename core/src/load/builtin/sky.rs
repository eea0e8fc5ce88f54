//! `sky` and `morning`: a small town of clay, under an even sky and on a clear day.

use super::author::{Author, BuiltinError, Shot};
use super::mesh::{Pose, append, arc, cuboid, lathe, portal, rounded_box, spline};
use crate::build::{Description, Mesh, Sky};
use crate::light::{AnyLight, Constant};
use crate::num::{self, TAU};
use glam::{Vec2, Vec3};
use std::vec::Vec;

/// The town under an even sky.
pub(super) fn make() -> Result<Description, BuiltinError> {
    let mut author = town()?;
    author.light(AnyLight::Constant(Constant::new([1.05, 1.12, 1.2].into())?));
    author.scene("sky", shot())
}

/// The town on a clear morning.
pub(super) fn make_morning() -> Result<Description, BuiltinError> {
    let mut description = town()?.scene("morning", shot())?;
    // Lets what lies in the sun be near white.
    Sky::new(35.0, 235.0, 2.5)?.scaled(1.6 * Sky::EXPOSED).surround(&mut description)?;
    Ok(description)
}

fn shot() -> Shot {
    let to = Vec3::new(0.1, 2.0, 0.0);
    Shot::orthographic(to + Vec3::new(9.0, 8.2, 12.0), to, 6.95)
}

fn town() -> Result<Author, BuiltinError> {
    let mut author = Author::default();
    let clay = author.matte("clay", [0.80, 0.775, 0.74])?;
    let tile = author.matte("tile", [0.70, 0.36, 0.25])?;
    let ground = author.matte("ground", [0.62, 0.66, 0.68])?;
    author.mesh("ground", Pose::at(0.0, -0.5, 0.0).apply(&cuboid(Vec3::new(60.0, 0.5, 60.0))), ground);
    author.mesh("terraces", terraces(), clay);
    author.mesh("temple", temple(), clay);
    author.mesh("dome", Pose::at(1.6, 3.02, -1.6).apply(&lathe(&dome(), 96)), tile);
    author.mesh("arcade", arcade(), clay);
    author.mesh("stairs", stairs(), clay);
    author.mesh("tower", tower(), clay);
    author.mesh("spire", Pose::at(-2.7, 3.85, -2.4).turned(Vec3::Y, 45.0).apply(&lathe(&spire(), 4)), tile);
    let leaf = author.matte("leaf", [0.30, 0.40, 0.24])?;
    author.mesh("cypresses", cypresses(), leaf);
    author.mesh("fountain", fountain(), clay);
    Ok(author)
}

/// A block that stands on height `y`.
fn block(mesh: &mut Mesh, [x, y, z]: [f32; 3], half: [f32; 3]) {
    let half = Vec3::from(half);
    append(mesh, &Pose::at(x, y + half.y, z).apply(&rounded_box(half, 0.025, 2)));
}

fn terraces() -> Mesh {
    let mut mesh = Mesh::default();
    block(&mut mesh, [0.0, -0.02, 0.0], [4.2, 0.16, 4.2]);
    block(&mut mesh, [0.4, 0.28, -1.2], [3.6, 0.4, 2.8]);
    mesh
}

/// A round temple: steps, a ring of columns and an entablature.
fn temple() -> Mesh {
    let mut mesh = Mesh::default();
    let centre = Pose::at(1.6, 1.08, -1.6);
    for (i, radius) in [1.55, 1.42, 1.29].into_iter().enumerate() {
        append(&mut mesh, &Pose::at(1.6, 1.08 + 0.1 * i as f32, -1.6).apply(&lathe(&drum(radius, 0.1), 96)));
    }
    let column = lathe(&column(), 32);
    let count = 10;
    for i in 0..count {
        let (sin, cos) = num::sin_cos(TAU * ((i as f32 + 0.5) / count as f32));
        let p = centre.point(Vec3::new(1.08 * cos, 0.3, 1.08 * sin));
        append(&mut mesh, &Pose::at(p.x, p.y, p.z).apply(&column));
    }
    let ring = [(0.92, 1.64), (1.2, 1.64), (1.2, 1.8), (1.3, 1.84), (1.3, 1.94), (0.92, 1.94), (0.92, 1.64)];
    append(&mut mesh, &centre.apply(&lathe(&ring.map(Vec2::from), 96)));
    let cella = [(0.0, 0.3), (0.62, 0.3), (0.62, 1.9), (0.0, 1.9)];
    append(&mut mesh, &centre.apply(&lathe(&cella.map(Vec2::from), 64)));
    mesh
}

/// A flat drum standing on y = 0.
fn drum(radius: f32, height: f32) -> [Vec2; 4] {
    [(0.0, 0.0), (radius, 0.0), (radius, height), (0.0, height)].map(Vec2::from)
}

/// A column of height 1.34 with a base, a swelling and a capital.
fn column() -> Vec<Vec2> {
    let mut p: Vec<Vec2> = [(0.0, 0.0), (0.135, 0.0), (0.135, 0.05)].into_iter().map(Vec2::from).collect();
    p.extend(arc(Vec2::new(0.115, 0.075), 0.022, -80.0, 80.0, 8));
    for i in 0..=8 {
        let t = i as f32 / 8.0;
        p.push(Vec2::new(0.098 - 0.022 * t * t, 0.11 + 1.08 * t));
    }
    p.extend([(0.085, 1.2), (0.125, 1.27), (0.14, 1.275), (0.14, 1.345), (0.0, 1.345)].map(Vec2::from));
    p
}

/// A dome with a lantern.
fn dome() -> Vec<Vec2> {
    let mut p: Vec<Vec2> = [(0.0, 0.0), (1.24, 0.0), (1.24, 0.06)].into_iter().map(Vec2::from).collect();
    p.extend(arc(Vec2::new(0.0, 0.06), 1.14, 0.0, 82.0, 40));
    p.extend([(0.16, 1.36), (0.21, 1.37), (0.21, 1.42)].map(Vec2::from));
    p.extend(arc(Vec2::new(0.0, 1.42), 0.19, 0.0, 90.0, 12));
    if let Some(tip) = p.last_mut() {
        tip.x = 0.0;
    }
    p
}

/// Arches in a row, with a parapet.
fn arcade() -> Mesh {
    let mut mesh = Mesh::default();
    let arch = portal(0.5, 1.5, 0.34, 0.72, 0.16);
    for i in 0..4 {
        let x = -3.05 + i as f32;
        append(&mut mesh, &Pose::at(x, 0.3, 3.35).apply(&arch));
    }
    block(&mut mesh, [-1.55, 1.79, 3.35], [2.08, 0.05, 0.22]);
    for i in 0..3 {
        let z = 2.85 - i as f32;
        append(&mut mesh, &Pose::at(-3.45, 0.3, z).turned(Vec3::Y, 90.0).apply(&arch));
    }
    block(&mut mesh, [-3.45, 1.79, 1.95], [0.22, 0.05, 1.62]);
    mesh
}

/// A flight up to the terrace.
fn stairs() -> Mesh {
    let mut mesh = Mesh::default();
    let steps = 8;
    for i in 0..steps {
        let height = 0.4 * (steps - i) as f32 / (steps + 1) as f32;
        block(&mut mesh, [1.6, 0.28, 1.68 + 0.16 * i as f32], [0.95, height, 0.08]);
    }
    for x in [0.55, 2.65] {
        block(&mut mesh, [x, 0.28, 2.24], [0.1, 0.48, 0.72]);
    }
    mesh
}

/// A square tower with a belfry.
fn tower() -> Mesh {
    let mut mesh = Mesh::default();
    block(&mut mesh, [-2.7, 0.28, -2.4], [0.75, 1.1, 0.75]);
    block(&mut mesh, [-2.7, 2.46, -2.4], [0.85, 0.06, 0.85]);
    let arch = portal(0.68, 1.2, 0.36, 0.62, 0.09);
    for i in 0..4 {
        let pose = Pose::at(0.0, 0.0, 0.59);
        let turn = Pose::at(-2.7, 2.56, -2.4).turned(Vec3::Y, 90.0 * i as f32);
        append(&mut mesh, &turn.apply(&pose.apply(&arch)));
    }
    block(&mut mesh, [-2.7, 3.74, -2.4], [0.8, 0.06, 0.8]);
    mesh
}

/// Slender trees, as (x, y, z, scale).
fn cypresses() -> Mesh {
    let outline = [
        (0.0, 0.0),
        (0.04, 0.0),
        (0.045, 0.12),
        (0.2, 0.2),
        (0.27, 0.5),
        (0.22, 1.0),
        (0.1, 1.55),
        (0.0, 1.8),
    ];
    let tree = lathe(&spline(&outline.map(Vec2::from), 5), 40);
    let mut mesh = Mesh::default();
    for (x, y, z, scale) in [
        (3.5, 1.08, 1.1, 0.9),
        (3.55, 1.08, 0.3, 1.1),
        (3.5, 1.08, -3.5, 1.2),
        (-0.9, 1.08, -3.5, 1.05),
        (-0.2, 1.08, -3.6, 0.85),
        (3.75, 0.3, 2.2, 0.8),
        (-3.7, 0.3, -3.7, 1.0),
    ] {
        append(&mut mesh, &Pose::at(x, y, z).scaled(scale).apply(&tree));
    }
    mesh
}

/// A basin with a bowl on a foot.
fn fountain() -> Mesh {
    let basin = [(0.0, 0.0), (0.62, 0.0), (0.62, 0.2), (0.54, 0.2), (0.54, 0.1), (0.1, 0.1), (0.06, 0.42)];
    let mut p: Vec<Vec2> = basin.into_iter().map(Vec2::from).collect();
    p.extend(spline(
        &[(0.06, 0.42), (0.2, 0.46), (0.3, 0.56), (0.27, 0.56), (0.1, 0.5), (0.0, 0.49)].map(Vec2::from),
        5,
    ));
    Pose::at(-0.75, 1.06, 0.45).apply(&lathe(&p, 64))
}

/// A steep roof.
fn spire() -> [Vec2; 4] {
    [(0.0, 0.0), (1.12, 0.0), (0.02, 1.1), (0.0, 1.1)].map(Vec2::from)
}
