//! Samples where the error is: one target error after another, as `render --time` takes them.

use super::choices::Candidate;
use super::ladder::Stage;
use crate::driver::samples;
use crate::goal::DEFAULT_CAP;
use crate::tiles::{Part, places};
use cpu_time::ThreadTime;
use halflight::estimate::{AdaptiveTile, PixelStats, TILE, Target};
use halflight::film::{Film, PixelRect};
use rayon::prelude::*;
use std::sync::atomic::Ordering;

/// The first target, which the fewest samples reach in most scenes (relative error, as a fraction).
const FIRST: f64 = 0.64;

/// Targets of a ladder, at most: the last is where `f32` does not tell better from worse.
pub(super) const MOST_TARGETS: u32 = 40;

/// A target of a ladder, counted from 0: each divides relMSE by two.
pub(super) fn target(index: u32) -> f64 {
    FIRST * 0.5_f64.powf(0.5 * f64::from(index))
}

/// Tiles that a film is refined in: as many threads can work on it.
pub(super) fn tiles(film: &Film) -> usize {
    places(film.crop(), TILE, Part::WHOLE).count()
}

/// A tile, its pixels row by row, and the CPU time that it took (s).
#[derive(Debug)]
struct Spot {
    tile: Box<AdaptiveTile>,
    pixels: Vec<PixelStats>,
    seconds: f64,
}

/// A picture that has been brought to a target.
#[derive(Debug)]
pub(super) struct Refined<'r> {
    /// Relative error (a fraction).
    pub(super) target: f64,
    crop: PixelRect,
    spots: &'r [Spot],
}

impl Refined<'_> {
    /// Samples per pixel so far, on average.
    pub(super) fn samples(&self) -> f64 {
        let of = |spot: &Spot| spot.pixels.iter().map(|p| f64::from(samples(p))).sum::<f64>();
        self.spots.iter().map(of).sum::<f64>() / self.crop.area() as f64
    }

    /// CPU time so far, of all threads (s).
    pub(super) fn seconds(&self) -> f64 {
        self.spots.iter().map(|spot| spot.seconds).sum()
    }

    /// The pixels, row by row.
    pub(super) fn pixels(&self) -> Vec<PixelStats> {
        let mut all = vec![PixelStats::NEW; self.crop.area()];
        let width = self.crop.width() as usize;
        for spot in self.spots {
            let rect = spot.tile.rect();
            for (row, y) in spot.pixels.chunks_exact(rect.width() as usize).zip(rect.y0..) {
                let start = (y - self.crop.y0) as usize * width + (rect.x0 - self.crop.x0) as usize;
                all[start..start + row.len()].copy_from_slice(row);
            }
        }
        all
    }
}

impl Stage<'_> {
    /// Brings a picture to one target after another; what one took counts for the next.
    ///
    /// * `after` – takes the picture after each, and says whether to go on; its own time is not counted
    pub(super) fn refine(
        &self,
        candidate: &Candidate,
        seed: u32,
        targets: impl Iterator<Item = u32>,
        mut after: impl FnMut(&Refined<'_>) -> bool,
    ) {
        let bound = self.field.buffers[candidate.tables].bind();
        let sequence = candidate.plan.sequence(seed, self.film.width(), DEFAULT_CAP);
        let job = self.job(candidate, &bound, sequence);
        let crop = self.film.crop();
        let spot = |(_, rect): (u32, PixelRect)| Spot {
            tile: Box::new(AdaptiveTile::new(rect)),
            pixels: vec![PixelStats::NEW; rect.area()],
            seconds: 0.0,
        };
        let mut spots: Vec<_> = places(crop, TILE, Part::WHOLE).map(spot).collect();
        let go_on = || !self.stop.load(Ordering::Relaxed);
        for relative_error in targets.map(target) {
            let goal = Target::new(relative_error, DEFAULT_CAP);
            spots.par_iter_mut().with_max_len(1).for_each(|Spot { tile, pixels, seconds }| {
                let start = ThreadTime::now();
                while job.refine(tile, &goal, pixels, go_on) > 0 {}
                *seconds += start.elapsed().as_secs_f64();
            });
            if !go_on() || !after(&Refined { target: relative_error, crop, spots: &spots }) {
                return;
            }
        }
    }
}
