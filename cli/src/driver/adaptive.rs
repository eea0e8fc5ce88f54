//! Samples where the error is.

use super::{Event, Loop, Rendered, Work, area, each, taken, unlocked};
use crate::failure::Failure;
use crate::keep::lock;
use crate::tiles::{Stored, Tile};
use halflight::estimate::{AdaptiveTile, ErrorEstimate, Pixel, TILE, Target};
use halflight::film::PixelRect;
use std::sync::Mutex;
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
    tiles: &'d [Mutex<Tile<P, Box<AdaptiveTile>>>],
    samples: u64,
    deadline: Option<Instant>,
}

impl<W, F: Fn(Event) + Sync> Loop<'_, W, F> {
    /// Refines each tile until it meets the target.
    pub(super) fn refine_to<P: Stored>(&self, target: &Target) -> Result<Rendered<P>, Failure>
    where
        W: Work<P>,
    {
        let tiles = self.begin(TILE)?;
        self.keeper.while_saving(&tiles, || Refinement::new(self, &tiles, None).refine(target));
        self.refined(tiles, Some(target))
    }

    /// Refines the picture, from one target to the next, until time is up or nothing is left to do.
    pub(super) fn refine_until<P: Stored>(&self, deadline: Instant, most: u32) -> Result<Rendered<P>, Failure>
    where
        W: Work<P>,
    {
        let tiles = self.begin(TILE)?;
        let mut picture = Refinement::new(self, &tiles, Some(deadline));
        let mut error = FIRST;
        loop {
            picture.refine(&Target::new(error, most));
            let is_finished = tiles.iter().all(|t| lock(t).state.fewest_samples() >= most);
            if !picture.goes_on() || error < LAST || is_finished {
                return self.refined(tiles, None);
            }
            error *= NEXT;
        }
    }

    /// Ends with the picture as it is.
    fn refined<P: Stored>(
        &self,
        tiles: Vec<Mutex<Tile<P, Box<AdaptiveTile>>>>,
        target: Option<&Target>,
    ) -> Result<Rendered<P>, Failure> {
        let interrupted = self.is_stopped();
        self.keeper.end(&tiles, interrupted)?;
        Ok(Rendered { interrupted, ..refined(unlocked(tiles), self.crop, target) })
    }
}

impl<'l, 'd, W: Work<P>, F: Fn(Event) + Sync, P: Stored> Refinement<'l, 'd, W, F, P> {
    fn new(
        all: &'d Loop<'l, W, F>,
        tiles: &'d [Mutex<Tile<P, Box<AdaptiveTile>>>],
        deadline: Option<Instant>,
    ) -> Self {
        Self { all, tiles, samples: taken(tiles), deadline }
    }

    /// True until time is up or the user wants an end.
    fn goes_on(&self) -> bool {
        !self.all.is_stopped() && self.deadline.is_none_or(|d| Instant::now() < d)
    }

    /// Takes rounds until each tile meets the target: in each, a step of every tile that does not.
    fn refine(&mut self, target: &Target) {
        let pixels = area(self.tiles);
        loop {
            let taken: u64 = each(self.tiles, |tile| self.step(tile, target)).into_iter().sum();
            self.samples += taken;
            self.all.round(self.samples, pixels, &self.error());
            if taken == 0 || !self.goes_on() {
                return;
            }
        }
    }

    /// A step of a tile: whether it counts, and its samples. One that the user has cut short makes a
    /// checkpoint useless, as what the tile became would depend on when that was.
    fn step(&self, tile: &mut Tile<P, Box<AdaptiveTile>>, target: &Target) -> (bool, u64) {
        // Every pixel gets its first sample.
        let first = tile.state.fewest_samples() == 0;
        let go_on = || first || self.goes_on();
        let taken = self.all.work.refine(&mut tile.state, target, &mut tile.pixels, &go_on);
        (self.all.on_progress)(Event::Samples(taken));
        let is_whole = !self.all.keeper.has_checkpoint() || go_on();
        (taken > 0 && is_whole, taken)
    }

    /// Estimated error of the picture.
    fn error(&self) -> ErrorEstimate {
        sum_of(self.tiles.iter().map(|tile| lock(tile).state.error()))
    }
}

/// The picture that tiles make.
pub(crate) fn refined<P: Pixel>(
    tiles: Vec<Tile<P, Box<AdaptiveTile>>>,
    crop: PixelRect,
    target: Option<&Target>,
) -> Rendered<P> {
    let missed =
        target.map_or(0, |target| tiles.iter().map(|tile| u64::from(tile.state.missed(target))).sum());
    let error = sum_of(tiles.iter().map(|tile| tile.state.error()));
    let tiles = tiles.into_iter().map(|tile| (tile.rect, tile.pixels)).collect();
    Rendered { tiles, crop, error, interrupted: false, missed }
}

/// The error of a picture from those of its tiles, in their order.
fn sum_of(errors: impl Iterator<Item = ErrorEstimate>) -> ErrorEstimate {
    errors.fold(ErrorEstimate::default(), |mut sum, error| {
        sum.merge(&error);
        sum
    })
}
