//! Rendering one choice up a ladder, of sample counts or of target errors: error and CPU time at each rung.

use super::choices::{Candidate, Field};
use super::reference::Reference;
use cpu_time::ThreadTime;
use halflight::build::BoundScene;
use halflight::estimate::{AnyEstimator, Job, PixelStats, passes};
use halflight::film::{Film, PixelRect};
use halflight::light::AnyLight;
use halflight::material::AnyMaterial;
use halflight::sequence::AnySequence;
use halflight::shape::AnyShape;
use halflight::{Camera, Rgb};
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};

/// A picture of any scene, by any estimator.
pub(super) type AnyJob<'a> = Job<'a, AnyShape, AnyLight<'a>, AnyMaterial<'a>, AnyEstimator<'a>, AnySequence>;

/// Rows that a thread renders at a time.
const BAND: usize = 4;

/// What all choices have in common.
#[derive(Debug)]
pub(super) struct Stage<'a> {
    pub(super) field: &'a Field,
    pub(super) camera: Camera,
    pub(super) film: Film,
    pub(super) stop: &'a AtomicBool,
}

/// How far a ladder goes.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Ladder {
    /// Up to so many samples of each pixel, a power of two.
    Samples(u32),
    /// Through these [targets](super::refined::target).
    Targets(Range<u32>),
}

/// What a ladder has come to after a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Rung {
    /// Samples per pixel so far, on average.
    pub(super) samples: f64,
    /// The relative error that was asked for (a fraction), where one was.
    pub(super) target: Option<f64>,
    /// CPU time so far, of all threads (s).
    pub(super) seconds: f64,
    /// relMSE, the noise of the reference included.
    pub(super) relmse: Errors,
}

/// A measure over all pixels, those that see their lights in full, and those that see a part; NaN where
/// there are none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Errors {
    pub(super) all: f64,
    pub(super) open: f64,
    pub(super) penumbra: f64,
}

impl Errors {
    /// Combines two measures, part by part.
    pub(super) fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self {
            all: f(self.all, other.all),
            open: f(self.open, other.open),
            penumbra: f(self.penumbra, other.penumbra),
        }
    }
}

impl Stage<'_> {
    /// Renders passes of 1, 1, 2, 4, … samples, to `samples` in all.
    ///
    /// * `after` – takes the samples so far, their CPU time (s) and the pixels, row by row; its own time
    ///   is not counted
    pub(super) fn climb(
        &self,
        candidate: &Candidate,
        seed: u32,
        samples: u32,
        mut after: impl FnMut(u32, f64, &[PixelStats]),
    ) {
        let mut pixels = vec![PixelStats::NEW; self.film.crop().area()];
        let mut seconds = 0.0;
        for pass in passes(samples) {
            if self.stop.load(Ordering::Relaxed) {
                return;
            }
            seconds += self.add(candidate, seed, samples, pass.clone(), &mut pixels);
            after(pass.end, seconds, &pixels);
        }
    }

    /// The rungs of a ladder, judged by a reference.
    pub(super) fn rungs(
        &self,
        candidate: &Candidate,
        seed: u32,
        ladder: &Ladder,
        by: &Reference,
    ) -> Vec<Rung> {
        let mut rungs = Vec::new();
        let mut rung = |target, samples, seconds, pixels: &[PixelStats]| {
            rungs.push(Rung { samples, target, seconds, relmse: by.relmse(pixels) });
        };
        match ladder {
            Ladder::Samples(most) => self.climb(candidate, seed, *most, |samples, seconds, pixels| {
                rung(None, f64::from(samples), seconds, pixels);
            }),
            Ladder::Targets(targets) => self.refine(candidate, seed, targets.clone(), |picture| {
                rung(Some(picture.target), picture.samples(), picture.seconds(), &picture.pixels());
                true
            }),
        }
        rungs
    }

    /// Adds samples to all pixels; returns the CPU time of that (s).
    fn add(
        &self,
        candidate: &Candidate,
        seed: u32,
        of: u32,
        samples: Range<u32>,
        pixels: &mut [PixelStats],
    ) -> f64 {
        let buffers = &self.field.buffers[candidate.tables];
        let bound = buffers.bind();
        let width = self.film.width();
        let job = self.job(candidate, &bound, candidate.plan.sequence(seed, width, of));
        let nanoseconds = AtomicU64::new(0);
        let rows = BAND * width as usize;
        pixels.par_chunks_mut(rows).enumerate().with_max_len(1).for_each(|(band, pixels)| {
            let y0 = (band * BAND) as u32;
            let y1 = y0 + (pixels.len() / width as usize) as u32;
            let start = ThreadTime::now();
            job.render(PixelRect { x0: 0, y0, x1: width, y1 }, samples.clone(), pixels);
            nanoseconds.fetch_add(start.elapsed().as_nanos() as u64, Ordering::Relaxed);
        });
        1e-9 * nanoseconds.into_inner() as f64
    }

    /// What a picture of a choice depends on.
    ///
    /// * `bound` – the choice's tables
    pub(super) fn job<'b>(
        &'b self,
        candidate: &Candidate,
        bound: &'b BoundScene<'b>,
        sequence: AnySequence,
    ) -> AnyJob<'b> {
        Job {
            scene: bound.scene(),
            camera: self.camera,
            film: self.film,
            estimator: candidate.plan.estimator(&self.field.buffers[candidate.tables]),
            sequence,
        }
    }

    /// One picture, and the CPU time that it took (s); `None` when interrupted.
    pub(super) fn picture(&self, candidate: &Candidate, seed: u32, samples: u32) -> Option<(Vec<Rgb>, f64)> {
        let mut picture = None;
        self.climb(candidate, seed, samples, |done, seconds, pixels| {
            if done == samples {
                picture = Some((pixels.iter().map(|p| p.mean()).collect(), seconds));
            }
        });
        picture
    }
}
