//! `<texture>`: values that vary over a surface.

use super::context::Context;
use super::element::Element;
use super::properties::Properties;
use crate::Rgb;
use crate::bsdf::GgxConductor;
use crate::build::{TexelBuffer, TextureDescription};
use crate::load::image::read_texels_from;
use crate::load::{Encoding, LoadError, Problem};
use crate::texture::{Interpolation, Kind, Pattern, TextureError, UvTransform, Wrap};
use std::borrow::ToOwned;
use std::sync::Arc;

const NAMES: [&str; 2] = ["bitmap", "checkerboard"];

/// A reflectance: one value, and the texture that replaces it, if there is one. The value is then
/// the texture's mean.
pub(super) fn reflectance(
    context: &mut Context<'_>,
    properties: &mut Properties<'_>,
    name: &'static str,
    default: f32,
) -> Result<(Rgb, Option<TextureDescription>), LoadError> {
    let Some(element) = properties.texture(name)? else {
        return Ok((properties.reflectance(name)?.unwrap_or(Rgb::splat(default)), None));
    };
    let mut texture = read(context, element)?;
    let refused = |e: TextureError| element.error(e);
    let largest = texture.texture().map_err(refused)?.largest();
    if largest.max_component() > 1.0 {
        clamp(context, element, &mut texture, largest)?;
    }
    let mean = texture.texture().map_err(refused)?.mean().map(|channel| channel.min(1.0));
    Ok((mean, Some(texture)))
}

/// A roughness, when it is given: one value, and the texture that replaces it, if there is one.
pub(super) fn roughness(
    context: &mut Context<'_>,
    properties: &mut Properties<'_>,
    name: &'static str,
) -> Result<(Option<f64>, Option<TextureDescription>), LoadError> {
    let Some(element) = properties.texture(name)? else { return Ok((properties.float(name)?, None)) };
    let texture = one_number(context, element)?;
    let looked = texture.texture().map_err(|e| element.error(e))?;
    if looked.smallest().luminance() < GgxConductor::MIN_ALPHA || looked.largest().luminance() > 1.0 {
        context.warn(element, "goes beyond the roughnesses that are supported, 0.0001 to 1, and is clamped");
    }
    let mean = f64::from(looked.mean().luminance().clamp(GgxConductor::MIN_ALPHA, 1.0));
    Ok((Some(mean), Some(texture)))
}

/// A texture of which one number is taken.
fn one_number(context: &mut Context<'_>, element: &Element) -> Result<TextureDescription, LoadError> {
    let mut texture = read(context, element)?;
    // Where Mitsuba asks a checkerboard for one number, the colours change places.
    if let Kind::Checkerboard([a, b]) = texture.pattern.kind() {
        let swapped = Pattern::from(Kind::Checkerboard([b, a]));
        texture.pattern = swapped.with_transform(texture.pattern.transform());
    }
    Ok(texture)
}

/// A number in `[0, 1]`, 1 when a texture gives it.
pub(super) fn share(
    context: &mut Context<'_>,
    properties: &mut Properties<'_>,
    name: &'static str,
    default: f64,
) -> Result<(f64, Option<TextureDescription>), LoadError> {
    match properties.texture(name)? {
        Some(element) => Ok((1.0, Some(one_number(context, element)?))),
        None => Ok((properties.float_or(name, default)?, None)),
    }
}

/// One texture with the numbers of the first in green and those of the second in blue; 1 where there is
/// none.
pub(super) fn both(
    green: Option<TextureDescription>,
    blue: Option<TextureDescription>,
) -> Result<Option<TextureDescription>, Problem> {
    let Some(first) = green.as_ref().or(blue.as_ref()) else { return Ok(None) };
    let pattern = first.pattern;
    let same = [&green, &blue].into_iter().flatten().all(|texture| texture.pattern == pattern);
    let Kind::Picture { width, height, .. } = pattern.kind() else { return Err(apart()) };
    if !same {
        return Err(apart());
    }
    let number = |texture: &Option<TextureDescription>, i: usize| {
        let texels = texture.as_ref().and_then(|t| t.texels.as_ref());
        texels.map_or(1.0, |texels| texels.texels().get(i).luminance())
    };
    let of = |i| Rgb::new(0.0, number(&green, i), number(&blue, i));
    let values = (0..width as usize * height as usize).map(of).collect();
    Ok(Some(TextureDescription { pattern, texels: Some(Arc::new(TexelBuffer::Float(values))) }))
}

fn apart() -> Problem {
    let what = "roughness and metalness from unlike textures".to_owned();
    Problem::NotSupported { what, instead: "give both as pictures of one size, or as numbers" }
}

/// A radiance: a factor, and the texture that it is on, if there is one.
pub(super) fn radiance(
    context: &mut Context<'_>,
    properties: &mut Properties<'_>,
    name: &'static str,
) -> Result<(Rgb, Option<TextureDescription>), LoadError> {
    let Some(element) = properties.texture(name)? else { return Ok((properties.emission(name)?, None)) };
    let texture = read(context, element)?;
    texture.texture().map_err(|e| element.error(e))?;
    Ok((Rgb::WHITE, Some(texture)))
}

/// Takes what is above 1 for 1, in the texels of a picture.
fn clamp(
    context: &mut Context<'_>,
    element: &Element,
    texture: &mut TextureDescription,
    largest: Rgb,
) -> Result<(), LoadError> {
    let Some(TexelBuffer::Float(values)) = texture.texels.as_deref() else {
        let parameter = "a reflectance";
        return Err(element.error(TextureError::TooBright { parameter, largest }));
    };
    let clamped = values.iter().map(|v| v.map(|channel| channel.min(1.0))).collect();
    texture.texels = Some(Arc::new(TexelBuffer::Float(clamped)));
    context.warn(element, "reflects more than arrives; values above 1 are taken for 1");
    Ok(())
}

/// A texture, or the one that a reference means.
fn read(context: &mut Context<'_>, element: &Element) -> Result<TextureDescription, LoadError> {
    if element.tag == "ref" {
        let target = context.referent(element)?;
        if target.tag != "texture" {
            let what = std::format!("a <{}> as a texture", target.tag);
            return Err(element.error(Problem::NotSupported { what, instead: "refer to a <texture>" }));
        }
        return read(context, target);
    }
    let kind = element.plugin("texture", &NAMES)?;
    let mut properties = Properties::new(element)?;
    let texture = match kind {
        "bitmap" => bitmap(context, element, &mut properties)?,
        _ => checkerboard(&mut properties)?,
    };
    let to_uv = transform(&mut properties)?;
    properties.finish(context)?;
    Ok(TextureDescription { pattern: texture.pattern.with_transform(to_uv), ..texture })
}

/// As Mitsuba, takes rows and columns of x and y, and what is added to them.
fn transform(properties: &mut Properties<'_>) -> Result<UvTransform, LoadError> {
    let Some((at, m)) = properties.transform("to_uv")? else { return Ok(UvTransform::IDENTITY) };
    let row = |i: usize| {
        let row = m.row(i);
        [row.x as f32, row.y as f32, row.w as f32]
    };
    UvTransform::new([row(0), row(1)]).map_err(|e| at.error(e))
}

fn checkerboard(properties: &mut Properties<'_>) -> Result<TextureDescription, LoadError> {
    let mut colour = |name, default| Ok(properties.reflectance(name)?.unwrap_or(Rgb::splat(default)));
    let colours = [colour("color0", 0.4)?, colour("color1", 0.2)?];
    Ok(TextureDescription { pattern: Kind::Checkerboard(colours).into(), texels: None })
}

fn bitmap(
    context: &mut Context<'_>,
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<TextureDescription, LoadError> {
    let (_, name) = properties
        .text("filename")?
        .ok_or_else(|| element.error(Problem::Missing { what: "the property \"filename\"".to_owned() }))?;
    let interpolation = one_of(
        properties,
        "filter_type",
        &[("bilinear", Interpolation::Bilinear), ("nearest", Interpolation::Nearest)],
    )?;
    let wraps = [("repeat", Wrap::Repeat), ("mirror", Wrap::Mirror), ("clamp", Wrap::Clamp)];
    let wrap = one_of(properties, "wrap_mode", &wraps)?;
    let raw = properties.flag("raw")?;
    properties.ignore(&["format", "accel"]);
    let (width, height, texels) = picture(context, element, name, raw)?;
    let pattern = Kind::Picture { width, height, interpolation, wrap }.into();
    Ok(TextureDescription { pattern, texels: Some(texels) })
}

/// The value of a property that has a few names; the first is what holds when it is not given.
fn one_of<T: Copy>(
    properties: &mut Properties<'_>,
    property: &'static str,
    names: &[(&str, T)],
) -> Result<T, LoadError> {
    let Some((child, text)) = properties.text(property)? else { return Ok(names[0].1) };
    names.iter().find(|(name, _)| *name == text).map(|(_, value)| *value).ok_or_else(|| {
        let known: std::vec::Vec<&str> = names.iter().map(|(name, _)| *name).collect();
        child.error(Problem::unknown(property, text, &known))
    })
}

/// A picture's columns, rows and texels.
fn picture(
    context: &mut Context<'_>,
    element: &Element,
    name: &str,
    raw: bool,
) -> Result<(u32, u32, Arc<TexelBuffer>), LoadError> {
    let path = context.find(element, name);
    let key = (path, raw);
    if let Some(known) = context.pictures.get(&key) {
        return Ok(known.clone());
    }
    let encoding = if raw { Encoding::Linear } else { Encoding::Srgb };
    let (width, height, texels) = read_texels_from(&context.document.files, &key.0, encoding)
        .map_err(|source| element.error(Problem::Image { path: key.0.clone(), source }))?;
    let read = (width, height, Arc::new(texels));
    context.pictures.insert(key, read.clone());
    Ok(read)
}
