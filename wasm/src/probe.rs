//! One point of the scene, explained by its light samples.

use crate::choices::Choices;
use halflight::build::SceneBuffers;
use halflight::estimate::PixelStats;
use halflight::geom::Ray;
use halflight::light::{AnyLight, Density, Emitter};
use halflight::scene::{AnyScene, Interaction};
use halflight::sequence::Sequence;
use halflight::{Camera, Film, Rgb};
use wasm_bindgen::prelude::*;

/// Most rays that a probe hands out: more are not told apart in a picture.
const MOST_RAYS: usize = 512;

/// Numbers for each ray of [`Probe::rays`].
const RAY: usize = 8;

/// What a light does at a probed point.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug, Clone, PartialEq)]
pub struct ProbedLight {
    /// Its index in the scene's table of lights.
    #[wasm_bindgen(readonly)]
    pub light: u32,
    /// Its kind.
    #[wasm_bindgen(readonly)]
    pub kind: String,
    /// Luminance of the irradiance that arrives from it (W m⁻²).
    #[wasm_bindgen(readonly)]
    pub arriving: f64,
    /// The same if nothing were in the way.
    #[wasm_bindgen(readonly)]
    pub unshadowed: f64,
    /// The closed form of the latter; `undefined` where there is none.
    #[wasm_bindgen(readonly)]
    pub closed_form: Option<f64>,
    /// Mean density of its samples (sr⁻¹); `undefined` of a delta light.
    #[wasm_bindgen(readonly)]
    pub density: Option<f64>,
}

/// What is known of one point.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug, Clone, PartialEq)]
pub struct Probe {
    /// The point (m).
    #[wasm_bindgen(readonly)]
    pub point: Vec<f32>,
    /// Unit normal on the side that is seen.
    #[wasm_bindgen(readonly)]
    pub normal: Vec<f32>,
    /// Distance from the camera (m).
    #[wasm_bindgen(readonly)]
    pub distance: f32,
    /// Samples that the numbers come from.
    #[wasm_bindgen(readonly)]
    pub samples: u32,
    /// Mean of the irradiance: red, green, blue (W m⁻²).
    #[wasm_bindgen(readonly)]
    pub irradiance: Vec<f32>,
    /// Luminance of the irradiance after 1, 2, 4 … samples (W m⁻²).
    #[wasm_bindgen(readonly)]
    pub means: Vec<f64>,
    /// Its standard error after as many; 0 after the first.
    #[wasm_bindgen(readonly)]
    pub errors: Vec<f64>,
    /// Luminance of the irradiance if nothing were in the way, by the same samples (W m⁻²).
    #[wasm_bindgen(readonly)]
    pub unshadowed: f64,
    /// The same in closed form; `undefined` when a light has none.
    #[wasm_bindgen(readonly)]
    pub closed_form: Option<f64>,
    /// Each ray as eight numbers: where it ends (m), 1 when it arrives or 0, the density (sr⁻¹, 0 of
    /// a delta light), the probability of the light, the luminance of its irradiance (W m⁻²), the light.
    #[wasm_bindgen(readonly)]
    pub rays: Vec<f32>,
    /// What each light does, the strongest first; none of more than there are rays.
    #[wasm_bindgen(readonly)]
    pub lights: Vec<ProbedLight>,
}

/// Sums for one light.
#[derive(Clone, Copy, Default)]
struct Share {
    arriving: f64,
    unshadowed: f64,
    density: f64,
    rays: u32,
    delta: bool,
}

/// Looks at the middle of pixel (x, y) with `samples` samples; `None` where the camera sees no surface.
pub(crate) fn probe(
    (scene, buffers): (&AnyScene<'_>, &SceneBuffers),
    (camera, film): (&Camera, &Film),
    choices: &Choices,
    (x, y): (u32, u32),
    samples: u32,
) -> Option<Probe> {
    let across = (x as f32 + 0.5) / film.width() as f32;
    let down = (y as f32 + 0.5) / film.height() as f32;
    let (ray, reach) = camera.ray(2.0 * across - 1.0, 1.0 - 2.0 * down);
    let hit = scene.closest_hit(&ray, reach)?;
    let pixel = y * film.width() + x;
    let mut known = Known::new(scene, &hit, &ray);
    let lights = scene.lights().len();
    let (arrival, mut sequence) = (choices.arrival(buffers, lights), choices.sequence(film.width()));
    for sample in 0..samples {
        sequence.start(pixel, sample);
        let mut sum = Rgb::BLACK;
        let draws = arrival.each_ray(scene, &hit, -ray.direction, &mut sequence, |ray| {
            known.take(&hit, &ray);
            sum += if ray.arrives { ray.irradiance } else { Rgb::BLACK };
        });
        known.finish_sample(sum / draws as f32);
    }
    Some(known.into_probe(scene, samples))
}

/// What has been gathered so far.
struct Known {
    probe: Probe,
    from: halflight::light::Receiver,
    stats: PixelStats,
    luminance: PixelStats,
    shares: Vec<Share>,
}

impl Known {
    fn new(scene: &AnyScene<'_>, hit: &Interaction, ray: &Ray) -> Self {
        let from = hit.receiver(-ray.direction);
        let probe = Probe {
            point: from.point.to_array().to_vec(),
            normal: from.normal.to_array().to_vec(),
            distance: hit.distance,
            samples: 0,
            irradiance: Vec::new(),
            means: Vec::new(),
            errors: Vec::new(),
            unshadowed: 0.0,
            closed_form: None,
            rays: Vec::new(),
            lights: Vec::new(),
        };
        let shares = vec![Share::default(); scene.lights().len()];
        Self { probe, from, stats: PixelStats::NEW, luminance: PixelStats::NEW, shares }
    }

    fn take(&mut self, hit: &Interaction, ray: &halflight::estimate::LightRay) {
        let luminance = ray.irradiance.luminance();
        let density = match ray.density {
            Density::SolidAngle(pdf) => pdf,
            Density::Delta => 0.0,
        };
        let share = &mut self.shares[ray.light];
        share.unshadowed += f64::from(luminance);
        share.arriving += if ray.arrives { f64::from(luminance) } else { 0.0 };
        share.density += f64::from(density);
        share.delta = ray.density == Density::Delta;
        share.rays += 1;
        if self.probe.rays.len() < RAY * MOST_RAYS {
            // A light without a place is drawn far away.
            let end = hit.at.point + ray.wi * ray.distance.min(1e4);
            let arrives = f32::from(u8::from(ray.arrives));
            self.probe.rays.extend(end.to_array());
            self.probe.rays.extend([arrives, density, ray.pmf, luminance, ray.light as f32]);
        }
    }

    fn finish_sample(&mut self, irradiance: Rgb) {
        self.stats.add(irradiance);
        self.luminance.add(Rgb::splat(irradiance.luminance()));
        let count = self.luminance.count();
        if count.is_power_of_two() {
            let variance = f64::from(self.luminance.variance().r) / f64::from(count);
            self.probe.means.push(f64::from(self.luminance.mean().r));
            self.probe.errors.push(variance.sqrt());
        }
    }

    fn into_probe(self, scene: &AnyScene<'_>, samples: u32) -> Probe {
        let Self { mut probe, from, stats, shares, .. } = self;
        let n = f64::from(samples.max(1));
        let closed =
            |light: &AnyLight<'_>| light.unshadowed_irradiance(&from).map(|e| f64::from(e.luminance()));
        let all: Option<Vec<f64>> = scene.lights().iter().map(closed).collect();
        probe.samples = samples;
        probe.irradiance = stats.mean().to_array().to_vec();
        probe.unshadowed = shares.iter().map(|s| s.unshadowed).sum::<f64>() / n;
        probe.closed_form = all.map(|e| e.iter().sum());
        let seen = shares.iter().enumerate().filter(|(_, share)| share.rays > 0);
        probe.lights = seen
            .map(|(index, share)| ProbedLight {
                light: index as u32,
                kind: scene.lights()[index].name().to_owned(),
                arriving: share.arriving / n,
                unshadowed: share.unshadowed / n,
                closed_form: closed(&scene.lights()[index]),
                density: (!share.delta).then(|| share.density / f64::from(share.rays)),
            })
            .collect();
        probe.lights.sort_by(|a, b| b.unshadowed.total_cmp(&a.unshadowed));
        probe.lights.truncate(MOST_RAYS);
        probe
    }
}
