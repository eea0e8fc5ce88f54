//! Encoding pictures as files.

use super::Picture;
use super::exr::{Header, encode_exr};
use super::pfm::encode_pfm;
use crate::args::{Depth, Showing, View};
use crate::failure::Failure;
use image::codecs::hdr::HdrEncoder;
use image::codecs::jpeg::JpegEncoder;
use image::{ExtendedColorType, ImageEncoder};
use png::{BitDepth, ColorType, ScaledFloat, SourceChromaticities, SrgbRenderingIntent};
use std::ffi::OsStr;
use std::fmt::Display;
use std::io::Cursor;
use std::path::Path;

/// What a picture is written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    /// PNG, 8 or 16 bits per channel, sRGB.
    Png,
    /// JPEG, 8 bits per channel, sRGB.
    Jpeg,
    /// OpenEXR, 32-bit floats, linear.
    Exr,
    /// Radiance RGBE, linear.
    Hdr,
    /// Portable float map, 32-bit floats, linear.
    Pfm,
}

/// What can be written.
const FORMATS: &str =
    "end the name in .png or .jpg (sRGB), or in .exr, .pfm (linear, 32-bit float) or .hdr (linear, RGBE)";

/// JPEG's quality where the user does not say.
const QUALITY: u8 = 92;

/// Most columns and rows of a JPEG.
const JPEG_SIDE: u32 = 65_535;

impl Format {
    /// The format that a file's name asks for.
    ///
    /// # Errors
    /// When the name has no extension, or one that is not written.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        let extension = path.extension().and_then(OsStr::to_str).map(str::to_ascii_lowercase);
        let reason = match extension.as_deref() {
            Some("png") => return Ok(Self::Png),
            Some("jpg" | "jpeg") => return Ok(Self::Jpeg),
            Some("exr") => return Ok(Self::Exr),
            Some("hdr") => return Ok(Self::Hdr),
            Some("pfm") => return Ok(Self::Pfm),
            Some(other) => format!("unknown format .{other}"),
            None => "its name has no extension".to_owned(),
        };
        let failure = Failure::new(format!("cannot write {}: {reason}", path.display()));
        let name = path.join("NAME.png");
        Err(match path.is_dir() {
            true => failure.tip(format!("it is a folder: name a file in it, as in -o {}", name.display())),
            false => failure.tip(FORMATS),
        })
    }

    /// True for a format whose values are shown as they are, so that a view and an exposure apply.
    pub(crate) fn is_shown(self) -> bool {
        matches!(self, Self::Png | Self::Jpeg)
    }

    /// Refuses a picture that is too large for the format.
    ///
    /// # Errors
    /// When it is.
    pub(crate) fn check_size(self, width: u32, height: u32) -> Result<(), Failure> {
        if self == Self::Jpeg && width.max(height) > JPEG_SIDE {
            let message = format!("JPEG holds at most {JPEG_SIDE} columns and rows, not {width}×{height}");
            return Err(Failure::new(message).tip("write .png or .exr, or a smaller picture"));
        }
        Ok(())
    }

    /// The bytes of a file with this picture, seen as `showing` says if the format is one that is shown.
    ///
    /// # Errors
    /// When the picture does not fit the format.
    pub(crate) fn encode(self, picture: &Picture, showing: &Showing) -> Result<Vec<u8>, Failure> {
        let Picture { width, height, .. } = *picture;
        let mut file = Cursor::new(Vec::new());
        match self {
            Self::Png => encode_png(&mut file, picture, showing).map_err(refused)?,
            Self::Jpeg => {
                let quality = showing.quality.unwrap_or(QUALITY);
                let bytes: Vec<u8> = showing.codes(&picture.pixels).flat_map(|c| c.map(byte)).collect();
                JpegEncoder::new_with_quality(&mut file, quality)
                    .write_image(&bytes, width, height, ExtendedColorType::Rgb8)
                    .map_err(refused)?;
            }
            Self::Exr => return encode_exr(picture, Vec::new(), &Header::default()),
            Self::Hdr => {
                let pixels: Vec<_> = picture.pixels.iter().map(|p| image::Rgb(p.to_array())).collect();
                HdrEncoder::new(&mut file)
                    .encode(&pixels, width as usize, height as usize)
                    .map_err(refused)?;
            }
            Self::Pfm => return Ok(encode_pfm(picture)),
        }
        Ok(file.into_inner())
    }
}

/// What an encoder says.
fn refused(error: impl Display) -> Failure {
    Failure::new(format!("cannot encode the picture: {error}"))
}

/// A code in 8 bits.
fn byte(code: f32) -> u8 {
    (code * 255.0).round() as u8
}

/// A code in 16 bits, the higher byte first.
fn two_bytes(code: f32) -> [u8; 2] {
    ((code * 65535.0).round() as u16).to_be_bytes()
}

/// The primaries and the white of sRGB, as PNG has them.
fn rec_709() -> SourceChromaticities {
    SourceChromaticities::new((0.3127, 0.329), (0.64, 0.33), (0.3, 0.6), (0.15, 0.06))
}

/// Writes a PNG that says what its codes mean: sRGB, with the chunks `gAMA` and `cHRM` for readers that do
/// not know that one, or linear ones.
fn encode_png(
    file: &mut Cursor<Vec<u8>>,
    picture: &Picture,
    showing: &Showing,
) -> Result<(), png::EncodingError> {
    let mut encoder = png::Encoder::new(file, picture.width, picture.height);
    encoder.set_color(ColorType::Rgb);
    if showing.view == Some(View::None) {
        encoder.set_source_gamma(ScaledFloat::new(1.0));
    } else {
        encoder.set_source_srgb(SrgbRenderingIntent::RelativeColorimetric);
        encoder.set_source_gamma(ScaledFloat::new(0.454_55));
        encoder.set_source_chromaticities(rec_709());
    }
    let codes = showing.codes(&picture.pixels);
    let (depth, bytes): (_, Vec<u8>) = match showing.depth.unwrap_or_default() {
        Depth::Eight => (BitDepth::Eight, codes.flat_map(|c| c.map(byte)).collect()),
        Depth::Sixteen => (BitDepth::Sixteen, codes.flatten().flat_map(two_bytes).collect()),
    };
    encoder.set_depth(depth);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(&bytes)?;
    writer.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::read;
    use halflight::Rgb;

    #[test]
    fn the_extension_decides_whatever_its_case() {
        assert_eq!(Format::of(Path::new("a.PNG")), Ok(Format::Png));
        assert_eq!(Format::of(Path::new("b/a.exr")), Ok(Format::Exr));
        assert_eq!(Format::of(Path::new("a.jpeg")), Ok(Format::Jpeg));
        assert!(Format::of(Path::new("a.bmp")).is_err());
        assert!(Format::of(Path::new("png")).is_err());
        assert!(Format::of(Path::new(".png")).is_err());
    }

    #[test]
    fn exposure_doubles_with_every_stop() {
        let picture = Picture { width: 1, height: 1, pixels: vec![Rgb::splat(0.25)] };
        let code = |exposure| Showing::exposed(exposure).codes(&picture.pixels).next().unwrap()[0];
        assert!((code(2.0) - 1.0).abs() < 1e-6);
        assert_eq!(Some([code(0.0); 3]), Showing::default().codes(&picture.pixels).next());
        assert!(code(1.0) > code(0.0));
        assert_eq!((byte(code(1e30)), code(-1e30)), (255, 0.0));
    }

    /// The chunks of a PNG.
    fn chunks(file: &[u8]) -> Vec<String> {
        let mut rest = &file[8..];
        let mut names = Vec::new();
        while let [a, b, c, d, name @ ..] = rest {
            names.push(String::from_utf8_lossy(&name[..4]).into_owned());
            rest = &rest[u32::from_be_bytes([*a, *b, *c, *d]) as usize + 12..];
        }
        names
    }

    #[test]
    fn a_png_says_what_its_codes_mean() {
        let picture = Picture { width: 3, height: 2, pixels: vec![Rgb::splat(0.25); 6] };
        let srgb = chunks(&Format::Png.encode(&picture, &Showing::default()).unwrap());
        for chunk in ["sRGB", "gAMA", "cHRM"] {
            assert!(srgb.iter().any(|name| name == chunk), "{chunk} is not among {srgb:?}");
        }
        let linear = Showing { view: Some(View::None), ..Showing::default() };
        let linear = chunks(&Format::Png.encode(&picture, &linear).unwrap());
        assert!(linear.contains(&"gAMA".to_owned()) && !linear.contains(&"sRGB".to_owned()), "{linear:?}");
    }

    #[test]
    fn sixteen_bits_are_finer_than_eight() {
        let folder = tempfile::tempdir().unwrap();
        let pixels: Vec<_> = (0..1000).map(|i| Rgb::splat(0.2 + i as f32 * 1e-5)).collect();
        let picture = Picture { width: 1000, height: 1, pixels };
        let off = |depth| {
            let path = folder.path().join("a.png");
            let showing = Showing { depth: Some(depth), ..Showing::default() };
            std::fs::write(&path, Format::Png.encode(&picture, &showing).unwrap()).unwrap();
            let read = read(&path).unwrap();
            let off = read.pixels.iter().zip(&picture.pixels).map(|(a, b)| (a.g - b.g).abs());
            off.fold(0.0, f32::max)
        };
        assert!(off(Depth::Sixteen) < 2e-5 && off(Depth::Eight) > 1e-3);
    }

    #[test]
    fn quality_costs_bytes() {
        let noise = |i: u32| (i.wrapping_mul(2_654_435_761) >> 24) as f32 / 255.0;
        let picture =
            Picture { width: 64, height: 64, pixels: (0..4096).map(|i| Rgb::splat(noise(i))).collect() };
        let bytes = |quality| {
            Format::Jpeg.encode(&picture, &Showing { quality, ..Showing::default() }).unwrap().len()
        };
        assert!(bytes(Some(10)) * 2 < bytes(None) && bytes(None) < bytes(Some(100)));
        assert!(Format::Jpeg.check_size(65_536, 1).is_err() && Format::Png.check_size(65_536, 1).is_ok());
    }
}
