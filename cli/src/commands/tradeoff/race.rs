//! The measurement: all choices in turn, so that whatever else the machine does meets them alike.

use super::choices::Candidate;
use super::ladder::{Rung, Stage};
use super::reference::Reference;
use super::region::Region;
use crate::progress::Step;
use halflight::Rgb;
use std::sync::atomic::Ordering;
use std::time::Instant;

/// Rounds, each with a seed of its own, into which the time is divided; and how few will do when it is up.
const ROUNDS: usize = 8;
const FEWEST_ROUNDS: usize = 3;

/// Samples of the trial that finds out how long each choice takes.
const TRIAL: u32 = 4;

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
    let trials = {
        let _step = Step::begin("trying each choice", terms.quiet);
        candidates.iter().map(|c| trial(stage, c)).collect::<Option<Vec<_>>>()?
    };
    let best = (0..trials.len()).min_by(|&a, &b| trials[a].cost().total_cmp(&trials[b].cost()))?;
    let cpu = terms.budget * terms.threads as f64;
    let reference = {
        let _step = Step::begin("rendering the reference", terms.quiet);
        let samples = trials[best].samples_in(REFERENCE_SHARE * cpu).max(16);
        match given {
            Some(pixels) => Reference::given(stage, &candidates[best], (samples / 4).max(4), regions, pixels),
            None => Reference::render(stage, &candidates[best], samples, regions),
        }?
    };
    let slice = cpu / (ROUNDS * candidates.len()) as f64;
    let tops: Vec<_> = trials.iter().map(|t| t.samples_in(slice)).collect();
    let ladders = race(stage, terms, &tops, &reference)?;
    Some(Measured { reference, ladders, slice })
}

/// Runs the rounds, until the time is up; `None` when interrupted before the fewest are done.
fn race(
    stage: &Stage<'_>,
    terms: &Terms,
    tops: &[u32],
    reference: &Reference,
) -> Option<Vec<Vec<Vec<Rung>>>> {
    let candidates = &stage.field.candidates;
    let start = Instant::now();
    let mut ladders = vec![Vec::new(); candidates.len()];
    for round in 0..ROUNDS {
        if round >= FEWEST_ROUNDS && start.elapsed().as_secs_f64() > terms.budget {
            break;
        }
        let mut done = Vec::new();
        for (i, (candidate, &top)) in candidates.iter().zip(tops).enumerate() {
            let all = candidates.len();
            let what = format!("round {} of {ROUNDS}, {} ({} of {all})", round + 1, candidate.name, i + 1);
            let _step = Step::begin(what, terms.quiet);
            let seed = terms.seed.wrapping_mul(ROUNDS as u32).wrapping_add(round as u32);
            done.push(stage.rungs(candidate, seed, top, reference));
        }
        if stage.stop.load(Ordering::Relaxed) {
            return (round >= FEWEST_ROUNDS).then_some(ladders);
        }
        ladders.iter_mut().zip(done).for_each(|(ladder, rungs)| ladder.push(rungs));
    }
    Some(ladders)
}

/// A first look at a choice.
struct Trial {
    /// CPU time of a sample of every pixel (s).
    seconds: f64,
    /// Mean squared difference of two pictures, relative to them.
    error: f64,
}

impl Trial {
    /// The lower, the better.
    fn cost(&self) -> f64 {
        self.seconds * self.error
    }

    /// The largest power of two of samples that takes no longer than that (s).
    fn samples_in(&self, seconds: f64) -> u32 {
        let most = (seconds / self.seconds).clamp(1.0, f64::from(HIGHEST)) as u32;
        1 << most.ilog2()
    }
}

/// Renders two small pictures of a choice; `None` when interrupted.
fn trial(stage: &Stage<'_>, candidate: &Candidate) -> Option<Trial> {
    let (a, a_seconds) = stage.picture(candidate, 0x7472_6961, TRIAL)?;
    let (b, b_seconds) = stage.picture(candidate, 0x7472_6962, TRIAL)?;
    let channels =
        |picture: &[Rgb]| picture.iter().flat_map(|p| p.to_array()).map(f64::from).collect::<Vec<_>>();
    let (a, b) = (channels(&a), channels(&b));
    let relative = |(a, b): (&f64, &f64)| (a - b).powi(2) / (0.25 * (a + b).powi(2) + 0.01);
    let error = a.iter().zip(&b).map(relative).sum::<f64>() / a.len() as f64;
    // A clock that has not moved is no reason for an infinity.
    let seconds = ((a_seconds + b_seconds) / f64::from(2 * TRIAL)).max(1e-9);
    Some(Trial { seconds, error })
}
