//! What the programs for microcontrollers share.
#![no_std]

pub mod footprint;
pub mod machine;
pub mod picture;
#[path = "../scenes/mod.rs"]
pub mod scenes;
