//! Parallel light, seen from anywhere.
#![no_main]

use halflight::light::Directional;
use halflight_fuzz::{Numbers, emitter};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut n = Numbers::new(data);
    if let Ok(light) = Directional::new(n.vector(), n.colour()) {
        emitter(&light, &n.receiver(), n.uniforms());
    }
});
