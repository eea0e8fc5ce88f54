//! Samples where the error is.

use super::{Event, Loop, Rendered, Tile, Work, each, tiles};
use halflight::estimate::{AdaptiveTile, ErrorEstimate, Pixel, TILE, Target};
use std::time::Instant;

/// What a picture is brought to first when its time is limited (relative error, as a fraction).
const FIRST: f64 = 0.16;

/// Each next target, as a fraction of the one before: about a third more samples. When time is up, what
/// has had its share and what has not are that close.
const NEXT: f64 = 0.84;

/// Below this error `f32` does not tell better from worse.
const LAST: f64 = 1e-6;

/// A picture on its way.
struct Refinement<'l, 'd, W, F, P> {
    all: &'d Loop<'l, W, F>,
    tiles: Vec<Tile<P, AdaptiveTile>>,
    samples: u64,
    deadline: Option<Instant>,
}

impl<W, F: Fn(Event) + Sync> Loop<'_, W, F> {
    /// Refines each tile until it meets the target.
    pub(super) fn refine_to<P: Pixel + Default + Clone + Send>(&self, target: &Target) -> Rendered<P>
    where
        W: Work<P>,
    {
        let mut picture = Refinement::new(self, None);
        picture.refine(target);
        picture.rendered(Some(target))
    }

    /// Refines the picture, from one target to the next, until time is up or nothing is left to do.
    pub(super) fn refine_until<P: Pixel + Default + Clone + Send>(
        &self,
        deadline: Instant,
        most: u32,
    ) -> Rendered<P>
    where
        W: Work<P>,
    {
        let mut picture = Refinement::new(self, Some(deadline));
        let mut error = FIRST;
        loop {
            picture.refine(&Target::new(error, most));
            let is_finished = picture.tiles.iter().all(|t| t.state.fewest_samples() >= most);
            if !picture.goes_on() || error < LAST || is_finished {
                return picture.rendered(None);
            }
            error *= NEXT;
        }
    }
}

impl<'l, 'd, W: Work<P>, F: Fn(Event) + Sync, P: Pixel + Default + Clone + Send> Refinement<'l, 'd, W, F, P> {
    fn new(all: &'d Loop<'l, W, F>, deadline: Option<Instant>) -> Self {
        Self { all, tiles: tiles(all.crop, TILE, AdaptiveTile::new), samples: 0, deadline }
    }

    /// True until time is up or the user wants an end.
    fn goes_on(&self) -> bool {
        !self.all.is_stopped() && self.deadline.is_none_or(|d| Instant::now() < d)
    }

    /// Takes rounds until each tile meets the target: in each, a step of every tile that does not.
    fn refine(&mut self, target: &Target) {
        loop {
            let (all, deadline, first) = (self.all, self.deadline, self.samples == 0);
            // Every pixel gets its first sample.
            let go_on = || first || (!all.is_stopped() && deadline.is_none_or(|d| Instant::now() < d));
            let taken: u64 = each(&mut self.tiles, |tile| {
                let taken = all.work.refine(&mut tile.state, target, &mut tile.pixels, &go_on);
                (all.on_progress)(Event::Samples(taken));
                taken
            })
            .into_iter()
            .sum();
            self.samples += taken;
            all.round(self.samples, &self.error());
            if taken == 0 || !self.goes_on() {
                return;
            }
        }
    }

    /// Estimated error of the picture.
    fn error(&self) -> ErrorEstimate {
        self.tiles.iter().fold(ErrorEstimate::default(), |mut sum, tile| {
            sum.merge(&tile.state.error());
            sum
        })
    }

    /// The picture as it is.
    fn rendered(self, target: Option<&Target>) -> Rendered<P> {
        let missed = target
            .map_or(0, |target| self.tiles.iter().map(|tile| u64::from(tile.state.missed(target))).sum());
        let (error, interrupted) = (self.error(), self.all.is_stopped());
        let done = |Tile { rect, pixels, .. }| Tile { rect, pixels, state: () };
        let tiles = self.tiles.into_iter().map(done).collect();
        Rendered { tiles, crop: self.all.crop, error, interrupted, missed }
    }
}
