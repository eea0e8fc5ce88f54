//! Materials in Mitsuba's words.

use super::ExportError;
use super::textures::Pictures;
use super::xml::Xml;
use crate::Rgb;
use crate::bsdf::{AnyBsdf, GgxConductor, MetallicRoughness, RoughPlastic, TwoSided};
use crate::build::{Material, MaterialTextures, TexelBuffer, TextureDescription};
use crate::texture::{Kind, Pattern};
use std::sync::Arc;

/// Writes a material.
pub(super) fn write(
    xml: &mut Xml,
    pictures: &mut Pictures<'_>,
    material: &Material,
    id: Option<&str>,
) -> Result<(), ExportError> {
    let (TwoSided { front, back }, textures) = (&material.bsdf, &material.textures);
    let Some(back) = back else { return one_sided(xml, pictures, front, &textures[0], id) };
    xml.open_plugin("bsdf", "twosided", id);
    one_sided(xml, pictures, front, &textures[0], None)?;
    if back != front || textures[0] != textures[1] {
        one_sided(xml, pictures, back, &textures[1], None)?;
    }
    xml.close("bsdf");
    Ok(())
}

fn one_sided(
    xml: &mut Xml,
    pictures: &mut Pictures<'_>,
    bsdf: &AnyBsdf,
    textures: &MaterialTextures,
    id: Option<&str>,
) -> Result<(), ExportError> {
    let scale = Rgb::splat(textures.scale);
    let diffuse = textures.diffuse.as_ref().map(|t| (t, scale));
    let specular = textures.specular.as_ref().map(|t| (t, scale));
    match bsdf {
        AnyBsdf::Lambert(b) => {
            xml.open_plugin("bsdf", "diffuse", id);
            pictures.colour(xml, "reflectance", b.reflectance(), diffuse)?;
        }
        AnyBsdf::Phong(b) => {
            xml.remark("phong is the plugin of Mitsuba 0.6; Mitsuba 3 needs it to be registered");
            xml.open_plugin("bsdf", "phong", id);
            pictures.colour(xml, "diffuse_reflectance", b.diffuse(), diffuse)?;
            pictures.colour(xml, "specular_reflectance", b.specular(), specular)?;
            xml.float("exponent", b.exponent());
        }
        AnyBsdf::GgxConductor(b) => {
            rough_conductor(xml, b, textures.roughness.is_some(), id);
            if let Some(roughness) = &textures.roughness {
                pictures.colour(xml, "alpha", Rgb::BLACK, Some((&for_one_number(roughness), Rgb::WHITE)))?;
            }
            pictures.colour(xml, "specular_reflectance", b.reflectance(), specular)?;
        }
        AnyBsdf::RoughPlastic(b) => {
            rough_plastic(xml, b, id);
            pictures.colour(xml, "diffuse_reflectance", b.diffuse(), diffuse)?;
            pictures.colour(xml, "specular_reflectance", b.specular(), specular)?;
        }
        AnyBsdf::MetallicRoughness(b) => metallic_roughness(xml, pictures, b, textures, id)?,
    }
    xml.close("bsdf");
    Ok(())
}

/// The nearest that Mitsuba has: the same facets, over a base that is not fainter for what they reflect.
fn metallic_roughness(
    xml: &mut Xml,
    pictures: &mut Pictures<'_>,
    bsdf: &MetallicRoughness,
    textures: &MaterialTextures,
    id: Option<&str>,
) -> Result<(), ExportError> {
    xml.remark("metallic-roughness of glTF, of which principled is the nearest: its matte base is brighter");
    xml.open_plugin("bsdf", "principled", id);
    let base = textures.diffuse.as_ref().map(|t| (t, bsdf.base_color() * textures.scale));
    pictures.colour(xml, "base_color", bsdf.base_color(), base)?;
    for (name, own, channel) in [("metallic", bsdf.metallic(), 2), ("roughness", bsdf.roughness(), 1)] {
        match &textures.roughness {
            None => xml.float(name, own),
            Some(both) => {
                let one = for_one_number(&one_channel(both, channel));
                pictures.colour(xml, name, Rgb::BLACK, Some((&one, Rgb::splat(own))))?;
            }
        }
    }
    Ok(())
}

/// A texture of one of the channels of another.
fn one_channel(texture: &TextureDescription, channel: usize) -> TextureDescription {
    let grey = |c: Rgb| Rgb::splat(c.to_array()[channel]);
    let kind = match texture.pattern.kind() {
        Kind::Constant(colour) => Kind::Constant(grey(colour)),
        Kind::Checkerboard(colours) => Kind::Checkerboard(colours.map(grey)),
        picture @ Kind::Picture { .. } => picture,
    };
    let texels = texture.texels.as_deref().map(|texels| match texels {
        TexelBuffer::Linear8(codes) => {
            TexelBuffer::Linear8(codes.iter().map(|code| [code[channel]; 3]).collect())
        }
        other => {
            let all = other.texels();
            TexelBuffer::Float((0..all.len()).map(|i| grey(all.get(i))).collect())
        }
    });
    let pattern = Pattern::from(kind).with_transform(texture.pattern.transform());
    TextureDescription { pattern, texels: texels.map(Arc::new) }
}

/// Where Mitsuba asks a checkerboard for one number, the colours change places.
fn for_one_number(texture: &TextureDescription) -> TextureDescription {
    let mut texture = texture.clone();
    if let Kind::Checkerboard([a, b]) = texture.pattern.kind() {
        let swapped = Pattern::from(Kind::Checkerboard([b, a]));
        texture.pattern = swapped.with_transform(texture.pattern.transform());
    }
    texture
}

fn rough_conductor(xml: &mut Xml, bsdf: &GgxConductor, textured: bool, id: Option<&str>) {
    xml.open_plugin("bsdf", "roughconductor", id);
    xml.property("string", "material", "none");
    xml.property("string", "distribution", "ggx");
    match bsdf.alpha() {
        _ if textured => {}
        [along, across] if along == across => xml.float("alpha", along),
        [along, across] => {
            xml.float("alpha_u", along);
            xml.float("alpha_v", across);
        }
    }
    if let Some((eta, k)) = bsdf.index() {
        xml.rgb("eta", eta);
        xml.rgb("k", k);
    }
}

fn rough_plastic(xml: &mut Xml, bsdf: &RoughPlastic, id: Option<&str>) {
    xml.open_plugin("bsdf", "roughplastic", id);
    xml.property("string", "distribution", "ggx");
    xml.float("alpha", bsdf.alpha());
    xml.float("int_ior", bsdf.eta());
    xml.float("ext_ior", 1.0);
    if bsdf.is_nonlinear() {
        xml.property("boolean", "nonlinear", "true");
    }
}
