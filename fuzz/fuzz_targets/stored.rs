//! Any bytes as a stored scene, with a checksum to match: refused, or every ray through it ends.
#![no_main]

use halflight::estimate::{Direct, Estimator};
use halflight::geom::Ray;
use halflight::sequence::Sobol;
use halflight::stored::{Aligned, Head, MAGIC, NO_LIGHT, NO_MATERIAL, StoredScene, VERSION, checksum};
use halflight_fuzz::Numbers;
use libfuzzer_sys::fuzz_target;

/// Entries of each table at most, so that scenes are found at all.
const FEW: u32 = 4;

/// Sizes of their entries (bytes).
const SIZES: [usize; 7] = [112, 56, 36, 24, 48, 64, 0];

fuzz_target!(|data: &[u8]| {
    let mut room = Aligned([0_u8; 4096]);
    let Some((first, body)) = data.split_first() else { return };
    let start = 16;
    let count = body.len().min(room.0.len() - start);
    room.0[start..start + count].copy_from_slice(&body[..count]);
    let material = size_of::<halflight::stored::StoredMaterial>();
    let mut length = size_of::<Head>();
    for (table, size) in SIZES.into_iter().enumerate() {
        let place = start + 4 * table;
        let few = u32::from(room.0[place]) % FEW;
        room.0[place..place + 4].copy_from_slice(&few.to_le_bytes());
        length += few as usize * if size == 0 { material } else { size };
    }
    // Now and then a length that does not fit.
    let length = if first % 16 == 0 { length - 4 } else { length };
    let bytes = &mut room.0[..length];
    bytes[..4].copy_from_slice(&MAGIC);
    bytes[4..8].copy_from_slice(&VERSION.to_le_bytes());
    bytes[8..12].copy_from_slice(&(length as u32).to_le_bytes());
    let words: Vec<u32> =
        bytes.chunks_exact(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect();
    bytes[12..16].copy_from_slice(&checksum(&words[4..]).to_le_bytes());
    let Ok(stored) = StoredScene::new(bytes) else { return };
    let (_, _) = (stored.camera(), stored.film());
    let (mut lights, mut materials) = ([NO_LIGHT; FEW as usize], [NO_MATERIAL; FEW as usize]);
    let Ok(scene) = stored.scene(&mut lights, &mut materials) else { return };
    let mut n = Numbers::new(data);
    for _ in 0..4 {
        let ray = Ray::new(n.vector(), n.vector());
        let _ = Direct::default().sample(&scene, &ray, f32::INFINITY, &mut Sobol::new(1));
    }
});
