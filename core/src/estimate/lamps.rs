//! Where the lamps of a scene are in its picture.
//!
//! A lamp that is smaller than a pixel is what samples miss most easily and what matters most: a
//! hundredth of a pixel that is ten thousand times brighter than the rest is all that is seen there.
//! But nothing is easier to find, since the scene knows its lamps: a ray to the middle of each tells
//! whether it is seen, and how bright. The edges of a flat one are followed pixel by pixel: where one of
//! them only cuts a corner off, a thousandth of a pixel may be most of its light, and no neighbour tells.

use super::{Estimator, Job};
use crate::film::{Film, PixelRect};
use crate::light::Emitter;
use crate::material::Material;
use crate::num;
use crate::sequence::Sequence;
use crate::shape::Shape;

/// With more lights than this none is looked for: a lamp of so many pieces is not small, and has
/// neighbours that tell of it.
const MOST: usize = 4096;

/// How far within its edges an outline is looked for, as a part of the way to its middle.
const INSET: f32 = 1e-5;

/// Most pixels that are looked at along one edge.
const MOST_PLACES: u32 = 1 << 15;

/// A lamp that is seen in a pixel.
pub(super) struct Sighting {
    /// Column and row in the film.
    pub(super) pixel: (u32, u32),
    /// What it sends (W m⁻² sr⁻¹), as average over the channels.
    pub(super) radiance: f32,
    /// True where it is an edge that was seen: something of the lamp is in this very pixel, however little.
    pub(super) is_edge: bool,
}

/// Tells of each lamp whose middle or whose straight edges are seen in a part of the film.
pub(super) fn each_lamp<S: Shape, L: Emitter, M: Material, E: Estimator, Q: Sequence + Clone>(
    job: &Job<'_, S, L, M, E, Q>,
    part: PixelRect,
    mut tell: impl FnMut(Sighting),
) {
    let lights = job.scene.lights();
    let few = lights.iter().take(if lights.len() > MOST { 0 } else { MOST });
    for (light, bounds) in few.filter_map(|light| Some((light, light.bounds()?))) {
        let mut look = |place: (f32, f32), is_edge: bool| {
            let inside =
                |&(x, y): &(u32, u32)| (part.x0..part.x1).contains(&x) && (part.y0..part.y1).contains(&y);
            let Some(pixel) = job.film.pixel(place).filter(inside) else { return };
            let (ray, reach) = job.camera.ray(place.0, place.1);
            let Some(hit) = job.scene.closest_hit(&ray, reach) else { return };
            let radiance = job.scene.emitted(&hit, -ray.direction).average();
            if radiance > 0.0 {
                tell(Sighting { pixel, radiance, is_edge });
            }
        };
        if let Some(place) = job.camera.place(bounds.centre) {
            look(place, false);
        }
        let corners = light.outline().map(|c| c.map(|p| p + (bounds.centre - p) * INSET));
        for edge in corners.iter().flat_map(|c| (0..4).map(|k| [c[k], c[(k + 1) % 4]])) {
            along(edge.map(|p| job.camera.place(p)), &job.film, |place| look(place, true));
        }
    }
}

/// Hands over a place of an edge in each pixel that it crosses, however short the way; none where an end is
/// not in front.
///
/// * `ends` – in the picture, as [`crate::Camera::place`] has them
fn along(ends: [Option<(f32, f32)>; 2], film: &Film, mut take: impl FnMut((f32, f32))) {
    let [Some(from), Some(to)] = ends else { return };
    let step = (to.0 - from.0, to.1 - from.1);
    let size = (0.5 * film.width() as f32, 0.5 * film.height() as f32);
    // Share of the way to the next border between pixels, for either axis.
    let to_border = |share: f32, from: f32, step: f32, size: f32| {
        let (start, speed) = ((from + 1.0) * size, step * size);
        let here = start + speed * share;
        // The border at or below; far outside of any film it matters no more.
        let below = here as i32 as f32 - if here < 0.0 { 1.0 } else { 0.0 };
        let border = if speed > 0.0 { below + 1.0 } else { below - f32::from(u8::from(below == here)) };
        if speed == 0.0 { 1.0 } else { (border - start) / speed }
    };
    let mut share = 0.0;
    for _ in 0..MOST_PLACES {
        let next = to_border(share, from.0, step.0, size.0).min(to_border(share, from.1, step.1, size.1));
        // A border that rounding does not get across is left behind.
        let next = num::clamp(next, share + 1e-6, 1.0);
        let middle = 0.5 * (share + next);
        take((from.0 + step.0 * middle, from.1 + step.1 * middle));
        share = next;
        if share >= 1.0 {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Filter;
    use std::vec::Vec;

    #[test]
    fn an_edge_is_seen_in_every_pixel_that_it_crosses() {
        let film = Film::new(96, 72, Filter::PIXEL).unwrap();
        let ends = [[(-0.9, -0.8), (0.7, 0.95)], [(0.3, 0.9), (0.31, -0.9)], [(0.503, 0.1), (-0.497, 0.1)]];
        for [from, to] in ends {
            let mut seen = Vec::new();
            along([Some(from), Some(to)], &film, |place| seen.extend(film.pixel(place)));
            for step in 0..100_000 {
                let share = step as f32 / 1e5;
                let pixel = film.pixel((from.0 + (to.0 - from.0) * share, from.1 + (to.1 - from.1) * share));
                assert!(pixel.is_none_or(|p| seen.contains(&p)), "{from:?} {to:?} {pixel:?}");
            }
            assert!(seen.len() <= 96 + 72 + 4, "{}", seen.len());
        }
        let mut places = 0;
        along([Some((0.0, 0.0)), None], &film, |_| places += 1);
        assert_eq!(places, 0);
        along([Some((0.2, 0.2)), Some((0.2, 0.2))], &film, |_| places += 1);
        assert_eq!(places, 1);
    }

    #[test]
    fn the_last_border_may_be_as_near_to_the_end_as_rounding_allows() {
        let film = Film::new(7, 5, Filter::PIXEL).unwrap();
        let unit = |i: u32, k: u32| 2.0 * num::unit_f32(num::hash2(i, k)) - 1.0;
        for i in 0..200_000 {
            // Ends at a border between pixels, or a little beside it.
            let column = (unit(i, 0) * 3.5 + 3.5) as u32 as f32;
            let end = (column / 3.5 - 1.0) * (1.0 + unit(i, 1) * 1e-6);
            let mut places = 0;
            along([Some((unit(i, 2), unit(i, 3))), Some((end, unit(i, 4)))], &film, |(x, y)| {
                assert!(x.is_finite() && y.is_finite());
                places += 1;
            });
            assert!((1..=7 + 5 + 4).contains(&places), "{i}: {places}");
        }
    }
}
