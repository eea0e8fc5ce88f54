//! Why a picture was not read or written.

use core::fmt;
use std::io;
use std::string::{String, ToString};

/// Why a picture was not read or written.
#[derive(Debug)]
#[non_exhaustive]
pub enum ImageError {
    /// The file is missing, or cannot be read or written.
    File(io::Error),
    /// The file is not a picture of a kind that is read.
    Format,
    /// The file breaks the rules of its format, or ends too early.
    Malformed {
        /// What is wrong.
        what: String,
    },
    /// The picture has no texel.
    Empty,
    /// The picture has more than [`super::MAX_TEXELS`] texels.
    TooLarge {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The file is too short for as many texels.
    Short {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Bytes of the file.
        bytes: u64,
    },
}

impl fmt::Display for ImageError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File(source) => source.fmt(f),
            Self::Format => write!(f, "not a picture that is read; pictures can be .exr, .hdr, .png or .jpg"),
            Self::Malformed { what } => write!(f, "the picture is damaged: {what}"),
            Self::Empty => write!(f, "the picture has no texel"),
            Self::TooLarge { width, height } => {
                write!(f, "{width} × {height} texels are more than {}; make it smaller", super::MAX_TEXELS)
            }
            Self::Short { width, height, bytes } => {
                write!(f, "the picture is torn: {bytes} bytes hold no {width} × {height} texels")
            }
        }
    }
}

impl core::error::Error for ImageError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::File(source) => Some(source),
            _ => None,
        }
    }
}

impl From<io::Error> for ImageError {
    fn from(e: io::Error) -> Self {
        Self::File(e)
    }
}

impl From<::image::ImageError> for ImageError {
    fn from(e: ::image::ImageError) -> Self {
        match e {
            // A file that ends too early is damaged; the file system has nothing to do with it.
            ::image::ImageError::IoError(e) if e.kind() != io::ErrorKind::UnexpectedEof => Self::File(e),
            ::image::ImageError::Unsupported(_) => Self::Format,
            other => Self::Malformed { what: other.to_string() },
        }
    }
}

impl From<::exr::error::Error> for ImageError {
    fn from(e: ::exr::error::Error) -> Self {
        match e {
            ::exr::error::Error::Io(e) if e.kind() != io::ErrorKind::UnexpectedEof => Self::File(e),
            other => Self::Malformed { what: other.to_string() },
        }
    }
}
