//! The same samples for every pixel.

use super::{Event, Goal, Loop, Rendered, Work, area, each, side, unlocked};
use crate::failure::Failure;
use crate::tiles::{Pass, Passes, State, Stored, Tile};
use halflight::estimate::{Convergence, DifferenceSums, Pixel};
use halflight::film::PixelRect;
use std::sync::Mutex;
use std::time::Instant;

/// Before so many samples no picture is thought good enough.
const FEWEST: u32 = 16;

/// How much of the time that is left is planned for.
const PLANNED: f64 = 0.98;

impl<W, F: Fn(Event) + Sync> Loop<'_, W, F> {
    /// Takes passes until the goal is reached.
    pub(super) fn uniform<P: Stored>(&self, goal: Goal) -> Result<Rendered<P>, Failure>
    where
        W: Work<P>,
    {
        let tiles = self.begin::<P, Passes>(side(goal))?;
        let interrupted = self.keeper.while_saving(&tiles, || self.passes(&tiles, goal));
        self.keeper.end(&tiles, interrupted)?;
        let mut rendered = passed(unlocked(tiles), self.crop, goal);
        rendered.interrupted = interrupted;
        Ok(rendered)
    }

    /// The passes; true when they were stopped by the user.
    fn passes<P: Stored>(&self, tiles: &[Mutex<Tile<P, Passes>>], goal: Goal) -> bool
    where
        W: Work<P>,
    {
        let mut convergence = Convergence::new();
        let (mut done, start, pixels) = (0, Instant::now(), area(tiles));
        while let Some(end) = next(goal, done, &convergence, start) {
            let Some(sums) = self.pass(tiles, end, goal) else { return self.is_stopped() };
            done = end;
            convergence.record(end, &sums);
            self.round(u64::from(end) * pixels, pixels, &convergence.estimate());
        }
        false
    }

    /// Brings every pixel to `end` samples; `None` when it was stopped on the way.
    fn pass<P: Stored>(
        &self,
        tiles: &[Mutex<Tile<P, Passes>>],
        end: u32,
        goal: Goal,
    ) -> Option<DifferenceSums>
    where
        W: Work<P>,
    {
        let is_late = || matches!(goal, Goal::Time { deadline, .. } if Instant::now() >= deadline);
        let sums = each(tiles, |tile| {
            let start = tile.state.samples();
            if start >= end {
                return (false, Some(tile.state.change(end)));
            }
            if start > 0 && (self.is_stopped() || is_late()) {
                return (false, None);
            }
            let sums = self.work.render(tile.rect, start..end, &mut tile.pixels);
            tile.state.0.push(Pass { end, sums });
            let taken = tile.pixels.len() as u64 * u64::from(end - start);
            (self.on_progress)(Event::Samples(taken));
            (true, Some(sums))
        });
        sums.into_iter().try_fold(DifferenceSums::default(), |mut all, sums| {
            all.merge(sums?);
            Some(all)
        })
    }
}

impl Passes {
    /// What the pass to `end` samples has changed; nothing when there was no such pass.
    fn change(&self, end: u32) -> DifferenceSums {
        self.0.iter().find(|pass| pass.end == end).map_or_else(DifferenceSums::default, |pass| pass.sums)
    }
}

/// The picture that passes have made, and its error by those that all tiles have had.
pub(crate) fn passed<P: Pixel>(tiles: Vec<Tile<P, Passes>>, crop: PixelRect, goal: Goal) -> Rendered<P> {
    let done = tiles.iter().map(|tile| tile.state.samples()).min().unwrap_or(0);
    let ends = tiles.first().map_or_else(Vec::new, |tile| tile.state.0.iter().map(|pass| pass.end).collect());
    let mut convergence = Convergence::new();
    for end in ends.into_iter().filter(|end| *end <= done) {
        let mut sums = DifferenceSums::default();
        tiles.iter().for_each(|tile| sums.merge(tile.state.change(end)));
        convergence.record(end, &sums);
    }
    let error = convergence.estimate();
    let misses = |target: f64| error.relative_error().is_none_or(|e| e > target);
    let missed = match goal {
        Goal::Error { target, most, .. } if done >= most && misses(target) => crop.area() as u64,
        _ => 0,
    };
    let tiles = tiles.into_iter().map(|tile| (tile.rect, tile.pixels)).collect();
    Rendered { tiles, crop, error, interrupted: false, missed }
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
