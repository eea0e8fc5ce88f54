//! Rendering a part of a picture.

use super::{DifferenceSums, Estimator, Pixel};
use crate::Rgb;
use crate::camera::Camera;
use crate::film::{Film, PixelRect};
use crate::geom::Ray;
use crate::light::Emitter;
use crate::material::Material;
use crate::scene::Scene;
use crate::sequence::{Dimension, Sequence};
use crate::shape::Shape;
use core::ops::Range;

/// Everything that a picture depends on, borrowed. What a pixel becomes depends on nothing else: not
/// on the tiles, their order, or the threads that render them.
#[derive(Debug)]
pub struct Job<'a, S, L, M, E, Q> {
    /// The scene.
    pub scene: Scene<'a, S, L, M>,
    /// What looks at it.
    pub camera: Camera,
    /// The raster.
    pub film: Film,
    /// What is estimated.
    pub estimator: E,
    /// Where the uniforms come from; cloned for each tile.
    pub sequence: Q,
}

impl<S: Shape, L: Emitter, M: Material, E: Estimator, Q: Sequence + Clone> Job<'_, S, L, M, E, Q> {
    /// Adds the given samples to each pixel of a tile.
    ///
    /// * `tile` – the part of the film
    /// * `samples` – which samples; each pixel must hold exactly those before them
    /// * `pixels` – of the tile, row by row from its top; as many as the tile has
    ///
    /// Returns what [`super::Convergence::record`] wants to know.
    pub fn render<P: Pixel>(&self, tile: PixelRect, samples: Range<u32>, pixels: &mut [P]) -> DifferenceSums {
        self.render_part(tile, tile, samples, pixels, |ray, reach, sequence, pixel| {
            self.estimator.observe(&self.scene, ray, reach, sequence, pixel)
        })
    }

    /// The same for a part of the tile.
    ///
    /// * `observe` – one sample along a ray within a reach
    #[inline]
    pub(super) fn render_part<P: Pixel>(
        &self,
        tile: PixelRect,
        part: PixelRect,
        samples: Range<u32>,
        pixels: &mut [P],
        observe: impl Fn(&Ray, f32, &mut Q, &mut P) -> Rgb,
    ) -> DifferenceSums {
        let mut sums = DifferenceSums::default();
        let mut sequence = self.sequence.clone();
        let columns = (part.x0 - tile.x0) as usize..(part.x1 - tile.x0) as usize;
        let rows = pixels.chunks_mut(tile.width() as usize).skip((part.y0 - tile.y0) as usize);
        for (y, row) in (part.y0..part.y1).zip(rows) {
            let Some(row) = row.get_mut(columns.clone()) else { break };
            for (x, pixel) in (part.x0..part.x1).zip(row) {
                let before = *pixel.stats();
                for sample in samples.clone() {
                    let (ray, reach) = self.ray(x, y, sample, &mut sequence);
                    let radiance = observe(&ray, reach, &mut sequence, pixel);
                    pixel.add(radiance);
                }
                let after = pixel.stats();
                if before.count() > 0 && after.count() > before.count() {
                    sums.add(before.mean(), after.mean(), before.count(), after.count());
                }
            }
        }
        sums
    }

    /// The ray of a sample of pixel (x, y), and how far it reaches (m).
    #[inline(always)]
    fn ray(&self, x: u32, y: u32, sample: u32, sequence: &mut Q) -> (Ray, f32) {
        // The pixel's number does not depend on the crop window.
        sequence.start(y.wrapping_mul(self.film.width()).wrapping_add(x), sample);
        let (px, py) = self.film.place(x, y, sequence.point(Dimension::Film, 0, 1));
        self.camera.ray(px, py)
    }
}

/// The passes that make up `samples` per pixel: 1, then as many again each time, the last cut short.
/// After any of them a picture can be shown, and its error estimated.
pub fn passes(samples: u32) -> impl Iterator<Item = Range<u32>> {
    let mut start = 0;
    core::iter::from_fn(move || {
        if start >= samples {
            return None;
        }
        let end = if start == 0 { 1 } else { start.saturating_mul(2).min(samples) };
        let pass = start..end;
        start = end;
        Some(pass)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn passes_double_and_end_where_they_should() {
        assert!(passes(0).eq([]));
        assert!(passes(1).eq(core::iter::once(0..1)));
        assert!(passes(8).eq([0..1, 1..2, 2..4, 4..8]));
        assert!(passes(11).eq([0..1, 1..2, 2..4, 4..8, 8..11]));
        assert_eq!(passes(u32::MAX).last().map(|p| p.end), Some(u32::MAX));
    }
}
