//! Indices of refraction, by number or by the name of a material.

use super::element::Element;
use super::properties::Properties;
use super::value;
use crate::load::{LoadError, Problem};

/// Indices of refraction at 589 nm and room temperature: the names and numbers of Mitsuba 3, most of
/// them from Hecht, *Optics*.
const MATERIALS: [(&str, f64); 23] = [
    ("vacuum", 1.0),
    ("helium", 1.000_036),
    ("hydrogen", 1.000_132),
    ("air", 1.000_277),
    ("carbon dioxide", 1.000_45),
    ("water", 1.333),
    ("acetone", 1.36),
    ("ethanol", 1.361),
    ("carbon tetrachloride", 1.461),
    ("glycerol", 1.4729),
    ("benzene", 1.501),
    ("silicone oil", 1.520_45),
    ("bromine", 1.661),
    ("water ice", 1.31),
    ("fused quartz", 1.458),
    ("pyrex", 1.47),
    ("acrylic glass", 1.49),
    ("polypropylene", 1.49),
    ("bk7", 1.5046),
    ("sodium chloride", 1.544),
    ("amber", 1.55),
    ("pet", 1.575),
    ("diamond", 2.419),
];

/// The index inside over that outside.
pub(super) fn relative(element: &Element, properties: &mut Properties<'_>) -> Result<f32, LoadError> {
    let inside = read(element, properties, "int_ior", "polypropylene")?;
    let outside = read(element, properties, "ext_ior", "air")?;
    Ok((inside / outside) as f32)
}

fn read(
    element: &Element,
    properties: &mut Properties<'_>,
    property: &'static str,
    default: &str,
) -> Result<f64, LoadError> {
    let (child, name) = match properties.float_or_text(property)? {
        Some(child) if child.tag == "string" => (child, child.required("value")?),
        Some(child) => return value::number(child, "value"),
        None => (element, default),
    };
    match MATERIALS.iter().find(|(known, _)| known.eq_ignore_ascii_case(name)) {
        Some((_, index)) => Ok(*index),
        None => Err(child.error(Problem::unknown("material", name, &MATERIALS.map(|(known, _)| known)))),
    }
}
