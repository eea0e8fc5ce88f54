//! Radiance in pictures of 8 or 16 bits: colours, and in place of alpha what they are divided by.

use super::{Encoding, ImageError, decoded, exr, texels};
use crate::build::Image;
use crate::load::Files;
use ::image::DynamicImage;
use std::path::Path;

/// Reads a picture like [`super::read_image`], but divides by alpha where integers have one.
///
/// * alpha is at least 1/255: of a texel that is transparent
///
/// Source: Khronos Group, *EXT_lights_image_based*, section "RGBD". Differs: colours follow sRGB, of
/// which it says nothing.
///
/// # Errors
/// As [`super::read_image`].
pub(in crate::load) fn read_rgbd_from(files: &Files, path: &Path) -> Result<Image, ImageError> {
    if exr::is_exr(files, path)? {
        return exr::read(files, path);
    }
    let image = decoded(files, path)?;
    let mut texels = texels(&image, Encoding::Srgb);
    let floats = matches!(image, DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_));
    if image.color().has_alpha() && !floats {
        for (texel, code) in texels.iter_mut().zip(image.to_rgba16().pixels()) {
            *texel *= f32::from(u16::MAX) / f32::from(code[3].max(u16::MAX / 255));
        }
    }
    Ok(Image { width: image.width(), height: image.height(), texels })
}
