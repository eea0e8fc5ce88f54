//! The size of (a), see the library.
#![no_std]
#![no_main]

use halflight_firmware::footprint::panel;
use halflight_firmware::machine::entry;

#[entry]
fn main() -> ! {
    panel::run();
    loop {}
}

halflight_firmware::nothing_panics!();
