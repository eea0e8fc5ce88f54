//! What became of a call.

use core::ffi::{CStr, c_char};
use halflight::stored::StoredError;

/// What became of a call. Where it is not `OK`, there is no answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
pub enum HalflightStatus {
    /// All is well.
    Ok = 0,
    /// A pointer is null.
    Null = 1,
    /// Bytes or memory are not at an address that `HALFLIGHT_ALIGNMENT` divides, or another pointer is not at
    /// one that is right for its type.
    Misaligned = 2,
    /// The bytes are no scene, or one of another version.
    NotAScene = 3,
    /// The bytes were changed or cut.
    Damaged = 4,
    /// An entry of the scene is none that halflight accepts.
    Refused = 5,
    /// There is less memory than `halflight_scene_room` says.
    Room = 6,
    /// A number is out of its range.
    Argument = 7,
    /// Nothing of that light arrives there in any case, or there is no such light.
    NoLight = 8,
}

impl From<StoredError> for HalflightStatus {
    fn from(error: StoredError) -> Self {
        match error {
            StoredError::NotAScene | StoredError::Version { .. } | StoredError::BigEndian => Self::NotAScene,
            StoredError::Length { .. } | StoredError::Checksum | StoredError::Tables => Self::Damaged,
            StoredError::Misaligned => Self::Misaligned,
            StoredError::Room { .. } => Self::Room,
            _ => Self::Refused,
        }
    }
}

/// What a status means, in words: a text of static duration, never null.
///
/// * `status` – a `HalflightStatus`, or any other number
#[unsafe(no_mangle)]
pub extern "C" fn halflight_message(status: u32) -> *const c_char {
    let text: &CStr = match status {
        0 => c"all is well",
        1 => c"a pointer is null",
        2 => c"not at an address that 16 divides: align the buffer to HALFLIGHT_ALIGNMENT",
        3 => c"no scene of this version: write it with `halflight export SCENE --as bytes`",
        4 => c"the scene was changed or cut after it had been written",
        5 => c"the scene holds an entry that halflight does not accept: export it again",
        6 => c"too little memory: ask halflight_scene_room how much is needed",
        7 => c"a number is out of its range: samples from 1, finite points, directions with a length",
        8 => c"nothing of that light arrives there in any case, or there is no such light",
        _ => c"no status of halflight's",
    };
    text.as_ptr()
}
