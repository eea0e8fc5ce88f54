//! What a sample meets on its way, for who wants to know more of a pixel than its radiance.

use crate::Rgb;
use crate::scene::Interaction;

/// Something that looks on while an estimator samples.
///
/// Nothing is computed for an observer that does not ask: its methods do nothing unless it has them,
/// and what costs something is handed over as a closure.
pub trait Observer {
    /// The camera ray has met a surface.
    ///
    /// * `albedo` – the fraction of light that it reflects, roughly
    /// * `toward` – unit vector to the viewer
    #[inline]
    fn surface(&mut self, at: &Interaction, toward: glam::Vec3, albedo: impl FnOnce() -> Rgb) {
        let _ = (at, toward, albedo);
    }

    /// A direction toward a light was drawn, and its light `arrives` or is blocked.
    ///
    /// * `unblocked` – what the sample brings when it arrives, as average over the channels:
    ///   `f_r L cos θ / p` (W m⁻² sr⁻¹), unweighted against other techniques
    #[inline]
    fn light(&mut self, arrives: bool, unblocked: impl FnOnce() -> f32) {
        let _ = (arrives, unblocked);
    }
}

/// Looks at nothing.
impl Observer for () {}
