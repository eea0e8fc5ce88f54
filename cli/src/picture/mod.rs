//! Pictures in memory: linear RGB, first row on top.

mod exr;
mod pfm;
mod read;
mod srgb;
mod view;
mod write;

pub(crate) use exr::{Decoded, Header, Layer, encode_exr};
pub(crate) use read::{read, read_framed};
pub(crate) use srgb::{decode, encode};
pub(crate) use write::Format;

use halflight::Rgb;

/// A picture in linear RGB.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Picture {
    /// Columns.
    pub(crate) width: u32,
    /// Rows.
    pub(crate) height: u32,
    /// Row by row, first row on top.
    pub(crate) pixels: Vec<Rgb>,
}
