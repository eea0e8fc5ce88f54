//! Refining a tile, step by step.

use super::adaptive::{BLOCKS, in_groups};
use super::lamps::each_lamp;
use super::sky::Above;
use super::{AdaptiveTile, Estimator, Job, Pixel, Target};
use crate::geom::Ray;
use crate::light::Emitter;
use crate::material::Material;
use crate::sequence::Sequence;
use crate::shape::Shape;

/// A step of a tile: the blocks whose samples are doubled, and how far that has come.
///
/// It can be taken in parts, at any times: what the tile becomes is the same.
#[derive(Debug, Clone)]
pub struct Step {
    chosen: [bool; BLOCKS],
    at: usize,
}

impl Step {
    /// The next step of a tile.
    #[must_use]
    pub fn next(tile: &AdaptiveTile, target: &Target) -> Self {
        Self { chosen: tile.next(target), at: 0 }
    }

    /// True when nothing is left to do: of a new step, that the tile is good enough.
    #[must_use]
    pub fn is_over(&self) -> bool {
        self.place().is_none()
    }

    /// The place of the next block, among all of them group by group.
    fn place(&self) -> Option<usize> {
        (self.at..BLOCKS).find(|&place| self.chosen[in_groups(place).0])
    }
}

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
        let mut step = Step::next(tile, target);
        let taken = self.take(&mut step, tile, target, pixels, go_on);
        if !step.is_over() {
            tile.look_for_hidden(pixels, &step.chosen);
        }
        taken
    }

    /// Takes a step of a tile, or a part of it.
    ///
    /// * `target` – that of the step
    /// * `pixels` – of the tile, row by row from its top; as many as the tile has
    /// * `go_on` – asked before each block; when it says no, the rest of the step is left for later
    ///
    /// Returns how many samples were taken.
    pub fn take<P: Pixel>(
        &self,
        step: &mut Step,
        tile: &mut AdaptiveTile,
        target: &Target,
        pixels: &mut [P],
        go_on: impl Fn() -> bool,
    ) -> u64 {
        if step.at == 0 && tile.fewest_samples() == 0 {
            self.begin(tile);
        }
        let (mut taken, mut above) = (0, Above::default());
        while let Some(place) = step.place().filter(|_| go_on()) {
            step.at = place + 1;
            let (index, group) = in_groups(place);
            let Some((part, samples, known)) = tile.block(index) else { continue };
            let end = samples.saturating_mul(2).clamp(1, target.most()).max(samples);
            let known = above.foreseen(self, tile, group, known);
            let observe = |ray: &Ray, reach, sequence: &mut Q, pixel: &mut P| {
                self.estimator.observe_known(&self.scene, known, ray, reach, sequence, pixel)
            };
            let sums = self.render_part(tile.rect(), part, samples..end, pixels, observe);
            taken += tile.note_samples(index, end, &sums);
        }
        if step.is_over() {
            tile.look_for_hidden(pixels, &step.chosen);
        }
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
