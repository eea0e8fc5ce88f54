//! Any bytes as a file of serialized meshes: read or refused, never a panic.
#![no_main]

use halflight_fuzz::load_mesh;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    load_mesh("serialized", data);
});
