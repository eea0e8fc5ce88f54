//! A cylinder that emits, seen from anywhere.
#![no_main]

use halflight::shape::Cylinder;
use halflight_fuzz::{Numbers, area_light};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut n = Numbers::new(data);
    if let Ok(shape) = Cylinder::new(n.vector(), n.vector(), n.number()) {
        area_light(if n.flag() { shape.flipped() } else { shape }, &mut n);
    }
});
