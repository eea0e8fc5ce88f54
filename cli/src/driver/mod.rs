//! The render loop: rounds in order, the tiles of a round in parallel, results in tile order.
//!
//! What comes out does not depend on the number of threads: pixels depend on nothing but the job and
//! the goal, and sums are taken in the order of the tiles. Only a goal in time depends on the clock.

mod adaptive;
mod uniform;

use halflight::estimate::{
    AdaptiveTile, DifferenceSums, ErrorEstimate, Estimator, Job, Pixel, PixelStats, Target,
};
use halflight::film::PixelRect;
use halflight::light::Emitter;
use halflight::material::Material;
use halflight::sequence::Sequence;
use halflight::shape::Shape;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

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

/// A part of the picture.
#[derive(Debug)]
struct Tile<P, T = ()> {
    rect: PixelRect,
    pixels: Vec<P>,
    state: T,
}

/// A picture with what is known about it.
#[derive(Debug)]
pub(crate) struct Rendered<P> {
    tiles: Vec<Tile<P>>,
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
    work: &'l W,
    on_progress: &'l F,
}

/// Renders the window `crop`, on the current rayon pool.
///
/// * `stop` – when it becomes true, no further part is begun; but each pixel gets its first sample
/// * `on_progress` – called from any thread
pub(crate) fn render<P: Pixel + Default + Clone + Send>(
    crop: PixelRect,
    goal: Goal,
    stop: &AtomicBool,
    work: &impl Work<P>,
    on_progress: &(impl Fn(Event) + Sync),
) -> Rendered<P> {
    let all = Loop { crop, stop, work, on_progress };
    match goal {
        Goal::Samples(_) => all.uniform(goal),
        Goal::Error { adaptive, .. } | Goal::Time { adaptive, .. } if !adaptive => all.uniform(goal),
        Goal::Error { target, most, .. } => all.refine_to(&Target::new(target, most)),
        Goal::Time { deadline, most, .. } => all.refine_until(deadline, most),
    }
}

impl<W, F: Fn(Event) + Sync> Loop<'_, W, F> {
    /// True when the user wants an end.
    fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Tells of a round's end.
    fn round(&self, samples: u64, error: &ErrorEstimate) {
        let samples = samples as f64 / self.crop.area() as f64;
        (self.on_progress)(Event::Round { samples, error: error.relative_error() });
    }
}

/// The tiles that make up a window, row by row.
fn tiles<P: Default + Clone, T>(
    crop: PixelRect,
    side: u32,
    state: impl Fn(PixelRect) -> T,
) -> Vec<Tile<P, T>> {
    let starts = |from: u32, to: u32| (from..to).step_by(side as usize);
    let tile = |x0: u32, y0: u32| {
        let (x1, y1) = (crop.x1.min(x0 + side), crop.y1.min(y0 + side));
        let rect = PixelRect { x0, y0, x1, y1 };
        Tile { rect, pixels: vec![P::default(); rect.area()], state: state(rect) }
    };
    starts(crop.y0, crop.y1)
        .flat_map(|y0| starts(crop.x0, crop.x1).map(move |x0| (x0, y0)))
        .map(|(x0, y0)| tile(x0, y0))
        .collect()
}

/// Does something with each tile, in parallel; returns what came of it, in the tiles' order.
fn each<P: Send, T: Send, R: Send>(
    tiles: &mut [Tile<P, T>],
    what: impl Fn(&mut Tile<P, T>) -> R + Sync + Send,
) -> Vec<R> {
    // One tile at a time for each thread: tiles differ in how long they take.
    tiles.par_iter_mut().with_max_len(1).map(what).collect()
}

/// Samples of a pixel, those left out among them.
pub(crate) fn samples(pixel: &PixelStats) -> u32 {
    pixel.count() + pixel.rejected()
}

impl<P: Pixel> Rendered<P> {
    /// Every pixel, tile by tile.
    fn stats(&self) -> impl Iterator<Item = &PixelStats> {
        self.tiles.iter().flat_map(|t| &t.pixels).map(P::stats)
    }

    /// Columns and rows.
    pub(crate) const fn size(&self) -> (u32, u32) {
        (self.crop.width(), self.crop.height())
    }

    /// Fewest and most samples of a pixel.
    pub(crate) fn samples_per_pixel(&self) -> (u32, u32) {
        self.stats().map(samples).fold((u32::MAX, 0), |(least, most), n| (least.min(n), most.max(n)))
    }

    /// Samples taken in all.
    pub(crate) fn samples(&self) -> u64 {
        self.stats().map(|p| u64::from(samples(p))).sum()
    }

    /// Samples that were no numbers to use.
    pub(crate) fn rejected(&self) -> u64 {
        self.stats().map(|p| u64::from(p.rejected())).sum()
    }

    /// The window's pixels, row by row, through `value`.
    pub(crate) fn pixels<T: Clone + Default>(&self, value: impl Fn(&P) -> T) -> Vec<T> {
        let mut all = vec![T::default(); self.crop.area()];
        for Tile { rect, pixels, .. } in &self.tiles {
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
mod tests {
    use super::*;
    use halflight::Rgb;
    use std::sync::Mutex;

    const CROP: PixelRect = PixelRect { x0: 3, y0: 5, x1: 80, y1: 70 };

    /// Each sample tells its pixel's place; a tile is good enough after one step.
    struct Place<F>(F);

    impl<F: Fn() + Sync> Work<PixelStats> for Place<F> {
        fn render(&self, rect: PixelRect, samples: Range<u32>, pixels: &mut [PixelStats]) -> DifferenceSums {
            (self.0)();
            let places = (rect.y0..rect.y1).flat_map(|y| (rect.x0..rect.x1).map(move |x| (x, y)));
            for ((x, y), pixel) in places.zip(pixels) {
                for _ in samples.clone() {
                    pixel.add(Rgb::new(x as f32, y as f32, 0.0));
                }
            }
            DifferenceSums::default()
        }

        fn refine(
            &self,
            tile: &mut AdaptiveTile,
            _: &Target,
            pixels: &mut [PixelStats],
            go_on: &dyn Fn() -> bool,
        ) -> u64 {
            if !go_on() || pixels[0].count() > 0 {
                return 0;
            }
            self.render(tile.rect(), 0..1, pixels);
            pixels.len() as u64
        }
    }

    const PLACE: Place<fn()> = Place(|| {});

    fn places_of(rendered: &Rendered<PixelStats>) -> Vec<[f32; 3]> {
        rendered.pixels(|p| p.mean().to_array())
    }

    fn expected() -> Vec<[f32; 3]> {
        (5..70).flat_map(|y| (3..80).map(move |x| [x as f32, y as f32, 0.0])).collect()
    }

    #[test]
    fn every_pixel_is_rendered_in_its_place() {
        let rendered = render(CROP, Goal::Samples(5), &AtomicBool::new(false), &PLACE, &|_| {});
        assert_eq!(places_of(&rendered), expected());
        assert_eq!(rendered.samples_per_pixel(), (5, 5));
        assert_eq!(rendered.samples(), 77 * 65 * 5);
        assert!(!rendered.interrupted);
    }

    #[test]
    fn every_pixel_is_refined_in_its_place() {
        let goal = Goal::Error { target: 0.1, most: 64, adaptive: true };
        let rendered = render(CROP, goal, &AtomicBool::new(false), &PLACE, &|_| {});
        assert_eq!(places_of(&rendered), expected());
        assert_eq!((rendered.samples(), rendered.missed), (77 * 65, 0));
    }

    #[test]
    fn progress_adds_up_and_passes_come_in_order() {
        let (taken, ends) = (Mutex::new(0), Mutex::new(Vec::new()));
        let on_progress = |event| match event {
            Event::Samples(n) => *taken.lock().unwrap() += n,
            Event::Round { samples, .. } => ends.lock().unwrap().push(samples),
        };
        render::<PixelStats>(CROP, Goal::Samples(6), &AtomicBool::new(false), &PLACE, &on_progress);
        assert_eq!(*taken.lock().unwrap(), 77 * 65 * 6);
        assert_eq!(*ends.lock().unwrap(), [1.0, 2.0, 4.0, 6.0]);
    }

    #[test]
    fn an_interrupt_stops_after_the_first_sample_of_each_pixel() {
        let goals = [
            Goal::Samples(64),
            Goal::Error { target: 0.1, most: 64, adaptive: false },
            Goal::Error { target: 0.1, most: 64, adaptive: true },
        ];
        for goal in goals {
            let rendered = render(CROP, goal, &AtomicBool::new(true), &PLACE, &|_| {});
            assert!(rendered.interrupted);
            assert_eq!(rendered.samples_per_pixel(), (1, 1));
            assert_eq!(places_of(&rendered), expected());
        }
    }

    #[test]
    fn an_interrupt_within_a_pass_keeps_what_was_done() {
        let stop = AtomicBool::new(false);
        let tiles = Mutex::new(0);
        let stop_early = Place(|| {
            *tiles.lock().unwrap() += 1;
            if *tiles.lock().unwrap() == 10 {
                stop.store(true, Ordering::Relaxed);
            }
        });
        let rendered = render(CROP, Goal::Samples(64), &stop, &stop_early, &|_| {});
        assert!(rendered.interrupted);
        assert_eq!(rendered.samples_per_pixel(), (1, 2));
        assert_eq!(places_of(&rendered).len(), CROP.area());
    }
}
