//! Prints how much stack each of the three programs uses.
#![no_std]
#![no_main]

use halflight_firmware::footprint::{everything, panel, triangles};
use halflight_firmware::machine::{entry, exit, println, stack_of};

#[entry]
fn main() -> ! {
    println!("a {}", stack_of(panel::run));
    println!("b {}", stack_of(triangles::run));
    println!("c {}", stack_of(everything::run));
    exit(true)
}

halflight_firmware::panics_end!();
