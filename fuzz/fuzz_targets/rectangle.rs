//! A rectangle that emits, seen from anywhere.
#![no_main]

use halflight::shape::Rectangle;
use halflight_fuzz::{Numbers, area_light};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut n = Numbers::new(data);
    // Axes at right angles, or anything, which is refused.
    let (centre, u, v) = (n.vector(), n.vector(), n.vector());
    let v = if n.flag() { v } else { u.cross(v) };
    if let Ok(shape) = Rectangle::new(centre, u, v) {
        area_light(if n.flag() { shape.flipped() } else { shape }, &mut n);
    }
});
