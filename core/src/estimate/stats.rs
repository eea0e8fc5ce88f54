//! What is known of a pixel so far.

use super::Observer;
use crate::Rgb;

/// Running mean and variance of a pixel's samples.
///
/// Source: Welford 1962, *Note on a Method for Calculating Corrected Sums of Squares and Products*,
/// Technometrics 4(3): never negative, and exact for constant samples.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[repr(C)]
pub struct PixelStats {
    mean: Rgb,
    squares: Rgb,
    count: u32,
    rejected: u32,
}

impl PixelStats {
    /// Nothing known yet.
    pub const NEW: Self = Self { mean: Rgb::BLACK, squares: Rgb::BLACK, count: 0, rejected: 0 };

    /// Takes a sample in. One that is not finite is counted as rejected and does not reach the mean.
    /// A negative one does: the difference of an unbiased estimator may be.
    #[inline]
    pub fn add(&mut self, sample: Rgb) {
        if !sample.is_finite() {
            self.rejected = self.rejected.saturating_add(1);
            return;
        }
        self.count += 1;
        let delta = sample - self.mean;
        self.mean += delta * (1.0 / self.count as f32);
        self.squares += delta * (sample - self.mean);
    }

    /// Mean of the samples, but never below 0; black before the first. What is estimated is light, so
    /// a negative mean is noise, and 0 is closer to the truth.
    #[inline]
    #[must_use]
    pub const fn mean(&self) -> Rgb {
        Rgb::new(self.mean.r.max(0.0), self.mean.g.max(0.0), self.mean.b.max(0.0))
    }

    /// Sample variance per channel; 0 before the second sample.
    #[must_use]
    pub fn variance(&self) -> Rgb {
        if self.count < 2 { Rgb::BLACK } else { self.squares / (self.count - 1) as f32 }
    }

    /// Samples in the mean.
    #[inline]
    #[must_use]
    pub const fn count(&self) -> u32 {
        self.count
    }

    /// Samples that were not numbers to use.
    #[must_use]
    pub const fn rejected(&self) -> u32 {
        self.rejected
    }

    /// Every bit of it, for keeping it elsewhere: the mean and the sum of squared deviations per
    /// channel, the samples, and those rejected.
    #[must_use]
    pub const fn to_words(&self) -> [u32; 8] {
        let (m, s) = (self.mean, self.squares);
        let word = f32::to_bits;
        [word(m.r), word(m.g), word(m.b), word(s.r), word(s.g), word(s.b), self.count, self.rejected]
    }

    /// What [`PixelStats::to_words`] was made from.
    #[must_use]
    pub const fn from_words([r, g, b, rr, gg, bb, count, rejected]: [u32; 8]) -> Self {
        let float = f32::from_bits;
        let mean = Rgb::new(float(r), float(g), float(b));
        Self { mean, squares: Rgb::new(float(rr), float(gg), float(bb)), count, rejected }
    }
}

/// Where the samples of a pixel go: its mean, and whatever else it observes.
pub trait Pixel: Observer {
    /// What is known of its radiance.
    fn stats(&self) -> &PixelStats;

    /// Takes a sample in.
    fn add(&mut self, sample: Rgb);
}

impl Observer for PixelStats {}

impl Pixel for PixelStats {
    #[inline]
    fn stats(&self) -> &Self {
        self
    }

    #[inline]
    fn add(&mut self, sample: Rgb) {
        self.add(sample);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mean_of_ones_is_one_after_many_samples() {
        let mut p = PixelStats::NEW;
        for _ in 0..1 << 20 {
            p.add(Rgb::WHITE);
        }
        assert_eq!(p.mean(), Rgb::WHITE);
        assert_eq!(p.variance(), Rgb::BLACK);
    }

    #[test]
    fn variance_of_a_die_is_that_of_a_die() {
        let mut p = PixelStats::NEW;
        for i in 0..60_000u32 {
            p.add(Rgb::splat(1.0 + (i % 6) as f32));
        }
        assert!((p.mean().r - 3.5).abs() < 1e-4);
        assert!((p.variance().g - 35.0 / 12.0).abs() < 1e-3);
    }

    #[test]
    fn what_is_not_a_number_is_counted_and_left_out() {
        let mut p = PixelStats::NEW;
        p.add(Rgb::splat(2.0));
        for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            p.add(Rgb::new(1.0, bad, 1.0));
        }
        assert_eq!((p.mean(), p.count(), p.rejected()), (Rgb::splat(2.0), 1, 3));
    }

    #[test]
    fn words_keep_every_bit() {
        let mut p = PixelStats::NEW;
        for i in 0..9_u8 {
            p.add(Rgb::new(0.1, -0.2, 1e-30) * f32::from(i));
        }
        p.add(Rgb::splat(f32::NAN));
        assert_eq!(PixelStats::from_words(p.to_words()), p);
    }

    #[test]
    fn negative_samples_count_and_negative_means_do_not_show() {
        let mut p = PixelStats::NEW;
        p.add(Rgb::new(-3.0, 1.0, -1.0));
        assert_eq!(p.mean(), Rgb::new(0.0, 1.0, 0.0));
        p.add(Rgb::new(4.0, 1.0, -1.0));
        assert_eq!((p.mean(), p.count()), (Rgb::new(0.5, 1.0, 0.0), 2));
    }
}
