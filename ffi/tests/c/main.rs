//! The layer as C sees it, and what it refuses.

mod header;
mod program;
mod refusals;

use halflight::build::Description;
use halflight::load::{builtin::builtin, scene_bytes};
use halflight_ffi::HALFLIGHT_ALIGNMENT;

/// A small box with a light.
fn cornell() -> Description {
    let mut description = builtin("cornell").expect("a built-in scene");
    (description.width, description.height) = (16, 12);
    description
}

/// The same as it is stored.
fn stored() -> Vec<u8> {
    scene_bytes(&cornell()).expect("a scene that can be stored")
}

/// Bytes at an address that halflight can use.
struct Buffer {
    memory: Vec<u8>,
    start: usize,
    length: usize,
}

impl Buffer {
    fn new(bytes: &[u8]) -> Self {
        let memory = vec![0; bytes.len() + HALFLIGHT_ALIGNMENT];
        let start = HALFLIGHT_ALIGNMENT - memory.as_ptr().addr() % HALFLIGHT_ALIGNMENT;
        let mut buffer = Self { memory, start, length: bytes.len() };
        buffer.bytes_mut().copy_from_slice(bytes);
        buffer
    }

    fn bytes(&self) -> &[u8] {
        &self.memory[self.start..self.start + self.length]
    }

    fn bytes_mut(&mut self) -> &mut [u8] {
        &mut self.memory[self.start..self.start + self.length]
    }
}
