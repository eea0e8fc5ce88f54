//! The program from end to end: what is typed, what is printed, what lies in the folder afterwards.

mod auto;
mod bad_input;
mod batch;
mod bits;
#[cfg(unix)]
mod checkpoint;
mod compare;
mod disk;
mod gltf;
mod goals;
mod help;
#[cfg(unix)]
mod interrupt;
mod layers;
#[cfg(target_os = "linux")]
mod memory;
mod output_range;
mod parts;
mod paths;
mod preview;
mod results;
mod serve;
mod support;
mod tradeoff;
#[cfg(unix)]
mod watch;
