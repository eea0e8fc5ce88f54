//! Unshadowed irradiance in closed form: what a diffuse receiver gets when nothing is in the way.
//!
//! The radiance is 1 (W m⁻² sr⁻¹) throughout, so that the irradiance is the projected solid angle (sr).

mod polygon;

pub use polygon::{polygon, rectangle, triangle};

#[cfg(test)]
mod tests;
