//! Whatever is shown, as one estimator: so that its code is in the module once, and not once for each
//! way to render.

use halflight::Rgb;
use halflight::estimate::{Arrival, Direct, Estimator, Foreseen, Known, Observer, Occlusion};
use halflight::geom::Ray;
use halflight::glam::Vec3;
use halflight::light::Emitter;
use halflight::material::Material;
use halflight::scene::{Interaction, Scene};
use halflight::sequence::Sequence;
use halflight::shape::Shape;

/// An estimator for a scene.
#[derive(Debug)]
pub(crate) enum Shown<'a> {
    Radiance(Direct<'a>),
    Visibility(Arrival<'a>),
    Occlusion(Occlusion),
}

impl Estimator for Shown<'_> {
    fn observe<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb {
        // Where nothing is known, the two are the same to the last bit.
        self.observe_known(scene, Foreseen::default(), ray, reach, sequence, observer)
    }

    fn looks_ahead(&self) -> bool {
        matches!(self, Self::Radiance(_))
    }

    #[inline(never)]
    fn observe_known<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        known: Foreseen<'_>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb {
        match self {
            Self::Radiance(e) => e.observe_known(scene, known, ray, reach, sequence, observer),
            Self::Visibility(e) => e.observe(scene, ray, reach, sequence, observer),
            Self::Occlusion(e) => e.observe(scene, ray, reach, sequence, observer),
        }
    }

    fn is_smooth<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        known: Known,
        hit: &Interaction,
        wo: Vec3,
    ) -> bool {
        matches!(self, Self::Radiance(e) if e.is_smooth(scene, known, hit, wo))
    }

    fn uses_sky<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        hit: &Interaction,
        wo: Vec3,
    ) -> bool {
        matches!(self, Self::Radiance(e) if e.uses_sky(scene, hit, wo))
    }
}
