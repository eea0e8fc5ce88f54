//! Encoding pictures as files.

use super::Picture;
use crate::args::Showing;
use crate::failure::Failure;
use halflight::num::pow;
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

    /// True for a format whose values are shown as they are, so that a view and an exposure apply.
    pub(crate) fn is_shown(self) -> bool {
        self == Self::Png
    }

    /// The bytes of a file with this picture, seen as `showing` says if the format is one that is shown.
    ///
    /// # Errors
    /// When the picture does not fit the format.
    pub(crate) fn encode(self, picture: &Picture, showing: &Showing) -> Result<Vec<u8>, Failure> {
        let Picture { width, height, .. } = *picture;
        let mut file = Cursor::new(Vec::new());
        match self {
            Self::Png => {
                let bytes = bytes(picture, showing);
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

/// The codes of the picture, 8 bits each.
fn bytes(picture: &Picture, showing: &Showing) -> Vec<u8> {
    let (view, gain) = (showing.view.unwrap_or_default(), pow(2.0, showing.exposure.unwrap_or(0.0)));
    let byte = |code: f32| (code * 255.0).round() as u8;
    picture.pixels.iter().flat_map(|&p| view.codes(p * gain).to_array().map(byte)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use halflight::Rgb;

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
        let code = |exposure| bytes(&picture, &Showing::exposed(exposure));
        assert_eq!(code(2.0), [255; 3]);
        assert_eq!(code(0.0), bytes(&picture, &Showing::default()));
        assert!(code(1.0)[0] > code(0.0)[0]);
        assert_eq!(code(1e30), [255; 3]);
        assert_eq!(code(-1e30), [0; 3]);
    }
}
