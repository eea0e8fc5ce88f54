//! Any bytes as a scene file: what is read and built gives light that is finite and not negative.
#![no_main]

use halflight_fuzz::render_files;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    render_files("scene.xml", &[("scene.xml", data)]);
});
