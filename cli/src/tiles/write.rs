//! Writing tiles.

use super::{Header, MAGIC, State, Stored, Tile, VERSION};
use std::io::{self, Write};
use std::ops::Deref;
use xxhash_rust::xxh3::{Xxh3Default, xxh3_64};

/// Writes a file of tiles; the tiles in the order of [`super::places`].
///
/// # Errors
/// When the system refuses.
pub(crate) fn write<W, P, S, T>(to: W, header: &Header, tiles: impl Iterator<Item = T>) -> io::Result<()>
where
    W: Write,
    P: Stored,
    S: State,
    T: Deref<Target = Tile<P, S>>,
{
    let mut to = Hashed { to, hash: Xxh3Default::new() };
    let text = header.json().to_string();
    to.put(MAGIC)?;
    to.put(&VERSION.to_le_bytes())?;
    to.put(&(text.len() as u32).to_le_bytes())?;
    to.put(text.as_bytes())?;
    let sum = to.hash.digest();
    to.put(&sum.to_le_bytes())?;
    let (mut state, mut bytes) = (Vec::new(), Vec::new());
    for tile in tiles {
        state.clear();
        bytes.clear();
        tile.state.put(&mut state);
        bytes.extend(tile.index.to_le_bytes());
        bytes.extend((state.len() as u32).to_le_bytes());
        bytes.extend(&state);
        tile.pixels.iter().for_each(|pixel| pixel.put(&mut bytes));
        drop(tile);
        bytes.extend(xxh3_64(&bytes).to_le_bytes());
        to.put(&bytes)?;
    }
    let sum = to.hash.digest128();
    to.put(&sum.to_le_bytes())?;
    to.to.flush()
}

/// A file whose bytes are hashed as they pass.
struct Hashed<W> {
    to: W,
    hash: Xxh3Default,
}

impl<W: Write> Hashed<W> {
    fn put(&mut self, bytes: &[u8]) -> io::Result<()> {
        self.hash.update(bytes);
        self.to.write_all(bytes)
    }
}
