//! A sphere that emits, seen from anywhere.
#![no_main]

use halflight::shape::Sphere;
use halflight_fuzz::{Numbers, area_light};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut n = Numbers::new(data);
    if let Ok(shape) = Sphere::new(n.vector(), n.number()) {
        area_light(if n.flag() { shape.flipped() } else { shape }, &mut n);
    }
});
