//! Scenes as `halflight export --as rust` writes them; the tests of the workspace keep them up to date.

#[rustfmt::skip]
pub mod cornell;
#[rustfmt::skip]
pub mod everything;
#[rustfmt::skip]
pub mod sky;
