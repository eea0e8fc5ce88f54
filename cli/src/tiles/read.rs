//! Reading tiles.

use super::state::words;
use super::{Header, MAGIC, MOST_HEADER, MOST_STATE, State, Stored, Tile, TilesError, VERSION, places};
use halflight::film::PixelRect;
use std::io::Read;
use xxhash_rust::xxh3::{Xxh3Default, xxh3_64};

/// Bytes of a tile beside its state and its pixels.
const FRAME: u64 = 16;

/// A file of tiles that is being read.
pub(crate) struct Reader<R> {
    header: Header,
    from: Hashed<R>,
}

impl<R: Read> Reader<R> {
    /// Reads the header.
    ///
    /// * `length` – bytes of the file
    ///
    /// # Errors
    /// When it is no such file, or its header says what cannot be.
    pub(crate) fn new(from: R, length: u64) -> Result<Self, TilesError> {
        let mut from = Hashed { from, left: length, hash: Xxh3Default::new() };
        if from.array().is_ok_and(|magic: [u8; 16]| magic != *MAGIC) || length < MAGIC.len() as u64 {
            return Err(TilesError::Foreign);
        }
        let version = from.number()?;
        if version != VERSION {
            return Err(TilesError::Version(version));
        }
        let bytes = from.number()?;
        if bytes > MOST_HEADER {
            return Err(TilesError::Header(format!("is {bytes} bytes long, above {MOST_HEADER}")));
        }
        let text = from.bytes(u64::from(bytes))?;
        let sum = from.hash.digest();
        if u64::from_le_bytes(from.array()?) != sum {
            return Err(TilesError::Header("is not what was written".to_owned()));
        }
        let json = serde_json::from_slice(&text)
            .map_err(|_| TilesError::Header("is no JSON that can be read".to_owned()))?;
        Ok(Self { header: Header::from_json(&json)?, from })
    }

    /// What the file says of itself.
    pub(crate) const fn header(&self) -> &Header {
        &self.header
    }

    /// Reads all tiles: those of the part, in their order. The caller has looked at the header and knows
    /// what pixels hold.
    ///
    /// # Errors
    /// When the file is not as it was written.
    pub(crate) fn tiles<P: Stored, S: State>(mut self) -> Result<Vec<Tile<P, S>>, TilesError> {
        let Header { crop, side, part, .. } = self.header;
        let count = places(crop, side, part)
            .fold((0u64, 0u64), |(tiles, pixels), (_, rect)| (tiles + 1, pixels + rect.area() as u64));
        // Nothing is allocated for what the file is too short for.
        let least = count.0 * FRAME + count.1 * P::WORDS as u64 * 4 + size_of::<u128>() as u64;
        if self.from.left < least {
            return Err(TilesError::Short);
        }
        let tiles = places(crop, side, part).enumerate().map(|(i, place)| self.from.tile(i, place));
        let tiles = tiles.collect::<Result<_, _>>()?;
        let sum = self.from.hash.digest128();
        if u128::from_le_bytes(self.from.array()?) != sum {
            return Err(TilesError::Checksum);
        }
        if self.from.left > 0 { Err(TilesError::Long) } else { Ok(tiles) }
    }
}

/// A file whose bytes are counted and hashed as they pass.
struct Hashed<R> {
    from: R,
    left: u64,
    hash: Xxh3Default,
}

impl<R: Read> Hashed<R> {
    /// The next bytes; allocates only what the file has.
    fn bytes(&mut self, count: u64) -> Result<Vec<u8>, TilesError> {
        self.left = self.left.checked_sub(count).ok_or(TilesError::Short)?;
        let mut bytes = vec![0; count as usize];
        self.from.read_exact(&mut bytes)?;
        self.hash.update(&bytes);
        Ok(bytes)
    }

    /// The next bytes, of a fixed number.
    fn array<const N: usize>(&mut self) -> Result<[u8; N], TilesError> {
        self.bytes(N as u64)?.try_into().map_err(|_| TilesError::Short)
    }

    /// The next number.
    fn number(&mut self) -> Result<u32, TilesError> {
        self.array().map(u32::from_le_bytes)
    }

    /// The next tile, the `i`-th of the file.
    fn tile<P: Stored, S: State>(
        &mut self,
        i: usize,
        (index, rect): (u32, PixelRect),
    ) -> Result<Tile<P, S>, TilesError> {
        let damaged = || TilesError::Tile(i);
        let head: [u8; 8] = self.array()?;
        let mut numbers = words(&head);
        let (number, state) = (numbers.next(), numbers.next().unwrap_or(u32::MAX));
        if number != Some(index) || state > MOST_STATE {
            return Err(damaged());
        }
        let pixels = rect.area() * P::WORDS * 4;
        let body = self.bytes(u64::from(state) + pixels as u64)?;
        let sum = u64::from_le_bytes(self.array()?);
        if xxh3_64(&[&head[..], &body].concat()) != sum {
            return Err(damaged());
        }
        let (state, pixels) = body.split_at(state as usize);
        let pixels: Vec<u32> = words(pixels).collect();
        let pixels = pixels.chunks_exact(P::WORDS).map(|words| P::take(words).filter(is_possible));
        let pixels = pixels.collect::<Option<_>>().ok_or_else(damaged)?;
        Ok(Tile { index, rect, pixels, state: S::take(rect, state).ok_or_else(damaged)? })
    }
}

/// False for a pixel that claims more samples than can be counted.
fn is_possible(pixel: &impl Stored) -> bool {
    let stats = pixel.stats();
    stats.count().checked_add(stats.rejected()).is_some()
}
