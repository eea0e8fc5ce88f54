//! Regions of directions above a horizon, and sampling over them in proportion to the cosine.

mod cap;

pub use cap::ProjectedCap;
