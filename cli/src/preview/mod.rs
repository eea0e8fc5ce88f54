//! The picture on its way, small, in the terminal.

mod draw;

use crate::args::{PreviewHow, Showing};
use crate::driver::Work;
use crate::terminal;
use console::Term;
use draw::{Protocol, Screen};
use halflight::Rgb;
use halflight::estimate::{AdaptiveTile, DifferenceSums, Pixel, Target};
use halflight::film::PixelRect;
use std::io::{IsTerminal, stdout};
use std::ops::Range;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Between two drawings.
const PAUSE: Duration = Duration::from_millis(250);

/// A picture that is shown while it is rendered.
#[derive(Debug)]
pub(crate) struct Preview {
    showing: Showing,
    state: Mutex<State>,
}

#[derive(Debug)]
struct State {
    canvas: Canvas,
    screen: Screen,
    /// When it was drawn; `None` before the first time.
    drawn: Option<Instant>,
}

/// A window of a film, smaller.
#[derive(Debug)]
struct Canvas {
    crop: PixelRect,
    /// Columns and rows.
    size: (u32, u32),
    pixels: Vec<Rgb>,
}

impl Preview {
    /// A preview of a window of a film; `None` where there is no terminal to show it on.
    ///
    /// * `how` – by which protocol; where it is named, it is drawn to whatever standard output is
    pub(crate) fn begin(how: PreviewHow, crop: PixelRect, showing: Showing) -> Option<Self> {
        if how == PreviewHow::Auto && !stdout().is_terminal() {
            terminal::warning(
                "--preview has no effect: standard output is no terminal; --preview=blocks draws all the same",
            );
            return None;
        }
        let cells = Term::stdout().size_checked().map_or((80, 24), |(r, c)| (u32::from(c), u32::from(r)));
        let protocol = Protocol::new(how, |name| std::env::var(name).ok());
        let screen = Screen::new(protocol, (crop.width(), crop.height()), cells);
        let canvas = Canvas::new(crop, screen.pixels());
        Some(Self { showing, state: Mutex::new(State { canvas, screen, drawn: None }) })
    }

    /// Takes in a tile, row by row, and draws if it was not just drawn.
    fn update<P: Pixel>(&self, tile: PixelRect, pixels: &[P]) {
        let Ok(mut state) = self.state.lock() else { return };
        state.canvas.update(tile, pixels);
        if state.drawn.is_none_or(|drawn| drawn.elapsed() >= PAUSE) {
            self.draw(&mut state);
        }
    }

    /// Draws it as it is.
    fn draw(&self, state: &mut State) {
        let codes: Vec<_> = self.showing.codes(&state.canvas.pixels).collect();
        state.screen.draw(&codes);
        state.drawn = Some(Instant::now());
    }
}

impl Drop for Preview {
    fn drop(&mut self) {
        if let Ok(mut state) = self.state.lock() {
            self.draw(&mut state);
        }
    }
}

impl Canvas {
    /// All black.
    fn new(crop: PixelRect, size: (u32, u32)) -> Self {
        Self { crop, size, pixels: vec![Rgb::BLACK; size.0 as usize * size.1 as usize] }
    }

    /// The film's column, or row, where one of these begins.
    fn start(&self, (x, y): (u32, u32)) -> (u32, u32) {
        let scaled = |n: u32, to: u32, of: u32| (u64::from(n) * u64::from(to) / u64::from(of)) as u32;
        let Self { crop, size, .. } = self;
        (crop.x0 + scaled(x, crop.width(), size.0), crop.y0 + scaled(y, crop.height(), size.1))
    }

    /// Takes in a tile, row by row: each pixel that begins in it becomes the mean of what it covers there.
    fn update<P: Pixel>(&mut self, tile: PixelRect, pixels: &[P]) {
        let (width, height) = self.size;
        for y in 0..height {
            if !(tile.y0..tile.y1).contains(&self.start((0, y)).1) {
                continue;
            }
            for x in 0..width {
                let ((x0, y0), (x1, y1)) = (self.start((x, y)), self.start((x + 1, y + 1)));
                if (tile.x0..tile.x1).contains(&x0) {
                    let (x1, y1) = (x1.max(x0 + 1).min(tile.x1), y1.max(y0 + 1).min(tile.y1));
                    let index = (y * width + x) as usize;
                    self.pixels[index] = mean(tile, pixels, PixelRect { x0, y0, x1, y1 });
                }
            }
        }
    }
}

/// Mean of a part of a tile.
fn mean<P: Pixel>(tile: PixelRect, pixels: &[P], part: PixelRect) -> Rgb {
    let places = (part.y0..part.y1).flat_map(|y| (part.x0..part.x1).map(move |x| (x, y)));
    let index = |(x, y): (u32, u32)| (y - tile.y0) as usize * tile.width() as usize + (x - tile.x0) as usize;
    let sum = places.map(|place| pixels[index(place)].stats().mean()).fold(Rgb::BLACK, |a, b| a + b);
    sum * (1.0 / part.area().max(1) as f32)
}

/// Work that is shown.
#[derive(Debug)]
pub(crate) struct Shown<'w, W> {
    /// What renders.
    pub(crate) work: &'w W,
    /// Where it is shown, if it is.
    pub(crate) preview: Option<&'w Preview>,
}

impl<P: Pixel, W: Work<P>> Work<P> for Shown<'_, W> {
    fn render(&self, tile: PixelRect, samples: Range<u32>, pixels: &mut [P]) -> DifferenceSums {
        let sums = self.work.render(tile, samples, pixels);
        if let Some(preview) = self.preview {
            preview.update(tile, pixels);
        }
        sums
    }

    fn refine(
        &self,
        tile: &mut AdaptiveTile,
        target: &Target,
        pixels: &mut [P],
        go_on: &dyn Fn() -> bool,
    ) -> u64 {
        let taken = self.work.refine(tile, target, pixels, go_on);
        if let Some(preview) = self.preview.filter(|_| taken > 0) {
            preview.update(tile.rect(), pixels);
        }
        taken
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use halflight::estimate::PixelStats;

    #[test]
    fn a_preview_is_the_mean_of_what_it_covers() {
        let crop = PixelRect { x0: 10, y0: 20, x1: 266, y1: 84 };
        let mut canvas = Canvas::new(crop, (80, 20));
        let tile = |x0: u32, y0: u32| PixelRect { x0, y0, x1: x0 + 32, y1: y0 + 32 };
        for (x, y) in (0..8).flat_map(|x| (0..2).map(move |y| (x, y))) {
            let rect = tile(10 + 32 * x, 20 + 32 * y);
            let pixels: Vec<_> = (0..32 * 32)
                .map(|i| {
                    let mut pixel = PixelStats::default();
                    pixel.add(Rgb::splat((rect.x0 - 10 + i % 32) as f32 / 256.0));
                    pixel
                })
                .collect();
            canvas.update(rect, &pixels);
        }
        for (i, p) in canvas.pixels.iter().enumerate() {
            let expected = ((i % 80) as f32 + 0.5) / 80.0;
            assert!((p.g - expected).abs() < 0.02, "{i}: {p:?} is not {expected}");
        }
    }
}
