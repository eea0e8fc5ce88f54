//! Parts of a picture with all that is known of them, in a file: what `merge` and a checkpoint need.
//!
//! All numbers are little-endian.
//!
//! | bytes | what |
//! |---|---|
//! | 16 | `halflight tiles\n` |
//! | 4 | version of this format: 1 |
//! | 4 | bytes of the header, at most 65 536 |
//! | … | the header, JSON: see [`Header`] |
//! | 8 | XXH3-64 of everything before |
//! | … | each tile of the part, in the order of their numbers |
//! | 16 | XXH3-128 of everything before |
//!
//! | bytes of a tile | what |
//! |---|---|
//! | 4 | its number: the tiles of the picture's window are counted row by row from the top |
//! | 4 | bytes of its state, at most those of [`AdaptiveTile::WORDS`] |
//! | … | its state: the passes of a uniform picture, or the blocks of an adaptive tile |
//! | … | its pixels, row by row, each [`Stored::WORDS`] words of 4 bytes |
//! | 8 | XXH3-64 of the tile's bytes before |
//!
//! The checksums tell files that are torn or altered by accident; they are no protection from somebody
//! who means harm. What a reader allocates is never more than the file is long.

mod error;
mod header;
mod read;
mod state;
mod write;

pub(crate) use error::TilesError;
pub(crate) use header::{About, Aim, Header, Part};
pub(crate) use read::Reader;
pub(crate) use state::{Pass, Passes, State, Stored};
pub(crate) use write::write;

use halflight::estimate::AdaptiveTile;
use halflight::film::PixelRect;

/// Opens every file.
const MAGIC: &[u8; 16] = b"halflight tiles\n";

/// Of the format.
const VERSION: u32 = 1;

/// Most bytes of a header.
const MOST_HEADER: u32 = 1 << 16;

/// Most bytes of a tile's state: an adaptive one's. Passes, of which there are 32 at most, take less.
const MOST_STATE: u32 = (AdaptiveTile::WORDS * 4) as u32;

/// A tile of the picture.
#[derive(Debug, Clone)]
pub(crate) struct Tile<P, S> {
    /// Its number in the picture's window, row by row from the top.
    pub(crate) index: u32,
    /// Its place.
    pub(crate) rect: PixelRect,
    /// Its pixels, row by row.
    pub(crate) pixels: Vec<P>,
    /// What is known beside them.
    pub(crate) state: S,
}

/// The tiles of a part, with their numbers, row by row.
///
/// The tiles are dealt out one by one, so that parts differ by one tile at most. Each row begins an odd
/// number of columns farther than the one above, about the golden section of it: a part's tiles lie on a
/// lattice over the whole picture, and no part gets all that is dear.
///
/// * `side` – of a tile (pixels)
pub(crate) fn places(crop: PixelRect, side: u32, part: Part) -> impl Iterator<Item = (u32, PixelRect)> {
    let starts = move |from: u32, to: u32| (0u64..).zip((from..to).step_by(side as usize));
    let columns = u64::from(crop.width().div_ceil(side));
    let step = (columns as f64 * 0.618_033_988_749_894_9).round() as u64 | 1;
    let places = starts(crop.y0, crop.y1).flat_map(move |y| starts(crop.x0, crop.x1).map(move |x| (x, y)));
    (0..).zip(places).filter_map(move |(index, ((column, x0), (row, y0)))| {
        let turn = row * columns + (column + row * step) % columns;
        let (x1, y1) = (crop.x1.min(x0 + side), crop.y1.min(y0 + side));
        let is_there = turn % u64::from(part.of) == u64::from(part.number - 1);
        is_there.then_some((index, PixelRect { x0, y0, x1, y1 }))
    })
}

#[cfg(test)]
mod tests;
