//! Lights of `KHR_lights_punctual`.

use super::container::malformed;
use super::document::Light;
use crate::Rgb;
use crate::light::{AnyLight, Directional, Point, Spot};
use crate::load::Problem;
use glam::DMat4;
use std::format;

/// From photometric to radiometric units (lm W⁻¹), as Blender has it.
///
/// Source: Bureau International des Poids et Mesures 2019, *The International System of Units*, 9th
/// edition, section 2.3.1: the luminous efficacy of green light, to three digits. Differs: used for every
/// colour.
const LUMENS_PER_WATT: f32 = 683.0;

/// Half-angle of a cone for which none is given (rad).
const OUTER: f32 = core::f32::consts::FRAC_PI_4;

/// A light at a node, along whose negative z axis it shines. Candela become W sr⁻¹, lux W m⁻²; the range
/// beyond which a game need not bother is left out.
///
/// Source: Khronos Group 2019, *KHR_lights_punctual*. Differs: between the inner and the outer angle a
/// spot fades linearly with the angle, as in Mitsuba 3.
pub(super) fn place(light: &Light, to_world: &DMat4) -> Result<AnyLight<'static>, Problem> {
    let strength = Rgb::from(light.color) * (light.intensity / LUMENS_PER_WATT);
    let position = to_world.w_axis.truncate().as_vec3();
    let direction = -to_world.z_axis.truncate().normalize_or_zero().as_vec3();
    Ok(match light.kind.as_str() {
        "point" => AnyLight::Point(Point::new(position, strength)?),
        "directional" => AnyLight::Directional(Directional::new(direction, strength)?),
        "spot" => {
            let cone = light.spot.as_ref().ok_or_else(|| malformed("a spot light without \"spot\""))?;
            let outer = cone.outer_cone_angle.unwrap_or(OUTER);
            AnyLight::Spot(Spot::new(position, direction, strength, cone.inner_cone_angle, outer)?)
        }
        other => return Err(malformed(format!("there is no type of light {other:?}"))),
    })
}
