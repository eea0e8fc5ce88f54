//! Pictures from files: radiance, and reflectance for textures.

mod error;
mod exr;
mod rgbd;
mod texels;

pub use error::ImageError;
pub use exr::write_exr;
pub(super) use rgbd::read_rgbd_from;
pub use texels::read_texels;
pub(super) use texels::read_texels_from;

use crate::Rgb;
use crate::build::Image;
use crate::load::Files;
use crate::load::files::room_for;
use crate::num;
use ::image::{DynamicImage, ImageReader, Limits};
use std::path::Path;
use std::vec::Vec;

/// What the numbers of an 8- or 16-bit file mean. Files of floating-point numbers are linear whatever
/// is said.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Encoding {
    /// Codes of the sRGB transfer curve: colours for people.
    #[default]
    Srgb,
    /// The values themselves, in `[0, 1]`.
    Linear,
}

/// Most texels of a picture: 16384 × 16384, 3 GiB.
pub const MAX_TEXELS: u64 = 1 << 28;

/// Reads a picture: .exr, .hdr, .png or .jpg, told by its first bytes. One channel is taken as grey,
/// alpha is ignored.
///
/// * `encoding` – of 8- and 16-bit files
///
/// The texels are what the file says, negative or not finite ones included: whoever uses them
/// refuses what cannot be used.
///
/// # Errors
/// When the file cannot be read, is none of these, is malformed, or has more than [`MAX_TEXELS`].
pub fn read_image(path: &Path, encoding: Encoding) -> Result<Image, ImageError> {
    read_image_from(&Files::on_disk(), path, encoding)
}

/// Reads a picture as [`read_image`] does, from files wherever they are.
///
/// # Errors
/// As [`read_image`].
pub fn read_image_from(files: &Files, path: &Path, encoding: Encoding) -> Result<Image, ImageError> {
    if exr::is_exr(files, path)? {
        return exr::read(files, path);
    }
    let image = decoded(files, path)?;
    Ok(Image { width: image.width(), height: image.height(), texels: texels(&image, encoding) })
}

/// The picture as the file has it.
fn decoded(files: &Files, path: &Path) -> Result<DynamicImage, ImageError> {
    // The bytes decide, and not the name: the name would choose a reader that finds something else wrong.
    let open = || ImageReader::new(files.open(path)?.0).with_guessed_format();
    let bytes = files.open(path)?.1;
    let mut reader = open()?;
    let mut limits = Limits::no_limits();
    limits.max_alloc = Some(MAX_TEXELS * 12);
    reader.limits(limits);
    let (width, height) = open()?.into_dimensions()?;
    check_size(width, height, bytes)?;
    Ok(reader.decode()?)
}

/// The most texels that a byte of a file stands for: with DEFLATE, which makes 1032 bytes of one, and 8
/// texels in a byte, as the PNG of one bit has them.
///
/// Source: RFC 1951, section 3.2.5: 258 bytes from two codes of one bit each.
const MOST_TEXELS_PER_BYTE: u64 = 1032 * 8;

/// Refuses a picture that would fill the memory, or that a file of so many bytes cannot hold: before
/// anything is allocated for it.
fn check_size(width: u32, height: u32, bytes: u64) -> Result<(), ImageError> {
    match u64::from(width) * u64::from(height) {
        0 => Err(ImageError::Empty),
        n if n > MAX_TEXELS => Err(ImageError::TooLarge { width, height }),
        n if n > bytes.saturating_mul(MOST_TEXELS_PER_BYTE) => {
            Err(ImageError::Short { width, height, bytes })
        }
        n => Ok(room_for(n * 12)?),
    }
}

/// The linear texels.
fn texels(image: &DynamicImage, encoding: Encoding) -> Vec<Rgb> {
    let decode = |code: f32| if encoding == Encoding::Srgb { srgb_to_linear(code) } else { code };
    match image {
        DynamicImage::ImageRgb32F(rgb) => rgb.pixels().map(|p| Rgb::from(p.0)).collect(),
        DynamicImage::ImageRgba32F(rgba) => rgba.pixels().map(|p| Rgb::new(p[0], p[1], p[2])).collect(),
        DynamicImage::ImageLuma16(_)
        | DynamicImage::ImageLumaA16(_)
        | DynamicImage::ImageRgb16(_)
        | DynamicImage::ImageRgba16(_) => {
            let value = |code: u16| decode(f32::from(code) / f32::from(u16::MAX));
            image.to_rgb16().pixels().map(|p| Rgb::from(p.0.map(value))).collect()
        }
        _ => {
            let table: [f32; 256] = core::array::from_fn(|code| decode(code as f32 / 255.0));
            image.to_rgb8().pixels().map(|p| Rgb::from(p.0.map(|code| table[usize::from(code)]))).collect()
        }
    }
}

/// From an sRGB code to its linear value; both in `[0, 1]`.
///
/// Source: IEC 61966-2-1:1999.
#[must_use]
pub fn srgb_to_linear(code: f32) -> f32 {
    if code <= 0.040_45 { code / 12.92 } else { num::pow((code + 0.055) / 1.055, 2.4) }
}

#[cfg(test)]
mod tests;
