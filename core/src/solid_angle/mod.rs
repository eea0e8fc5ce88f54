//! Regions of directions and uniform sampling over them: the geometry behind the lights' views.

#[cfg(test)]
mod flat_tests;
mod rectangle;
mod triangle;

pub use rectangle::{RectanglePlace, SphericalRectangle};
pub(crate) use triangle::triangle_solid_angle;
pub use triangle::{SphericalTriangle, TrianglePlace};
