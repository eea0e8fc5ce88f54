//! `colours`: three lamps of different colours, shapes and sizes on white things.

use super::author::{Author, BuiltinError, Channels, Shot};
use super::mesh::{Pose, Tube, append, arc, knot, lathe, sheet, tube};
use crate::build::{Description, Geometry, Mesh};
use crate::geom::Frame;
use crate::num::{self, TAU};
use crate::shape::{AnyShape, Disk, Rectangle, Sphere};
use glam::{Vec2, Vec3};
use std::vec::Vec;

/// Colours of the lamps. Together they are white, so that only the shadows are coloured.
const ROSE: Channels = [1.00, 0.20, 0.22];
const JADE: Channels = [0.14, 0.84, 0.28];
const AZURE: Channels = [0.16, 0.26, 0.80];

pub(super) fn make() -> Result<Description, BuiltinError> {
    let mut author = Author::default();
    let white = author.matte("white", [0.80, 0.80, 0.80])?;
    let mut outline = std::vec![Vec2::new(9.0, 0.0)];
    outline.extend(arc(Vec2::new(-4.0, 3.0), 3.0, 270.0, 180.0, 64));
    outline.push(Vec2::new(-7.0, 12.0));
    author.mesh("stage", sheet(&outline, 14.0), white);
    let ring = tube(&knot(2, 3, [0.62, 0.27], 0.15, 288), Tube { sides: 40, closed: true });
    author.mesh(
        "knot",
        Pose::at(0.0, 0.98, 0.0).turned(Vec3::X, 80.0).turned(Vec3::Y, 20.0).apply(&ring),
        white,
    );
    author.mesh("pegs", pegs(), white);
    lamps(&mut author)?;
    let shot = Shot::perspective(Vec3::new(0.0, 6.6, 7.6), Vec3::new(0.0, 0.3, 0.15), 33.0);
    author.scene("colours", shot)
}

/// A ring of thin round-headed pegs, tall behind and short in front.
fn pegs() -> Mesh {
    let radius = 0.06;
    let count = 18;
    let mut mesh = Mesh::default();
    for i in 0..count {
        let (sin, cos) = num::sin_cos(TAU * (i as f32 + 0.5) / count as f32);
        let height = 0.62 - 0.34 * sin;
        let mut peg: Vec<Vec2> = std::vec![Vec2::ZERO, Vec2::new(radius, 0.0)];
        peg.extend(arc(Vec2::new(0.0, height - radius), radius, 0.0, 90.0, 12));
        if let Some(tip) = peg.last_mut() {
            tip.x = 0.0;
        }
        append(&mut mesh, &Pose::at(2.0 * cos, 0.0, 1.7 * sin).apply(&lathe(&peg, 32)));
    }
    mesh
}

fn lamps(author: &mut Author) -> Result<(), BuiltinError> {
    let target = Vec3::new(0.0, 0.4, 0.0);
    let aimed = |from: Vec3| Frame::from_normal((target - from).normalize_or(Vec3::NEG_Y));
    let at = Vec3::new(-4.3, 4.6, 2.6);
    let f = aimed(at);
    let rose = Rectangle::new(at, f.s * 0.6, f.t * 0.6)?;
    let power = |colour: Channels, radiance: f32| colour.map(|c| c * radiance);
    author.lamp("rose", Geometry::Shape(AnyShape::Rectangle(rose)), power(ROSE, 80.0))?;
    let at = Vec3::new(0.0, 5.0, -4.6);
    let f = aimed(at);
    let jade = Disk::new(at, f.s * 0.45, f.t * 0.45)?;
    author.lamp("jade", Geometry::Shape(AnyShape::Disk(jade)), power(JADE, 175.0))?;
    let azure = Sphere::new(Vec3::new(4.3, 4.6, 2.6), 0.22)?;
    author.lamp("azure", Geometry::Shape(AnyShape::Sphere(azure)), power(AZURE, 750.0))?;
    Ok(())
}
