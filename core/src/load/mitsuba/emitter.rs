//! `<emitter>`: lights, with and without a surface.

use super::context::Context;
use super::element::Element;
use super::properties::Properties;
use super::texture;
use crate::build::Emission;
use crate::light::{AnyLight, Constant, Directional, LightError, Point, Spot};
use crate::load::{LoadError, Problem};
use glam::{DMat4, DVec3};
use std::borrow::ToOwned;

const FREE: [&str; 4] = ["point", "spot", "directional", "constant"];

/// What a surface emits.
pub(super) fn surface(context: &mut Context<'_>, element: &Element) -> Result<Emission, LoadError> {
    element.plugin("emitter of a shape", &["area"])?;
    let mut properties = Properties::new(element)?;
    let (radiance, texture) = texture::radiance(context, &mut properties, "radiance")?;
    let two_sided = properties.flag("two_sided")?;
    properties.finish(context)?;
    if radiance.is_valid() {
        Ok(Emission { radiance, texture, two_sided })
    } else {
        Err(element.error(LightError::NegativeEmission { emission: radiance }))
    }
}

/// A light without a surface.
pub(super) fn free(context: &mut Context<'_>, element: &Element) -> Result<AnyLight<'static>, LoadError> {
    match element.attribute("type") {
        Some("area") => {
            let what = "an area emitter outside of a shape".to_owned();
            return Err(element.error(Problem::NotSupported { what, instead: "put it into the <shape>" }));
        }
        Some("envmap") => {
            let what = "an environment map".to_owned();
            let instead = "use <emitter type=\"constant\"> with its mean radiance";
            return Err(element.error(Problem::NotSupported { what, instead }));
        }
        _ => {}
    }
    let kind = element.plugin("emitter", &FREE)?;
    let mut properties = Properties::new(element)?;
    let light = match kind {
        "point" => {
            let intensity = properties.emission("intensity")?;
            let position = place(&mut properties, "position", DMat4::transform_point3, DVec3::ZERO)?;
            Point::new(position.as_vec3(), intensity).map(AnyLight::Point)
        }
        "spot" => spot(&mut properties)?.map(AnyLight::Spot),
        "directional" => {
            let irradiance = properties.emission("irradiance")?;
            let direction = place(&mut properties, "direction", DMat4::transform_vector3, DVec3::Z)?;
            let direction = direction.normalize_or_zero().as_vec3();
            Directional::new(direction, irradiance).map(AnyLight::Directional)
        }
        _ => Constant::new(properties.emission("radiance")?).map(AnyLight::Constant),
    };
    properties.ignore(&["sampling_weight"]);
    properties.finish(context)?;
    light.map_err(|e| element.error(e))
}

/// A position or direction: either given as such, or the image of `own` under `to_world`.
fn place(
    properties: &mut Properties<'_>,
    name: &'static str,
    image: fn(&DMat4, DVec3) -> DVec3,
    own: DVec3,
) -> Result<DVec3, LoadError> {
    let given = properties.vector(name)?;
    match (given, properties.transform("to_world")?) {
        (Some(_), Some((at, _))) => {
            let what = "a transform together with coordinates".to_owned();
            Err(at.error(Problem::NotSupported { what, instead: "give one of the two" }))
        }
        (Some(given), None) => Ok(given),
        (None, transform) => Ok(image(&transform.map_or(DMat4::IDENTITY, |(_, m)| m), own)),
    }
}

fn spot(properties: &mut Properties<'_>) -> Result<Result<Spot, LightError>, LoadError> {
    let intensity = properties.emission("intensity")?;
    let cutoff = properties.float_or("cutoff_angle", 20.0)?;
    let beam = properties.float_or("beam_width", cutoff * 0.75)?;
    let m = properties.transform("to_world")?.map_or(DMat4::IDENTITY, |(_, m)| m);
    let axis = m.z_axis.truncate().normalize_or_zero().as_vec3();
    let (beam, cutoff) = (beam.to_radians() as f32, cutoff.to_radians() as f32);
    Ok(Spot::new(m.w_axis.truncate().as_vec3(), axis, intensity, beam, cutoff))
}
