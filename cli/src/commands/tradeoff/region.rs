//! Which pixels see their lights in full, and which see one in part.

use halflight::film::Film;
use halflight::geom::Ray;
use halflight::light::{Density, Emitter, Receiver, SurfaceDensity};
use halflight::scene::{AnyScene, Interaction};
use halflight::sequence::{Dimension, Sequence, Sobol};
use halflight::{Camera, Rgb};
use rayon::prelude::*;

/// Camera rays that judge a pixel, for each light.
const RAYS: u32 = 32;

/// At most so many lights are looked at, spread evenly over the table of lights.
const LIGHTS: usize = 8;

/// A pixel of whose light more than this comes from lights that are seen in part is in a penumbra.
const PART: f64 = 0.01;

/// Parts of a picture that are reported apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Region {
    /// Each light is seen in full or not at all, and some are seen.
    Open,
    /// A light is seen in part.
    Penumbra,
    /// No light is seen, or no surface.
    Dark,
}

/// What a light sends to a pixel, and what of that arrives.
#[derive(Debug, Clone, Copy, Default)]
struct Tally {
    sent: f64,
    arrives: f64,
}

/// Judges every pixel of a whole film, row by row.
///
/// For each light [`RAYS`] camera rays look whether a point of it is seen from where they end, weighted
/// by the irradiance that the point stands for. The light is seen in part when some but not all of that
/// arrives. What a light sends from below the horizon of the surface counts for neither.
pub(super) fn regions(scene: &AnyScene<'_>, camera: &Camera, film: &Film) -> Vec<Region> {
    let pixels = film.width() * film.height();
    (0..pixels).into_par_iter().map(|pixel| region(scene, camera, film, pixel)).collect()
}

/// Judges one pixel.
fn region(scene: &AnyScene<'_>, camera: &Camera, film: &Film, pixel: u32) -> Region {
    let stride = scene.lights().len().div_ceil(LIGHTS).max(1);
    let mut sequence = Sobol::new(0);
    let (mut all, mut partly) = (Tally::default(), 0.0);
    for light in (0..scene.lights().len()).step_by(stride) {
        let mut tally = Tally::default();
        for sample in 0..RAYS {
            sequence.start(pixel, sample);
            let u = sequence.point(Dimension::Film, 0, 1);
            let (px, py) = film.place(pixel % film.width(), pixel / film.width(), u);
            let (ray, reach) = camera.ray(px, py);
            tally.take(light_at(scene, &ray, reach, light, &mut sequence));
        }
        // Sums of the same terms in the same order are equal to the last bit.
        let in_part = tally.arrives > 0.0 && tally.arrives < tally.sent;
        partly += if in_part { tally.sent } else { 0.0 };
        all = Tally { sent: all.sent + tally.sent, arrives: all.arrives + tally.arrives };
    }
    if all.arrives <= 0.0 {
        Region::Dark
    } else if partly > PART * all.sent {
        Region::Penumbra
    } else {
        Region::Open
    }
}

impl Tally {
    fn take(&mut self, (weight, arrives): (f64, bool)) {
        self.sent += weight;
        self.arrives += if arrives { weight } else { 0.0 };
    }
}

/// What a point of a light would send to where the ray ends, and whether that arrives.
fn light_at(scene: &AnyScene<'_>, ray: &Ray, reach: f32, light: usize, sequence: &mut Sobol) -> (f64, bool) {
    let nothing = (0.0, false);
    let Some(hit) = scene.closest_hit(ray, reach) else { return nothing };
    let from = receiver(&hit, ray);
    let u = sequence.point(Dimension::Light(0), 0, 1);
    let Some(sample) = scene.lights()[light].sample(&from, SurfaceDensity::Auto, u) else { return nothing };
    let per_density = match sample.density {
        Density::SolidAngle(pdf) => 1.0 / pdf,
        Density::Delta => 1.0,
    };
    let cos = from.normal.dot(sample.wi).max(0.0);
    let weight = f64::from(brightness(sample.incident) * cos * per_density);
    (weight, scene.light_visible(&hit.at, sample.wi, sample.distance, light))
}

/// The surface on the side that is looked at.
fn receiver(hit: &Interaction, ray: &Ray) -> Receiver {
    let front = hit.at.normal.dot(ray.direction) <= 0.0;
    Receiver { point: hit.at.point, normal: if front { hit.at.normal } else { -hit.at.normal } }
}

/// Average over the channels.
fn brightness(colour: Rgb) -> f32 {
    (colour.r + colour.g + colour.b) / 3.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use halflight::build::SceneBuffers;
    use halflight::load::builtin::builtin;

    #[test]
    fn a_lit_room_has_all_regions() {
        let description = builtin("cornell").unwrap();
        let buffers = SceneBuffers::new(&description).unwrap();
        let film = Film::new(48, 48, description.filter).unwrap();
        let camera = description.camera.camera(48, 48).unwrap();
        let regions = regions(&buffers.bind().scene(), &camera, &film);
        for region in [Region::Open, Region::Penumbra, Region::Dark] {
            let part = regions.iter().filter(|r| **r == region).count() as f64 / regions.len() as f64;
            assert!(part > 0.02, "{region:?}: {part}");
        }
    }
}
