//! Direct light: `L_o = L_e + ∫ f_r L_i V cos θ dω`.
//!
//! Two forms of the same integral are sampled. Over the lights' surfaces, a sample contributes
//! `f_r L_e V G / p_A` with `G = cos θ_i cos θ' / d²`; carried to solid angle by
//! `p_ω = p_A d² / cos θ'` that is `f_r L_e V cos θ_i / p_ω`, which also covers densities over
//! direction. Over the hemisphere, directions come from the BSDF and meet a light or do not.

use super::shading::Shading;
use super::{Estimator, Heuristic};
use crate::Rgb;
use crate::bsdf::Bsdf;
use crate::choose::LightChoice;
use crate::geom::{Ray, offset_origin};
use crate::light::{Density, Emitter, SurfaceDensity};
use crate::material::Material;
use crate::scene::Scene;
use crate::sequence::{Dimension, Sequence};
use crate::shape::Shape;
use glam::Vec3;

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
    /// What each shading point requires: by light where the BSDF is diffuse, both elsewhere.
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

/// What a technique comes down to at one shading point.
#[derive(Clone, Copy)]
struct Plan {
    light: u32,
    bsdf: u32,
    heuristic: Heuristic,
    control: bool,
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
    /// Light that the surface point reflects toward the viewer (W m⁻² sr⁻¹): one sample.
    #[inline]
    fn reflected<S: Shape, L: Emitter, M: Material>(
        &self,
        scene: &Scene<'_, S, L, M>,
        shading: &Shading<'_, M::Bsdf>,
        sequence: &mut impl Sequence,
    ) -> Rgb {
        let plan = self.plan(scene, shading.bsdf());
        let mut sum = if plan.control { unshadowed(scene, shading) } else { Rgb::BLACK };
        if plan.light > 0 || scene.has_delta_light() {
            sum += self.over_lights(scene, shading, plan, sequence);
        }
        if plan.bsdf > 0 {
            sum += self.over_hemisphere(scene, shading, plan, sequence);
        }
        sum
    }

    /// How many samples of each kind this point gets.
    #[inline]
    fn plan<S: Shape, L: Emitter, M: Material>(&self, scene: &Scene<'_, S, L, M>, bsdf: &M::Bsdf) -> Plan {
        let diffuse = bsdf.is_diffuse();
        let (light, bsdf_samples, heuristic) = match self.technique {
            Technique::Light => (self.light_samples, 0, Heuristic::Power),
            Technique::Bsdf => (0, self.bsdf_samples, Heuristic::Power),
            Technique::Mis(h) => (self.light_samples, self.bsdf_samples, h),
            Technique::Auto(h) | Technique::Control(h) if diffuse => (self.light_samples.max(1), 0, h),
            Technique::Auto(h) | Technique::Control(h) => (self.light_samples, self.bsdf_samples, h),
        };
        // Where no ray can meet a light, none is sent.
        let bsdf = if scene.has_light_to_meet() { bsdf_samples } else { 0 };
        let control = diffuse && matches!(self.technique, Technique::Control(_));
        Plan { light, bsdf, heuristic, control }
    }

    /// The light-sampling part: over every light, or over a chosen one for each sample.
    #[inline]
    fn over_lights<S: Shape, L: Emitter, M: Material>(
        &self,
        scene: &Scene<'_, S, L, M>,
        shading: &Shading<'_, M::Bsdf>,
        plan: Plan,
        sequence: &mut impl Sequence,
    ) -> Rgb {
        let lights = scene.lights().len();
        let draws = plan.light.max(1);
        let mut sum = Rgb::BLACK;
        let chooses = self.choice != LightChoice::All;
        for light in self.choice.not_chosen(lights) {
            // The best dimension is for the chosen light, where one is chosen.
            let dimension = Dimension::Light(light as u32 + u32::from(chooses));
            for draw in 0..draws {
                let u = sequence.point(dimension, draw, draws);
                sum += self.toward(scene, shading, plan, light, 1.0, u);
            }
        }
        if chooses {
            for draw in 0..draws {
                let u = sequence.choice(Dimension::Light(0), draw, draws);
                let more = || sequence.choice(Dimension::Choice, draw, draws);
                if let Some((light, pmf)) = self.choice.choose(&shading.receiver, lights, u, more) {
                    let u = sequence.point(Dimension::Light(0), draw, draws);
                    sum += self.toward(scene, shading, plan, light, pmf, u);
                }
            }
        }
        sum / draws as f32
    }

    /// One sample of one light, chosen with probability `pmf`.
    #[inline]
    fn toward<S: Shape, L: Emitter, M: Material>(
        &self,
        scene: &Scene<'_, S, L, M>,
        shading: &Shading<'_, M::Bsdf>,
        plan: Plan,
        light: usize,
        pmf: f32,
        u: [f32; 2],
    ) -> Rgb {
        let (index, light) = (light, &scene.lights()[light]);
        if plan.light == 0 && !light.is_delta() {
            return Rgb::BLACK;
        }
        let Some(sample) = light.sample(&shading.receiver, self.surface, u) else { return Rgb::BLACK };
        if sample.incident.is_black() {
            return Rgb::BLACK;
        }
        let Some(reflected) = shading.reflect(sample.wi) else { return Rgb::BLACK };
        let weight = match sample.density {
            Density::Delta => 1.0 / pmf,
            Density::SolidAngle(pdf) if plan.bsdf == 0 => 1.0 / (pdf * pmf),
            Density::SolidAngle(pdf) => {
                let this = plan.light as f32 * pdf * pmf;
                let other = plan.bsdf as f32 * shading.pdf_solid_angle(&reflected);
                plan.heuristic.weight(this, other) / (pdf * pmf)
            }
        };
        let arrives = shading.is_outside(sample.wi)
            && scene.light_visible(&shading.at.at, sample.wi, sample.distance, index);
        let answered = plan.control && light.unshadowed_irradiance(&shading.receiver).is_some();
        match (arrives, answered) {
            (true, false) => reflected.f_cos * sample.incident * weight,
            (false, true) => reflected.f_cos * sample.incident * -weight,
            _ => Rgb::BLACK,
        }
    }

    /// The BSDF-sampling part: directions over the hemisphere, and the light that they meet.
    #[inline]
    fn over_hemisphere<S: Shape, L: Emitter, M: Material>(
        &self,
        scene: &Scene<'_, S, L, M>,
        shading: &Shading<'_, M::Bsdf>,
        plan: Plan,
        sequence: &mut impl Sequence,
    ) -> Rgb {
        let mut sum = Rgb::BLACK;
        for draw in 0..plan.bsdf {
            let u = sequence.point(Dimension::Bsdf, draw, plan.bsdf);
            let lobe = sequence.choice(Dimension::Bsdf, draw, plan.bsdf);
            let Some((wi, pdf)) = shading.sample(u, lobe) else { continue };
            let Some(reflected) = shading.reflect(wi).filter(|_| shading.is_outside(wi)) else { continue };
            sum += reflected.f_cos * self.met(scene, shading, plan, wi, pdf) / pdf;
        }
        sum / plan.bsdf as f32
    }

    /// The radiance that arrives along `wi`, drawn by the BSDF with density `pdf`, weighted against
    /// the light samples that draw it too.
    #[inline]
    fn met<S: Shape, L: Emitter, M: Material>(
        &self,
        scene: &Scene<'_, S, L, M>,
        shading: &Shading<'_, M::Bsdf>,
        plan: Plan,
        wi: Vec3,
        pdf: f32,
    ) -> Rgb {
        let (from, lights) = (&shading.receiver, scene.lights().len());
        let weighted = |incident: Rgb, index: usize, pdf_light: f32| {
            let other = plan.light as f32 * pdf_light * self.choice.pmf(from, lights, index);
            incident * plan.heuristic.weight(plan.bsdf as f32 * pdf, other)
        };
        let at = &shading.at.at;
        let ray = Ray::new(offset_origin(at.point, at.error, at.normal, wi), wi);
        match scene.closest_hit(&ray, f32::INFINITY) {
            Some(hit) => scene.lights().get(hit.light as usize).map_or(Rgb::BLACK, |light| {
                let incident = light.radiance(&hit.at, -wi);
                if plan.light == 0 || incident.is_black() {
                    return incident;
                }
                let pdf_light = light.pdf_solid_angle(from, self.surface, wi, &hit.at);
                weighted(incident, hit.light as usize, pdf_light)
            }),
            None if plan.light == 0 => scene.radiance_escaping(wi),
            None => scene.environments().fold(Rgb::BLACK, |sum, (index, light)| {
                sum + weighted(light.radiance_escaping(wi), index, light.pdf_escaping(from, wi))
            }),
        }
    }
}

/// What a diffuse point reflects when nothing is in the way: `f_r Σ E`, of the lights that have a
/// closed form.
#[inline]
fn unshadowed<S: Shape, L: Emitter, M: Material>(
    scene: &Scene<'_, S, L, M>,
    shading: &Shading<'_, M::Bsdf>,
) -> Rgb {
    let irradiance =
        |sum: Rgb, light: &L| sum + light.unshadowed_irradiance(&shading.receiver).unwrap_or(Rgb::BLACK);
    shading.diffuse() * scene.lights().iter().fold(Rgb::BLACK, irradiance)
}

impl Estimator for Direct<'_> {
    #[inline]
    fn sample<S: Shape, L: Emitter, M: Material>(
        &self,
        scene: &Scene<'_, S, L, M>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
    ) -> Rgb {
        let Some(hit) = scene.closest_hit(ray, reach) else {
            return scene.radiance_escaping(ray.direction);
        };
        let wo = -ray.direction;
        let emitted = scene.emitted(&hit, wo);
        let Some(material) = scene.materials().get(hit.material as usize) else { return emitted };
        let bsdf = material.at(|| scene.uv(&hit));
        if bsdf.is_black() {
            return emitted;
        }
        let shading = Shading::new(&hit, bsdf, wo, || scene.tangent(&hit));
        emitted + self.reflected(scene, &shading, sequence)
    }
}
