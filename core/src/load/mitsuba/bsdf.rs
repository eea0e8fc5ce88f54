//! `<bsdf>`: materials.

use super::context::Context;
use super::element::Element;
use super::ior;
use super::properties::Properties;
use super::texture;
use crate::Rgb;
use crate::bsdf::{AnyBsdf, GgxConductor, Lambert, MetallicRoughness, Phong, RoughPlastic, TwoSided};
use crate::build::{Material, MaterialTextures, TextureDescription};
use crate::load::{LoadError, Problem};
use std::borrow::ToOwned;
use std::format;
use std::string::String;

const NAMES: [&str; 6] = ["diffuse", "phong", "principled", "roughconductor", "roughplastic", "twosided"];
const ONE_SIDED: [&str; 5] = ["diffuse", "phong", "principled", "roughconductor", "roughplastic"];

/// The smoothest surface that is kept as written.
const MIN_ALPHA: f64 = 1e-4;

/// One side of a material.
type Side = (AnyBsdf, MaterialTextures);

/// A material for both sides of a surface, without a name.
pub(super) fn read(context: &mut Context<'_>, element: &Element) -> Result<Material, LoadError> {
    let (bsdf, textures) = if element.plugin("bsdf", &NAMES)? == "twosided" {
        two_sided(context, element)?
    } else {
        let (front, textures) = one_sided(context, element)?;
        (TwoSided::front_only(front), [textures, MaterialTextures::default()])
    };
    Ok(Material { name: String::new(), bsdf, textures })
}

/// What a surface without a `<bsdf>` has: grey, or black where it emits, as in Mitsuba 3.
pub(super) fn default(emits: bool) -> Result<TwoSided<AnyBsdf>, crate::bsdf::BsdfError> {
    Lambert::new(Rgb::splat(if emits { 0.0 } else { 0.5 })).map(AnyBsdf::Lambert).map(TwoSided::front_only)
}

fn two_sided(
    context: &mut Context<'_>,
    element: &Element,
) -> Result<(TwoSided<AnyBsdf>, [MaterialTextures; 2]), LoadError> {
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
    let (back, back_textures) = back.unwrap_or_else(|| front.clone());
    Ok((TwoSided { front: front.0, back: Some(back) }, [front.1, back_textures]))
}

fn one_sided(context: &mut Context<'_>, element: &Element) -> Result<Side, LoadError> {
    let kind = element.plugin("bsdf for one side", &ONE_SIDED)?;
    let mut properties = Properties::new(element)?;
    let side = match kind {
        "diffuse" => {
            let (reflectance, diffuse) = texture::reflectance(context, &mut properties, "reflectance", 0.5)?;
            let bsdf = Lambert::new(reflectance).map_err(|e| element.error(e))?;
            (AnyBsdf::Lambert(bsdf), MaterialTextures { diffuse, ..MaterialTextures::default() })
        }
        "phong" => phong(context, element, &mut properties)?,
        "principled" => principled(context, element, &mut properties)?,
        "roughconductor" => rough_conductor(context, element, &mut properties)?,
        _ => rough_plastic(context, element, &mut properties)?,
    };
    properties.finish(context)?;
    Ok(side)
}

/// As `phong` of Mitsuba 0.6: both reflectances are scaled down when they exceed 1 together.
fn phong(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<Side, LoadError> {
    let (mut kd, diffuse) = texture::reflectance(context, properties, "diffuse_reflectance", 0.5)?;
    let (mut ks, specular) = texture::reflectance(context, properties, "specular_reflectance", 0.2)?;
    let exponent = properties.float_or("exponent", 30.0)? as f32;
    let largest = |own: Rgb, texture: &Option<TextureDescription>| match texture {
        Some(texture) => texture.texture().map(|t| t.largest()).map_err(|e| element.error(e)),
        None => Ok(own),
    };
    let most = (largest(kd, &diffuse)? + largest(ks, &specular)?).max_component();
    let mut scale = 1.0;
    if most > 1.0 && kd.is_valid() && ks.is_valid() {
        // Mitsuba 0.6 keeps 1 % of distance to losing nothing.
        scale = 0.99 / most;
        (kd, ks) = (kd * scale, ks * scale);
        context.warn(element, "reflects more than arrives; both reflectances are scaled down to 0.99 in sum");
    }
    let bsdf = Phong::new(kd, ks, exponent).map_err(|e| element.error(e))?;
    Ok((AnyBsdf::Phong(bsdf), MaterialTextures { diffuse, specular, roughness: None, scale }))
}

/// The part of `principled` that glTF has, in its model.
fn principled(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<Side, LoadError> {
    let (mut base, diffuse) = texture::reflectance(context, properties, "base_color", 0.5)?;
    let (roughness, rough) = texture::share(context, properties, "roughness", 0.5)?;
    let (metallic, metal) = texture::share(context, properties, "metallic", 0.0)?;
    let eta = properties.float_or("eta", 1.5)?;
    if properties.float_or("specular", 0.5)? != 0.5 || eta != 1.5 {
        let what = "another index of refraction than 1.5".to_owned();
        return Err(
            element.error(Problem::NotSupported { what, instead: "leave \"specular\" and \"eta\" out" })
        );
    }
    if diffuse.is_some() {
        // Textures are factors.
        base = Rgb::WHITE;
    }
    context.warn(element, "is read as the metallic-roughness model of glTF, whose matte base is darker");
    let bsdf =
        MetallicRoughness::new(base, metallic as f32, roughness as f32).map_err(|e| element.error(e))?;
    let roughness = texture::both(rough, metal).map_err(|problem| element.error(problem))?;
    let textures = MaterialTextures { diffuse, roughness, ..MaterialTextures::default() };
    Ok((AnyBsdf::MetallicRoughness(bsdf), textures))
}

fn rough_conductor(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<Side, LoadError> {
    if let Some((child, material)) = properties.text("material")?
        && material != "none"
    {
        return Err(child.error(Problem::unknown("material", material, &["none"])));
    }
    only_ggx(element, properties)?;
    let (reflectance, specular) = texture::reflectance(context, properties, "specular_reflectance", 1.0)?;
    let (alpha, roughness) = roughnesses(context, element, properties)?;
    let mut bsdf = GgxConductor::anisotropic(reflectance, alpha).map_err(|e| element.error(e))?;
    let (eta, k) = (properties.reflectance("eta")?, properties.reflectance("k")?);
    if eta.is_some() || k.is_some() {
        // What is not given is that of a mirror.
        let (eta, k) = (eta.unwrap_or(Rgb::BLACK), k.unwrap_or(Rgb::WHITE));
        bsdf = bsdf.with_index(eta, k).map_err(|e| element.error(e))?;
    }
    let textures = MaterialTextures { specular, roughness, ..MaterialTextures::default() };
    Ok((AnyBsdf::GgxConductor(bsdf), textures))
}

fn rough_plastic(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<Side, LoadError> {
    only_ggx(element, properties)?;
    let alpha = supported(context, element, properties.float_or("alpha", 0.1)?);
    let eta = ior::relative(element, properties)?;
    let (kd, diffuse) = texture::reflectance(context, properties, "diffuse_reflectance", 0.5)?;
    let (ks, specular) = texture::reflectance(context, properties, "specular_reflectance", 1.0)?;
    let nonlinear = properties.flag("nonlinear")?;
    let bsdf = RoughPlastic::new(alpha, eta)
        .and_then(|bsdf| bsdf.with_diffuse(kd)?.with_specular(ks))
        .map(|bsdf| bsdf.with_nonlinear(nonlinear))
        .map_err(|e| element.error(e))?;
    let textures = MaterialTextures { diffuse, specular, ..MaterialTextures::default() };
    Ok((AnyBsdf::RoughPlastic(bsdf), textures))
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

/// Roughness along the surface's tangent and across it, and a texture for both.
fn roughnesses(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<([f32; 2], Option<TextureDescription>), LoadError> {
    let (both, texture) = texture::roughness(context, properties, "alpha")?;
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
    let first = supported(context, element, along);
    // The same roughness is warned of once.
    let second = if across == along { first } else { supported(context, element, across) };
    Ok(([first, second], texture))
}

/// A roughness as far as it is supported.
fn supported(context: &mut Context<'_>, element: &Element, alpha: f64) -> f32 {
    if (0.0..MIN_ALPHA).contains(&alpha) {
        context.warn(element, "alpha is below 0.0001, the smoothest that is supported; 0.0001 is used");
        return MIN_ALPHA as f32;
    }
    alpha as f32
}
