//! The size of (c), see the library.
#![no_std]
#![no_main]

use halflight_firmware::footprint::everything;
use halflight_firmware::machine::entry;

#[entry]
fn main() -> ! {
    everything::run();
    loop {}
}

halflight_firmware::panics_end!();
