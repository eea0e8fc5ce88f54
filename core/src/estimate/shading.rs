//! A surface point made ready for reflecting light.

use crate::Rgb;
use crate::bsdf::{Bsdf, BsdfSample};
use crate::geom::Frame;
use crate::light::Receiver;
use crate::scene::Interaction;
use glam::Vec3;

/// A point, the direction it is seen from, and its BSDF.
pub(super) struct Shading<'s, B> {
    pub(super) at: &'s Interaction,
    pub(super) receiver: Receiver,
    bsdf: &'s B,
    frame: Frame,
    wo: Vec3,
    /// Geometric normal on the side that is looked at.
    side: Vec3,
}

impl<'s, B: Bsdf> Shading<'s, B> {
    /// * `wo` – unit direction to the viewer, world space
    /// * `tangent` – computes the surface's tangent; called only where the BSDF needs it
    ///
    /// Where the viewer sees the geometric front and the interpolated back, or the other way round, the
    /// geometric normal is taken. Differs from Mitsuba 3, which is black there: silhouettes of coarse
    /// meshes have no dark rim. Light through the geometric surface is left out; in Mitsuba it leaks
    /// where nothing else is in the way.
    #[inline]
    pub(super) fn new(at: &'s Interaction, bsdf: &'s B, wo: Vec3, tangent: impl FnOnce() -> Vec3) -> Self {
        let front = at.at.normal.dot(wo) >= 0.0;
        let side = if front { at.at.normal } else { -at.at.normal };
        let receiver = at.receiver(wo);
        // On the side that the surface calls its front.
        let normal = if front { receiver.normal } else { -receiver.normal };
        let frame = if bsdf.needs_tangent() {
            Frame::from_normal_and_tangent(normal, tangent())
        } else {
            Frame::from_normal(normal)
        };
        Self { at, receiver, bsdf, frame, wo: frame.to_local(wo), side }
    }

    #[inline]
    pub(super) fn bsdf(&self) -> &B {
        self.bsdf
    }

    /// `f_r cos θ` toward the world direction `wi` and the density with which the BSDF draws it;
    /// `None` where nothing is reflected.
    #[inline]
    pub(super) fn reflect(&self, wi: Vec3) -> Option<Reflected> {
        let cos_theta = self.receiver.normal.dot(wi);
        if cos_theta <= 0.0 {
            return None;
        }
        let local = self.frame.to_local(wi);
        let f = self.bsdf.eval(self.wo, local);
        (!f.is_black()).then(|| Reflected { f_cos: f * cos_theta, local })
    }

    /// True for directions on the viewer's side of the surface: the others come through it, also
    /// where an interpolated normal would let them in.
    #[inline]
    pub(super) fn is_outside(&self, wi: Vec3) -> bool {
        self.side.dot(wi) > 0.0
    }

    /// `f_r` of a BSDF that is the same in all directions.
    #[inline]
    pub(super) fn diffuse(&self) -> Rgb {
        self.bsdf.eval(self.wo, Vec3::Z * self.wo.z.signum())
    }

    /// Density of a direction that [`Shading::reflect`] has accepted (sr⁻¹).
    #[inline]
    pub(super) fn pdf_solid_angle(&self, reflected: &Reflected) -> f32 {
        self.bsdf.pdf_solid_angle(self.wo, reflected.local)
    }

    /// Draws a world direction from the BSDF.
    #[inline]
    pub(super) fn sample(&self, u: [f32; 2], lobe: f32) -> Option<(Vec3, f32)> {
        let BsdfSample { wi, pdf_solid_angle } = self.bsdf.sample(self.wo, u, lobe)?;
        Some((self.frame.to_world(wi), pdf_solid_angle))
    }
}

/// What a surface makes of light from one direction.
pub(super) struct Reflected {
    /// BSDF times cosine (sr⁻¹).
    pub(super) f_cos: Rgb,
    local: Vec3,
}
