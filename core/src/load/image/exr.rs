//! OpenEXR: texels go straight to where they stay, because environment maps are large.

use super::{ImageError, check_size};
use crate::Rgb;
use crate::build::Image;
use crate::load::Files;
use ::exr::meta::MetaData;
use ::exr::prelude::{ReadChannels, ReadLayers, ReadSpecificChannel, SpecificChannels, Vec2, WritableImage};
use std::io::{Read, Seek, Write};
use std::path::Path;
use std::vec::Vec;

/// The first bytes of an OpenEXR file.
const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];

/// True when the file starts as an OpenEXR file does.
pub(super) fn is_exr(files: &Files, path: &Path) -> Result<bool, ImageError> {
    let mut start = Vec::new();
    files.open(path)?.0.take(MAGIC.len() as u64).read_to_end(&mut start)?;
    Ok(start == MAGIC)
}

/// Reads the first layer that has red, green and blue, or luminance alone.
pub(super) fn read(files: &Files, path: &Path) -> Result<Image, ImageError> {
    let open = || files.open(path).map(|(file, _)| file);
    let bytes = files.open(path)?.1;
    let headers = MetaData::read_from_buffered(open()?, false)?.headers;
    headers.iter().try_for_each(|h| check_size(h.layer_size.0 as u32, h.layer_size.1 as u32, bytes))?;
    let has =
        |channel: &str| headers.iter().any(|h| h.channels.find_index_of_channel(&channel.into()).is_some());
    let layers = ::exr::prelude::read().no_deep_data().largest_resolution_level();
    let canvas = if has("Y") && !has("G") {
        let grey = |canvas: &mut Canvas, at: Vec2<usize>, (y,): (f32,)| canvas.put(at, Rgb::splat(y));
        let channels =
            layers.specific_channels().required("Y").collect_pixels(|size, _| Canvas::new(size), grey);
        channels.first_valid_layer().all_attributes().from_buffered(open()?)?.layer_data.channel_data.pixels
    } else {
        let put = |canvas: &mut Canvas, at: Vec2<usize>, (r, g, b): (f32, f32, f32)| {
            canvas.put(at, Rgb::new(r, g, b))
        };
        let channels = layers.rgb_channels(|size, _| Canvas::new(size), put);
        channels.first_valid_layer().all_attributes().from_buffered(open()?)?.layer_data.channel_data.pixels
    };
    Ok(Image { width: canvas.width as u32, height: canvas.height as u32, texels: canvas.texels })
}

/// What the texels are put on as they come.
struct Canvas {
    width: usize,
    height: usize,
    texels: Vec<Rgb>,
}

impl Canvas {
    fn new(size: Vec2<usize>) -> Self {
        Self { width: size.0, height: size.1, texels: [Rgb::BLACK].repeat(size.0 * size.1) }
    }

    fn put(&mut self, at: Vec2<usize>, texel: Rgb) {
        if let Some(place) = self.texels.get_mut(at.1 * self.width + at.0) {
            *place = texel;
        }
    }
}

/// Writes a picture as OpenEXR: red, green and blue, 32-bit floats, without loss.
///
/// # Errors
/// When it cannot be written.
pub fn write_exr(image: &Image, out: impl Write + Seek) -> Result<(), ImageError> {
    let size = (image.width as usize, image.height as usize);
    let channels = SpecificChannels::rgb(|at: Vec2<usize>| {
        let Rgb { r, g, b } = image.texels.get(at.1 * size.0 + at.0).copied().unwrap_or(Rgb::BLACK);
        (r, g, b)
    });
    Ok(::exr::prelude::Image::from_channels(size, channels).write().to_buffered(out)?)
}
