//! `still-life`: things on a table under one rectangle of light.

use super::author::{Author, BuiltinError, Shot};
use super::mesh::{Pose, Tube, append, arc, knot, lathe, rounded_box, sheet, spline, tube};
use crate::build::{Description, Geometry, Mesh};
use crate::num::{self, TAU};
use crate::shape::{AnyShape, Rectangle};
use glam::{Vec2, Vec3};
use std::vec::Vec;

pub(super) fn make() -> Result<Description, BuiltinError> {
    let mut author = Author::default();
    let plaster = author.matte("plaster", [0.52, 0.46, 0.39])?;
    author.mesh("backdrop", backdrop(), plaster);
    vessels(&mut author)?;
    fruit(&mut author)?;
    keepsakes(&mut author)?;
    light(&mut author)?;
    let shot = Shot::perspective(Vec3::new(0.04, 0.47, 1.30), Vec3::new(0.03, 0.108, 0.0), 31.0);
    // Clean enough to show, and a few seconds on two cores.
    let samples_per_pixel = Some(16);
    author.scene("still-life", shot).map(|scene| Description { samples_per_pixel, ..scene })
}

/// The window: one rectangle, high on the left.
fn light(author: &mut Author) -> Result<(), BuiltinError> {
    let centre = Vec3::new(-1.15, 0.98, 0.34);
    let toward = (Vec3::new(0.0, 0.05, 0.0) - centre).normalize_or(Vec3::NEG_Y);
    let u = toward.cross(Vec3::Y).normalize_or(Vec3::X);
    let v = u.cross(toward);
    let window = Rectangle::new(centre, v * 0.13, u * 0.18)?;
    let geometry = Geometry::Shape(AnyShape::Rectangle(window));
    author.lamp("window", geometry, [115.0, 106.0, 93.0])?;
    Ok(())
}

/// A table that rolls up into a wall.
fn backdrop() -> Mesh {
    let mut outline = std::vec![Vec2::new(1.6, 0.0)];
    outline.extend(arc(Vec2::new(-0.35, 0.4), 0.4, 270.0, 180.0, 48));
    outline.push(Vec2::new(-0.75, 2.0));
    sheet(&outline, 2.5)
}

/// Points of an outline from pairs.
fn outline(points: &[(f32, f32)]) -> Vec<Vec2> {
    points.iter().copied().map(Vec2::from).collect()
}

fn vessels(author: &mut Author) -> Result<(), BuiltinError> {
    let glass = author.glossy("bottle", [0.016, 0.085, 0.088], 0.22, 260.0)?;
    author.mesh("bottle", Pose::at(-0.15, 0.0, -0.13).apply(&lathe(&bottle(), 56)), glass);
    let china = author.glossy("china", [0.70, 0.67, 0.60], 0.06, 90.0)?;
    author.mesh("vase", Pose::at(0.035, 0.0, -0.10).apply(&lathe(&vase(), 72)), china);
    let clay = author.matte("terracotta", [0.46, 0.155, 0.075])?;
    author.mesh("bowl", Pose::at(0.2, 0.0, 0.06).apply(&lathe(&bowl(), 72)), clay);
    Ok(())
}

fn bottle() -> Vec<Vec2> {
    let mut p = outline(&[(0.0, 0.0), (0.034, 0.0)]);
    p.extend(spline(
        &outline(&[
            (0.034, 0.0),
            (0.041, 0.006),
            (0.042, 0.02),
            (0.042, 0.09),
            (0.042, 0.155),
            (0.0395, 0.176),
            (0.0325, 0.195),
            (0.0235, 0.213),
            (0.0165, 0.234),
            (0.014, 0.26),
            (0.0138, 0.296),
        ]),
        6,
    ));
    p.extend(outline(&[(0.0172, 0.297)]));
    p.extend(spline(&outline(&[(0.0172, 0.297), (0.0182, 0.303), (0.0165, 0.3105), (0.012, 0.3115)]), 5));
    p.extend(outline(&[(0.0105, 0.30), (0.0105, 0.24), (0.0, 0.24)]));
    p
}

fn vase() -> Vec<Vec2> {
    let mut p = outline(&[(0.0, 0.0), (0.036, 0.0)]);
    p.extend(spline(
        &outline(&[
            (0.036, 0.0),
            (0.038, 0.006),
            (0.052, 0.045),
            (0.074, 0.098),
            (0.076, 0.138),
            (0.052, 0.178),
            (0.030, 0.198),
            (0.0255, 0.216),
            (0.031, 0.24),
            (0.043, 0.2555),
            (0.0435, 0.2585),
            (0.0415, 0.2585),
            (0.029, 0.241),
            (0.0225, 0.216),
            (0.027, 0.198),
            (0.047, 0.176),
        ]),
        6,
    ));
    p.extend(outline(&[(0.0, 0.12)]));
    p
}

fn bowl() -> Vec<Vec2> {
    let mut p = outline(&[(0.0, 0.0), (0.038, 0.0), (0.041, 0.003), (0.040, 0.012)]);
    p.extend(spline(
        &outline(&[
            (0.040, 0.012),
            (0.068, 0.021),
            (0.094, 0.042),
            (0.106, 0.068),
            (0.1065, 0.0725),
            (0.104, 0.0745),
            (0.1015, 0.0725),
            (0.0995, 0.068),
            (0.088, 0.045),
            (0.063, 0.026),
            (0.03, 0.018),
            (0.0, 0.0165),
        ]),
        6,
    ));
    p
}

fn fruit(author: &mut Author) -> Result<(), BuiltinError> {
    let lemon_peel = author.glossy("lemon", [0.72, 0.46, 0.035], 0.06, 28.0)?;
    let orange_peel = author.glossy("orange", [0.72, 0.225, 0.022], 0.07, 24.0)?;
    let pear_skin = author.glossy("pear", [0.40, 0.42, 0.06], 0.06, 40.0)?;
    let stalk = author.matte("stalk", [0.10, 0.06, 0.03])?;
    let lemon = lathe(&lemon(), 48);
    let lemons = [
        Pose::at(0.232, 0.056, 0.087).turned(Vec3::X, 74.0).turned(Vec3::Y, 60.0),
        Pose::at(-0.03, 0.0285, 0.19).turned(Vec3::Z, 86.0).turned(Vec3::Y, 28.0),
    ];
    let mut both = Mesh::default();
    lemons.iter().for_each(|pose| append(&mut both, &pose.apply(&lemon)));
    author.mesh("lemons", both, lemon_peel);
    let orange = lathe(&orange(), 56);
    let mut heap = Mesh::default();
    append(&mut heap, &Pose::at(0.163, 0.0565, 0.07).turned(Vec3::Z, 25.0).apply(&orange));
    append(&mut heap, &Pose::at(0.215, 0.0605, 0.005).turned(Vec3::X, -40.0).apply(&orange));
    author.mesh("oranges", heap, orange_peel);
    let pose = Pose::at(-0.14, 0.0, 0.15).turned(Vec3::Z, -4.0);
    author.mesh("pear", pose.apply(&lathe(&pear(), 56)), pear_skin);
    let stem: Vec<(Vec3, f32)> = (0..=12)
        .map(|i| {
            let t = i as f32 / 12.0;
            (Vec3::new(0.012 * t * t, 0.094 + 0.026 * t, 0.004 * t), 0.0016 + 0.0009 * t * t)
        })
        .collect();
    author.mesh("pear-stalk", pose.apply(&tube(&stem, Tube { sides: 16, closed: false })), stalk);
    Ok(())
}

fn lemon() -> Vec<Vec2> {
    spline(
        &outline(&[
            (0.0, -0.042),
            (0.0055, -0.0405),
            (0.009, -0.035),
            (0.021, -0.024),
            (0.0285, 0.0),
            (0.021, 0.0245),
            (0.0085, 0.0365),
            (0.0045, 0.0425),
            (0.0, 0.044),
        ]),
        4,
    )
}

/// A ball, a little flat, with a dimple.
fn orange() -> Vec<Vec2> {
    (0..=28)
        .map(|i| {
            let angle = i as f32 / 28.0 * 0.5 * TAU;
            let (sin, cos) = num::sin_cos(angle);
            let dimple = 1.0 - 0.10 * num::exp(-90.0 * (1.0 + cos) * (1.0 + cos) - 14.0 * sin * sin);
            let top = 1.0 - 0.16 * num::exp(-40.0 * sin * sin) * if cos < 0.0 { 1.0 } else { 0.3 };
            let r = if i == 0 || i == 28 { 0.0 } else { sin };
            Vec2::new(0.0365 * r, -0.0355 * cos * dimple * top)
        })
        .collect()
}

fn pear() -> Vec<Vec2> {
    spline(
        &outline(&[
            (0.0, 0.004),
            (0.012, 0.0005),
            (0.026, 0.006),
            (0.036, 0.024),
            (0.0345, 0.046),
            (0.023, 0.066),
            (0.0165, 0.080),
            (0.0135, 0.092),
            (0.008, 0.0975),
            (0.0, 0.0955),
        ]),
        8,
    )
}

/// A brass knot on two books, and a candle in its stick.
fn keepsakes(author: &mut Author) -> Result<(), BuiltinError> {
    let brass = author.metal("brass", [0.86, 0.62, 0.28], 0.32)?;
    let wax = author.matte("wax", [0.80, 0.74, 0.62])?;
    let wick = author.matte("wick", [0.03, 0.03, 0.03])?;
    let mut stick = outline(&[(0.0, 0.0), (0.043, 0.0), (0.044, 0.004)]);
    stick.extend(spline(
        &outline(&[
            (0.044, 0.004),
            (0.034, 0.011),
            (0.012, 0.016),
            (0.0075, 0.03),
            (0.013, 0.042),
            (0.0075, 0.053),
            (0.006, 0.10),
            (0.0085, 0.125),
            (0.018, 0.133),
            (0.0225, 0.136),
        ]),
        5,
    ));
    stick.extend(outline(&[(0.0225, 0.139), (0.0125, 0.139), (0.0125, 0.148), (0.0, 0.148)]));
    let place = Pose::at(-0.27, 0.0, 0.02);
    author.mesh("candlestick", place.apply(&lathe(&stick, 56)), brass);
    let mut candle = outline(&[(0.0, 0.14), (0.0105, 0.14), (0.0098, 0.30)]);
    candle.extend(outline(&[(0.0085, 0.3022), (0.0, 0.301)]));
    author.mesh("candle", place.apply(&lathe(&candle, 40)), wax);
    let string = [(0.0, 0.30), (0.0004, 0.306), (0.0018, 0.312)].map(|(x, y)| (Vec3::new(x, y, 0.0), 0.0009));
    author.mesh("wick", place.apply(&tube(&string, Tube { sides: 12, closed: false })), wick);
    let cloth = author.matte("cloth", [0.075, 0.11, 0.20])?;
    let book = rounded_box(Vec3::new(0.075, 0.014, 0.055), 0.003, 4);
    author.mesh("book", Pose::at(0.30, 0.0139, -0.16).turned(Vec3::Y, -22.0).apply(&book), cloth);
    let ring = tube(&knot(2, 3, [0.036, 0.0165], 0.0098, 200), Tube { sides: 20, closed: true });
    let place = Pose::at(0.297, 0.0815, -0.162).turned(Vec3::X, 82.0).turned(Vec3::Y, -18.0);
    author.mesh("knot", place.apply(&ring), brass);
    Ok(())
}
