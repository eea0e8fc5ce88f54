//! The picture's raster and its reconstruction filter.

use crate::num;
use core::fmt;

/// Largest width or height of a film (pixels).
pub const MAX_RESOLUTION: u32 = 1 << 16;

/// How samples near a pixel make up its value.
///
/// A filter is realised by drawing the sample's place from it, so that every sample has the same
/// weight, pixels are independent of one another, and the mean and variance of a pixel are those of
/// its samples.
///
/// Source: Ernst, Stamminger, Greiner 2006, *Filter Importance Sampling*, IEEE RT.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Filter {
    /// The same weight up to `radius` (pixels); ½ is the pixel itself.
    Box {
        /// Half of its width (pixels).
        radius: f32,
    },
    /// Weight falling linearly to 0 at `radius` (pixels).
    Tent {
        /// Half of its width (pixels).
        radius: f32,
    },
    /// A bell of the given standard deviation, cut off at four of them (pixels).
    Gaussian {
        /// Standard deviation (pixels).
        stddev: f32,
    },
}

impl Filter {
    /// The pixel itself.
    pub const PIXEL: Self = Self::Box { radius: 0.5 };

    /// An offset from the pixel's centre (pixels), distributed as the filter.
    #[inline]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> [f32; 2] {
        match *self {
            Self::Box { radius } => u.map(|u| (2.0 * u - 1.0) * radius),
            Self::Tent { radius } => u.map(|u| tent(u) * radius),
            Self::Gaussian { stddev } => u.map(|u| bell(u) * stddev),
        }
    }

    /// Largest offset from the pixel's centre, along either axis (pixels).
    const fn reach(&self) -> f32 {
        match *self {
            Self::Box { radius } | Self::Tent { radius } => radius,
            Self::Gaussian { stddev } => 4.01 * stddev,
        }
    }

    /// The filter's length in pixels, which must be positive and finite.
    const fn extent(&self) -> f32 {
        match *self {
            Self::Box { radius } | Self::Tent { radius } => radius,
            Self::Gaussian { stddev } => stddev,
        }
    }
}

/// How far around its pixels a part of the picture is taken to reach (pixels): more than places are rounded.
const CORNER_SLACK: f32 = 1.0 / 64.0;

/// Inverse of the cumulative tent on [−1, 1].
#[inline]
fn tent(u: f32) -> f32 {
    if u < 0.5 { num::sqrt(2.0 * u) - 1.0 } else { 1.0 - num::sqrt(2.0 - 2.0 * u) }
}

/// Fraction of a normal distribution below −4 standard deviations.
const BELOW_FOUR_SIGMA: f32 = 3.167_124_2e-5;

/// Inverse of the cumulative normal distribution, cut off at ±4.
///
/// Source: Giles 2010, *Approximating the erfinv Function*, GPU Computing Gems, table 5 (single
/// precision).
#[inline]
fn bell(u: f32) -> f32 {
    // x = 2 Φ − 1, with Φ in [Φ(−4), Φ(4)].
    let x = (2.0 * u - 1.0) * (1.0 - 2.0 * BELOW_FOUR_SIGMA);
    let w = -num::ln((1.0 - x) * (1.0 + x));
    let p = if w < 5.0 {
        horner(
            w - 2.5,
            &[
                2.810_226_4e-8,
                3.432_739_4e-7,
                -3.523_387_7e-6,
                -4.391_506_5e-6,
                0.000_218_580_87,
                -0.001_253_725,
                -0.004_177_681_6,
                0.246_640_73,
                1.501_409_4,
            ],
        )
    } else {
        horner(
            num::sqrt(w) - 3.0,
            &[
                -0.000_200_214_26,
                0.000_100_950_56,
                0.001_349_343_2,
                -0.003_673_428_4,
                0.005_739_507_7,
                -0.007_622_461_3,
                0.009_438_870_5,
                1.001_674,
                2.832_976_8,
            ],
        )
    };
    core::f32::consts::SQRT_2 * p * x
}

/// Evaluates a polynomial, highest coefficient first.
#[inline]
fn horner(x: f32, coefficients: &[f32]) -> f32 {
    coefficients.iter().fold(0.0, |sum, c| sum * x + c)
}

/// A rectangle of pixels: `x0 ≤ x < x1`, `y0 ≤ y < y1`, rows from the top.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelRect {
    /// First column.
    pub x0: u32,
    /// First row.
    pub y0: u32,
    /// One past the last column.
    pub x1: u32,
    /// One past the last row.
    pub y1: u32,
}

impl PixelRect {
    /// Number of columns.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.x1 - self.x0
    }

    /// Number of rows.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.y1 - self.y0
    }

    /// Number of pixels.
    #[must_use]
    pub const fn area(&self) -> usize {
        self.width() as usize * self.height() as usize
    }
}

/// The raster of a picture. Row 0 is on top.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Film {
    width: u32,
    height: u32,
    crop: PixelRect,
    filter: Filter,
}

/// Why a film was refused.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum FilmError {
    /// Width or height is 0 or above [`MAX_RESOLUTION`].
    Resolution {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
    },
    /// The filter's radius or standard deviation is not in `(0, 100]` pixels.
    Filter(f32),
    /// The crop window is empty or reaches beyond the film.
    Crop(PixelRect),
}

impl fmt::Display for FilmError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Resolution { width, height } => write!(
                f,
                "the film is {width}×{height} pixels; width and height must be between 1 and {MAX_RESOLUTION}"
            ),
            Self::Filter(r) => {
                write!(f, "the filter's extent is {r} pixels; it must be above 0 and at most 100")
            }
            Self::Crop(PixelRect { x0, y0, x1, y1 }) => {
                write!(f, "the crop window {x0},{y0},{x1},{y1} is empty or reaches beyond the film")
            }
        }
    }
}

impl core::error::Error for FilmError {}

impl Film {
    /// A film of `width` × `height` pixels.
    ///
    /// # Errors
    /// When a side is 0 or above [`MAX_RESOLUTION`], or the filter has no usable extent.
    pub const fn new(width: u32, height: u32, filter: Filter) -> Result<Self, FilmError> {
        if width == 0 || width > MAX_RESOLUTION || height == 0 || height > MAX_RESOLUTION {
            return Err(FilmError::Resolution { width, height });
        }
        let extent = filter.extent();
        if !(extent > 0.0 && extent <= 100.0) {
            return Err(FilmError::Filter(extent));
        }
        Ok(Self { width, height, crop: PixelRect { x0: 0, y0: 0, x1: width, y1: height }, filter })
    }

    /// The same film, of which only a part is wanted.
    ///
    /// # Errors
    /// When the window is empty or reaches beyond the film.
    pub fn with_crop(self, crop: PixelRect) -> Result<Self, FilmError> {
        let PixelRect { x0, y0, x1, y1 } = crop;
        if x0 < x1 && y0 < y1 && x1 <= self.width && y1 <= self.height {
            Ok(Self { crop, ..self })
        } else {
            Err(FilmError::Crop(crop))
        }
    }

    /// Columns of the whole picture.
    #[must_use]
    pub const fn width(&self) -> u32 {
        self.width
    }

    /// Rows of the whole picture.
    #[must_use]
    pub const fn height(&self) -> u32 {
        self.height
    }

    /// The part that is wanted.
    #[must_use]
    pub const fn crop(&self) -> PixelRect {
        self.crop
    }

    /// The reconstruction filter.
    #[must_use]
    pub const fn filter(&self) -> Filter {
        self.filter
    }

    /// The place in the picture of a sample of pixel (x, y), as [`crate::Camera::ray`] takes it.
    #[inline]
    #[must_use]
    pub fn place(&self, x: u32, y: u32, u: [f32; 2]) -> (f32, f32) {
        let [dx, dy] = self.filter.sample(u);
        let across = (x as f32 + 0.5 + dx) / self.width as f32;
        let down = (y as f32 + 0.5 + dy) / self.height as f32;
        (2.0 * across - 1.0, 1.0 - 2.0 * down)
    }

    /// Four places in the picture, in order around it, between which lie those of all samples of some pixels.
    pub(crate) fn corners(&self, pixels: PixelRect) -> [(f32, f32); 4] {
        let reach = self.filter.reach() + CORNER_SLACK;
        let place = |x: f32, y: f32| (2.0 * x / self.width as f32 - 1.0, 1.0 - 2.0 * y / self.height as f32);
        let (left, right) = (pixels.x0 as f32 + 0.5 - reach, pixels.x1 as f32 - 0.5 + reach);
        let (top, bottom) = (pixels.y0 as f32 + 0.5 - reach, pixels.y1 as f32 - 0.5 + reach);
        [place(left, top), place(right, top), place(right, bottom), place(left, bottom)]
    }

    /// The pixel that a place in the picture is in, as [`Film::place`] returns it; `None` outside.
    #[must_use]
    pub fn pixel(&self, (x, y): (f32, f32)) -> Option<(u32, u32)> {
        let is_inside = |v: f32| (-1.0..1.0).contains(&v);
        let column = (0.5 * (x + 1.0) * self.width as f32) as u32;
        let row = (0.5 * (1.0 - y) * self.height as f32) as u32;
        (is_inside(x) && is_inside(-y)).then(|| (column.min(self.width - 1), row.min(self.height - 1)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Mean square of the offsets over a fine grid.
    fn variance(filter: Filter) -> f64 {
        let n = 100_000;
        (0..n)
            .map(|i| {
                let [x, y] = filter.sample([(i as f32 + 0.5) / n as f32, 0.5]);
                assert!(y.abs() < 1e-6, "the middle of the filter is its centre");
                f64::from(x).powi(2)
            })
            .sum::<f64>()
            / n as f64
    }

    #[test]
    fn offsets_have_the_variance_of_their_filter() {
        // r²/3, r²/6, and σ² less the tails beyond 4 σ: 1 − 8 φ(4)/(2Φ(4) − 1).
        assert!((variance(Filter::PIXEL) - 0.25 / 3.0).abs() < 1e-5);
        assert!((variance(Filter::Tent { radius: 1.0 }) - 1.0 / 6.0).abs() < 1e-5);
        assert!(
            (variance(Filter::Gaussian { stddev: 0.5 }) - 0.25 * (1.0 - 8.0 * 1.338_302e-4)).abs() < 2e-5
        );
    }

    #[test]
    fn the_middle_of_a_pixel_is_in_it() {
        let film = Film::new(7, 3, Filter::PIXEL).unwrap();
        for (x, y) in [(0, 0), (6, 2), (3, 1)] {
            assert_eq!(film.pixel(film.place(x, y, [0.5, 0.5])), Some((x, y)));
        }
        for place in [(1.0, 0.0), (-1.1, 0.0), (0.0, -1.0), (f32::NAN, 0.0)] {
            assert_eq!(film.pixel(place), None, "{place:?}");
        }
    }

    #[test]
    fn the_bell_ends_at_four_standard_deviations() {
        let f = Filter::Gaussian { stddev: 1.0 };
        assert!((f.sample([0.0, 0.5])[0] + 4.0).abs() < 1e-3);
        assert!((f.sample([num::ONE_MINUS_EPSILON, 0.5])[0] - 4.0).abs() < 1e-2);
    }

    #[test]
    fn rows_start_at_the_top() {
        let film = Film::new(2, 2, Filter::PIXEL).unwrap();
        assert_eq!(film.place(0, 0, [0.5, 0.5]), (-0.5, 0.5));
        assert_eq!(film.place(1, 1, [0.5, 0.5]), (0.5, -0.5));
    }

    #[test]
    fn impossible_films_are_refused() {
        assert!(Film::new(0, 1, Filter::PIXEL).is_err());
        assert!(Film::new(1, MAX_RESOLUTION + 1, Filter::PIXEL).is_err());
        assert!(Film::new(1, 1, Filter::Tent { radius: f32::NAN }).is_err());
        let film = Film::new(4, 4, Filter::PIXEL).unwrap();
        assert!(film.with_crop(PixelRect { x0: 1, y0: 1, x1: 1, y1: 2 }).is_err());
        assert!(film.with_crop(PixelRect { x0: 1, y0: 1, x1: 5, y1: 2 }).is_err());
    }
}
