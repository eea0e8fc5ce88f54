//! The wall of a sphere around the receiver.

use crate::geom::{Frame, unit};
use crate::light::{Receiver, SurfaceSample, SurfaceView};
use crate::num;
use crate::shape::{Sphere, SurfacePoint};
use crate::warp;
use glam::Vec3;

/// A sphere from inside, where each direction meets its wall: uniform over all directions,
/// `1 / 4π` (sr⁻¹), or over the projected hemisphere, `cos θ / π` (sr⁻¹).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SphereInside {
    sphere: Sphere,
    frame: Frame,
    /// From the receiver to the centre (m).
    to_centre: Vec3,
    /// Product of the distances to both ends of a chord (m²).
    power: f32,
    projected: bool,
}

impl SphereInside {
    /// * `gap` – how far outside the receiver is (m), 0 or less
    #[inline]
    pub(super) fn new(sphere: &Sphere, from: &Receiver, gap: f32, projected: bool) -> Self {
        let frame = Frame::from_normal(from.normal);
        let power = -gap * (2.0 * sphere.radius() + gap);
        Self { sphere: *sphere, frame, to_centre: sphere.centre() - from.point, power, projected }
    }
}

impl SurfaceView for SphereInside {
    /// The point where the direction meets the wall; `None` where it leaves at once.
    #[inline]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        let local = if self.projected { warp::cosine_hemisphere(u) } else { warp::uniform_sphere(u) };
        let wi = self.frame.to_world(local);
        let middle = wi.dot(self.to_centre);
        let half_chord = num::sqrt(middle * middle + self.power);
        let distance = if middle > 0.0 { middle + half_chord } else { self.power / (half_chord - middle) };
        if !(distance > 0.0) {
            return None;
        }
        let n = unit(wi * distance - self.to_centre)?;
        Some(SurfaceSample { at: self.sphere.point(n), wi, distance })
    }

    #[inline]
    fn pdf_solid_angle(&self, _: &SurfacePoint, wi: Vec3, _: f32) -> Option<f32> {
        let pdf = if self.projected {
            warp::cosine_hemisphere_pdf(self.frame.n.dot(wi))
        } else {
            warp::UNIFORM_SPHERE_PDF
        };
        (pdf > 0.0).then_some(pdf)
    }

    fn invert(&self, _: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        let local = self.frame.to_local(wi);
        let u = if !self.projected {
            warp::uniform_sphere_inverse(local)
        } else if local.z > 0.0 {
            warp::cosine_hemisphere_inverse(local)
        } else {
            return None;
        };
        Some(u.map(num::clamp_unit))
    }
}
