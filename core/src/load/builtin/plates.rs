//! `plates`: four lamps in four plates.

use super::author::{Author, BuiltinError, Shot};
use super::mesh::{Pose, arc, rounded_box, sheet};
use crate::build::{Description, Geometry};
use crate::num;
use crate::shape::{AnyShape, Sphere};
use glam::{Vec2, Vec3};
use std::format;
use std::vec::Vec;

/// Where the lamps hang: far enough back and high enough that the plates mirror them.
const LAMPS: Vec3 = Vec3::new(0.0, 3.6, -1.3);
const EYE: Vec3 = Vec3::new(0.0, 2.4, 13.0);

/// Middles of the plates as (y, z), and the exponent of their highlight, from the farthest to the nearest.
const PLATES: [([f32; 2], f32); 4] =
    [([0.95, 0.6], 12000.0), ([0.42, 2.15], 1800.0), ([0.07, 3.75], 280.0), ([-0.12, 5.25], 45.0)];

/// Radius and tint of the lamps, from the left. All have the same power.
const BULBS: [(f32, [f32; 3]); 4] = [
    (0.045, [1.00, 0.52, 0.30]),
    (0.13, [1.00, 0.78, 0.42]),
    (0.36, [0.62, 0.86, 0.80]),
    (0.80, [0.42, 0.62, 1.00]),
];
/// Where they hang, so that the gaps between them look alike.
const ACROSS: [f32; 4] = [-3.3, -1.85, 0.0, 2.55];

pub(super) fn make() -> Result<Description, BuiltinError> {
    let mut author = Author::default();
    let wall = author.matte("wall", [0.55, 0.55, 0.56])?;
    let mut outline = std::vec![Vec2::new(14.0, -0.6)];
    outline.extend(arc(Vec2::new(-0.9, 1.4), 2.0, 270.0, 180.0, 32));
    outline.push(Vec2::new(-2.9, 12.0));
    author.mesh("room", sheet(&outline, 16.0), wall);
    for (i, ([y, z], exponent)) in PLATES.into_iter().enumerate() {
        let enamel = author.glossy(&format!("enamel-{}", i + 1), [0.06, 0.065, 0.075], 0.75, exponent)?;
        let plate = rounded_box(Vec3::new(4.0, 0.04, 0.62), 0.03, 4);
        let tilt = mirror_tilt(Vec3::new(0.0, y, z));
        let pose = Pose::at(0.0, y, z).turned(Vec3::X, tilt);
        author.mesh(&format!("plate-{}", i + 1), pose.apply(&plate), enamel);
    }
    for (i, ((radius, tint), x)) in BULBS.into_iter().zip(ACROSS).enumerate() {
        let bulb = Sphere::new(Vec3::new(x, LAMPS.y, LAMPS.z), radius)?;
        // Power 4π² r² L, the same for each.
        let radiance = tint.map(|c| c * 1.0 / (radius * radius));
        author.lamp(&format!("lamp-{}", i + 1), Geometry::Shape(AnyShape::Sphere(bulb)), radiance)?;
    }
    author.scene("plates", Shot::perspective(EYE, Vec3::new(0.0, 1.42, 0.0), 47.0))
}

/// By how much a plate leans toward the viewer so that it mirrors the lamps into the eye [degrees].
fn mirror_tilt(middle: Vec3) -> f32 {
    let directions: Vec<Vec3> =
        [EYE, LAMPS].iter().filter_map(|p| (*p - middle).with_x(0.0).try_normalize()).collect();
    let half: Vec3 = directions.iter().sum();
    num::atan2(half.z, half.y).to_degrees()
}
