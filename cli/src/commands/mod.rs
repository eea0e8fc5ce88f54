//! The commands: one file each.

pub(crate) mod compare;
pub(crate) mod export;
pub(crate) mod inspect;
pub(crate) mod render;
pub(crate) mod scenes;
pub(crate) mod serve;
pub(crate) mod shell;
pub(crate) mod tradeoff;
