//! Direct light: `L_o = L_e + ∫ f_r L_i V cos θ dω`.
//!
//! Two forms of the same integral are sampled. Over the lights' surfaces, a sample contributes
//! `f_r L_e V G / p_A` with `G = cos θ_i cos θ' / d²`; carried to solid angle by
//! `p_ω = p_A d² / cos θ'` that is `f_r L_e V cos θ_i / p_ω`, which also covers densities over
//! direction. Over the hemisphere, directions come from the BSDF and meet a light or do not.

use super::gather::Gather;
use super::known::Knowledge;
use super::shading::Shading;
use super::{Estimator, Foreseen, Heuristic, Known, Observer};
use crate::Rgb;
use crate::bsdf::Bsdf;
use crate::choose::LightChoice;
use crate::geom::Ray;
use crate::light::{Emitter, SurfaceDensity};
use crate::material::Material;
use crate::scene::{Interaction, NONE, Scene};
use crate::sequence::Sequence;
use crate::shape::Shape;
use glam::{Vec2, Vec3};

/// Which densities are combined.
///
/// A delta light is met by no ray, so it is sampled by light in each of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Technique {
    /// Directions toward the lights.
    Light,
    /// Directions from the BSDF.
    Bsdf,
    /// Both, weighted.
    Mis(Heuristic),
    /// What each shading point requires: by light where the BSDF is diffuse, or changes little within each
    /// light; both elsewhere.
    Auto(Heuristic),
    /// On diffuse points, the unshadowed answer in closed form less an estimate of its blocked part:
    /// no noise where nothing is in the way. A sample may be negative; the expectation is not.
    /// Elsewhere, and for lights without a closed form, as `Auto`.
    Control(Heuristic),
}

/// The direct-lighting estimator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Direct<'a> {
    /// Which densities are combined.
    pub technique: Technique,
    /// Light samples per camera sample, and per light when all lights are sampled.
    pub light_samples: u32,
    /// BSDF samples per camera sample.
    pub bsdf_samples: u32,
    /// How a light's surface is sampled.
    pub surface: SurfaceDensity,
    /// Which lights are sampled.
    pub choice: LightChoice<'a>,
}

impl Default for Direct<'_> {
    fn default() -> Self {
        Self {
            technique: Technique::Auto(Heuristic::Power),
            light_samples: 1,
            bsdf_samples: 1,
            surface: SurfaceDensity::Auto,
            choice: LightChoice::All,
        }
    }
}

impl Direct<'_> {
    /// What leaves a hit of a camera ray toward its origin: one sample.
    #[inline(always)]
    fn leaving<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        hit: &Interaction,
        wo: Vec3,
        known: impl Knowledge,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb {
        let emitted = scene.emitted(hit, wo);
        let Some(material) = scene.materials().get(hit.material as usize) else { return emitted };
        let bsdf = material.at(|| scene.uv(hit));
        observer.surface(hit, wo, || bsdf.albedo());
        if bsdf.is_black() {
            return emitted;
        }
        let shading = Shading::new(hit, &bsdf, wo, || scene.tangent(hit));
        emitted + Gather::new(self, scene, &shading, known).reflected(sequence, observer)
    }
}

impl Estimator for Direct<'_> {
    #[inline]
    fn observe<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb {
        match scene.closest_hit(ray, reach) {
            Some(hit) => self.leaving(scene, &hit, -ray.direction, (), sequence, observer),
            None => scene.radiance_escaping(ray.direction),
        }
    }

    fn looks_ahead(&self) -> bool {
        true
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
        match known.known().first_hit(scene, ray, reach) {
            Some(hit) => self.leaving(scene, &hit, -ray.direction, known, sequence, observer),
            None => scene.radiance_escaping(ray.direction),
        }
    }

    fn is_smooth<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        known: Known,
        hit: &Interaction,
        wo: Vec3,
    ) -> bool {
        let Some(material) = scene.materials().get(hit.material as usize) else { return false };
        if material.is_textured() || hit.light != NONE {
            return false;
        }
        let bsdf = material.at(|| Vec2::ZERO);
        let shading = Shading::new(hit, &bsdf, wo, || scene.tangent(hit));
        Gather::new(self, scene, &shading, Foreseen::from(known)).is_smooth()
    }

    fn uses_sky<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        hit: &Interaction,
        wo: Vec3,
    ) -> bool {
        let Some(material) = scene.materials().get(hit.material as usize) else { return false };
        let bsdf = material.at(|| scene.uv(hit));
        let shading = Shading::new(hit, &bsdf, wo, || scene.tangent(hit));
        Gather::new(self, scene, &shading, ()).may_take_closed_form()
    }
}
