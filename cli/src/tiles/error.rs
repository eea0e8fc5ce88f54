//! What can be wrong with a file of tiles.

use std::{fmt, io};

/// Why a file of tiles was refused. Its text goes on after the file's name.
#[derive(Debug)]
pub(crate) enum TilesError {
    /// The system refused.
    Io(io::Error),
    /// It begins with something else.
    Foreign,
    /// Of a format that is not known.
    Version(u32),
    /// Its header says something that cannot be.
    Header(String),
    /// It ends before its tiles do.
    Short,
    /// There are bytes behind its end.
    Long,
    /// A tile is not what was written, by its number in the file.
    Tile(usize),
    /// Something is not what was written.
    Checksum,
}

impl fmt::Display for TilesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(e) => write!(f, "cannot be read: {e}"),
            Self::Foreign => f.write_str("is no part or checkpoint of a render"),
            Self::Version(version) => write!(
                f,
                "is written in version {version} of the format, and this halflight reads version {}",
                super::VERSION
            ),
            Self::Header(what) => write!(f, "is damaged: its header {what}"),
            Self::Short => f.write_str("is torn: it ends before its tiles do"),
            Self::Long => f.write_str("is damaged: there are bytes behind its end"),
            Self::Tile(tile) => write!(f, "is damaged: tile {tile} of it is not what was written"),
            Self::Checksum => f.write_str("is damaged: its checksum is another"),
        }
    }
}

impl From<io::Error> for TilesError {
    fn from(error: io::Error) -> Self {
        match error.kind() {
            io::ErrorKind::UnexpectedEof => Self::Short,
            _ => Self::Io(error),
        }
    }
}
