//! A convex polygon that emits, seen from anywhere.
#![no_main]

use halflight::glam::Vec3;
use halflight::shape::Polygon;
use halflight_fuzz::{Numbers, area_light};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let mut n = Numbers::new(data);
    // Corners in a plane, or anywhere, which is refused.
    let (a, u, v) = (n.vector(), n.vector(), n.vector());
    let flat = n.flag();
    let corners: Vec<Vec3> = (0..n.byte() % 10)
        .map(|_| if flat { a + u * n.number() + v * n.number() } else { n.vector() })
        .collect();
    if let Ok(shape) = Polygon::new(&corners) {
        area_light(if n.flag() { shape.flipped() } else { shape }, &mut n);
    }
});
