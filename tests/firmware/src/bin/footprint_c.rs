//! The size of (c), see the library; with feature `stack` its stack is printed.
#![no_std]
#![no_main]

use halflight_firmware::footprint::everything;
use halflight_firmware::machine::entry;

#[entry]
fn main() -> ! {
    #[cfg(feature = "stack")]
    halflight_firmware::machine::print_stack_of(everything::run_by_area);
    #[cfg(not(feature = "stack"))]
    loop {
        everything::run_by_area();
    }
}

#[cfg(not(feature = "stack"))]
halflight_firmware::nothing_panics!();
#[cfg(feature = "stack")]
halflight_firmware::panics_end!();
