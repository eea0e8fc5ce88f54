//! `<transform>`: a list of steps, composed in double precision.

use super::element::Element;
use super::value::{bad, coordinates, number, numbers, triple};
use crate::load::{LoadError, Problem};
use glam::{DMat4, DVec3, DVec4};
use std::borrow::ToOwned;

/// How far the length of an axis may be from 1: an axis written with few digits.
const UNIT_LENGTH: f64 = 1e-3;

const STEPS: [&str; 5] = ["translate", "rotate", "scale", "lookat", "matrix"];

/// The product of all steps; each later one acts on the result of those before.
pub(super) fn read(element: &Element) -> Result<DMat4, LoadError> {
    let mut whole = DMat4::IDENTITY;
    for child in &element.children {
        child.no_children()?;
        whole = step(child)? * whole;
    }
    if whole.is_finite() {
        Ok(whole)
    } else {
        Err(element.error(Problem::Transform { must: "have finite numbers" }))
    }
}

fn step(element: &Element) -> Result<DMat4, LoadError> {
    let known: &[&str] = match element.tag.as_str() {
        "translate" | "scale" => &["x", "y", "z", "value"],
        "rotate" => &["x", "y", "z", "value", "angle"],
        "lookat" => &["origin", "target", "up"],
        "matrix" => &["value"],
        tag => return Err(element.error(Problem::unknown("transform step", tag, &STEPS))),
    };
    element.only_attributes(known)?;
    match element.tag.as_str() {
        "translate" => Ok(DMat4::from_translation(coordinates(element, Some(0.0))?)),
        "rotate" => rotate(element),
        "scale" => scale(element),
        "lookat" => look_at(element),
        _ => matrix(element),
    }
}

fn scale(element: &Element) -> Result<DMat4, LoadError> {
    const EXPECTED: &str = "one finite number or three";
    if element.attribute("value").is_none() {
        return Ok(DMat4::from_scale(coordinates(element, Some(1.0))?));
    }
    match *numbers(element, "value", EXPECTED)?.as_slice() {
        [s] => Ok(DMat4::from_scale(DVec3::splat(s))),
        [x, y, z] => Ok(DMat4::from_scale(DVec3::new(x, y, z))),
        _ => Err(bad(element, "value", EXPECTED)),
    }
}

/// Mitsuba 3 takes the axis as it is, and shears when its length is not 1: what was meant and what it
/// does are then two things.
fn rotate(element: &Element) -> Result<DMat4, LoadError> {
    let angle = number(element, "angle")?.to_radians();
    let axis = coordinates(element, Some(0.0))?;
    match axis.try_normalize() {
        None => Err(element.error(Problem::Missing { what: "the axis (x, y, z or value)".to_owned() })),
        Some(_) if (axis.length() - 1.0).abs() > UNIT_LENGTH => Err(element.error(Problem::Transform {
            must: "turn around an axis of length 1, because Mitsuba does not normalise it",
        })),
        Some(axis) => Ok(DMat4::from_axis_angle(axis, angle)),
    }
}

fn look_at(element: &Element) -> Result<DMat4, LoadError> {
    let (origin, target, up) =
        (triple(element, "origin")?, triple(element, "target")?, triple(element, "up")?);
    let forward = (target - origin).try_normalize();
    let left = forward.and_then(|f| up.try_normalize()?.cross(f).try_normalize());
    match forward.zip(left) {
        Some((forward, left)) => Ok(DMat4::from_cols(
            left.extend(0.0),
            forward.cross(left).extend(0.0),
            forward.extend(0.0),
            origin.extend(1.0),
        )),
        None => Err(element.error(Problem::Transform {
            must: "have different origin and target, and up not along the view",
        })),
    }
}

fn matrix(element: &Element) -> Result<DMat4, LoadError> {
    const EXPECTED: &str = "16 or 9 finite numbers, row by row";
    match numbers(element, "value", EXPECTED)?.as_slice() {
        &[a, b, c, d, e, f, g, h, i] => Ok(DMat4::from_cols(
            DVec4::new(a, d, g, 0.0),
            DVec4::new(b, e, h, 0.0),
            DVec4::new(c, f, i, 0.0),
            DVec4::W,
        )),
        v if v.len() == 16 => {
            let mut cells = [0.0; 16];
            cells.copy_from_slice(v);
            let m = DMat4::from_cols_array(&cells).transpose();
            if m.row(3) == DVec4::W {
                Ok(m)
            } else {
                Err(element.error(Problem::Transform { must: "end with the row 0 0 0 1" }))
            }
        }
        _ => Err(bad(element, "value", EXPECTED)),
    }
}
