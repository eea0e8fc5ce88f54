//! Pictures as textures keep them.

use super::{Encoding, ImageError, decoded, exr, texels};
use crate::build::TexelBuffer;
use crate::load::Files;
use ::image::DynamicImage;
use std::path::Path;

/// Reads a picture like [`super::read_image`], but keeps 8 bits where the file has no more: its
/// columns, its rows and its texels.
///
/// # Errors
/// As [`super::read_image`].
pub fn read_texels(path: &Path, encoding: Encoding) -> Result<(u32, u32, TexelBuffer), ImageError> {
    read_texels_from(&Files::on_disk(), path, encoding)
}

/// The same from files wherever they are.
pub(in crate::load) fn read_texels_from(
    files: &Files,
    path: &Path,
    encoding: Encoding,
) -> Result<(u32, u32, TexelBuffer), ImageError> {
    if exr::is_exr(files, path)? {
        let image = exr::read(files, path)?;
        return Ok((image.width, image.height, TexelBuffer::Float(image.texels)));
    }
    let image = decoded(files, path)?;
    let buffer = match &image {
        DynamicImage::ImageLuma8(_)
        | DynamicImage::ImageLumaA8(_)
        | DynamicImage::ImageRgb8(_)
        | DynamicImage::ImageRgba8(_) => {
            let codes = image.to_rgb8().pixels().map(|p| p.0).collect();
            if encoding == Encoding::Srgb { TexelBuffer::Srgb8(codes) } else { TexelBuffer::Linear8(codes) }
        }
        _ => TexelBuffer::Float(texels(&image, encoding)),
    };
    Ok((image.width(), image.height(), buffer))
}
