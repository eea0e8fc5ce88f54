//! What stands before the tables.

use super::StoredError;
use crate::camera::{Camera, View};
use crate::film::{Film, Filter};
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// The first bytes of every scene.
pub const MAGIC: [u8; 4] = *b"HLSC";

/// The version of the format.
pub const VERSION: u32 = 1;

/// The first 144 bytes.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Head {
    /// [`MAGIC`].
    pub magic: [u8; 4],
    /// [`VERSION`].
    pub version: u32,
    /// How many bytes there are in all.
    pub length: u32,
    /// [`checksum`] of the words that follow, to the end of the bytes.
    pub checksum: u32,
    /// Entries of the tables, in their order.
    pub counts: [u32; 7],
    /// 0 for a perspective camera, 1 for an orthographic one.
    pub projection: u32,
    /// The camera's origin (m), and its unit vectors to the right, upward and forward.
    pub view: [[f32; 3]; 4],
    /// Half of the width and height of the picture, at a distance of 1 or (m).
    pub half_extents: [f32; 2],
    /// Where the camera begins and ends to see (m).
    pub clip: [f32; 2],
    /// Pixels in a row, and rows.
    pub size: [u32; 2],
    /// 0 for a box, 1 for a tent, 2 for a Gaussian.
    pub filter: u32,
    /// Its radius, or standard deviation (pixels).
    pub filter_radius: f32,
    /// 0.
    pub reserved: [u32; 4],
}

/// A checksum of 32 bits over words.
///
/// Source: Fowler, Noll, Vo, *The FNV Non-Cryptographic Hash Algorithm*, variant 1a. Differs: a word at a
/// time.
#[must_use]
pub fn checksum(words: &[u32]) -> u32 {
    words.iter().fold(0x811c_9dc5, |sum, &word| (sum ^ word).wrapping_mul(0x0100_0193))
}

/// The checked head, and what follows.
pub(super) fn split(bytes: &[u8]) -> Result<(&Head, &[u8]), StoredError> {
    if cfg!(target_endian = "big") {
        return Err(StoredError::BigEndian);
    }
    if !bytes.starts_with(&MAGIC) {
        return Err(StoredError::NotAScene);
    }
    if !(bytes.as_ptr() as usize).is_multiple_of(16) {
        return Err(StoredError::Misaligned);
    }
    let (head, rest) = bytes.split_at_checked(size_of::<Head>()).ok_or(StoredError::NotAScene)?;
    let head: &Head = bytemuck::try_from_bytes(head).map_err(|_| StoredError::Misaligned)?;
    if head.version != VERSION {
        return Err(StoredError::Version { found: head.version });
    }
    if head.length as usize != bytes.len() {
        return Err(StoredError::Length { told: head.length, found: bytes.len() });
    }
    let words: &[u32] = bytemuck::try_cast_slice(bytes).map_err(|_| StoredError::Tables)?;
    if words.get(4..).map(checksum) != Some(head.checksum) {
        return Err(StoredError::Checksum);
    }
    Ok((head, rest))
}

impl Head {
    pub(super) fn camera(&self) -> Result<Camera, StoredError> {
        let [origin, right, up, forward] = self.view.map(Vec3::from_array);
        let ([width, height], [near, far]) = (self.half_extents, self.clip);
        let view = View { origin, right, up, forward };
        let camera = match self.projection {
            0 => Camera::perspective(view, width, height),
            1 => Camera::orthographic(view, width, height),
            _ => return Err(StoredError::Kind { table: "cameras", index: 0 }),
        };
        camera.and_then(|camera| camera.with_clip(near, far)).map_err(StoredError::Camera)
    }

    pub(super) fn film(&self) -> Result<Film, StoredError> {
        let radius = self.filter_radius;
        let filter = match self.filter {
            0 => Filter::Box { radius },
            1 => Filter::Tent { radius },
            2 => Filter::Gaussian { stddev: radius },
            _ => return Err(StoredError::Kind { table: "filters", index: 0 }),
        };
        let [width, height] = self.size;
        Film::new(width, height, filter).map_err(StoredError::Film)
    }
}
