//! Where scenes come from (std).

pub mod builtin;
