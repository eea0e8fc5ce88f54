//! `penumbra`: the same spray in four niches, under lamps of growing size.

use super::author::{Author, BuiltinError, Shot};
use super::mesh::{Pose, Tube, append, cuboid, lathe, spline, surface, tube};
use crate::build::{Description, Geometry, Mesh};
use crate::num::{self, PI};
use crate::shape::{AnyShape, Sphere};
use glam::{Vec2, Vec3};
use std::format;
use std::vec::Vec;

/// Radii of the lamps [m]; their power is the same.
const RADII: [f32; 4] = [0.005, 0.03, 0.08, 0.16];
/// Intensity of each lamp [W sr⁻¹].
const INTENSITY: f32 = 2.6;
/// Where a lamp hangs in its niche, and where the vase stands.
const LAMP: Vec3 = Vec3::new(-0.17, 1.76, 0.55);
const VASE: Vec3 = Vec3::new(0.015, 0.0, 0.0);

/// Width of a niche between its walls [m], and of a wall.
const NICHE: f32 = 0.78;
const WALL: f32 = 0.02;
/// Beyond the upper edge of the picture.
const HEIGHT: f32 = 2.6;
/// Depth of the back and of the front of the niches [m].
const BACK: f32 = -0.28;
const FRONT: f32 = 0.85;

pub(super) fn make() -> Result<Description, BuiltinError> {
    let mut author = Author::default();
    let plaster = author.matte("plaster", [0.66, 0.64, 0.61])?;
    let leaf = author.matte("leaf", [0.15, 0.25, 0.08])?;
    let clay = author.glossy("clay", [0.42, 0.15, 0.08], 0.05, 40.0)?;
    author.mesh("niches", niches(), plaster);
    let (spray, vase) = (spray(), lathe(&vase(), 64));
    for (i, radius) in RADII.into_iter().enumerate() {
        let middle = Vec3::X * ((i as f32 - 1.5) * (NICHE + WALL));
        let at = middle + VASE;
        let place = Pose::at(at.x, at.y, at.z).scaled(1.3);
        author.mesh(&format!("spray-{}", i + 1), place.apply(&spray), leaf);
        author.mesh(&format!("vase-{}", i + 1), place.apply(&vase), clay);
        let lamp = Sphere::new(middle + LAMP, radius)?;
        // Intensity π r² L.
        let radiance = [1.0, 0.88, 0.70].map(|c| c * INTENSITY / (PI * radius * radius));
        author.lamp(&format!("lamp-{}", i + 1), Geometry::Shape(AnyShape::Sphere(lamp)), radiance)?;
    }
    // Parallel projection: the niches look alike, but for their shadows.
    let to = Vec3::new(0.0, 0.96, 0.0);
    author.scene("penumbra", Shot::orthographic(to + Vec3::new(0.0, 0.9, 6.0), to, 1.6))
}

/// A wall with partitions, a floor and a lintel.
fn niches() -> Mesh {
    let pitch = NICHE + WALL;
    let wide = 4.0 * pitch + WALL;
    let depth = FRONT - BACK;
    let middle = 0.5 * (FRONT + BACK);
    let mut mesh = Mesh::default();
    let mut block = |centre: Vec3, size: Vec3| {
        append(&mut mesh, &Pose::at(centre.x, centre.y, centre.z).apply(&cuboid(size * 0.5)));
    };
    // Each reaches a little beyond the next, so that no two faces coincide.
    block(Vec3::new(0.0, 0.5 * HEIGHT, BACK - 0.05), Vec3::new(wide + 0.2, HEIGHT + 0.4, 0.1));
    block(Vec3::new(0.0, -0.05, middle), Vec3::new(wide + 0.1, 0.1, depth + 0.05));
    block(Vec3::new(0.0, HEIGHT + 0.05, middle), Vec3::new(wide + 0.1, 0.1, depth + 0.05));
    for i in 0..5 {
        let x = (i as f32 - 2.0) * pitch;
        block(Vec3::new(x, 0.5 * HEIGHT, middle), Vec3::new(WALL, HEIGHT + 0.05, depth + 0.02));
    }
    mesh
}

/// A round vase with a narrow neck.
fn vase() -> Vec<Vec2> {
    let wall = [
        (0.05, 0.0),
        (0.055, 0.008),
        (0.085, 0.06),
        (0.088, 0.10),
        (0.06, 0.15),
        (0.026, 0.18),
        (0.024, 0.205),
        (0.034, 0.225),
        (0.034, 0.229),
        (0.030, 0.229),
        (0.018, 0.205),
        (0.018, 0.18),
    ];
    let mut p: Vec<Vec2> = std::vec![Vec2::ZERO];
    p.extend(spline(&wall.map(Vec2::from), 6));
    p.push(Vec2::new(0.0, 0.17));
    p
}

/// Three fronds: a stem with pairs of leaves each.
fn spray() -> Mesh {
    let mut mesh = Mesh::default();
    for (lean, turn, length) in [(0.10, 20.0, 0.98), (0.34, 165.0, 0.72), (0.42, -28.0, 0.62)] {
        append(&mut mesh, &Pose::at(0.0, 0.18, 0.0).turned(Vec3::Y, turn).apply(&frond(lean, length)));
    }
    mesh
}

/// A stem that bends over toward +x by `lean` times its length, with leaves that get shorter.
fn frond(lean: f32, length: f32) -> Mesh {
    let at = |t: f32| Vec3::new(lean * t * t, t * (1.0 - 0.35 * lean * t), 0.0) * length;
    let stem: Vec<(Vec3, f32)> = (0..=24)
        .map(|i| {
            let t = i as f32 / 24.0;
            (at(t), 0.0042 - 0.003 * t)
        })
        .collect();
    let mut mesh = tube(&stem, Tube { sides: 8, closed: false });
    let pairs = 9;
    for i in 0..pairs {
        let t = 0.26 + 0.68 * (i as f32 / (pairs - 1) as f32);
        let size = length * 0.19 * (1.25 - 0.75 * t);
        let heading = at(t + 0.01) - at(t - 0.01);
        let upright = num::atan2(heading.x, heading.y).to_degrees();
        for side in [-1.0, 1.0] {
            let p = at(t + 0.012 * side);
            let pose = Pose::at(p.x, p.y, p.z)
                .scaled(size)
                .turned(Vec3::X, 18.0)
                .turned(Vec3::Z, -side * (58.0 - 22.0 * t))
                .turned(Vec3::Z, -upright);
            append(&mut mesh, &pose.apply(&leaf()));
        }
    }
    let tip = at(1.0);
    append(
        &mut mesh,
        &Pose::at(tip.x, tip.y, tip.z).scaled(length * 0.09).turned(Vec3::Z, -20.0).apply(&leaf()),
    );
    mesh
}

/// A pointed leaf of length 1 along y, a little folded and curled.
fn leaf() -> Mesh {
    surface(4, 9, |u, v| {
        let across = 2.0 * u - 1.0;
        // Never quite 0, so that the ends keep an area.
        let width =
            0.002 + 0.2 * num::sqrt(num::sin_cos(PI * num::pow(v, 0.8)).0.max(0.0)) * (1.0 - 0.55 * v);
        Vec3::new(across * width, v, 0.10 * across.abs() * width - 0.16 * v * v)
    })
}
