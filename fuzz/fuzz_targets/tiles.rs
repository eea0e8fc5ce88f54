//! Any bytes as a part of a picture, some of them with checksums to match: read or refused, never a panic.
#![no_main]

/// The command line's own.
#[allow(dead_code, unused_imports)]
#[path = "../../cli/src/tiles/mod.rs"]
mod tiles;

use halflight::estimate::{AdaptiveTile, LayeredPixel, PixelStats};
use libfuzzer_sys::fuzz_target;
use tiles::{Passes, Reader, State, Stored, write};
use xxhash_rust::xxh3::{xxh3_64, xxh3_128};

/// Reads it; what is read is written again as the same bytes.
fn read<P: Stored, S: State>(bytes: &[u8]) {
    let Ok(reader) = Reader::new(bytes, bytes.len() as u64) else { return };
    let header = reader.header().clone();
    let Ok(tiles) = reader.tiles::<P, S>() else { return };
    let mut again = Vec::new();
    write(&mut again, &header, tiles.iter()).expect("memory can be written");
    let mut twice = Vec::new();
    let reader = Reader::new(&again[..], again.len() as u64).expect("what was written");
    write(&mut twice, &header, reader.tiles::<P, S>().expect("what was written").iter()).expect("memory");
    assert!(again == twice);
}

/// Sets the checksums of a file whose header is that long and whose tiles take all the rest, as one.
fn mended(data: &[u8]) -> Option<Vec<u8>> {
    let mut bytes = data.to_vec();
    let length = u32::from_le_bytes(data.get(20..24)?.try_into().ok()?) as usize;
    let header = 24_usize.checked_add(length)?;
    let end = bytes.len().checked_sub(16)?;
    if header + 16 > end {
        return None;
    }
    let sum = xxh3_64(&bytes[..header]);
    bytes[header..header + 8].copy_from_slice(&sum.to_le_bytes());
    let sum = xxh3_64(&bytes[header + 8..end - 8]);
    bytes[end - 8..end].copy_from_slice(&sum.to_le_bytes());
    let sum = xxh3_128(&bytes[..end]);
    bytes[end..].copy_from_slice(&sum.to_le_bytes());
    Some(bytes)
}

fuzz_target!(|data: &[u8]| {
    for bytes in [Some(data.to_vec()), mended(data)].into_iter().flatten() {
        read::<PixelStats, Box<AdaptiveTile>>(&bytes);
        read::<PixelStats, Passes>(&bytes);
        read::<LayeredPixel, Passes>(&bytes);
    }
});
