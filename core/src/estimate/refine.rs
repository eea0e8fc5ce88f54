//! Refining a tile, step by step.

use super::adaptive::BLOCKS;
use super::lamps::each_lamp;
use super::{AdaptiveTile, Estimator, Job, Pixel, Target};
use crate::geom::Ray;
use crate::light::Emitter;
use crate::material::Material;
use crate::sequence::Sequence;
use crate::shape::Shape;

impl<S: Shape, L: Emitter, M: Material, E: Estimator, Q: Sequence + Clone> Job<'_, S, L, M, E, Q> {
    /// Refines a tile by a step: where it is worth most, the samples are doubled.
    ///
    /// * `pixels` – of the tile, row by row from its top; as many as the tile has
    /// * `go_on` – asked before each block; when it says no, the step ends early, and what the tile
    ///   becomes depends on when that was
    ///
    /// Returns how many samples were taken; none when the tile is good enough.
    pub fn refine<P: Pixel>(
        &self,
        tile: &mut AdaptiveTile,
        target: &Target,
        pixels: &mut [P],
        go_on: impl Fn() -> bool,
    ) -> u64 {
        let chosen = tile.next(target);
        if tile.fewest_samples() == 0 {
            self.begin(tile);
        }
        let mut taken = 0;
        for index in (0..BLOCKS).filter(|&i| chosen[i]) {
            if !go_on() {
                break;
            }
            let Some((part, samples, known)) = tile.block(index) else { continue };
            let end = samples.saturating_mul(2).clamp(1, target.most()).max(samples);
            let observe = |ray: &Ray, reach, sequence: &mut Q, pixel: &mut P| {
                self.estimator.observe_known(&self.scene, known, ray, reach, sequence, pixel)
            };
            let sums = self.render_part(tile.rect(), part, samples..end, pixels, observe);
            taken += tile.note_samples(index, end, &sums);
        }
        tile.look_for_hidden(pixels, &chosen);
        taken
    }

    /// Finds out what can be known before the first sample.
    fn begin(&self, tile: &mut AdaptiveTile) {
        each_lamp(self, tile.rect(), |lamp| tile.note_lamp(&lamp));
        for index in 0..BLOCKS {
            if let Some((part, ..)) = tile.block(index) {
                let (known, is_smooth) = self.look_ahead(part);
                tile.note_known(index, known, is_smooth);
            }
        }
    }
}
