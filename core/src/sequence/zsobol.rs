//! Owen-scrambled Sobol points, dealt out to the pixels along a Z.

use super::points::{coordinate, point};
use super::sobol::of_first;
use super::{Dimension, Sequence};
use crate::num;

/// Binary digits of a pixel's place in its tile, both coordinates together: tiles of 256 × 256.
const TILE_BITS: u32 = 16;

/// Owen-scrambled Sobol points that neighbouring pixels share.
///
/// The pixels of a tile stand in Z-order: each quarter of it, each quarter of that, and so on, is a run
/// of pixels. One sequence is dealt out along that order, so many points to each pixel in turn; every
/// square of 1, 4, 16, … pixels then has one well-spread set of points. The error of a pixel is
/// what its neighbours lack: it looks finer, and is smaller after any blur. The runs are
/// shuffled, which keeps them runs; within a pixel the points are as those of [`super::Sobol`].
///
/// Source: Ahmed, Wonka 2020, *Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via
/// Hierarchical Ordering of Pixels*, ACM Trans. Graph. 39(6), sections 3 and 4. Differs: the 24
/// orders of a square's quarters come as three pairings, the same for every decision, and Owen's random
/// flips of binary digits, another for each; tiles, each with a scramble of its own, so that 32 bits
/// suffice for any film and sample count.
#[derive(Debug, Clone)]
pub struct ZSobol {
    seed: u32,
    width: u32,
    samples: u32,
    /// The pixel that all below belongs to, where it stands in its tile, and the tile's seed.
    pixel: u32,
    place: u32,
    tile_seed: u32,
    sample: u32,
    /// The decision that follows the place in the pixel, and that place.
    first: [f32; 4],
}

impl ZSobol {
    /// A sequence for one picture; another seed gives other noise.
    ///
    /// * `width` – of the film (pixels); pixel number `y * width + x` is at column x of row y
    /// * `samples` – how many each pixel will take. With fewer, neighbours share less; with more,
    ///   each further as many begin another scramble
    #[must_use]
    pub const fn new(seed: u32, width: u32, samples: u32) -> Self {
        let (width, samples) = (if width == 0 { 1 } else { width }, if samples == 0 { 1 } else { samples });
        let sequence =
            Self { seed, width, samples, pixel: 0, place: 0, tile_seed: 0, sample: 0, first: [0.0; 4] };
        sequence.at(0)
    }

    /// The sequence turned to a pixel.
    #[inline]
    const fn at(mut self, pixel: u32) -> Self {
        let (x, y) = (pixel % self.width, pixel / self.width);
        self.pixel = pixel;
        self.tile_seed = num::hash2(num::hash2(x >> 8, y >> 8), self.seed);
        self.place = paired(spread(x) | spread(y) << 1, self.tile_seed);
        self
    }

    /// Index within a scramble, and the scramble's seed.
    #[inline]
    fn index(&self, dimension: Dimension, draw: u32, draws: u32) -> (u32, u32) {
        let own = u64::from(self.sample) * u64::from(draws) + u64::from(draw);
        let reserved = u64::from(self.samples) * u64::from(draws);
        // The smallest power of two that holds a pixel's points; what is left of 32 bits is for the place.
        let bits = (u64::BITS - (reserved - 1).leading_zeros()).min(32);
        let kept = (32 - bits).min(TILE_BITS);
        let place = self.place & ((1 << kept) - 1);
        let index = u64::from(place) << bits | own & ((1 << bits) - 1);
        let scramble = (own >> bits) as u32;
        let outside = num::hash(self.place >> kept) ^ num::hash(scramble).rotate_left(16);
        (index as u32, num::hash2(self.tile_seed, dimension.key() ^ outside))
    }
}

/// The lower 8 bits of `x`, each followed by a 0.
#[inline]
const fn spread(x: u32) -> u32 {
    let x = (x & 0xff | x << 4) & 0x0f0f;
    let x = (x | x << 2) & 0x3333;
    (x | x << 1) & 0x5555
}

/// Joins the four quarters of each square in pairs: beside, above or across from one another, at
/// random. Without it all pairs stand side by side, which shows as stripes.
#[inline]
const fn paired(place: u32, seed: u32) -> u32 {
    let (mut order, mut shift) = (0, TILE_BITS);
    while shift > 0 {
        shift -= 2;
        let (x, y) = (place >> shift & 1, place >> (shift + 1) & 1);
        let square = num::hash(seed ^ (place >> (shift + 2) << 5 | shift));
        let (pair, member) = match square % 3 {
            0 => (y, x),
            1 => (x, y),
            _ => (x ^ y, x),
        };
        order = order << 2 | pair << 1 | member;
    }
    order
}

impl Sequence for ZSobol {
    #[inline]
    fn start(&mut self, pixel: u32, sample: u32) {
        if pixel != self.pixel {
            *self = self.clone().at(pixel);
        }
        self.sample = sample;
        let (index, seed) = self.index(Dimension::Film, 0, 1);
        self.first = point(index, seed);
    }

    #[inline]
    fn point(&mut self, dimension: Dimension, draw: u32, draws: u32) -> [f32; 2] {
        of_first(self.first, dimension, draws).unwrap_or_else(|| {
            let (index, seed) = self.index(dimension, draw, draws);
            let [x, y, _, _] = point(index, seed);
            [x, y]
        })
    }

    #[inline]
    fn choice(&mut self, dimension: Dimension, draw: u32, draws: u32) -> f32 {
        let (index, seed) = self.index(dimension, draw, draws);
        coordinate(index, 2, seed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    /// Light points of the `side` × `side` pixels from (x0, y0), all `samples` of each.
    fn square(
        mut s: ZSobol,
        dimension: Dimension,
        x0: u32,
        y0: u32,
        side: u32,
        samples: u32,
    ) -> Vec<[f32; 2]> {
        let mut points = Vec::new();
        for (x, y) in (y0..y0 + side).flat_map(|y| (x0..x0 + side).map(move |x| (x, y))) {
            for sample in 0..samples {
                s.start(y * s.width + x, sample);
                points.push(s.point(dimension, 0, 1));
            }
        }
        points
    }

    #[test]
    fn squares_of_pixels_share_one_set_of_points() {
        for (x0, y0, side, samples) in [(0, 0, 16, 1), (16, 32, 8, 4), (300, 520, 4, 16), (777, 3, 1, 256)] {
            for dimension in [Dimension::Light(0), Dimension::Light(1), Dimension::Bsdf] {
                let s = ZSobol::new(5, 1000, samples);
                let mut cells = [0; 256];
                for [x, y] in square(s, dimension, x0, y0, side, samples) {
                    cells[(x * 16.0) as usize * 16 + (y * 16.0) as usize] += 1;
                }
                assert_eq!(cells, [1; 256], "{x0} {y0} {side} {samples} {dimension:?}");
            }
        }
    }

    #[test]
    fn any_beginning_of_a_pixel_is_well_spread() {
        let mut s = ZSobol::new(5, 640, 200);
        for shown in [1_u32, 2, 4, 8, 16, 32, 64, 128] {
            let mut cells = std::vec![0; shown as usize];
            for sample in 0..shown {
                s.start(12_345, sample);
                cells[(s.point(Dimension::Light(4), 0, 1)[1] * shown as f32) as usize] += 1;
            }
            assert!(cells.iter().all(|&n| n == 1), "{shown}");
        }
    }

    #[test]
    fn any_film_and_sample_count_has_points_of_its_own() {
        for (samples, draws) in [(1, 1), (1 << 20, 1), (u32::MAX, 1), (u32::MAX, u32::MAX), (3, 5)] {
            let mut s = ZSobol::new(1, 65_536, samples);
            let mut seen = Vec::new();
            for pixel in [0, 1, 255, 256, 65_536, 65_537, 0x0100_0000, u32::MAX] {
                for sample in [0, samples - 1, samples / 2, samples.saturating_add(7)] {
                    s.start(pixel, sample);
                    let [x, y] = s.point(Dimension::Bsdf, draws - 1, draws);
                    assert!((0.0..1.0).contains(&x) && (0.0..1.0).contains(&y));
                    seen.push((pixel, sample, x.to_bits(), y.to_bits()));
                }
            }
            seen.sort_unstable();
            seen.dedup();
            let points = seen.len();
            seen.sort_unstable_by_key(|s| (s.2, s.3));
            seen.dedup_by_key(|s| (s.2, s.3));
            assert_eq!(seen.len(), points, "{samples} {draws}");
        }
    }

    #[test]
    fn neighbours_lack_what_a_pixel_has_and_strangers_do_not_care() {
        // The error of the mean of x over 16 samples in a pixel, times that of another pixel.
        let error = |seed, x: u32, y: u32| {
            let s = ZSobol::new(seed, 640, 16);
            square(s, Dimension::Light(0), x, y, 1, 16).iter().map(|p| p[0] - 0.5).sum::<f32>() / 16.0
        };
        let runs = 4096;
        let correlation = |x: u32, y: u32| {
            let square = |x: f32| x * x;
            let (mut product, mut variance) = (0.0, 0.0);
            for seed in 0..runs {
                product += error(seed, 100, 60) * error(seed, x, y);
                variance += square(error(seed, 100, 60));
            }
            product / variance
        };
        let quad = correlation(101, 60) + correlation(100, 61) + correlation(101, 61);
        assert!(quad < -0.6, "{quad}");
        let bound = 5.0 / (runs as f32).sqrt();
        for (x, y) in [(228, 60), (300, 60), (100, 400)] {
            assert!(correlation(x, y).abs() < bound, "{x} {y}: {}", correlation(x, y));
        }
    }
}
