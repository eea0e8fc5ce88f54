//! Textures and their pictures.

use super::container::malformed;
use super::document::{TextureInfo, TextureTransform};
use super::log::Log;
use super::source::{Source, entry};
use crate::build::{TexelBuffer, TextureDescription};
use crate::load::image::read_texels_from;
use crate::load::{Encoding, MAX_TEXELS, Problem};
use crate::num;
use crate::texture::{Interpolation, Kind, Pattern, UvTransform, Wrap};
use std::collections::BTreeMap;
use std::format;
use std::sync::Arc;

/// The code for what is nearest, without interpolation.
const NEAREST: u32 = 9728;

/// Columns, rows and texels of a picture.
type Picture = (u32, u32, Arc<TexelBuffer>);

/// The pictures that have been read, by index and whether they hold colours.
#[derive(Debug, Default)]
pub(super) struct Pictures {
    known: BTreeMap<(usize, bool), Picture>,
    texels: u64,
}

/// The set of texture coordinates that a texture is on.
pub(super) fn uv_set(info: &TextureInfo) -> u32 {
    let overruling = info.extensions.transform.as_ref().and_then(|t| t.tex_coord);
    overruling.unwrap_or(info.tex_coord)
}

impl Pictures {
    /// A texture.
    ///
    /// * `colour` – true for sRGB codes, false for numbers
    pub(super) fn texture(
        &mut self,
        source: &Source<'_>,
        log: &mut Log<'_>,
        info: &TextureInfo,
        colour: bool,
    ) -> Result<TextureDescription, Problem> {
        let texture = entry(&source.document.textures, "textures", info.index)?;
        let item = format!("textures[{}]", info.index);
        let image = texture.source.ok_or_else(|| Problem::NotSupported {
            what: format!("{item}, whose picture only an extension names,"),
            instead: "export textures as PNG or JPEG",
        })?;
        let (width, height, texels) = self.picture(source, image, colour)?;
        let (mut interpolation, mut wrap) = (Interpolation::Bilinear, Wrap::Repeat);
        if let Some(index) = texture.sampler {
            let sampler = entry(&source.document.samplers, "samplers", index)?;
            if sampler.mag_filter == Some(NEAREST) {
                interpolation = Interpolation::Nearest;
            }
            wrap = wrapped(sampler.wrap_s)?;
            if wrapped(sampler.wrap_t)? != wrap {
                log.warn(
                    &item,
                    "continues in one way to the sides and another up and down; the first is used",
                );
            }
        }
        let pattern = Pattern::from(Kind::Picture { width, height, interpolation, wrap });
        let to_uv = transform(info.extensions.transform.as_ref())?;
        Ok(TextureDescription { pattern: pattern.with_transform(to_uv), texels: Some(texels) })
    }

    fn picture(&mut self, source: &Source<'_>, index: usize, colour: bool) -> Result<Picture, Problem> {
        if let Some(known) = self.known.get(&(index, colour)) {
            return Ok(known.clone());
        }
        let (files, path) = source.picture(index)?;
        let encoding = if colour { Encoding::Srgb } else { Encoding::Linear };
        let read = read_texels_from(&files, &path, encoding);
        let (width, height, texels) = read.map_err(|source| Problem::Image { path, source })?;
        self.texels += u64::from(width) * u64::from(height);
        if self.texels > MAX_TEXELS {
            return Err(Problem::TooLarge { what: "texels of all pictures", limit: MAX_TEXELS as usize });
        }
        let picture = (width, height, Arc::new(texels));
        self.known.insert((index, colour), picture.clone());
        Ok(picture)
    }
}

fn wrapped(code: Option<u32>) -> Result<Wrap, Problem> {
    match code {
        None | Some(10497) => Ok(Wrap::Repeat),
        Some(33648) => Ok(Wrap::Mirror),
        Some(33071) => Ok(Wrap::Clamp),
        Some(other) => Err(malformed(format!("there is no wrapping mode {other}"))),
    }
}

/// Scales, turns, then moves texture coordinates, whose second one points down.
///
/// Source: Khronos Group 2018, *KHR_texture_transform*, section "glTF Schema Updates". Differs: turned
/// counter-clockwise, as its words and Khronos's own viewer have it; its matrix turns the other way.
fn transform(transform: Option<&TextureTransform>) -> Result<UvTransform, Problem> {
    let Some(transform) = transform else { return Ok(UvTransform::IDENTITY) };
    let ([x, y], [su, sv]) = (transform.offset, transform.scale.unwrap_or([1.0; 2]));
    let (sin, cos) = num::sin_cos(transform.rotation);
    UvTransform::new([[cos * su, sin * sv, x], [-sin * su, cos * sv, y]]).map_err(Problem::Texture)
}
