//! The measurement: all choices in turn, so that whatever else the machine does meets them alike.

use super::choices::Candidate;
use super::ladder::{Ladder, Rung, Stage};
use super::reference::Reference;
use super::refined::{MOST_TARGETS, tiles};
use super::region::Region;
use crate::progress::Step;
use halflight::Rgb;
use std::ops::Range;
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Rounds, each with a seed of its own, into which the time is divided; and how few will do when it is up.
const ROUNDS: usize = 8;
const FEWEST_ROUNDS: usize = 3;

/// Samples of the trial that finds out how long each choice takes.
const TRIAL: u32 = 4;

/// Its seeds, far away from those of the ladders.
const TRIAL_SEEDS: [u32; 2] = [0x7472_6961, 0x7472_6962];

/// The share of the time that the reference takes besides.
const REFERENCE_SHARE: f64 = 0.5;

/// Highest rung of a ladder (samples per pixel).
const HIGHEST: u32 = 1 << 20;

/// How much is to be measured.
#[derive(Debug, Clone, Copy)]
pub(super) struct Terms {
    /// Wall time (s).
    pub(super) budget: f64,
    pub(super) threads: usize,
    pub(super) seed: u32,
    pub(super) quiet: bool,
}

/// Everything that was measured.
#[derive(Debug)]
pub(super) struct Measured {
    pub(super) reference: Reference,
    /// For each choice, for each round, its rungs.
    pub(super) ladders: Vec<Vec<Vec<Rung>>>,
    /// CPU time that every choice was given in a round (s).
    pub(super) slice: f64,
}

/// Measures all choices; `None` when interrupted before there is something to tell.
pub(super) fn measure(
    stage: &Stage<'_>,
    terms: &Terms,
    regions: Vec<Region>,
    given: Option<Vec<Rgb>>,
) -> Option<Measured> {
    let candidates = &stage.field.candidates;
    let cpu = terms.budget * terms.threads as f64;
    let slice = cpu / (ROUNDS * candidates.len()) as f64;
    let trials = {
        let _step = Step::begin("trying each choice", terms.quiet);
        // Threads without a tile are idle.
        let of_tiles = slice * (tiles(&stage.film) as f64 / terms.threads as f64).min(1.0);
        candidates.iter().map(|c| trial(stage, c, of_tiles)).collect::<Option<Vec<_>>>()?
    };
    let best = (0..trials.len()).min_by(|&a, &b| trials[a].cost().total_cmp(&trials[b].cost()))?;
    let reference = {
        let _step = Step::begin("rendering the reference", terms.quiet);
        let samples = trials[best].samples_in(REFERENCE_SHARE * cpu).max(16);
        match given {
            Some(pixels) => Reference::given(stage, &candidates[best], (samples / 4).max(4), regions, pixels),
            None => Reference::render(stage, &candidates[best], samples, regions),
        }?
    };
    let ladders: Vec<_> = trials.into_iter().map(|t| t.ladder(slice)).collect();
    let ladders = race(stage, terms, &ladders, &reference)?;
    Some(Measured { reference, ladders, slice })
}

/// Runs the rounds, until the time is up; `None` when interrupted before the fewest are done.
fn race(
    stage: &Stage<'_>,
    terms: &Terms,
    ladders: &[Ladder],
    reference: &Reference,
) -> Option<Vec<Vec<Vec<Rung>>>> {
    let candidates = &stage.field.candidates;
    let start = Instant::now();
    let mut all_rungs = vec![Vec::new(); candidates.len()];
    for round in 0..ROUNDS {
        if round >= FEWEST_ROUNDS && start.elapsed().as_secs_f64() > terms.budget {
            break;
        }
        let mut done = Vec::new();
        for (i, (candidate, ladder)) in candidates.iter().zip(ladders).enumerate() {
            let all = candidates.len();
            let what = format!("round {} of {ROUNDS}, {} ({} of {all})", round + 1, candidate.name, i + 1);
            let _step = Step::begin(what, terms.quiet);
            let seed = terms.seed.wrapping_mul(ROUNDS as u32).wrapping_add(round as u32);
            done.push(stage.rungs(candidate, seed, ladder, reference));
        }
        if stage.stop.load(Ordering::Relaxed) {
            return (round >= FEWEST_ROUNDS).then_some(all_rungs);
        }
        all_rungs.iter_mut().zip(done).for_each(|(all, rungs)| all.push(rungs));
    }
    Some(all_rungs)
}

/// A first look at a choice.
enum Trial {
    /// With the same samples for every pixel.
    Uniform {
        /// CPU time of a sample of every pixel (s).
        seconds: f64,
        /// Mean squared difference of two pictures, relative to them.
        error: f64,
    },
    /// With samples where the error is: the targets that are worth a rung each.
    Adaptive(Range<u32>),
}

impl Trial {
    /// The lower, the better for a reference.
    fn cost(&self) -> f64 {
        match self {
            Self::Uniform { seconds, error } => seconds * error,
            Self::Adaptive(_) => f64::INFINITY,
        }
    }

    /// The largest power of two of samples that takes no longer than that (s).
    fn samples_in(&self, time: f64) -> u32 {
        let Self::Uniform { seconds, .. } = self else { return 1 };
        1 << ((time / seconds).clamp(1.0, f64::from(HIGHEST)) as u32).ilog2()
    }

    /// What to climb in a time (s).
    fn ladder(self, time: f64) -> Ladder {
        match self {
            Self::Adaptive(targets) => Ladder::Targets(targets),
            Self::Uniform { .. } => Ladder::Samples(self.samples_in(time)),
        }
    }
}

/// Finds out what a choice takes; `None` when interrupted.
///
/// * `time` – what samples where the error is may take (s)
fn trial(stage: &Stage<'_>, candidate: &Candidate, time: f64) -> Option<Trial> {
    if candidate.adaptive { adaptive_trial(stage, candidate, time) } else { uniform_trial(stage, candidate) }
}

/// Refines a picture until half of the time is up: the next target might take the rest. Targets that its
/// fewest samples reach are one rung.
fn adaptive_trial(stage: &Stage<'_>, candidate: &Candidate, time: f64) -> Option<Trial> {
    let (mut fewest, mut first, mut end) = (0.0, 0, 0);
    stage.refine(candidate, TRIAL_SEEDS[0], 0..MOST_TARGETS, |picture| {
        let samples = picture.samples();
        if end == 0 || samples <= fewest {
            (fewest, first) = (samples, end);
        }
        end += 1;
        picture.seconds() < 0.5 * time
    });
    (!stage.stop.load(Ordering::Relaxed)).then_some(Trial::Adaptive(first..end))
}

/// Renders two small pictures of a choice.
fn uniform_trial(stage: &Stage<'_>, candidate: &Candidate) -> Option<Trial> {
    let (a, a_seconds) = stage.picture(candidate, TRIAL_SEEDS[0], TRIAL)?;
    let (b, b_seconds) = stage.picture(candidate, TRIAL_SEEDS[1], TRIAL)?;
    let channels =
        |picture: &[Rgb]| picture.iter().flat_map(|p| p.to_array()).map(f64::from).collect::<Vec<_>>();
    let (a, b) = (channels(&a), channels(&b));
    let relative = |(a, b): (&f64, &f64)| (a - b).powi(2) / (0.25 * (a + b).powi(2) + 0.01);
    let error = a.iter().zip(&b).map(relative).sum::<f64>() / a.len() as f64;
    // A clock that has not moved is no reason for an infinity.
    let seconds = ((a_seconds + b_seconds) / f64::from(2 * TRIAL)).max(1e-9);
    Some(Trial::Uniform { seconds, error })
}
