//! Why bytes were refused.

use super::VERSION;
use crate::camera::CameraError;
use crate::film::FilmError;
use crate::scene::BakedError;
use core::fmt;

/// Why bytes were refused as a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum StoredError {
    /// They do not begin as a scene does.
    NotAScene,
    /// They are of another version.
    Version {
        /// Which.
        found: u32,
    },
    /// They are fewer or more than the head says.
    Length {
        /// What the head says (bytes).
        told: u32,
        /// How many there are.
        found: usize,
    },
    /// They were changed after they had been written.
    Checksum,
    /// The tables do not fill them.
    Tables,
    /// They are not at an address that 16 divides.
    Misaligned,
    /// This machine has the other order of bytes.
    BigEndian,
    /// An entry is of a kind that does not exist.
    Kind {
        /// Which table.
        table: &'static str,
        /// Which entry.
        index: usize,
    },
    /// There is too little room for a table.
    Room {
        /// Which table.
        table: &'static str,
        /// Entries that there are.
        needed: usize,
        /// Entries that there is room for.
        has: usize,
    },
    /// The camera.
    Camera(CameraError),
    /// The raster.
    Film(FilmError),
    /// An entry is not what halflight accepts.
    Entry(BakedError),
}

impl fmt::Display for StoredError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotAScene => write!(f, "not a scene that `halflight export --as bytes` wrote"),
            Self::Version { found } => {
                write!(f, "a scene of version {found}; this program reads {VERSION}: export it again")
            }
            Self::Length { told, found } => write!(f, "{found} bytes of a scene of {told}"),
            Self::Checksum => write!(f, "the bytes of the scene have changed since they were written"),
            Self::Tables => write!(f, "the tables of the scene do not fill its bytes"),
            Self::Misaligned => write!(f, "the bytes must be at an address that 16 divides; see `Aligned`"),
            Self::BigEndian => write!(f, "scenes in bytes are for little-endian machines"),
            Self::Kind { table, index } => write!(f, "entry {index} of the {table} is of no known kind"),
            Self::Room { table, needed, has } => write!(f, "{needed} {table}, and room for {has}"),
            Self::Camera(source) => write!(f, "{source}"),
            Self::Film(source) => write!(f, "{source}"),
            Self::Entry(source) => write!(f, "{source}"),
        }
    }
}

impl core::error::Error for StoredError {}
