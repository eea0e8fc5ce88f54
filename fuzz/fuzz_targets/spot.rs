//! A spot light, seen from anywhere.
#![no_main]

use halflight::light::Spot;
use halflight_fuzz::{Numbers, emitter};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut n = Numbers::new(data);
    if let Ok(light) = Spot::new(n.vector(), n.vector(), n.colour(), n.number(), n.number()) {
        emitter(&light, &n.receiver(), n.uniforms());
    }
});
