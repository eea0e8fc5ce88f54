//! Numbers in attributes.

use super::element::Element;
use crate::Rgb;
use crate::load::{LoadError, Problem};
use glam::DVec3;
use std::borrow::ToOwned;
use std::vec::Vec;

/// The error for an attribute that is not what is expected.
pub(super) fn bad(element: &Element, attribute: &str, expected: &'static str) -> LoadError {
    element.error(Problem::Value {
        attribute: attribute.to_owned(),
        text: element.attribute(attribute).unwrap_or_default().to_owned(),
        expected,
    })
}

/// The finite numbers of an attribute, separated by commas or blanks; `None` when one is none.
fn finite(text: &str) -> Option<Vec<f64>> {
    text.split([',', ' ', '\t', '\n', '\r'])
        .filter(|part| !part.is_empty())
        .map(|part| part.parse().ok().filter(|v: &f64| v.is_finite() && (*v as f32).is_finite()))
        .collect()
}

/// One number.
pub(super) fn number(element: &Element, attribute: &str) -> Result<f64, LoadError> {
    let text = element.required(attribute)?;
    match finite(text).as_deref() {
        Some(&[v]) => Ok(v),
        _ => Err(bad(element, attribute, "one finite number")),
    }
}

/// One number, or what holds when the attribute is not there.
pub(super) fn number_or(element: &Element, attribute: &str, default: f64) -> Result<f64, LoadError> {
    if element.attribute(attribute).is_some() { number(element, attribute) } else { Ok(default) }
}

/// The numbers of an attribute, as many as there are.
pub(super) fn numbers(
    element: &Element,
    attribute: &str,
    expected: &'static str,
) -> Result<Vec<f64>, LoadError> {
    finite(element.required(attribute)?).ok_or_else(|| bad(element, attribute, expected))
}

/// Three numbers in one attribute.
pub(super) fn triple(element: &Element, attribute: &str) -> Result<DVec3, LoadError> {
    const EXPECTED: &str = "three finite numbers";
    match numbers(element, attribute, EXPECTED)?.as_slice() {
        &[x, y, z] => Ok(DVec3::new(x, y, z)),
        _ => Err(bad(element, attribute, EXPECTED)),
    }
}

/// `x`, `y`, `z` on their own, or `value` with all of them. What is missing is `default`; without
/// one it is an error.
pub(super) fn coordinates(element: &Element, default: Option<f64>) -> Result<DVec3, LoadError> {
    if element.attribute("value").is_some() {
        return triple(element, "value");
    }
    let one = |axis| match default {
        Some(default) => number_or(element, axis, default),
        None => number(element, axis),
    };
    Ok(DVec3::new(one("x")?, one("y")?, one("z")?))
}

/// A colour: one number for all channels, or three.
pub(super) fn colour(element: &Element) -> Result<Rgb, LoadError> {
    const EXPECTED: &str = "one finite number, or three of them: linear red, green and blue";
    match *numbers(element, "value", EXPECTED)?.as_slice() {
        [v] => Ok(Rgb::splat(v as f32)),
        [r, g, b] => Ok(Rgb::new(r as f32, g as f32, b as f32)),
        _ => Err(bad(element, "value", EXPECTED)),
    }
}

/// A whole number from 0.
pub(super) fn count(element: &Element) -> Result<u32, LoadError> {
    let text = element.required("value")?;
    text.trim().parse().map_err(|_| bad(element, "value", "a whole number from 0 to 4294967295"))
}

/// A number of segments of a path: from 1, or -1 for any number, which is [`u32::MAX`].
pub(super) fn depth(element: &Element) -> Result<u32, LoadError> {
    match element.required("value")?.trim() {
        "-1" => Ok(u32::MAX),
        text => match text.parse() {
            Ok(depth @ 1..) => Ok(depth),
            _ => Err(bad(element, "value", "a whole number from 1, or -1 for paths without end")),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_finite_numbers_are_numbers() {
        assert_eq!(finite("1, 2.5 -3e2,.5"), Some([1.0, 2.5, -300.0, 0.5].to_vec()));
        assert_eq!(finite("  "), Some(Vec::new()));
        for text in ["nan", "inf", "-infinity", "1e400", "1e39", "1;2", "0x10", "1,,a"] {
            assert_eq!(finite(text), None, "{text}");
        }
    }
}
