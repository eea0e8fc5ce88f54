//! Where the lamps of a scene are in its picture.
//!
//! A lamp that is smaller than a pixel is what samples miss most easily and what matters most: a
//! hundredth of a pixel that is ten thousand times brighter than the rest is all that is seen there.
//! But nothing is easier to find, since the scene knows its lamps: a ray to the middle of each tells
//! whether it is seen, and how bright.

use super::{Estimator, Job};
use crate::film::PixelRect;
use crate::light::Emitter;
use crate::material::Material;
use crate::sequence::Sequence;
use crate::shape::Shape;

/// With more lights than this none is looked for: a lamp of so many pieces is not small, and has
/// neighbours that tell of it.
const MOST: usize = 4096;

/// Tells of each lamp whose middle is seen in a part of the film: its pixel, and its radiance as average over
/// the channels (W m⁻² sr⁻¹).
pub(super) fn each_lamp<S: Shape, L: Emitter, M: Material, E: Estimator, Q: Sequence + Clone>(
    job: &Job<'_, S, L, M, E, Q>,
    part: PixelRect,
    mut tell: impl FnMut((u32, u32), f32),
) {
    let lights = job.scene.lights();
    let placed = lights.iter().take(if lights.len() > MOST { 0 } else { MOST }).filter_map(Emitter::bounds);
    for bounds in placed {
        let Some(place) = job.camera.place(bounds.centre) else { continue };
        let within =
            |&(x, y): &(u32, u32)| (part.x0..part.x1).contains(&x) && (part.y0..part.y1).contains(&y);
        let Some(pixel) = job.film.pixel(place).filter(within) else { continue };
        let (ray, reach) = job.camera.ray(place.0, place.1);
        if let Some(hit) = job.scene.closest_hit(&ray, reach) {
            tell(pixel, job.scene.emitted(&hit, -ray.direction).average());
        }
    }
}
