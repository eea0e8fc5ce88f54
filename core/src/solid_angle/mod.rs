//! Regions of directions and uniform sampling over them: the geometry behind the lights' views.

#[cfg(test)]
mod flat_tests;
mod rectangle;
mod slab;
mod triangle;

pub use rectangle::{RectanglePlace, SphericalRectangle};
pub(crate) use slab::{FromEnd, Span, Sweep};
pub(crate) use triangle::{Apex, Corner, half_solid_angle};
pub use triangle::{SphericalTriangle, TrianglePlace};
