//! The commands: one file each.

pub(crate) mod batch;
pub(crate) mod compare;
pub(crate) mod export;
pub(crate) mod inspect;
mod keeping;
pub(crate) mod merge;
pub(crate) mod render;
pub(crate) mod scenes;
pub(crate) mod serve;
pub(crate) mod shell;
mod shots;
pub(crate) mod tradeoff;
pub(crate) mod watch;
