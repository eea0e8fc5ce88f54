use super::*;
use std::fs;
use std::io::Cursor;
use std::path::PathBuf;

/// A file of its own for each test, gone afterwards.
struct Scratch(PathBuf);

impl Scratch {
    fn new(name: &str, bytes: &[u8]) -> Self {
        let path = std::env::temp_dir().join(std::format!("halflight-{}-{name}", std::process::id()));
        fs::write(&path, bytes).unwrap();
        Self(path)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        let _ = fs::remove_file(&self.0);
    }
}

fn gradient() -> Image {
    let texels = (0..7 * 5).map(|i| Rgb::new(i as f32 * 1e3, 0.5, 1.0 / (1 + i) as f32)).collect();
    Image { width: 7, height: 5, texels }
}

fn exr_bytes(image: &Image) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    write_exr(image, &mut bytes).unwrap();
    bytes.into_inner()
}

fn encoded(image: DynamicImage, format: ::image::ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

#[test]
fn exr_keeps_every_bit() {
    let file = Scratch::new("bits.exr", &exr_bytes(&gradient()));
    assert_eq!(read_image(&file.0, Encoding::Srgb).unwrap(), gradient());
}

#[test]
fn eight_bits_are_srgb_or_raw_and_the_first_row_is_on_top() {
    let pixels = [0, 10, 128, 255, 64, 1].to_vec();
    let image = DynamicImage::ImageRgb8(::image::RgbImage::from_raw(1, 2, pixels).unwrap());
    let file = Scratch::new("codes.png", &encoded(image, ::image::ImageFormat::Png));
    let raw = read_image(&file.0, Encoding::Linear).unwrap();
    assert_eq!((raw.width, raw.height), (1, 2));
    assert_eq!(raw.texels[1], Rgb::new(1.0, 64.0 / 255.0, 1.0 / 255.0));
    let srgb = read_image(&file.0, Encoding::Srgb).unwrap();
    assert_eq!(srgb.texels[0].r, 0.0);
    assert!((srgb.texels[0].b - 0.215_860_5).abs() < 1e-6, "{:?}", srgb.texels[0]);
    assert!((srgb.texels[0].g - 10.0 / 255.0 / 12.92).abs() < 1e-8);
}

#[test]
fn sixteen_bits_and_grey_are_read() {
    let deep = ::image::ImageBuffer::from_raw(1, 1, [65535_u16, 32768, 0].to_vec()).unwrap();
    let file = Scratch::new("deep.png", &encoded(DynamicImage::ImageRgb16(deep), ::image::ImageFormat::Png));
    let texel = read_image(&file.0, Encoding::Linear).unwrap().texels[0];
    assert_eq!(texel, Rgb::new(1.0, 32768.0 / 65535.0, 0.0));
    let grey = DynamicImage::ImageLuma8(::image::GrayImage::from_raw(1, 1, [255].to_vec()).unwrap());
    let file = Scratch::new("grey.png", &encoded(grey, ::image::ImageFormat::Png));
    assert_eq!(read_image(&file.0, Encoding::Srgb).unwrap().texels, [Rgb::WHITE]);
}

#[test]
fn hdr_and_jpeg_are_read() {
    let rgb = ::image::Rgb32FImage::from_raw(1, 1, [4.0, 2.0, 0.5].to_vec()).unwrap();
    let bytes = encoded(DynamicImage::ImageRgb32F(rgb), ::image::ImageFormat::Hdr);
    let file = Scratch::new("a.hdr", &bytes);
    assert_eq!(read_image(&file.0, Encoding::Srgb).unwrap().texels, [Rgb::new(4.0, 2.0, 0.5)]);
    let image = DynamicImage::ImageRgb8(::image::RgbImage::from_pixel(8, 8, ::image::Rgb([255; 3])));
    let file = Scratch::new("a.jpg", &encoded(image, ::image::ImageFormat::Jpeg));
    assert_eq!(read_image(&file.0, Encoding::Srgb).unwrap().texels, [Rgb::WHITE; 64]);
}

#[test]
fn what_is_not_a_picture_is_refused() {
    let missing = read_image(Path::new("no-such-picture.exr"), Encoding::Srgb);
    assert!(matches!(missing, Err(ImageError::File(_))), "{missing:?}");
    let text = Scratch::new("text.exr", b"not a picture");
    assert!(matches!(read_image(&text.0, Encoding::Srgb), Err(ImageError::Format)));
    let bytes = exr_bytes(&gradient());
    let cut = Scratch::new("cut.exr", &bytes[..bytes.len() / 2]);
    assert!(matches!(read_image(&cut.0, Encoding::Srgb), Err(ImageError::Malformed { .. })));
    let empty = Scratch::new("empty.png", b"");
    assert!(read_image(&empty.0, Encoding::Srgb).is_err());
}

#[test]
fn a_picture_that_would_fill_the_memory_is_refused() {
    assert!(matches!(check_size(1 << 15, 1 << 14, u64::MAX), Err(ImageError::TooLarge { .. })));
    assert!(matches!(check_size(0, 4, 100), Err(ImageError::Empty)));
    assert!(check_size(8192, 4096, 1 << 20).is_ok());
}

#[test]
fn a_small_file_that_claims_to_be_a_large_picture_is_refused() {
    let header = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n";
    let small = Scratch::new("claims.hdr", header);
    let error = read_image(&small.0, Encoding::Srgb).unwrap_err();
    assert!(matches!(error, ImageError::Short { width: 16384, height: 16384, bytes: 53 }), "{error:?}");
    assert!(std::format!("{error}").contains("53 bytes hold no 16384 × 16384 texels"), "{error}");
}

#[test]
fn the_smallest_file_of_a_picture_is_read() {
    // White, of one bit per texel: no file is shorter.
    let white = ::image::GrayImage::from_pixel(2048, 2048, ::image::Luma([255]));
    let mut bytes = Cursor::new(Vec::new());
    white.write_to(&mut bytes, ::image::ImageFormat::Png).unwrap();
    let file = Scratch::new("white.png", bytes.get_ref());
    assert!(read_image(&file.0, Encoding::Linear).unwrap().texels.iter().all(|t| t.g == 1.0));
}
