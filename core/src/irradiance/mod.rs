//! Unshadowed irradiance in closed form: what a diffuse receiver gets when nothing is in the way.

mod disk;
mod sphere;

pub use disk::disk;
pub use sphere::sphere;
pub(crate) use sphere::sphere_at;
