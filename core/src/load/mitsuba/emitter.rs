//! `<emitter>`: lights, with and without a surface.

use super::context::Context;
use super::element::Element;
use super::properties::Properties;
use super::texture;
use crate::build::{Emission, EnvironmentDescription, Geometry};
use crate::light::{AnyLight, Constant, Directional, EnvironmentMap, LightError, Point, Portal, Spot};
use crate::load::{Encoding, LoadError, Problem, read_image_from};
use crate::shape::AnyShape;
use glam::{DMat3, DMat4, DVec3, Mat3};
use std::borrow::ToOwned;
use std::format;

const FREE: [&str; 5] = ["point", "spot", "directional", "constant", "envmap"];

/// How far a transform of directions may be from a rotation.
const RIGID: f64 = 1e-5;

/// A light without a surface.
#[derive(Debug)]
pub(super) enum Free {
    /// One that the description holds as it is.
    Light(AnyLight<'static>),
    /// A picture.
    Environment(EnvironmentDescription),
}

/// The emitter that makes a rectangle an opening for the light from all around. Mitsuba has none.
pub(super) const PORTAL: &str = "portal";

/// The opening that a shape is.
pub(super) fn portal(
    context: &mut Context<'_>,
    element: &Element,
    geometry: &Geometry,
) -> Result<Portal, LoadError> {
    element.plugin("emitter of a shape", &[PORTAL])?;
    Properties::new(element)?.finish(context)?;
    match geometry {
        Geometry::Shape(AnyShape::Rectangle(shape)) => Portal::new(*shape).map_err(|e| element.error(e)),
        _ => {
            let what = "a portal of another shape".to_owned();
            Err(element.error(Problem::NotSupported { what, instead: "use <shape type=\"rectangle\">" }))
        }
    }
}

/// What a surface emits.
pub(super) fn surface(context: &mut Context<'_>, element: &Element) -> Result<Emission, LoadError> {
    element.plugin("emitter of a shape", &["area", PORTAL])?;
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
pub(super) fn free(context: &mut Context<'_>, element: &Element) -> Result<Free, LoadError> {
    if element.attribute("type") == Some("area") {
        let what = "an area emitter outside of a shape".to_owned();
        return Err(element.error(Problem::NotSupported { what, instead: "put it into the <shape>" }));
    }
    let kind = element.plugin("emitter", &FREE)?;
    let mut properties = Properties::new(element)?;
    let light = match kind {
        "envmap" => return environment(context, element, properties).map(Free::Environment),
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
    light.map(Free::Light).map_err(|e| element.error(e))
}

/// A picture of the light from all around.
fn environment(
    context: &mut Context<'_>,
    element: &Element,
    mut properties: Properties<'_>,
) -> Result<EnvironmentDescription, LoadError> {
    let (named, name) = properties
        .text("filename")?
        .ok_or_else(|| element.error(Problem::Missing { what: "the property \"filename\"".to_owned() }))?;
    let scale = properties.float_or("scale", 1.0)? as f32;
    let to_world = match properties.transform("to_world")? {
        Some((at, m)) => rotation(&m).map_err(|problem| at.error(problem))?,
        None => Mat3::IDENTITY,
    };
    // How it is sampled is the renderer's business.
    properties.ignore(&["sampling_weight", "mis_compensation"]);
    properties.finish(context)?;
    let path = context.find(named, name);
    let refused = |problem| named.error(problem);
    let mut image = read_image_from(&context.document.files, &path, Encoding::Srgb)
        .map_err(|source| refused(Problem::Image { path: path.clone(), source }))?;
    let (width, height) = (image.width, image.height);
    if width.abs_diff(2 * height) > height / 8 {
        let text = format!(
            "{} has {width}×{height} texels; one in longitude and latitude is twice as wide as high",
            path.display()
        );
        context.warn(element, &text);
    }
    image.texels.iter_mut().for_each(|texel| *texel *= scale);
    EnvironmentMap::new(&image.texels, image.width, image.height, to_world)
        .map_err(|source| refused(Problem::Map { path, source }))?;
    Ok(EnvironmentDescription::new(image, to_world))
}

/// A transform that turns and mirrors; where it moves things to is no matter to what is infinitely far.
fn rotation(m: &DMat4) -> Result<Mat3, Problem> {
    let linear = DMat3::from_mat4(*m);
    let off = linear.transpose() * linear - DMat3::IDENTITY;
    if off.to_cols_array().iter().all(|v| v.abs() <= RIGID) {
        Ok(linear.as_mat3())
    } else {
        Err(Problem::Transform { must: "only turn or mirror an environment map" })
    }
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
