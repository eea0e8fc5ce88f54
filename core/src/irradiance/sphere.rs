//! Irradiance from a sphere.

use crate::light::Receiver;
use crate::num::PI;
use crate::projected::ProjectedCap;
use crate::shape::Sphere;

/// Projected solid angle of a sphere above the horizon of `from` (sr), in `[0, π]`: the irradiance
/// for a radiance of 1 on the side that is seen. From inside it is π.
///
/// Source: [`ProjectedCap::new`].
#[must_use]
pub fn sphere(from: &Receiver, sphere: &Sphere) -> f32 {
    sphere_at(from, sphere, sphere.clearance(from.point))
}

/// The same for a receiver that is taken to be `gap` outside of the sphere (m).
pub(crate) fn sphere_at(from: &Receiver, sphere: &Sphere, gap: f32) -> f32 {
    if !(gap > 0.0) {
        return PI;
    }
    let to_centre = sphere.centre() - from.point;
    ProjectedCap::of_sphere(from, to_centre, sphere.radius(), gap).map_or(0.0, |(cap, _)| cap.area())
}
