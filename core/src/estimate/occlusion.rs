//! Ambient occlusion: how much of the hemisphere is open, weighted by the cosine.

use super::{Estimator, Observer};
use crate::Rgb;
use crate::bsdf::Bsdf;
use crate::geom::{Frame, Ray};
use crate::light::Emitter;
use crate::material::Material;
use crate::scene::Scene;
use crate::sequence::{Dimension, Sequence};
use crate::shape::Shape;
use crate::warp;

/// The ambient-occlusion estimator: `1/π ∫ V cos θ dω`, sampled with `p = cos θ / π`, so that each
/// sample is plainly open or not. 1 where nothing is near, 0 in a closed corner; lights and
/// materials do not enter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Occlusion {
    /// What is farther than this does not occlude (m); may be infinite.
    pub reach: f32,
    /// Directions per camera sample.
    pub samples: u32,
}

impl Default for Occlusion {
    fn default() -> Self {
        Self { reach: f32::INFINITY, samples: 1 }
    }
}

impl Estimator for Occlusion {
    #[inline]
    fn observe<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb {
        let Some(hit) = scene.closest_hit(ray, reach) else { return Rgb::WHITE };
        let albedo = |m: &M| m.at(|| scene.uv(&hit)).albedo();
        let material = scene.materials().get(hit.material as usize);
        observer.surface(&hit, -ray.direction, || material.map_or(Rgb::BLACK, albedo));
        let front = hit.at.normal.dot(ray.direction) <= 0.0;
        let frame = Frame::from_normal(if front { hit.at.normal } else { -hit.at.normal });
        let draws = self.samples.max(1);
        let open = (0..draws)
            .filter(|&draw| {
                let u = sequence.point(Dimension::Occlusion, draw, draws);
                let wi = frame.to_world(warp::cosine_hemisphere(u));
                let open = scene.visible(&hit.at, wi, self.reach);
                observer.light(open, || 1.0);
                open
            })
            .count();
        Rgb::splat(open as f32 / draws as f32)
    }
}
