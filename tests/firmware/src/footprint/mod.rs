//! Three programs whose size and stack are measured: what a scene requires, and nothing else.

pub mod everything;
pub mod panel;
pub mod triangles;
