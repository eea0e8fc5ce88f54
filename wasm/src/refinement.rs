//! A part of the picture that gets its samples where its error is.

use crate::Scene;
use crate::render::{pixels_of, words_of};
use crate::scene::{Res, thrown};
use halflight::estimate::{AdaptiveTile, PixelStats, Step, TILE, Target};
use halflight::film::PixelRect;
use std::cell::Cell;
use wasm_bindgen::prelude::*;

/// Samples that no pixel exceeds: what `halflight render --error` allows.
const MOST_SAMPLES: u32 = 1 << 16;

#[wasm_bindgen]
extern "C" {
    #[wasm_bindgen(js_namespace = performance)]
    fn now() -> f64;
}

/// A tile that is refined until it is good enough: `halflight render --error`, tile by tile.
///
/// A step of it can be taken in pieces; what the tile becomes does not depend on how many.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Refinement {
    tile: Box<AdaptiveTile>,
    step: Option<(Step, Target)>,
    pixels: Vec<PixelStats>,
}

#[wasm_bindgen]
impl Refinement {
    /// Columns and rows of a tile; those at the right and below may be smaller. Other tiles than these,
    /// counted from the picture's top left, come to other samples than the command line's.
    #[must_use]
    pub fn side() -> u32 {
        TILE
    }

    /// A tile.
    ///
    /// * `state` – what [`Refinement::state`] returned, after any step and from any worker; empty at first
    /// * `pixels` – of the tile, as [`Scene::render`] has them
    ///
    /// # Errors
    /// When the state or the pixels are none of such a tile.
    #[wasm_bindgen(constructor)]
    pub fn new(
        x0: u32,
        y0: u32,
        x1: u32,
        y1: u32,
        state: &[u32],
        pixels: &[u32],
    ) -> Result<Refinement, JsError> {
        Self::restored(PixelRect { x0, y0, x1, y1 }, state, pixels).map_err(thrown)
    }

    /// All that is known beside the pixels. Without the rest of a step that is not over.
    #[must_use]
    pub fn state(&self) -> Vec<u32> {
        self.tile.to_words().to_vec()
    }

    /// The pixels.
    #[must_use]
    pub fn pixels(&self) -> Vec<u32> {
        let mut words = vec![0; self.pixels.len() * crate::render::WORDS];
        words_of(&self.pixels, &mut words);
        words
    }

    /// Estimated relMSE of the tile; `undefined` before the second sample. Its mean over all pixels is the
    /// picture's.
    #[must_use]
    pub fn relative_mse(&self) -> Option<f64> {
        self.tile.error().relative_mse()
    }

    /// True in the middle of a step.
    #[must_use]
    pub fn is_midway(&self) -> bool {
        self.step.is_some()
    }
}

impl Refinement {
    fn restored(rect: PixelRect, state: &[u32], pixels: &[u32]) -> Res<Self> {
        if rect.x1.saturating_sub(rect.x0) > TILE || rect.y1.saturating_sub(rect.y0) > TILE {
            return Err("a tile has at most 128 columns and rows".into());
        }
        let tile = match state {
            [] => Some(AdaptiveTile::new(rect)),
            words => words.try_into().ok().and_then(|words| AdaptiveTile::from_words(rect, words)),
        };
        let tile = Box::new(tile.ok_or("this is not the state of a tile")?);
        Ok(Self { tile, step: None, pixels: pixels_of(rect, pixels)? })
    }
}

#[wasm_bindgen]
impl Scene {
    /// Refines a tile by a step, or by a piece of one; returns how many samples that took: none, and no step
    /// begun, when the tile is good enough.
    ///
    /// * `error` – the relative error that is wanted, as a fraction; that of a step when it began
    /// * `milliseconds` – after which the rest of a step is left for the next call
    ///
    /// # Errors
    /// When the tile is not in the picture.
    pub fn refine(&self, tile: &mut Refinement, error: f64, milliseconds: f64) -> Result<f64, JsError> {
        let end = now() + milliseconds;
        let begun = Cell::new(false);
        // However little time there is, it gets on.
        let go_on = || !begun.replace(true) || now() < end;
        self.take_step(tile, error, go_on).map(|samples| samples as f64).map_err(thrown)
    }
}

impl Scene {
    fn take_step(&self, of: &mut Refinement, error: f64, go_on: impl Fn() -> bool) -> Res<u64> {
        let Refinement { tile, step, pixels } = of;
        let (next, target) = step.get_or_insert_with(|| {
            let target = Target::new(error, MOST_SAMPLES);
            (Step::next(tile, &target), target)
        });
        let taken = if next.is_over() {
            0
        } else {
            self.with_job(tile.rect(), |job| job.take(next, tile, target, pixels, go_on))?
        };
        if next.is_over() {
            *step = None;
        }
        Ok(taken)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The words of a tile of the scene at 1 %, each step in pieces of so many blocks.
    fn refined(blocks: u32) -> Vec<u32> {
        let mut scene = Scene::builtin("penumbra").unwrap();
        scene.resize(96, 64).unwrap();
        let rect = PixelRect { x0: 0, y0: 0, x1: 96, y1: 64 };
        let mut words = vec![0; rect.area() * crate::render::WORDS];
        let mut state = Vec::new();
        loop {
            let mut tile = Refinement::restored(rect, &state, &words).unwrap();
            let mut samples = 0;
            loop {
                let left = Cell::new(blocks);
                let go_on = || left.replace(left.get().saturating_sub(1)) > 0;
                samples += scene.take_step(&mut tile, 0.05, go_on).unwrap();
                if !tile.is_midway() {
                    break;
                }
            }
            (state, words) = (tile.state(), tile.pixels());
            if samples == 0 {
                assert!(tile.relative_mse().unwrap() <= 0.05 * 0.05);
                return words;
            }
        }
    }

    #[test]
    fn steps_in_pieces_come_to_the_same_bits() {
        let whole = refined(u32::MAX);
        assert!(whole == refined(97));
        let samples = || whole.chunks(crate::render::WORDS).map(|pixel| pixel[6]);
        assert!(samples().max() > samples().min(), "as many samples everywhere");
    }

    #[test]
    fn what_is_no_tile_is_refused() {
        let rect = |x1| PixelRect { x0: 0, y0: 0, x1, y1: 1 };
        assert!(Refinement::restored(rect(129), &[], &[0; 8 * 129]).is_err());
        assert!(Refinement::restored(rect(2), &[], &[0; 8]).is_err());
        assert!(Refinement::restored(rect(1), &[1, 2], &[0; 8]).is_err());
    }
}
