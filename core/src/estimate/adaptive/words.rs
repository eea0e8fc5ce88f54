//! Every bit of a tile, for keeping it elsewhere.

use super::{AdaptiveTile, BLOCKS, Block, Known, MEMORY};
use crate::film::PixelRect;
use core::array;
use core::ops::Range;

/// Words of a block.
const BLOCK_WORDS: usize = MEMORY + 5;

/// Which of them are numbers.
const NUMBERS: [Range<usize>; 2] = [1..3, 5..BLOCK_WORDS];

/// Where the bits of the edges are in the word of the lights.
const EDGES: u32 = 24;

/// Above the bits of the second word of [`Known`].
const SMOOTH: u32 = 1 << 31;

impl AdaptiveTile {
    /// Words that [`AdaptiveTile::to_words`] makes.
    pub const WORDS: usize = BLOCKS * BLOCK_WORDS;

    /// Every bit of what is known of the tile, without its place: block by block the samples, and as
    /// bits of `f32` what may hide and the brightest lamp, then what was known, and the last changes.
    #[must_use]
    pub fn to_words(&self) -> [u32; Self::WORDS] {
        array::from_fn(|i| {
            let block = &self.blocks[i / BLOCK_WORDS];
            let [met, lights] = block.known.to_words();
            match i % BLOCK_WORDS {
                0 => block.samples,
                1 => block.hidden.to_bits(),
                2 => block.lamp.to_bits(),
                3 => met,
                4 => lights | u32::from(block.edges) << EDGES | if block.smooth { SMOOTH } else { 0 },
                word => block.changes[word - 5].to_bits(),
            }
        })
    }

    /// What [`AdaptiveTile::to_words`] was made from, at its place. `None` when the words are no tile's:
    /// one of the numbers among
    /// them is negative or NaN.
    #[must_use]
    pub fn from_words(rect: PixelRect, words: &[u32; Self::WORDS]) -> Option<Self> {
        let mut tile = Self::new(rect);
        for (block, words) in tile.blocks.iter_mut().zip(words.chunks_exact(BLOCK_WORDS)) {
            let number = |i: usize| f32::from_bits(words[i]);
            if !NUMBERS.into_iter().flatten().all(|i| number(i) >= 0.0) {
                return None;
            }
            let changes = array::from_fn(|ago| number(ago + 5));
            let (hidden, lamp) = (number(1), number(2));
            let edges = (words[4] >> EDGES & 15) as u8;
            let known = Known::from_words([words[3], words[4] & !SMOOTH & !(15 << EDGES)])?;
            let smooth = words[4] & SMOOTH != 0;
            *block = Block { samples: words[0], changes, hidden, lamp, edges, known, smooth, ..*block };
        }
        Some(tile)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RECT: PixelRect = PixelRect { x0: 64, y0: 32, x1: 91, y1: 64 };

    #[test]
    fn words_keep_every_bit() {
        let mut tile = AdaptiveTile::new(RECT);
        for (i, block) in (0_u16..).zip(&mut tile.blocks) {
            block.samples = u32::from(i) + 1;
            block.hidden = 0.1 * f32::from(i);
            block.lamp = if i == 0 { f32::INFINITY } else { 1e30 / f32::from(i) };
            block.changes = array::from_fn(|ago| 1e-3 * f32::from(i) + ago as f32);
            block.known = Known::from_words([u32::from(i % 5), u32::from(i)]).unwrap();
            block.smooth = i % 3 == 0;
            block.edges = (i % 16) as u8;
        }
        let words = tile.to_words();
        let again = AdaptiveTile::from_words(RECT, &words).unwrap();
        assert_eq!(again.to_words(), words);
        assert_eq!(again.rect(), tile.rect());
        assert_eq!(again.error(), tile.error());
        assert_eq!(again.fewest_samples(), 1);
    }

    #[test]
    fn what_is_no_tile_is_refused() {
        let words = AdaptiveTile::new(RECT).to_words();
        for bad in [f32::NAN, -1.0] {
            for place in NUMBERS.into_iter().flatten() {
                let mut words = words;
                words[BLOCK_WORDS + place] = bad.to_bits();
                assert!(AdaptiveTile::from_words(RECT, &words).is_none(), "{bad} at {place}");
            }
        }
        let mut words = words;
        words[4] = 1 << 20;
        assert!(AdaptiveTile::from_words(RECT, &words).is_none(), "lights beyond the last");
    }
}
