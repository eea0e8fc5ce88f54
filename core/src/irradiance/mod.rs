//! Unshadowed irradiance in closed form: what a diffuse receiver gets when nothing is in the way.
//!
//! The radiance is 1 (W m⁻² sr⁻¹) throughout, so that the irradiance is the projected solid angle (sr).

mod disk;
mod polygon;
mod segment;
mod sphere;

pub use disk::disk;
pub use polygon::{polygon, rectangle, triangle};
pub use sphere::sphere;
pub(crate) use sphere::sphere_at;

#[cfg(test)]
mod disk_tests;
#[cfg(test)]
mod tests;
