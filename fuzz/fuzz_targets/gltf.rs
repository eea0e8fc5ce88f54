//! Any bytes as a glTF scene: read or refused, never a panic.
#![no_main]

use halflight_fuzz::load_file;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    load_file("scene.gltf", data);
});
