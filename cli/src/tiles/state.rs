//! What is kept of tiles and pixels, word by word.

use halflight::estimate::{AdaptiveTile, DifferenceSums, LayeredPixel, Pixel, PixelStats};
use halflight::film::PixelRect;

/// A pixel that can be kept with every bit.
pub(crate) trait Stored: Pixel + Default + Clone + Send {
    /// What it holds, by name.
    const KIND: &str;
    /// Words of 4 bytes that it takes.
    const WORDS: usize;

    /// Appends its words.
    fn put(&self, to: &mut Vec<u8>);

    /// What the words were made from, [`Stored::WORDS`] of them.
    fn take(words: &[u32]) -> Option<Self>;
}

impl Stored for PixelStats {
    const KIND: &str = "radiance";
    const WORDS: usize = 8;

    fn put(&self, to: &mut Vec<u8>) {
        put(&self.to_words(), to);
    }

    fn take(words: &[u32]) -> Option<Self> {
        words.try_into().ok().map(Self::from_words)
    }
}

impl Stored for LayeredPixel {
    const KIND: &str = "layers";
    const WORDS: usize = 18;

    fn put(&self, to: &mut Vec<u8>) {
        put(&self.to_words(), to);
    }

    fn take(words: &[u32]) -> Option<Self> {
        words.try_into().ok().map(Self::from_words)
    }
}

/// What is known of a tile beside its pixels.
pub(crate) trait State: Clone + Send {
    /// A tile of which nothing is known yet.
    fn new(rect: PixelRect) -> Self;

    /// Fewest samples of its pixels.
    fn samples(&self) -> u32;

    /// Appends its bytes.
    fn put(&self, to: &mut Vec<u8>);

    /// What the bytes were made from; `None` when they were made from nothing such.
    fn take(rect: PixelRect, bytes: &[u8]) -> Option<Self>;
}

/// On the heap: it is large, and moved.
impl State for Box<AdaptiveTile> {
    fn new(rect: PixelRect) -> Self {
        Self::new(AdaptiveTile::new(rect))
    }

    fn samples(&self) -> u32 {
        self.fewest_samples()
    }

    fn put(&self, to: &mut Vec<u8>) {
        put(&self.to_words(), to);
    }

    fn take(rect: PixelRect, bytes: &[u8]) -> Option<Self> {
        let words: Vec<u32> = words(bytes).collect();
        AdaptiveTile::from_words(rect, words.as_slice().try_into().ok()?).map(Self::new)
    }
}

/// A pass over a tile of a uniform picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pass {
    /// Samples of each pixel after it.
    pub(crate) end: u32,
    /// By how much the pixels have changed.
    pub(crate) sums: DifferenceSums,
}

/// The passes that a tile of a uniform picture has had.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Passes(pub(crate) Vec<Pass>);

/// Bytes of a pass.
const PASS: usize = 32;

impl State for Passes {
    fn new(_: PixelRect) -> Self {
        Self::default()
    }

    fn samples(&self) -> u32 {
        self.0.last().map_or(0, |pass| pass.end)
    }

    fn put(&self, to: &mut Vec<u8>) {
        for pass in &self.0 {
            to.extend(u64::from(pass.end).to_le_bytes());
            pass.sums.to_words().into_iter().for_each(|word| to.extend(word.to_le_bytes()));
        }
    }

    fn take(_: PixelRect, bytes: &[u8]) -> Option<Self> {
        let pass = |bytes: &[u8]| {
            let (numbers, _) = bytes.as_chunks();
            let mut words = numbers.iter().map(|b| u64::from_le_bytes(*b));
            let end = u32::try_from(words.next()?).ok()?;
            Some(Pass {
                end,
                sums: DifferenceSums::from_words([words.next()?, words.next()?, words.next()?])?,
            })
        };
        let passes: Vec<_> = bytes.chunks(PASS).map(pass).collect::<Option<_>>()?;
        let starts = [0].into_iter().chain(passes.iter().map(|pass| pass.end));
        starts.zip(&passes).all(|(start, pass)| start < pass.end).then_some(Self(passes))
    }
}

/// Appends words.
fn put(words: &[u32], to: &mut Vec<u8>) {
    words.iter().for_each(|word| to.extend(word.to_le_bytes()));
}

/// The words that were put into bytes.
pub(super) fn words(bytes: &[u8]) -> impl Iterator<Item = u32> {
    let (words, _) = bytes.as_chunks();
    words.iter().map(|b| u32::from_le_bytes(*b))
}
