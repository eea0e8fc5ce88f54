//! Decoding files as pictures.

use super::exr::{Decoded, decode_exr, is_exr};
use super::pfm::{decode_pfm, is_pfm};
use super::{Picture, decode};
use crate::failure::{Failure, io_reason};
use halflight::Rgb;
use halflight::film::PixelRect;
use image::{DynamicImage, ImageError, ImageReader};
use std::fs;
use std::io::Cursor;
use std::path::Path;

/// Reads a .exr, .pfm, .hdr, .png or .jpg file; what is not linear is taken as sRGB.
///
/// # Errors
/// When it cannot be read or is none of these.
pub(crate) fn read(path: &Path) -> Result<Picture, Failure> {
    Ok(read_framed(path)?.picture)
}

/// Reads a file as [`read`] does, and where in the film its picture is: a part of it, in .exr.
///
/// # Errors
/// As [`read`].
pub(crate) fn read_framed(path: &Path) -> Result<Decoded, Failure> {
    let fail = |reason: String| Failure::new(format!("cannot read {}: {reason}", path.display()));
    let bytes =
        fs::read(path).map_err(|e| fail(io_reason(&e)).tip("give the name of a picture that is there"))?;
    let decoded = match bytes.as_slice() {
        bytes if is_exr(bytes) => decode_exr(bytes),
        bytes if is_pfm(bytes) => decode_pfm(bytes).map(whole),
        bytes => decode_other(bytes).map(whole),
    };
    decoded.map_err(|reason| fail(reason).tip("pictures can be .exr, .pfm, .hdr, .png or .jpg"))
}

/// A picture that is all of its film.
fn whole(picture: Picture) -> Decoded {
    let film = (picture.width, picture.height);
    let window = PixelRect { x0: 0, y0: 0, x1: film.0, y1: film.1 };
    Decoded { picture, errors: None, window, film }
}

/// Of the formats that a library reads.
fn decode_other(bytes: &[u8]) -> Result<Picture, String> {
    let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|e| io_reason(&e))?;
    // The default limit of half a gigabyte is less than a large film.
    reader.no_limits();
    reader.decode().map(|image| picture(&image)).map_err(|e| reason(&e))
}

/// Linear RGB, without alpha.
fn picture(image: &DynamicImage) -> Picture {
    let linear = matches!(image, DynamicImage::ImageRgb32F(_) | DynamicImage::ImageRgba32F(_));
    let rgb = image.to_rgb32f();
    let pixels = rgb.pixels().map(|p| Rgb::from(p.0)).map(|p| if linear { p } else { p.map(decode) });
    Picture { width: rgb.width(), height: rgb.height(), pixels: pixels.collect() }
}

/// What is wrong with the file.
fn reason(error: &ImageError) -> String {
    match error {
        ImageError::IoError(e) => io_reason(e),
        ImageError::Unsupported(_) => "it is not a picture that halflight reads".to_owned(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::Showing;
    use crate::picture::Format;

    fn gradient() -> Picture {
        let pixels = (0..12 * 5).map(|i| Rgb::new(i as f32 / 60.0, 0.5, 1.0 - i as f32 / 60.0)).collect();
        Picture { width: 12, height: 5, pixels }
    }

    fn round_trip(format: Format, name: &str) -> Picture {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        fs::write(&path, format.encode(&gradient(), &Showing::default()).unwrap()).unwrap();
        read(&path).unwrap()
    }

    fn largest_difference(a: &Picture, b: &Picture) -> f32 {
        assert_eq!((a.width, a.height), (b.width, b.height));
        let channels = |p: &Picture| p.pixels.iter().flat_map(|p| p.to_array()).collect::<Vec<_>>();
        channels(a).iter().zip(channels(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f32::max)
    }

    #[test]
    fn exr_and_pfm_keep_every_bit() {
        assert_eq!(round_trip(Format::Exr, "a.exr"), gradient());
        assert_eq!(round_trip(Format::Pfm, "a.pfm"), gradient());
    }

    #[test]
    fn hdr_keeps_eight_bits_of_the_largest_channel() {
        assert!(largest_difference(&round_trip(Format::Hdr, "a.hdr"), &gradient()) < 1.0 / 128.0);
    }

    #[test]
    fn png_and_jpeg_are_linear_again_after_reading() {
        assert!(largest_difference(&round_trip(Format::Png, "a.png"), &gradient()) < 0.005);
        assert!(largest_difference(&round_trip(Format::Jpeg, "a.jpg"), &gradient()) < 0.15);
    }

    #[test]
    fn what_is_not_a_picture_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        fs::write(&path, "not a picture").unwrap();
        assert!(read(&path).is_err());
        assert!(read(&folder.path().join("missing.png")).is_err());
    }
}
