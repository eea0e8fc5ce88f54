//! The size of (b), see the library.
#![no_std]
#![no_main]

use halflight_firmware::footprint::triangles;
use halflight_firmware::machine::entry;

#[entry]
fn main() -> ! {
    triangles::run();
    loop {}
}

halflight_firmware::panics_end!();
