//! Parts of the picture, into memory of JavaScript's.

use crate::Scene;
use crate::estimator::Shown;
use crate::scene::Res;
use halflight::estimate::{DifferenceSums, Job, PixelStats};
use halflight::film::PixelRect;
use halflight::light::AnyLight;
use halflight::material::AnyMaterial;
use halflight::sequence::AnySequence;
use halflight::shape::AnyShape;
use std::ops::Range;

/// Words that a pixel takes, see [`PixelStats::to_words`].
pub(crate) const WORDS: usize = 8;

/// Everything that a picture of the page depends on.
pub(crate) type PageJob<'a> = Job<'a, AnyShape, AnyLight<'a>, AnyMaterial<'a>, Shown<'a>, AnySequence>;

/// The pixels of a tile that were kept as words.
///
/// # Errors
/// When the tile has another number of pixels.
pub(crate) fn pixels_of(tile: PixelRect, words: &[u32]) -> Res<Vec<PixelStats>> {
    let (pixels, rest) = words.as_chunks::<WORDS>();
    if pixels.len() != tile.area() || !rest.is_empty() {
        return Err("a pixel takes eight words".into());
    }
    Ok(pixels.iter().map(|w| PixelStats::from_words(*w)).collect())
}

/// Keeps pixels as words.
pub(crate) fn words_of(pixels: &[PixelStats], words: &mut [u32]) {
    for (words, pixel) in words.as_chunks_mut::<WORDS>().0.iter_mut().zip(pixels) {
        *words = pixel.to_words();
    }
}

impl Scene {
    /// Has something done by a job for a tile.
    ///
    /// # Errors
    /// When the tile is not in the picture, or the camera cannot be.
    pub(crate) fn with_job<T>(&self, tile: PixelRect, run: impl FnOnce(&PageJob<'_>) -> T) -> Res<T> {
        let film = self.film()?.with_crop(tile)?;
        let camera = self.camera()?;
        let bound = self.buffers.bind();
        let scene = bound.scene();
        let estimator = self.choices.estimator(&self.description, &self.buffers, scene.lights().len());
        let sequence = self.choices.sequence(film.width());
        Ok(run(&Job { scene, camera, film, estimator, sequence }))
    }

    /// Adds samples to the pixels of a tile.
    pub(crate) fn add_samples(
        &self,
        tile: PixelRect,
        samples: Range<u32>,
        words: &mut [u32],
    ) -> Res<DifferenceSums> {
        let mut pixels = pixels_of(tile, words)?;
        let sums = self.with_job(tile, |job| job.render(tile, samples, &mut pixels))?;
        words_of(&pixels, words);
        Ok(sums)
    }
}
