//! Encoding pictures as files.

use super::{Picture, encode};
use crate::failure::Failure;
use halflight::Rgb;
use image::codecs::hdr::HdrEncoder;
use image::codecs::openexr::OpenExrEncoder;
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder, ImageError};
use std::ffi::OsStr;
use std::io::Cursor;
use std::path::Path;

/// What a picture is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    /// PNG, 8 bits per channel, sRGB.
    Png,
    /// OpenEXR, 32-bit floats, linear.
    Exr,
    /// Radiance RGBE, linear.
    Hdr,
}

impl Format {
    /// The format that a file's name asks for.
    ///
    /// # Errors
    /// When the name has no extension, or one that is not written.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let extension = path.extension().and_then(OsStr::to_str).map(str::to_ascii_lowercase);
        match extension.as_deref() {
            Some("png") => Ok(Self::Png),
            Some("exr") => Ok(Self::Exr),
            Some("hdr") => Ok(Self::Hdr),
            Some(other) => {
                Err(Failure::new(format!("cannot write {}: unknown format .{other}", path.display())))
            }
            None => Err(Failure::new(format!("cannot write {}: its name has no extension", path.display()))),
        }
        .map_err(|f| {
            f.tip("end the name in .png (8-bit sRGB), .exr (linear, 32-bit float) or .hdr (linear, RGBE)")
        })
    }

    /// True for a format whose values are shown as they are, so that exposure applies.
    pub(crate) fn is_8_bit(self) -> bool {
        self == Self::Png
    }

    /// The bytes of a file with this picture, whose values are multiplied by 2^`exposure` if the
    /// format has 8 bits.
    ///
    /// # Errors
    /// When the picture does not fit the format.
    pub(crate) fn encode(self, picture: &Picture, exposure: f32) -> Result<Vec<u8>, Failure> {
        let Picture { width, height, .. } = *picture;
        let mut file = Cursor::new(Vec::new());
        match self {
            Self::Png => {
                let bytes = bytes(picture, exposure);
                PngEncoder::new(&mut file).write_image(&bytes, width, height, ExtendedColorType::Rgb8)
            }
            Self::Exr => {
                let floats: Vec<u8> =
                    picture.pixels.iter().flat_map(|p| p.to_array()).flat_map(f32::to_ne_bytes).collect();
                OpenExrEncoder::new(&mut file).write_image(&floats, width, height, ExtendedColorType::Rgb32F)
            }
            Self::Hdr => {
                let pixels: Vec<_> = picture.pixels.iter().map(|p| image::Rgb(p.to_array())).collect();
                HdrEncoder::new(&mut file).encode(&pixels, width as usize, height as usize)
            }
        }
        .map_err(|e: ImageError| Failure::new(format!("cannot encode the picture: {e}")))?;
        Ok(file.into_inner())
    }
}

/// The picture in 8-bit sRGB.
fn bytes(picture: &Picture, exposure: f32) -> Vec<u8> {
    let gain = exposure.exp2();
    let byte = |linear: f32| (encode(linear * gain) * 255.0).round() as u8;
    picture.pixels.iter().flat_map(|&Rgb { r, g, b }| [byte(r), byte(g), byte(b)]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_extension_decides_whatever_its_case() {
        assert_eq!(Format::of(Path::new("a.PNG")), Ok(Format::Png));
        assert_eq!(Format::of(Path::new("b/a.exr")), Ok(Format::Exr));
        assert!(Format::of(Path::new("a.bmp")).is_err());
        assert!(Format::of(Path::new("png")).is_err());
        assert!(Format::of(Path::new(".png")).is_err());
    }

    #[test]
    fn exposure_doubles_with_every_stop() {
        let picture = Picture { width: 1, height: 1, pixels: vec![Rgb::splat(0.25)] };
        assert_eq!(bytes(&picture, 2.0), [255; 3]);
        assert_eq!(bytes(&picture, 0.0), bytes(&picture, 0.0));
        assert!(bytes(&picture, 1.0)[0] > bytes(&picture, 0.0)[0]);
    }
}
