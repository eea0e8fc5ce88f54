//! The render loop: passes in order, the tiles of a pass in parallel, results in tile order.
//!
//! What comes out does not depend on the number of threads: pixels depend on nothing but the job, and
//! sums are taken in the order of the tiles.

use halflight::estimate::{Convergence, DifferenceSums, PixelStats, passes};
use halflight::film::PixelRect;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering};

/// A part of the picture.
#[derive(Debug)]
struct Tile {
    rect: PixelRect,
    pixels: Vec<PixelStats>,
    samples: u32,
}

/// What has happened since the last time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Event {
    /// That many samples were taken.
    Samples(u64),
    /// Every pixel has `samples` samples now, and this is the estimated relative error.
    Pass {
        /// Samples of each pixel.
        samples: u32,
        /// As a fraction; `None` while unknown.
        error: Option<f64>,
    },
}

/// A picture with what is known about it.
#[derive(Debug)]
pub(crate) struct Rendered {
    tiles: Vec<Tile>,
    crop: PixelRect,
    convergence: Convergence,
    /// True when it was stopped before the last sample.
    pub(crate) interrupted: bool,
}

/// Renders the window `crop` with `samples` samples per pixel, on the current rayon pool.
///
/// * `stop` – when it becomes true, no further tile is begun; but each pixel gets its first sample
/// * `render_tile` – adds a range of samples to the pixels of a tile, row by row
/// * `on_progress` – called from any thread
pub(crate) fn render(
    crop: PixelRect,
    samples: u32,
    stop: &AtomicBool,
    render_tile: &(impl Fn(PixelRect, Range<u32>, &mut [PixelStats]) -> DifferenceSums + Sync),
    on_progress: &(impl Fn(Event) + Sync),
) -> Rendered {
    let tiles = tiles(crop, side(samples));
    let mut rendered = Rendered { tiles, crop, convergence: Convergence::new(), interrupted: false };
    for pass in passes(samples) {
        let one_tile = |tile: &mut Tile| {
            if pass.start > 0 && stop.load(Ordering::Relaxed) {
                return None;
            }
            let sums = render_tile(tile.rect, pass.clone(), &mut tile.pixels);
            tile.samples = pass.end;
            on_progress(Event::Samples(tile.pixels.len() as u64 * u64::from(pass.end - pass.start)));
            Some(sums)
        };
        // One tile at a time for each thread: tiles differ in how long they take.
        let sums: Vec<_> = rendered.tiles.par_iter_mut().with_max_len(1).map(one_tile).collect();
        let Some(sums) = sums.into_iter().collect::<Option<Vec<_>>>() else {
            rendered.interrupted = true;
            break;
        };
        rendered.convergence.record(pass.end, &merged(sums));
        on_progress(Event::Pass { samples: pass.end, error: rendered.relative_error() });
    }
    rendered
}

/// Sums over all tiles, in their order.
fn merged(sums: Vec<DifferenceSums>) -> DifferenceSums {
    sums.into_iter().fold(DifferenceSums::default(), |mut all, sums| {
        all.merge(sums);
        all
    })
}

/// Side of a tile in pixels: with many samples per pixel, smaller tiles, so that stopping at the next
/// one does not take long.
const fn side(samples: u32) -> u32 {
    match samples {
        0..=1024 => 32,
        1025..=16_384 => 16,
        _ => 8,
    }
}

/// The tiles that make up a window, row by row.
fn tiles(crop: PixelRect, side: u32) -> Vec<Tile> {
    let starts = |from: u32, to: u32| (from..to).step_by(side as usize);
    let tile = |x0: u32, y0: u32| {
        let (x1, y1) = (crop.x1.min(x0 + side), crop.y1.min(y0 + side));
        let rect = PixelRect { x0, y0, x1, y1 };
        Tile { rect, pixels: vec![PixelStats::NEW; rect.area()], samples: 0 }
    };
    starts(crop.y0, crop.y1).flat_map(|y0| starts(crop.x0, crop.x1).map(move |x0| tile(x0, y0))).collect()
}

impl Rendered {
    /// Estimated relative error, as a fraction; `None` while unknown.
    pub(crate) fn relative_error(&self) -> Option<f64> {
        self.convergence.relative_error()
    }

    /// Fewest and most samples of a pixel.
    pub(crate) fn samples_per_pixel(&self) -> (u32, u32) {
        let counts = || self.tiles.iter().map(|t| t.samples);
        (counts().min().unwrap_or(0), counts().max().unwrap_or(0))
    }

    /// Samples taken in all.
    pub(crate) fn samples(&self) -> u64 {
        self.tiles.iter().map(|t| t.pixels.len() as u64 * u64::from(t.samples)).sum()
    }

    /// Samples that were no numbers to use.
    pub(crate) fn rejected(&self) -> u64 {
        self.tiles.iter().flat_map(|t| &t.pixels).map(|p| u64::from(p.rejected())).sum()
    }

    /// The window's pixels, row by row, through `value`.
    pub(crate) fn pixels<T: Clone + Default>(&self, value: impl Fn(&PixelStats) -> T) -> Vec<T> {
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

    /// Each sample tells its pixel's place.
    fn place(rect: PixelRect, samples: Range<u32>, pixels: &mut [PixelStats]) -> DifferenceSums {
        let places = (rect.y0..rect.y1).flat_map(|y| (rect.x0..rect.x1).map(move |x| (x, y)));
        for ((x, y), pixel) in places.zip(pixels) {
            for _ in samples.clone() {
                pixel.add(Rgb::new(x as f32, y as f32, 0.0));
            }
        }
        DifferenceSums::default()
    }

    fn places_of(rendered: &Rendered) -> Vec<[f32; 3]> {
        rendered.pixels(|p| p.mean().to_array())
    }

    #[test]
    fn every_pixel_is_rendered_in_its_place() {
        let rendered = render(CROP, 5, &AtomicBool::new(false), &place, &|_| {});
        let expected: Vec<_> =
            (5..70).flat_map(|y| (3..80).map(move |x| [x as f32, y as f32, 0.0])).collect();
        assert_eq!(places_of(&rendered), expected);
        assert_eq!(rendered.samples_per_pixel(), (5, 5));
        assert_eq!(rendered.samples(), 77 * 65 * 5);
        assert!(!rendered.interrupted);
    }

    #[test]
    fn progress_adds_up_and_passes_come_in_order() {
        let (taken, ends) = (Mutex::new(0), Mutex::new(Vec::new()));
        let on_progress = |event| match event {
            Event::Samples(n) => *taken.lock().unwrap() += n,
            Event::Pass { samples, .. } => ends.lock().unwrap().push(samples),
        };
        render(CROP, 6, &AtomicBool::new(false), &place, &on_progress);
        assert_eq!(*taken.lock().unwrap(), 77 * 65 * 6);
        assert_eq!(*ends.lock().unwrap(), [1, 2, 4, 6]);
    }

    #[test]
    fn an_interrupt_stops_after_the_first_sample_of_each_pixel() {
        let rendered = render(CROP, 64, &AtomicBool::new(true), &place, &|_| {});
        assert!(rendered.interrupted);
        assert_eq!(rendered.samples_per_pixel(), (1, 1));
    }

    #[test]
    fn an_interrupt_within_a_pass_keeps_what_was_done() {
        let stop = AtomicBool::new(false);
        let tiles = Mutex::new(0);
        let stop_early = |rect, samples: Range<u32>, pixels: &mut [PixelStats]| {
            *tiles.lock().unwrap() += 1;
            if *tiles.lock().unwrap() == 10 {
                stop.store(true, Ordering::Relaxed);
            }
            place(rect, samples, pixels)
        };
        let rendered = render(CROP, 64, &stop, &stop_early, &|_| {});
        assert!(rendered.interrupted);
        assert_eq!(rendered.samples_per_pixel(), (1, 2));
        assert_eq!(places_of(&rendered).len(), CROP.area());
    }
}
