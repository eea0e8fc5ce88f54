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
    crop: PixelRect,
    /// Columns and rows of what is shown.
    size: (u32, u32),
    showing: Showing,
    state: Mutex<State>,
}

#[derive(Debug)]
struct State {
    pixels: Vec<Rgb>,
    screen: Screen,
    /// When it was drawn; `None` before the first time.
    drawn: Option<Instant>,
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
        let size = screen.pixels();
        let pixels = vec![Rgb::BLACK; size.0 as usize * size.1 as usize];
        Some(Self { crop, size, showing, state: Mutex::new(State { pixels, screen, drawn: None }) })
    }

    /// Takes in a tile, row by row, and draws if it was not just drawn.
    fn update<P: Pixel>(&self, tile: PixelRect, pixels: &[P]) {
        let Ok(mut state) = self.state.lock() else { return };
        let (width, height) = (self.crop.width(), self.crop.height());
        // Where a shown pixel begins in the film.
        let column =
            |x: u32| self.crop.x0 + (u64::from(x) * u64::from(width) / u64::from(self.size.0)) as u32;
        let row = |y: u32| self.crop.y0 + (u64::from(y) * u64::from(height) / u64::from(self.size.1)) as u32;
        for y in (0..self.size.1).filter(|y| (tile.y0..tile.y1).contains(&row(*y))) {
            for x in (0..self.size.0).filter(|x| (tile.x0..tile.x1).contains(&column(*x))) {
                let (x1, y1) =
                    (column(x + 1).clamp(column(x) + 1, tile.x1), row(y + 1).clamp(row(y) + 1, tile.y1));
                let part = PixelRect { x0: column(x), y0: row(y), x1, y1 };
                state.pixels[(y * self.size.0 + x) as usize] = mean(tile, pixels, part);
            }
        }
        if state.drawn.is_none_or(|drawn| drawn.elapsed() >= PAUSE) {
            self.draw(&mut state);
        }
    }

    /// Draws it as it is.
    fn draw(&self, state: &mut State) {
        let pixels: Vec<_> = self.showing.codes(&state.pixels).collect();
        state.screen.draw(&pixels);
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
        let preview = Preview::begin(PreviewHow::Blocks, crop, Showing::default()).unwrap();
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
            preview.update(rect, &pixels);
        }
        let (width, height) = preview.size;
        assert!(width < 256 && height < 64, "{width} {height}");
        let state = preview.state.lock().unwrap();
        for (i, p) in state.pixels.iter().enumerate() {
            let expected = ((i as u32 % width) as f32 + 0.5) / width as f32;
            assert!((p.g - expected).abs() < 0.02, "{i}: {p:?} is not {expected}");
        }
    }
}
