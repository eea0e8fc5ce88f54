//! Indirect light: paths that go on from surface to surface.
//!
//! `L_o = L_e + ∫ f_r L_o' cos θ dω`, one sample of it: at each point of the path the light that comes
//! straight from the lights is estimated as [`Direct`] does, and a direction drawn from the BSDF leads
//! to the next point. Where the BSDF's directions are weighted against those toward the lights, the same
//! ray serves both.
//!
//! Source: Kajiya 1986, *The Rendering Equation*, section 4; next-event estimation and the weights of both
//! techniques as in Veach 1997, *Robust Monte Carlo Methods for Light Transport Simulation*, section 10.2.

use super::gather::{Drawn, Gather};
use super::shading::Shading;
use super::{Direct, Estimator, Observer, Technique};
use crate::Rgb;
use crate::bsdf::Bsdf;
use crate::geom::{Ray, offset_origin};
use crate::light::Emitter;
use crate::material::Material;
use crate::scene::{Interaction, NONE, Scene};
use crate::sequence::{Dimension, Sequence};
use crate::shape::Shape;
use glam::Vec3;

/// Highest probability with which roulette lets a path go on: also between white walls every path ends. The
/// weights of survivors of albedo ρ then have a finite variance where `ρ² < q`. Differs from Mitsuba 3,
/// whose 0.95 leaves a closed room of albedo above 0.975 an infinite one; this does above 0.9995.
const SURVIVAL: f32 = 1.0 - 1.0 / 1024.0;

/// Roulette begins at the latest after so many bounces.
const LATEST: u32 = 1024;

/// Most emitting surfaces that a camera ray passes, where they are hidden.
const MOST_HIDDEN: u32 = 64;

/// The estimator of direct and indirect light.
///
/// With a `max_depth` of 2 every sample is, to the last bit, that of [`Direct`] with one BSDF sample.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Path<'a> {
    /// How the light is estimated that comes straight from the lights, at each point of the path. What it
    /// says of samples is for the first point; the others have one of each kind, and no control variate.
    pub direct: Direct<'a>,
    /// Most segments between camera and light: 1 shows the lights themselves, 2 direct light, [`u32::MAX`]
    /// has no end.
    pub max_depth: u32,
    /// Segments after which Russian roulette decides whether a path goes on.
    pub rr_depth: u32,
    /// Camera rays pass through surfaces that emit, and an environment is black to them.
    pub hide_emitters: bool,
}

impl Default for Path<'_> {
    /// As Mitsuba 3 has it: no end, and roulette from the fifth segment.
    fn default() -> Self {
        Self { direct: Direct::default(), max_depth: u32::MAX, rr_depth: 5, hide_emitters: false }
    }
}

/// A path that has arrived somewhere.
struct Walk {
    at: Interaction,
    /// Unit direction to where it came from.
    wo: Vec3,
    /// What the way from the camera leaves of the light: products of `f_r cos θ / p`.
    throughput: Rgb,
}

impl Path<'_> {
    /// What the camera ray meets.
    #[inline]
    fn first<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
    ) -> Option<Interaction> {
        let mut hit = scene.closest_hit(ray, reach)?;
        for _ in 0..if self.hide_emitters { MOST_HIDDEN } else { 0 } {
            if hit.light == NONE {
                break;
            }
            let at = &hit.at;
            let behind = Ray::new(offset_origin(at.point, at.error, at.normal, ray.direction), ray.direction);
            let next = scene.closest_hit(&behind, reach - hit.distance)?;
            hit = Interaction { distance: hit.distance + next.distance, ..next };
        }
        Some(hit)
    }

    /// How the point after so many bounces is lit.
    #[inline]
    fn lit(&self, bounces: u32) -> Direct<'_> {
        let Direct { technique, light_samples, .. } = self.direct;
        match (bounces, technique) {
            (0, _) => Direct { bsdf_samples: 1, ..self.direct },
            (_, Technique::Control(h)) => {
                Direct { technique: Technique::Auto(h), light_samples: 1, bsdf_samples: 1, ..self.direct }
            }
            _ => Direct { light_samples: light_samples.min(1), bsdf_samples: 1, ..self.direct },
        }
    }

    /// Probability with which a path goes on that has taken so many bounces.
    ///
    /// * `throughput` – after the bounce
    ///
    /// As large as what is left of the light, so that what goes on carries all of it: the throughput of a
    /// path that roulette has let go on is never above that of the last bounce, or 1 and a thousandth.
    /// Source: Arvo, Kirk 1990, *Particle Transport and Image Synthesis*, section 3.
    #[inline]
    fn survival(&self, bounces: u32, throughput: Rgb) -> f32 {
        let left = throughput.max_component();
        if !(left > 0.0) {
            0.0
        } else if bounces >= self.rr_depth.min(LATEST) {
            left.min(SURVIVAL)
        } else {
            1.0
        }
    }

    /// The light that a point of the path sends back, as far as it comes straight from lights
    /// (W m⁻² sr⁻¹), and where the path goes on.
    #[inline]
    fn visit<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        walk: &Walk,
        sequence: &mut After<'_, impl Sequence>,
        observer: &mut impl Observer,
    ) -> (Rgb, Option<Walk>) {
        let Walk { at, wo, throughput } = walk;
        let bounces = sequence.bounces;
        let Some(material) = scene.materials().get(at.material as usize) else { return (Rgb::BLACK, None) };
        let bsdf = material.at(|| scene.uv(at));
        if bounces == 0 {
            observer.surface(at, *wo, || bsdf.albedo());
        }
        if bsdf.is_black() {
            return (Rgb::BLACK, None);
        }
        let shading = Shading::new(at, &bsdf, *wo, || scene.tangent(at));
        let direct = self.lit(bounces);
        let gather = Gather::new(&direct, scene, &shading, ());
        let light = gather.light_part(sequence, observer);
        let is_last = bounces + 2 >= self.max_depth;
        if is_last && !gather.draws_from_bsdf() {
            return (light, None);
        }
        let Some(drawn) = gather.draw(sequence, 0, 1) else { return (light, None) };
        let Drawn { wi, pdf, f_cos } = drawn;
        let throughput = *throughput * f_cos / pdf;
        let survival = self.survival(bounces + 1, throughput);
        if survival < 1.0 && !(sequence.choice(Dimension::Roulette, 0, 1) < survival) {
            return (light, None);
        }
        let hit = scene.closest_hit(&gather.ray(&drawn), f32::INFINITY);
        let met = if gather.draws_from_bsdf() { gather.met(&drawn, hit.as_ref()) } else { Rgb::BLACK };
        let onward = hit.filter(|_| !is_last);
        let onward = onward.map(|at| Walk { at, wo: -wi, throughput: throughput / survival });
        (light + f_cos * met / pdf / survival, onward)
    }
}

impl Estimator for Path<'_> {
    #[inline]
    fn observe<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb {
        let Some(at) = self.first(scene, ray, reach) else {
            return if self.hide_emitters { Rgb::BLACK } else { scene.radiance_escaping(ray.direction) };
        };
        let wo = -ray.direction;
        let mut sum = if self.hide_emitters { Rgb::BLACK } else { scene.emitted(&at, wo) };
        let mut walk = Walk { at, wo, throughput: Rgb::WHITE };
        for bounces in 0..self.max_depth.saturating_sub(1) {
            let mut sequence = After { sequence: &mut *sequence, bounces };
            let mut observer = AtFirst((bounces == 0).then_some(&mut *observer));
            let (light, onward) = self.visit(scene, &walk, &mut sequence, &mut observer);
            sum += walk.throughput * light;
            let Some(onward) = onward else { break };
            walk = onward;
        }
        sum
    }
}

/// The sequence for the decisions after so many bounces.
struct After<'q, Q> {
    sequence: &'q mut Q,
    bounces: u32,
}

impl<Q: Sequence> Sequence for After<'_, Q> {
    fn start(&mut self, pixel: u32, sample: u32) {
        self.sequence.start(pixel, sample);
    }

    #[inline]
    fn point(&mut self, dimension: Dimension, draw: u32, draws: u32) -> [f32; 2] {
        self.sequence.point(dimension.after(self.bounces), draw, draws)
    }

    #[inline]
    fn choice(&mut self, dimension: Dimension, draw: u32, draws: u32) -> f32 {
        self.sequence.choice(dimension.after(self.bounces), draw, draws)
    }
}

/// Looks on at the first point only.
struct AtFirst<'o, O>(Option<&'o mut O>);

impl<O: Observer> Observer for AtFirst<'_, O> {
    #[inline]
    fn surface(&mut self, at: &Interaction, toward: Vec3, albedo: impl FnOnce() -> Rgb) {
        if let Some(observer) = &mut self.0 {
            observer.surface(at, toward, albedo);
        }
    }

    #[inline]
    fn light(&mut self, arrives: bool, unblocked: impl FnOnce() -> f32) {
        if let Some(observer) = &mut self.0 {
            observer.light(arrives, unblocked);
        }
    }
}
