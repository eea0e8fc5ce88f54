//! Whether two pictures differ by more than their noise.

use crate::picture::Picture;

/// Standard errors of a picture's pixels, those of red, green and blue.
pub(crate) type Errors = Picture;

/// Edge of the blocks that are judged (pixels).
const BLOCK: usize = 16;

/// How likely it may be that a block of pictures that agree is judged to differ, all blocks together.
const RISK: f64 = 1e-4;

/// How well two pictures agree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Agreement {
    /// Root of the mean square of the blocks' differences, in standard errors of them: about 1 for noise.
    pub(crate) typical: f64,
    /// The largest of them.
    pub(crate) largest: f64,
    /// What the largest of so many may be.
    pub(crate) limit: f64,
    /// Column and row of the worst block's first pixel.
    pub(crate) worst: [usize; 2],
}

impl Agreement {
    /// True when noise explains the differences.
    pub(crate) fn holds(&self) -> bool {
        self.largest <= self.limit
    }
}

/// Compares blocks of two pictures with standard errors: in a block many pixels are summed up, so that their
/// noise is normally distributed, and what is systematic adds up.
///
/// Derived: the difference of sums of independent estimates is 0 on average, and its variance the sum of
/// theirs. The limit is that of a normal distribution at [`RISK`] over the number of blocks and channels
/// (Bonferroni's inequality).
pub(crate) fn agreement(a: (&Picture, &Errors), b: (&Picture, &Errors)) -> Agreement {
    let (width, height) = (a.0.width as usize, a.0.height as usize);
    let (mut squares, mut count, mut largest, mut worst) = (0.0, 0.0, 0.0, [0, 0]);
    for y in (0..height).step_by(BLOCK) {
        for x in (0..width).step_by(BLOCK) {
            for channel in 0..3 {
                let (mut difference, mut variance) = (0.0_f64, 0.0_f64);
                for row in y..(y + BLOCK).min(height) {
                    for i in (x..(x + BLOCK).min(width)).map(|column| row * width + column) {
                        let of = |p: &Picture| f64::from(p.pixels[i].to_array()[channel]);
                        difference += of(a.0) - of(b.0);
                        variance += of(a.1).powi(2) + of(b.1).powi(2);
                    }
                }
                let z = if difference == 0.0 { 0.0 } else { difference.abs() / variance.sqrt() };
                squares += z * z;
                count += 1.0;
                if z > largest {
                    (largest, worst) = (z, [x, y]);
                }
            }
        }
    }
    Agreement { typical: (squares / count).sqrt(), largest, limit: normal_limit(RISK / count), worst }
}

/// What a normal variable exceeds, to either side, with a small probability.
///
/// Source: Abramowitz and Stegun 1964, *Handbook of Mathematical Functions*, 26.2.23: off by less than
/// 4.5e-4.
fn normal_limit(probability: f64) -> f64 {
    let t = (-2.0 * (0.5 * probability).ln()).sqrt();
    let above = 2.515_517 + t * (0.802_853 + t * 0.010_328);
    t - above / (1.0 + t * (1.432_788 + t * (0.189_269 + t * 0.001_308)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use halflight::Rgb;

    #[test]
    fn limits_are_those_of_tables() {
        for (probability, limit) in [(0.05, 1.959_96), (0.01, 2.575_83), (1e-6, 4.891_64)] {
            assert!((normal_limit(probability) - limit).abs() < 5e-4, "{probability}");
        }
    }

    /// A picture whose pixels are off by a reproducible noise of deviation 0.1, and brighter by `bias`.
    fn noisy(seed: u64, bias: f32) -> Picture {
        let mut state = seed;
        let mut uniform = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f32 / (1_u64 << 24) as f32
        };
        // The sum of twelve has the deviation 1.
        let mut noise = || 0.1 * ((0..12).map(|_| uniform()).sum::<f32>() - 6.0);
        let pixels = (0..64 * 48).map(|_| Rgb::new(1.0 + noise(), 1.0 + noise(), 1.0 + bias + noise()));
        Picture { width: 64, height: 48, pixels: pixels.collect() }
    }

    #[test]
    fn noise_is_told_from_a_bias_that_is_smaller() {
        let errors = Picture { width: 64, height: 48, pixels: vec![Rgb::splat(0.1); 64 * 48] };
        let judged = |bias| agreement((&noisy(1, 0.0), &errors), (&noisy(2, bias), &errors));
        let same = judged(0.0);
        assert!(same.holds() && (0.6..1.4).contains(&same.typical), "{same:?}");
        // 0.6 deviations of a pixel are 0.6 √(16²/2) of a block.
        let other = judged(0.06);
        assert!(!other.holds(), "{other:?}");
        let exact = Picture { pixels: vec![Rgb::BLACK; 64 * 48], ..errors };
        let [a, b] = [noisy(1, 0.0), noisy(2, 0.0)];
        assert!(agreement((&a, &exact), (&a, &exact)).holds(), "equal pictures without noise");
        assert!(!agreement((&a, &exact), (&b, &exact)).holds(), "other ones");
    }
}
