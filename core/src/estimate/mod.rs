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
mod lamps;
mod layers;
mod observer;
mod occlusion;
mod path;
mod probe;
mod shading;
mod stats;
mod target;

pub use adaptive::{AdaptiveTile, TILE};
pub use arrival::{Arrival, LightRay};
pub use by_light::{ByArea, ByLight, ByProjected, BySolidAngle, StaticDensity};
pub use convergence::{Convergence, DifferenceSums, ErrorEstimate};
pub use direct::{Direct, Technique};
pub use heuristic::Heuristic;
pub use job::{Job, passes};
pub use layers::LayeredPixel;
pub use observer::Observer;
pub use occlusion::Occlusion;
pub use path::Path;
pub use probe::{Irradiance, Probe};
pub use stats::{Pixel, PixelStats};
pub use target::Target;

use crate::Rgb;
use crate::geom::Ray;
use crate::light::Emitter;
use crate::material::Material;
use crate::scene::Scene;
use crate::sequence::Sequence;
use crate::shape::Shape;

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
}
