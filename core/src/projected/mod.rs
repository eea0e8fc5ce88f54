//! Regions of directions above a horizon, and sampling over them in proportion to the cosine.

mod arc;
mod cap;
mod chains;
mod chart;
mod clip;
mod cut;
mod lanes;
mod meridian;
#[cfg(test)]
pub(crate) mod oracle;
mod polygon;
mod sector;
mod sectors;
#[cfg(test)]
mod tests;

pub use cap::ProjectedCap;
pub use chart::Chart;
pub use polygon::{PolygonSample, ProjectedPolygon};
