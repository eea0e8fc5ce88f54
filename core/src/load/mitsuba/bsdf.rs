//! `<bsdf>`: materials.

use super::context::Context;
use super::element::Element;
use super::ior;
use super::properties::Properties;
use crate::Rgb;
use crate::bsdf::{AnyBsdf, GgxConductor, Lambert, Phong, RoughPlastic, TwoSided};
use crate::load::{LoadError, Problem};
use std::borrow::ToOwned;
use std::format;

const NAMES: [&str; 5] = ["diffuse", "phong", "roughconductor", "roughplastic", "twosided"];
const ONE_SIDED: [&str; 4] = ["diffuse", "phong", "roughconductor", "roughplastic"];

/// The smoothest surface that is kept as written.
const MIN_ALPHA: f64 = 1e-4;

/// A material for both sides of a surface.
pub(super) fn read(context: &mut Context<'_>, element: &Element) -> Result<TwoSided<AnyBsdf>, LoadError> {
    if element.plugin("bsdf", &NAMES)? == "twosided" {
        two_sided(context, element)
    } else {
        one_sided(context, element).map(TwoSided::front_only)
    }
}

/// What a surface without a `<bsdf>` has: grey, or black where it emits, as in Mitsuba 3.
pub(super) fn default(emits: bool) -> Result<TwoSided<AnyBsdf>, crate::bsdf::BsdfError> {
    Lambert::new(Rgb::splat(if emits { 0.0 } else { 0.5 })).map(AnyBsdf::Lambert).map(TwoSided::front_only)
}

fn two_sided(context: &mut Context<'_>, element: &Element) -> Result<TwoSided<AnyBsdf>, LoadError> {
    let mut properties = Properties::new(element)?;
    let mut sides = properties.nested(&["bsdf", "ref"]).into_iter();
    let mut side = |context: &mut Context<'_>| match sides.next() {
        Some(e) if e.tag == "ref" => context.referent(e).and_then(|e| one_sided(context, e)).map(Some),
        Some(e) => one_sided(context, e).map(Some),
        None => Ok(None),
    };
    let front = side(context)?
        .ok_or_else(|| element.error(Problem::Missing { what: "the <bsdf> of the front".to_owned() }))?;
    let back = side(context)?;
    if let Some(third) = sides.next() {
        let what = "a <bsdf> for a third side".to_owned();
        return Err(third.error(Problem::NotSupported { what, instead: "give one or two" }));
    }
    properties.finish(context)?;
    Ok(TwoSided { front, back: Some(back.unwrap_or(front)) })
}

fn one_sided(context: &mut Context<'_>, element: &Element) -> Result<AnyBsdf, LoadError> {
    let kind = element.plugin("bsdf for one side", &ONE_SIDED)?;
    let mut properties = Properties::new(element)?;
    let bsdf = match kind {
        "diffuse" => {
            let reflectance = properties.reflectance("reflectance")?.unwrap_or(Rgb::splat(0.5));
            AnyBsdf::Lambert(Lambert::new(reflectance).map_err(|e| element.error(e))?)
        }
        "phong" => AnyBsdf::Phong(phong(context, element, &mut properties)?),
        "roughconductor" => AnyBsdf::GgxConductor(rough_conductor(context, element, &mut properties)?),
        _ => AnyBsdf::RoughPlastic(rough_plastic(context, element, &mut properties)?),
    };
    properties.finish(context)?;
    Ok(bsdf)
}

/// As `phong` of Mitsuba 0.6: both reflectances are scaled down when they exceed 1 together.
fn phong(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<Phong, LoadError> {
    let mut diffuse = properties.reflectance("diffuse_reflectance")?.unwrap_or(Rgb::splat(0.5));
    let mut specular = properties.reflectance("specular_reflectance")?.unwrap_or(Rgb::splat(0.2));
    let exponent = properties.float_or("exponent", 30.0)? as f32;
    let most = (diffuse + specular).max_component();
    if most > 1.0 && diffuse.is_valid() && specular.is_valid() {
        // Mitsuba 0.6 keeps 1 % of distance to losing nothing.
        let scale = 0.99 / most;
        (diffuse, specular) = (diffuse * scale, specular * scale);
        context.warn(element, "reflects more than arrives; both reflectances are scaled down to 0.99 in sum");
    }
    Phong::new(diffuse, specular, exponent).map_err(|e| element.error(e))
}

fn rough_conductor(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<GgxConductor, LoadError> {
    if let Some((child, material)) = properties.text("material")?
        && material != "none"
    {
        return Err(child.error(Problem::unknown("material", material, &["none"])));
    }
    only_ggx(element, properties)?;
    let reflectance = properties.reflectance("specular_reflectance")?.unwrap_or(Rgb::WHITE);
    let alpha = roughnesses(context, element, properties)?;
    let bsdf = GgxConductor::anisotropic(reflectance, alpha).map_err(|e| element.error(e))?;
    let (eta, k) = (properties.reflectance("eta")?, properties.reflectance("k")?);
    if eta.is_none() && k.is_none() {
        return Ok(bsdf);
    }
    // What is not given is that of a mirror.
    bsdf.with_index(eta.unwrap_or(Rgb::BLACK), k.unwrap_or(Rgb::WHITE)).map_err(|e| element.error(e))
}

fn rough_plastic(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<RoughPlastic, LoadError> {
    only_ggx(element, properties)?;
    let alpha = roughness(context, element, properties.float_or("alpha", 0.1)?);
    let eta = ior::relative(element, properties)?;
    let diffuse = properties.reflectance("diffuse_reflectance")?.unwrap_or(Rgb::splat(0.5));
    let specular = properties.reflectance("specular_reflectance")?.unwrap_or(Rgb::WHITE);
    let nonlinear = properties.flag("nonlinear")?;
    RoughPlastic::new(alpha, eta)
        .and_then(|bsdf| bsdf.with_diffuse(diffuse)?.with_specular(specular))
        .map(|bsdf| bsdf.with_nonlinear(nonlinear))
        .map_err(|e| element.error(e))
}

/// Refuses what Mitsuba takes when nothing is said.
fn only_ggx(element: &Element, properties: &mut Properties<'_>) -> Result<(), LoadError> {
    let (child, distribution) = properties.text("distribution")?.unwrap_or((element, "beckmann"));
    properties.ignore(&["sample_visible"]);
    if distribution == "ggx" {
        return Ok(());
    }
    Err(child.error(Problem::unknown("distribution", distribution, &["ggx"])))
}

/// Roughness along the surface's tangent and across it.
fn roughnesses(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<[f32; 2], LoadError> {
    let both = properties.float("alpha")?;
    let [along, across] = match (both, properties.float("alpha_u")?, properties.float("alpha_v")?) {
        (both, None, None) => [both.unwrap_or(0.1); 2],
        (None, Some(along), Some(across)) => [along, across],
        (Some(_), ..) => {
            let what = "\"alpha\" together with \"alpha_u\" or \"alpha_v\"".to_owned();
            return Err(element.error(Problem::NotSupported { what, instead: "leave \"alpha\" out" }));
        }
        (None, along, _) => {
            let missing = if along.is_some() { "alpha_v" } else { "alpha_u" };
            return Err(element.error(Problem::Missing { what: format!("the property \"{missing}\"") }));
        }
    };
    Ok([roughness(context, element, along), roughness(context, element, across)])
}

/// A roughness as far as it is supported.
fn roughness(context: &mut Context<'_>, element: &Element, alpha: f64) -> f32 {
    if (0.0..MIN_ALPHA).contains(&alpha) {
        context.warn(element, "alpha is below 0.0001, the smoothest that is supported; 0.0001 is used");
        return MIN_ALPHA as f32;
    }
    alpha as f32
}
