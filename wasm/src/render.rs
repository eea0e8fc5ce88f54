//! Parts of the picture, into memory of JavaScript's.

use crate::choices::{Choices, Estimator};
use halflight::build::{Description, SceneBuffers};
use halflight::estimate::{DifferenceSums, Job, PixelStats};
use halflight::film::PixelRect;
use halflight::{Camera, Film};
use std::ops::Range;

/// Words that a pixel takes, see [`PixelStats::to_words`].
pub(crate) const WORDS: usize = 8;

/// Adds samples to the pixels of a tile, which are kept as words.
pub(crate) fn render(
    (description, buffers): (&Description, &SceneBuffers),
    (camera, film): (Camera, Film),
    choices: &Choices,
    tile: PixelRect,
    samples: Range<u32>,
    words: &mut [u32],
) -> DifferenceSums {
    let bound = buffers.bind();
    let scene = bound.scene();
    let mut pixels: Vec<PixelStats> =
        words.as_chunks().0.iter().map(|w| PixelStats::from_words(*w)).collect();
    macro_rules! job {
        ($estimator:expr) => {
            Job { scene, camera, film, estimator: $estimator, sequence: choices.sequence() }.render(
                tile,
                samples,
                &mut pixels,
            )
        };
    }
    let sums = match choices.estimator(description, buffers, scene.lights().len()) {
        Estimator::Direct(direct) => job!(direct),
        Estimator::Arrival(arrival) => job!(arrival),
        Estimator::Occlusion(occlusion) => job!(occlusion),
    };
    for (words, pixel) in words.as_chunks_mut::<WORDS>().0.iter_mut().zip(&pixels) {
        *words = pixel.to_words();
    }
    sums
}
