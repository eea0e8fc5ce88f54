//! The render loop: rounds in order, the tiles of a round in parallel, results in tile order.
//!
//! What comes out does not depend on the number of threads: pixels depend on nothing but the job and
//! the goal, and sums are taken in the order of the tiles. Only a goal in time depends on the clock.

mod adaptive;
mod uniform;

use crate::failure::Failure;
use crate::keep::{Keeper, lock};
use crate::tiles::{State, Stored, Tile};
use halflight::estimate::{
    AdaptiveTile, DifferenceSums, ErrorEstimate, Estimator, Job, Pixel, PixelStats, TILE, Target,
};
use halflight::film::PixelRect;
use halflight::light::Emitter;
use halflight::material::Material;
use halflight::sequence::Sequence;
use halflight::shape::Shape;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

pub(crate) use adaptive::refined;
pub(crate) use uniform::passed;

/// What is wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Goal {
    /// So many samples of each pixel.
    Samples(u32),
    /// That relative error of the picture (a fraction), with at most so many samples of a pixel.
    Error { target: f64, most: u32, adaptive: bool },
    /// The best picture that there is at that time, with at most so many samples of a pixel.
    Time { deadline: Instant, most: u32, adaptive: bool },
}

/// What has happened since the last time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Event {
    /// The render goes on from a checkpoint.
    Resumed,
    /// That many samples were taken.
    Samples(u64),
    /// A round has ended, with so many samples per pixel on average, and this estimated relative error.
    Round {
        /// Mean over the pixels.
        samples: f64,
        /// As a fraction; `None` while unknown.
        error: Option<f64>,
    },
}

/// What renders a part of the picture.
pub(crate) trait Work<P>: Sync {
    /// Adds a range of samples to the pixels of a tile, row by row.
    fn render(&self, tile: PixelRect, samples: Range<u32>, pixels: &mut [P]) -> DifferenceSums;

    /// Refines a tile by a step; returns how many samples it took.
    fn refine(
        &self,
        tile: &mut AdaptiveTile,
        target: &Target,
        pixels: &mut [P],
        go_on: &dyn Fn() -> bool,
    ) -> u64;
}

impl<P, S, L, M, E, Q> Work<P> for Job<'_, S, L, M, E, Q>
where
    P: Pixel,
    S: Shape + Sync,
    L: Emitter + Sync,
    M: Material + Sync,
    E: Estimator + Sync,
    Q: Sequence + Clone + Sync,
{
    fn render(&self, tile: PixelRect, samples: Range<u32>, pixels: &mut [P]) -> DifferenceSums {
        self.render(tile, samples, pixels)
    }

    fn refine(
        &self,
        tile: &mut AdaptiveTile,
        target: &Target,
        pixels: &mut [P],
        go_on: &dyn Fn() -> bool,
    ) -> u64 {
        self.refine(tile, target, pixels, go_on)
    }
}

/// A picture, or a part of one, with what is known about it.
#[derive(Debug)]
pub(crate) struct Rendered<P> {
    tiles: Vec<(PixelRect, Vec<P>)>,
    crop: PixelRect,
    /// How good it is.
    pub(crate) error: ErrorEstimate,
    /// True when it was stopped by the user.
    pub(crate) interrupted: bool,
    /// Pixels that have all samples that they may have, and more error than their share.
    pub(crate) missed: u64,
}

/// What all loops share.
struct Loop<'l, W, F> {
    crop: PixelRect,
    stop: &'l AtomicBool,
    keeper: &'l Keeper,
    work: &'l W,
    on_progress: &'l F,
}

/// Renders the keeper's part of the window `crop`, on the current rayon pool.
///
/// * `stop` – when it becomes true, no further part is begun; but each pixel gets its first sample
/// * `on_progress` – called from any thread
///
/// # Errors
/// When the keeper cannot read what it has, or write what it is to keep.
pub(crate) fn render<P: Stored>(
    crop: PixelRect,
    goal: Goal,
    (stop, keeper): (&AtomicBool, &Keeper),
    work: &impl Work<P>,
    on_progress: &(impl Fn(Event) + Sync),
) -> Result<Rendered<P>, Failure> {
    let all = Loop { crop, stop, keeper, work, on_progress };
    match goal {
        Goal::Samples(_) => all.uniform(goal),
        Goal::Error { adaptive, .. } | Goal::Time { adaptive, .. } if !adaptive => all.uniform(goal),
        Goal::Error { target, most, .. } => all.refine_to(&Target::new(target, most)),
        Goal::Time { deadline, most, .. } => all.refine_until(deadline, most),
    }
}

/// Side of a tile in pixels: with many samples per pixel, smaller tiles, so that stopping at the next
/// one does not take long.
pub(crate) const fn side(goal: Goal) -> u32 {
    match goal {
        Goal::Error { adaptive: true, .. } | Goal::Time { adaptive: true, .. } => TILE,
        Goal::Samples(0..=1024) => 32,
        Goal::Samples(1025..=16_384) => 16,
        _ => 8,
    }
}

impl<W, F: Fn(Event) + Sync> Loop<'_, W, F> {
    /// True when the user wants an end.
    fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Tells of a round's end.
    fn round(&self, samples: u64, pixels: u64, error: &ErrorEstimate) {
        let samples = samples as f64 / pixels.max(1) as f64;
        (self.on_progress)(Event::Round { samples, error: error.relative_error() });
    }

    /// The tiles to begin with: those of the checkpoint, if there is one.
    fn begin<P: Stored, S: State>(&self, side: u32) -> Result<Vec<Mutex<Tile<P, S>>>, Failure> {
        let tiles = self.keeper.begin(self.crop, side)?;
        if self.keeper.resumes().is_some() {
            (self.on_progress)(Event::Resumed);
            (self.on_progress)(Event::Samples(taken(&tiles)));
        }
        Ok(tiles)
    }
}

/// Samples that tiles have had.
fn taken<P: Pixel, S>(tiles: &[Mutex<Tile<P, S>>]) -> u64 {
    let of = |tile: &Tile<P, S>| tile.pixels.iter().map(|p| u64::from(samples(p.stats()))).sum::<u64>();
    tiles.iter().map(|tile| of(&lock(tile))).sum()
}

/// Pixels in tiles.
fn area<P, S>(tiles: &[Mutex<Tile<P, S>>]) -> u64 {
    tiles.iter().map(|tile| lock(tile).pixels.len() as u64).sum()
}

/// Takes a step of each tile, in parallel; returns what came of it, in the tiles' order.
///
/// A step works on a copy, and says whether it is to take the tile's place: a checkpoint, which may be written
/// at any time, finds each tile as it was between two steps.
fn each<P: Stored, S: State, R: Send>(
    tiles: &[Mutex<Tile<P, S>>],
    step: impl Fn(&mut Tile<P, S>) -> (bool, R) + Sync + Send,
) -> Vec<R> {
    let each = |tile: &Mutex<Tile<P, S>>| {
        let mut copy = lock(tile).clone();
        let (counts, result) = step(&mut copy);
        if counts {
            *lock(tile) = copy;
        }
        result
    };
    // One tile at a time for each thread: tiles differ in how long they take.
    tiles.par_iter().with_max_len(1).map(each).collect()
}

/// The tiles when nobody works on them any more.
fn unlocked<P, S>(tiles: Vec<Mutex<Tile<P, S>>>) -> Vec<Tile<P, S>> {
    tiles.into_iter().map(|tile| tile.into_inner().unwrap_or_else(PoisonError::into_inner)).collect()
}

/// Samples of a pixel, those left out among them.
pub(crate) fn samples(pixel: &PixelStats) -> u32 {
    pixel.count() + pixel.rejected()
}

impl<P: Pixel> Rendered<P> {
    /// Every pixel, tile by tile.
    fn stats(&self) -> impl Iterator<Item = &PixelStats> {
        self.tiles.iter().flat_map(|(_, pixels)| pixels).map(P::stats)
    }

    /// Columns and rows.
    pub(crate) const fn size(&self) -> (u32, u32) {
        (self.crop.width(), self.crop.height())
    }

    /// Pixels that were rendered: fewer than the window has in a part of it.
    pub(crate) fn area(&self) -> u64 {
        self.tiles.iter().map(|(_, pixels)| pixels.len() as u64).sum()
    }

    /// Fewest and most samples of a pixel.
    pub(crate) fn samples_per_pixel(&self) -> (u32, u32) {
        let counts = || self.stats().map(samples);
        (counts().min().unwrap_or(0), counts().max().unwrap_or(0))
    }

    /// Samples taken in all.
    pub(crate) fn samples(&self) -> u64 {
        self.stats().map(|p| u64::from(samples(p))).sum()
    }

    /// Samples that were no numbers to use.
    pub(crate) fn rejected(&self) -> u64 {
        self.stats().map(|p| u64::from(p.rejected())).sum()
    }

    /// Pixels without any light.
    pub(crate) fn dark(&self) -> u64 {
        self.stats().filter(|p| p.mean().is_black()).count() as u64
    }

    /// The window's pixels, row by row, through `value`.
    pub(crate) fn pixels<T: Clone + Default>(&self, value: impl Fn(&P) -> T) -> Vec<T> {
        let mut all = vec![T::default(); self.crop.area()];
        for (rect, pixels) in &self.tiles {
            for (row, y) in pixels.chunks_exact(rect.width() as usize).zip(rect.y0..) {
                let start = (y - self.crop.y0) as usize * self.crop.width() as usize
                    + (rect.x0 - self.crop.x0) as usize;
                for (to, from) in all[start..].iter_mut().zip(row) {
                    *to = value(from);
                }
            }
        }
        all
    }
}

#[cfg(test)]
mod tests;
