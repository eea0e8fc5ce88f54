//! The same samples for every pixel.

use super::{Event, Goal, Loop, Rendered, Tile, Work, each, tiles};
use halflight::estimate::{Convergence, DifferenceSums, Pixel};
use std::ops::Range;
use std::time::Instant;

/// Before so many samples no picture is thought good enough.
const FEWEST: u32 = 16;

/// How much of the time that is left is planned for.
const PLANNED: f64 = 0.98;

impl<W, F: Fn(Event) + Sync> Loop<'_, W, F> {
    /// Takes passes until the goal is reached.
    pub(super) fn uniform<P: Pixel + Default + Clone + Send>(&self, goal: Goal) -> Rendered<P>
    where
        W: Work<P>,
    {
        let mut tiles = tiles::<P, _>(self.crop, side(goal), |_| ());
        let mut convergence = Convergence::new();
        let (mut done, mut interrupted, start) = (0, false, Instant::now());
        while let Some(end) = next(goal, done, &convergence, start) {
            let Some(sums) = self.pass(&mut tiles, done..end, goal) else {
                interrupted = self.is_stopped();
                break;
            };
            done = end;
            convergence.record(end, &sums);
            self.round(u64::from(end) * self.crop.area() as u64, &convergence.estimate());
        }
        let error = convergence.estimate();
        let misses = |target: f64| error.relative_error().is_none_or(|e| e > target);
        let missed = match goal {
            Goal::Error { target, most, .. } if done >= most && misses(target) => self.crop.area() as u64,
            _ => 0,
        };
        Rendered { tiles, crop: self.crop, error, interrupted, missed }
    }

    /// Adds samples to every pixel; `None` when it was stopped on the way.
    fn pass<P: Pixel + Send>(
        &self,
        tiles: &mut [Tile<P>],
        samples: Range<u32>,
        goal: Goal,
    ) -> Option<DifferenceSums>
    where
        W: Work<P>,
    {
        let is_late = || matches!(goal, Goal::Time { deadline, .. } if Instant::now() >= deadline);
        let sums = each(tiles, |tile| {
            if samples.start > 0 && (self.is_stopped() || is_late()) {
                return None;
            }
            let sums = self.work.render(tile.rect, samples.clone(), &mut tile.pixels);
            let taken = tile.pixels.len() as u64 * u64::from(samples.end - samples.start);
            (self.on_progress)(Event::Samples(taken));
            Some(sums)
        });
        sums.into_iter().try_fold(DifferenceSums::default(), |mut all, sums| {
            all.merge(sums?);
            Some(all)
        })
    }
}

/// Samples of each pixel after the next pass; `None` when the goal is reached. Passes double.
fn next(goal: Goal, done: u32, convergence: &Convergence, start: Instant) -> Option<u32> {
    let doubled = done.saturating_mul(2).max(1);
    let most = match goal {
        Goal::Samples(samples) => samples,
        Goal::Error { most, .. } if done < FEWEST => most,
        // What is missing is taken at once: looking after each few samples whether it is good enough
        // would find a moment when it only seems so.
        Goal::Error { target, most, .. } => convergence.samples_for(target * target)?.min(most),
        Goal::Time { deadline, most, .. } if done > 0 => {
            let left = deadline.saturating_duration_since(Instant::now()).as_secs_f64();
            let per_second = f64::from(done) / start.elapsed().as_secs_f64().max(1e-9);
            most.min(done.saturating_add((per_second * left * PLANNED) as u32))
        }
        Goal::Time { most, .. } => most,
    };
    (done < most).then(|| doubled.min(most))
}

/// Side of a tile in pixels: with many samples per pixel, smaller tiles, so that stopping at the next
/// one does not take long.
const fn side(goal: Goal) -> u32 {
    match goal {
        Goal::Samples(0..=1024) => 32,
        Goal::Samples(1025..=16_384) => 16,
        _ => 8,
    }
}
