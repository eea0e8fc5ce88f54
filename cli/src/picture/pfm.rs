//! Portable float maps: 32-bit floats, linear, last row first.
//!
//! Source: Debevec, "PFM portable float map image format" (pauldebevec.com/Research/HDR/PFM). Differs: the
//! size of the scale, which says what unit 1.0 stands for, is read over.

use super::Picture;
use halflight::Rgb;

/// Most pixels of a row or a column.
const MOST: usize = 1 << 20;

/// True for bytes that begin as such a file does.
pub(super) fn is_pfm(bytes: &[u8]) -> bool {
    matches!(bytes, [b'P', b'F' | b'f', b'\n' | b'\r' | b' ' | b'\t', ..])
}

/// The bytes of a file with this picture, in the order of little-endian machines.
pub(super) fn encode_pfm(picture: &Picture) -> Vec<u8> {
    let mut file = format!("PF\n{} {}\n-1.0\n", picture.width, picture.height).into_bytes();
    let rows = picture.pixels.chunks_exact(picture.width as usize).rev();
    file.extend(rows.flatten().flat_map(|p| p.to_array()).flat_map(f32::to_le_bytes));
    file
}

/// The picture in a file's bytes: three channels, or one.
///
/// # Errors
/// Says what is wrong with them.
pub(super) fn decode_pfm(bytes: &[u8]) -> Result<Picture, String> {
    let (kind, rest) = word(bytes)?;
    let (width, rest) = word(rest)?;
    let (height, rest) = word(rest)?;
    let (scale, values) = word(rest)?;
    let side = |text: &str| match text.parse() {
        Ok(n @ 1..=MOST) => Ok(n),
        _ => Err(format!("\"{text}\" is no number of pixels")),
    };
    let (width, height) = (side(width)?, side(height)?);
    let little = match scale.parse::<f32>() {
        Ok(scale) if scale != 0.0 && scale.is_finite() => scale < 0.0,
        _ => return Err(format!("\"{scale}\" is no scale: it is 1 or -1, by the order of the bytes")),
    };
    let channels = if kind == "PF" { 3 } else { 1 };
    let needed = width * height * channels * 4;
    if values.len() < needed {
        return Err(format!("it is cut off: {} bytes of values where {needed} are needed", values.len()));
    }
    let number = |bytes: &[u8]| {
        let bytes = [bytes[0], bytes[1], bytes[2], bytes[3]];
        if little { f32::from_le_bytes(bytes) } else { f32::from_be_bytes(bytes) }
    };
    let pixel = |bytes: &[u8]| Rgb::from([0, 1, 2].map(|c| number(&bytes[c.min(channels - 1) * 4..])));
    let rows = values[..needed].chunks_exact(width * channels * 4).rev();
    let pixels = rows.flat_map(|row| row.chunks_exact(channels * 4)).map(pixel).collect();
    Ok(Picture { width: width as u32, height: height as u32, pixels })
}

/// The next word of the header, and what follows the one space behind it.
fn word(bytes: &[u8]) -> Result<(&str, &[u8]), String> {
    let bytes = bytes.trim_ascii_start();
    let header = "its header is cut off: PF, columns, rows, scale";
    let end = bytes.iter().take(40).position(u8::is_ascii_whitespace).ok_or(header)?;
    let text = std::str::from_utf8(&bytes[..end]).map_err(|_| header)?;
    Ok((text, &bytes[end + 1..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture() -> Picture {
        let pixels = (0..6).map(|i| Rgb::new(i as f32, -0.5, 1e30)).collect();
        Picture { width: 2, height: 3, pixels }
    }

    #[test]
    fn every_bit_survives_the_round_trip() {
        let bytes = encode_pfm(&picture());
        assert!(is_pfm(&bytes) && bytes.starts_with(b"PF\n2 3\n-1.0\n"));
        assert_eq!(bytes[12..16], 4.0_f32.to_le_bytes(), "the last row comes first");
        assert_eq!(decode_pfm(&bytes), Ok(picture()));
    }

    #[test]
    fn either_order_of_bytes_and_one_channel_are_read() {
        let mut grey = b"Pf 1 2 1.0 ".to_vec();
        grey.extend([2.0_f32, 1.0].into_iter().flat_map(f32::to_be_bytes));
        let read = decode_pfm(&grey).unwrap();
        assert_eq!(read.pixels, [Rgb::splat(1.0), Rgb::splat(2.0)]);
    }

    #[test]
    fn what_is_cut_off_or_makes_no_sense_is_refused() {
        let whole = encode_pfm(&picture());
        for length in 0..whole.len() {
            assert!(decode_pfm(&whole[..length]).is_err(), "{length}");
        }
        for header in
            ["PF 0 1 -1 ", "PF -1 1 -1 ", "PF 1e3 1 -1 ", "PF 1 1 0 ", "PF 1 1 nan ", "PF 99999999 1 -1 "]
        {
            let file = [header.as_bytes(), &[0; 64]].concat();
            assert!(decode_pfm(&file).is_err(), "{header}");
        }
    }
}
