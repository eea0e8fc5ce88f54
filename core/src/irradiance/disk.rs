//! Irradiance from a disk.
use crate::light::Receiver;
use crate::shape::Disk;
/// x
#[must_use]
pub fn disk(_from: &Receiver, _disk: &Disk) -> f32 {
    0.0
}
