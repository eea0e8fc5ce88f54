//! Estimators: what a camera ray brings back, and how well that is known.

mod adaptive;
mod arrival;
mod by_light;
mod convergence;
mod direct;
mod gather;
mod heuristic;
mod hidden;
mod job;
mod known;
mod lamps;
mod layers;
mod observer;
mod occlusion;
mod path;
mod probe;
mod refine;
mod shading;
mod sky;
mod stats;
mod target;

pub use adaptive::{AdaptiveTile, TILE};
pub use arrival::{Arrival, LightRay};
pub use by_light::{ByArea, ByLight, ByProjected, BySolidAngle, StaticDensity};
pub use convergence::{Convergence, DifferenceSums, ErrorEstimate};
pub use direct::{Direct, Technique};
pub use heuristic::Heuristic;
pub use job::{Job, passes};
pub use known::{Foreseen, Known, Met};
pub use layers::LayeredPixel;
pub use observer::Observer;
pub use occlusion::Occlusion;
pub use path::Path;
pub use probe::{Irradiance, Probe};
pub use refine::Step;
pub use stats::{Pixel, PixelStats};
pub use target::Target;

use crate::Rgb;
use crate::geom::Ray;
use crate::light::Emitter;
use crate::material::Material;
use crate::scene::{Interaction, Scene};
use crate::sequence::Sequence;
use crate::shape::Shape;
use glam::Vec3;

/// Something that can be estimated along a camera ray.
pub trait Estimator {
    /// One sample of what arrives along `ray` from within `reach` (m).
    ///
    /// `sequence` has been turned to the sample; the camera has used its [`crate::sequence::Dimension::Film`].
    #[inline]
    fn sample<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
    ) -> Rgb {
        self.observe(scene, ray, reach, sequence, &mut ())
    }

    /// The same sample, while `observer` looks on.
    fn observe<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb;

    /// True when it is worth finding out what is known of a part of a picture, for
    /// [`Estimator::observe_known`].
    fn looks_ahead(&self) -> bool {
        false
    }

    /// One sample, with the same expectation, where something is known of all of them.
    ///
    /// * `known` – of the part of the picture that the ray is in
    fn observe_known<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        known: Foreseen<'_>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb {
        let _ = known;
        self.observe(scene, ray, reach, sequence, observer)
    }

    /// True when [`Estimator::observe_known`] is a smooth function of the place in the picture, and of
    /// nothing else: so that a few samples will do.
    ///
    /// * `hit` – one of the points that are seen, toward the unit direction `wo`
    fn is_smooth<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        known: Known,
        hit: &Interaction,
        wo: Vec3,
    ) -> bool {
        let _ = (scene, known, hit, wo);
        false
    }

    /// True when [`Estimator::observe_known`] makes use of what is known of the sky above a surface.
    ///
    /// * `hit` – one of the points that are seen, toward the unit direction `wo`
    fn uses_sky<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        hit: &Interaction,
        wo: Vec3,
    ) -> bool {
        let _ = (scene, hit, wo);
        false
    }
}

/// Any of the estimators, chosen at run time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AnyEstimator<'a> {
    /// Direct light.
    Direct(Direct<'a>),
    /// Ambient occlusion.
    Occlusion(Occlusion),
    /// Direct and indirect light.
    Path(Path<'a>),
}

impl Estimator for AnyEstimator<'_> {
    #[inline]
    fn observe<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb {
        match self {
            Self::Direct(e) => e.observe(scene, ray, reach, sequence, observer),
            Self::Occlusion(e) => e.observe(scene, ray, reach, sequence, observer),
            Self::Path(e) => e.observe(scene, ray, reach, sequence, observer),
        }
    }

    fn looks_ahead(&self) -> bool {
        matches!(self, Self::Direct(_))
    }

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
            Self::Direct(e) => e.observe_known(scene, known, ray, reach, sequence, observer),
            other => other.observe(scene, ray, reach, sequence, observer),
        }
    }

    fn is_smooth<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        known: Known,
        hit: &Interaction,
        wo: Vec3,
    ) -> bool {
        matches!(self, Self::Direct(e) if e.is_smooth(scene, known, hit, wo))
    }

    fn uses_sky<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        hit: &Interaction,
        wo: Vec3,
    ) -> bool {
        matches!(self, Self::Direct(e) if e.uses_sky(scene, hit, wo))
    }
}
