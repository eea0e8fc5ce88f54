//! Points, directions, boxes, and the offsets that keep a ray from meeting the surface it leaves.

mod aabb;
mod frame;
mod offset;
mod ray;
mod region;

pub use aabb::Aabb;
pub use frame::Frame;
pub(crate) use frame::unit;
pub use offset::offset_origin;
pub use ray::{PreparedRay, Ray};
pub use region::Region;
