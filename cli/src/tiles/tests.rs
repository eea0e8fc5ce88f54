use super::*;
use halflight::Rgb;
use halflight::estimate::{LayeredPixel, PixelStats, TILE};

const CROP: PixelRect = PixelRect { x0: 3, y0: 5, x1: 80, y1: 70 };

fn header(part: Part) -> Header {
    Header {
        scene: "still-life".to_owned(),
        fingerprint: "0123".to_owned(),
        settings: vec![("spp".to_owned(), "4".to_owned()), ("seed".to_owned(), "0".to_owned())],
        about: About {
            triangles: u64::MAX,
            choices: vec![("technique".to_owned(), "mis".to_owned())],
            ..About::default()
        },
        aim: Aim::Error { target: 0.1 + 0.2, most: 64, adaptive: true },
        pixels: "radiance".to_owned(),
        crop: CROP,
        side: 32,
        part,
        complete: true,
    }
}

/// Tiles that know something.
fn tiles<P: Stored, S: State>(part: Part) -> Vec<Tile<P, S>> {
    places(CROP, 32, part)
        .map(|(index, rect)| {
            let mut pixels = vec![P::default(); rect.area()];
            for (i, pixel) in pixels.iter_mut().enumerate() {
                pixel.add(Rgb::new(i as f32, index as f32 + 0.1, 1.0));
            }
            Tile { index, rect, pixels, state: S::new(rect) }
        })
        .collect()
}

fn written<P: Stored, S: State>(part: Part) -> Vec<u8> {
    let mut bytes = Vec::new();
    write(&mut bytes, &header(part), tiles::<P, S>(part).iter()).unwrap();
    bytes
}

fn read<P: Stored, S: State>(bytes: &[u8]) -> Result<Vec<Tile<P, S>>, TilesError> {
    Reader::new(bytes, bytes.len() as u64)?.tiles()
}

/// The same bytes in, and out.
fn round_trip<P: Stored, S: State>() {
    let part = Part { number: 2, of: 3 };
    let bytes = written::<P, S>(part);
    let reader = Reader::new(&bytes[..], bytes.len() as u64).unwrap();
    assert_eq!(*reader.header(), header(part));
    let tiles = reader.tiles::<P, S>().unwrap();
    let mut again = Vec::new();
    write(&mut again, &header(part), tiles.iter()).unwrap();
    assert!(again == bytes);
}

#[test]
fn what_is_written_is_read() {
    round_trip::<PixelStats, Box<AdaptiveTile>>();
    round_trip::<PixelStats, Passes>();
    round_trip::<LayeredPixel, Passes>();
}

#[test]
fn passes_keep_every_bit_and_must_go_on() {
    let sums = halflight::estimate::DifferenceSums::from_words([0.1f64.to_bits(), 1e-3f64.to_bits(), 7]);
    let passes = Passes([1, 2, 4].map(|end| Pass { end, sums: sums.unwrap() }).to_vec());
    let mut bytes = Vec::new();
    passes.put(&mut bytes);
    assert_eq!(Passes::take(CROP, &bytes), Some(passes));
    assert_eq!(Passes::take(CROP, &bytes[1..]), None);
    bytes[0] = 2;
    assert_eq!(Passes::take(CROP, &bytes), None, "two passes that end at 2");
}

#[test]
fn every_altered_byte_is_found() {
    let bytes = written::<PixelStats, Passes>(Part { number: 4, of: 9 });
    for place in 0..bytes.len() {
        let mut altered = bytes.clone();
        altered[place] ^= 4;
        assert!(read::<PixelStats, Passes>(&altered).is_err(), "byte {place} of {}", bytes.len());
    }
}

#[test]
fn every_torn_file_is_found() {
    let bytes = written::<PixelStats, Passes>(Part { number: 4, of: 9 });
    for length in 0..bytes.len() {
        assert!(read::<PixelStats, Passes>(&bytes[..length]).is_err(), "{length} bytes of {}", bytes.len());
    }
    let longer = [&bytes[..], b"x"].concat();
    assert!(matches!(read::<PixelStats, Passes>(&longer), Err(TilesError::Long)));
    assert!(matches!(read::<PixelStats, Passes>(b"not a part at all"), Err(TilesError::Foreign)));
    assert!(matches!(read::<PixelStats, Passes>(b""), Err(TilesError::Foreign)));
}

#[test]
fn a_small_file_cannot_ask_for_much() {
    let huge = Header { crop: PixelRect { x0: 0, y0: 0, x1: 65_536, y1: 65_536 }, ..header(Part::WHOLE) };
    let mut bytes = Vec::new();
    write(&mut bytes, &huge, std::iter::empty::<&Tile<PixelStats, Passes>>()).unwrap();
    assert!(matches!(read::<PixelStats, Passes>(&bytes), Err(TilesError::Short)));
    let mut bytes = [&MAGIC[..], &VERSION.to_le_bytes(), &u32::MAX.to_le_bytes()].concat();
    bytes.resize(100, b'x');
    assert!(matches!(read::<PixelStats, Passes>(&bytes), Err(TilesError::Header(_))));
}

#[test]
fn headers_that_cannot_be_are_refused() {
    let good = header(Part { number: 1, of: 2 });
    let bad = [
        Header { crop: PixelRect { x1: 3, ..CROP }, ..good.clone() },
        Header { crop: PixelRect { y1: 65_537, ..CROP }, ..good.clone() },
        Header { side: 0, ..good.clone() },
        Header { side: TILE + 1, ..good.clone() },
        Header { part: Part { number: 3, of: 2 }, ..good.clone() },
        Header { part: Part { number: 0, of: 2 }, ..good.clone() },
        Header { aim: Aim::Error { target: f64::NAN, most: 1, adaptive: false }, ..good.clone() },
    ];
    for header in bad {
        assert!(Header::from_json(&header.json()).is_err(), "{header:?}");
    }
    assert_eq!(Header::from_json(&good.json()).unwrap(), good);
}

#[test]
fn differences_are_named() {
    let one = header(Part { number: 1, of: 2 });
    assert_eq!(one.difference(&header(Part { number: 2, of: 2 })), None);
    let mut other = one.clone();
    other.settings[0].1 = "16".to_owned();
    assert_eq!(one.difference(&other).unwrap(), "its spp is 4, not 16");
    other.settings.remove(0);
    assert_eq!(one.difference(&other).unwrap(), "it has a spp, unlike the other");
    let other = Header { fingerprint: String::new(), ..one.clone() };
    assert!(one.difference(&other).unwrap().contains("scene"));
    assert!(one.difference(&header(Part { number: 1, of: 3 })).unwrap().contains("2 parts, not 3"));
    let other = Header { pixels: "layers".to_owned(), ..one.clone() };
    assert!(one.difference(&other).is_some());
}

#[test]
fn parts_share_the_picture_evenly() {
    let crop = PixelRect { x0: 7, y0: 0, x1: 7 + 960, y1: 640 };
    for of in [1, 2, 3, 4, 16, 30, 31, 64] {
        let parts: Vec<Vec<u32>> = (1..=of)
            .map(|number| places(crop, 32, Part { number, of }).map(|(index, _)| index).collect())
            .collect();
        let mut all = parts.concat();
        all.sort_unstable();
        assert!(all.into_iter().eq(0..600), "{of} parts");
        let counts = parts.iter().map(Vec::len);
        let (least, most) = (counts.clone().min().unwrap(), counts.max().unwrap());
        assert!(most - least <= 1, "{of} parts: {least} to {most} tiles");
        // Tiles of a part are in no column more often than by chance.
        let column = |part: &Vec<u32>| (0..30).map(|c| part.iter().filter(|i| *i % 30 == c).count()).max();
        let crowded = parts.iter().filter_map(column).max().unwrap();
        assert!(crowded <= 20 / of as usize + 4, "{of} parts: {crowded} tiles in a column of 20");
    }
}
