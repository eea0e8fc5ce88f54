//! OpenEXR: the picture in R, G and B, layers beside it, and a header that says how it was made.

use super::Picture;
use crate::failure::Failure;
use exr::meta::attribute::Chromaticities;
use exr::prelude::{
    AnyChannel, AnyChannels, AttributeValue, Encoding, FlatImage, FlatSamples, Image, ImageAttributes,
    IntegerBounds, Layer as Part, LayerAttributes, ReadChannels, ReadLayers, Text, Vec2, WritableImage, read,
};
use halflight::Rgb;
use halflight::film::PixelRect;
use std::io::Cursor;

/// A channel: a number for each pixel, row by row.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Layer {
    /// As OpenEXR has it: a layer's name, a point, and the channel's.
    pub(crate) name: &'static str,
    /// As many as there are pixels.
    pub(crate) values: Vec<f32>,
}

/// Where a picture is, and what is said about it.
#[derive(Debug, Clone, Default)]
pub(crate) struct Header {
    /// Columns and rows of the whole film; those of the picture when `None`.
    pub(crate) film: Option<(u32, u32)>,
    /// The picture's first column and row there.
    pub(crate) at: (u32, u32),
    /// For people.
    pub(crate) comment: Option<String>,
    /// For programs.
    pub(crate) settings: Option<String>,
}

/// The attribute with the settings of the render: the only one of our own, as a second one could come
/// before or after it, and equal pictures are equal files.
const SETTINGS: &str = "halflight";

/// The primaries and the white of all pictures: ITU-R BT.709-6, item 1.
const REC_709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.3, 0.6),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.329),
};

/// The bytes of an OpenEXR file: 32-bit floats, one part, scan lines. The display window is the film, the
/// data window what was rendered of it.
///
/// # Errors
/// When they cannot be encoded.
pub(crate) fn encode_exr(picture: &Picture, layers: Vec<Layer>, header: &Header) -> Result<Vec<u8>, Failure> {
    let size = Vec2(picture.width as usize, picture.height as usize);
    let of = |channel: usize| picture.pixels.iter().map(|p| p.to_array()[channel]).collect();
    let radiance = ["R", "G", "B"].into_iter().zip(0..).map(|(name, i)| Layer { name, values: of(i) });
    let channels = radiance.chain(layers).map(|l| AnyChannel::new(l.name, FlatSamples::F32(l.values)));
    let channels = AnyChannels::sort(channels.collect());
    let (width, height) = header.film.map_or((size.0, size.1), |(w, h)| (w as usize, h as usize));
    let mut whole = ImageAttributes::new(IntegerBounds::from_dimensions(Vec2(width, height)));
    whole.chromaticities = Some(REC_709);
    let mut own = LayerAttributes {
        layer_position: Vec2(header.at.0 as i32, header.at.1 as i32),
        software_name: Some(text(concat!("halflight ", env!("CARGO_PKG_VERSION")))),
        comments: header.comment.as_deref().map(text),
        ..LayerAttributes::default()
    };
    if let Some(settings) = &header.settings {
        own.other.insert(text(SETTINGS), AttributeValue::Text(text(settings)));
    }
    let mut file = Cursor::new(Vec::new());
    Image::new(whole, Part::new(size, own, Encoding::SMALL_LOSSLESS, channels))
        .write()
        .to_buffered(&mut file)
        .map_err(|e| Failure::new(format!("cannot encode the picture: {e}")))?;
    Ok(file.into_inner())
}

/// As OpenEXR has text: bytes, of which other programs show the ASCII ones alike.
fn text(words: &str) -> Text {
    let ascii: String = words.chars().map(|c| if c.is_ascii() { c } else { '?' }).collect();
    Text::new_or_none(ascii).unwrap_or_default()
}

/// What a file holds.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Decoded {
    /// What was rendered: the data window.
    pub(crate) picture: Picture,
    /// The standard errors of its pixels, where the file has them: `error.R`, `error.G`, `error.B`.
    pub(crate) errors: Option<Picture>,
    /// Where that is in the film, and how large the film is.
    pub(crate) window: PixelRect,
    /// Columns and rows of the film: the display window.
    pub(crate) film: (u32, u32),
}

/// Whether bytes begin as an OpenEXR file does.
pub(super) fn is_exr(bytes: &[u8]) -> bool {
    bytes.starts_with(&[0x76, 0x2f, 0x31, 0x01])
}

/// What an OpenEXR file's bytes hold: of the first part that has colours, or else a luminance.
///
/// # Errors
/// Says what is wrong with them.
pub(crate) fn decode_exr(bytes: &[u8]) -> Result<Decoded, String> {
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .all_layers()
        .all_attributes()
        .from_buffered(Cursor::new(bytes))
        .map_err(|e| e.to_string())?;
    let found = decode(&image, ["R", "G", "B"]).or_else(|| decode(&image, ["Y"; 3]));
    found.ok_or_else(|| "it has no channels R, G and B".to_owned())
}

/// The first part with three channels of that name.
fn decode(image: &FlatImage, names: [&str; 3]) -> Option<Decoded> {
    let display = image.attributes.display_window;
    image.layer_data.iter().find_map(|part| {
        let picture = picture(part, names)?;
        let offset = part.attributes.layer_position - display.position;
        let (x0, y0) = (u32::try_from(offset.0), u32::try_from(offset.1));
        let film = (display.size.0 as u32, display.size.1 as u32);
        // Beyond the film there is no place to compare it at: it stands for itself.
        let (x0, y0, film) = match (x0, y0) {
            (Ok(x), Ok(y)) if x + picture.width <= film.0 && y + picture.height <= film.1 => (x, y, film),
            _ => (0, 0, (picture.width, picture.height)),
        };
        let window = PixelRect { x0, y0, x1: x0 + picture.width, y1: y0 + picture.height };
        let errors = self::picture(part, ["error.R", "error.G", "error.B"]);
        Some(Decoded { picture, errors, window, film })
    })
}

/// Three channels of a part.
fn picture(part: &Part<AnyChannels<FlatSamples>>, names: [&str; 3]) -> Option<Picture> {
    let channel = |name: &str| {
        let found = part.channel_data.list.iter().find(|channel| channel.name == *name)?;
        Some(found.sample_data.values_as_f32())
    };
    let (r, g, b) = (channel(names[0])?, channel(names[1])?, channel(names[2])?);
    let pixels: Vec<_> = r.zip(g).zip(b).map(|((r, g), b)| Rgb::new(r, g, b)).collect();
    // A channel may have fewer values than there are pixels.
    let whole = pixels.len() == part.size.area();
    whole.then_some(Picture { width: part.size.0 as u32, height: part.size.1 as u32, pixels })
}

impl Decoded {
    /// The whole film, black where nothing was rendered.
    pub(crate) fn framed(&self) -> Picture {
        let (width, height) = self.film;
        let mut pixels = vec![Rgb::BLACK; width as usize * height as usize];
        let rows = self.picture.pixels.chunks_exact(self.picture.width as usize);
        for (row, y) in rows.zip(self.window.y0 as usize..) {
            let start = y * width as usize + self.window.x0 as usize;
            pixels[start..start + row.len()].copy_from_slice(row);
        }
        Picture { width, height, pixels }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Picture {
        Picture { width: 3, height: 2, pixels: (0..6).map(|i| Rgb::splat(i as f32)).collect() }
    }

    fn header() -> Header {
        Header {
            film: Some((10, 8)),
            at: (4, 5),
            comment: Some("a scène".to_owned()),
            settings: Some("{\"seed\":7}".to_owned()),
        }
    }

    #[test]
    fn windows_and_layers_survive_the_round_trip() {
        let layer = |name| Layer { name, values: vec![0.5; 6] };
        let layers = ["error.R", "error.G", "error.B", "Z"].map(layer).to_vec();
        let read = decode_exr(&encode_exr(&picture(), layers, &header()).unwrap()).unwrap();
        assert_eq!((read.film, read.window), ((10, 8), PixelRect { x0: 4, y0: 5, x1: 7, y1: 7 }));
        assert_eq!(read.errors.as_ref().map(|e| e.pixels[5]), Some(Rgb::splat(0.5)));
        let framed = read.framed();
        assert_eq!((framed.width, framed.pixels[5 * 10 + 5]), (10, Rgb::splat(1.0)));
        assert_eq!(framed.pixels.iter().filter(|p| **p == Rgb::BLACK).count(), 80 - 5);
        assert_eq!(read.picture, picture());
    }

    #[test]
    fn the_header_says_what_it_should() {
        let bytes = encode_exr(&picture(), Vec::new(), &header()).unwrap();
        let image = read().no_deep_data().largest_resolution_level().all_channels().all_layers();
        let image = image.all_attributes().from_buffered(Cursor::new(&bytes)).unwrap();
        assert_eq!(image.attributes.chromaticities, Some(REC_709));
        let own = &image.layer_data[0].attributes;
        assert!(own.software_name.as_ref().is_some_and(|name| name.to_string().starts_with("halflight ")));
        assert_eq!(own.comments.as_ref().map(ToString::to_string).as_deref(), Some("a sc?ne"));
        assert_eq!(own.other.get(&text(SETTINGS)), Some(&AttributeValue::Text(text("{\"seed\":7}"))));
        assert_eq!(bytes, encode_exr(&picture(), Vec::new(), &header()).unwrap());
    }

    #[test]
    fn what_is_cut_off_is_refused() {
        let bytes = encode_exr(&picture(), Vec::new(), &header()).unwrap();
        for length in [0, 4, 100, bytes.len() / 2, bytes.len() - 1] {
            assert!(decode_exr(&bytes[..length]).is_err(), "{length}");
        }
    }
}
