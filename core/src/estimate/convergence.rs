//! How large the error is, judged from the samples alone.
//!
//! The samples of a pixel come in passes that double their number. When `n` samples give the mean
//! `A` and `n` more give `B`, the final mean is `M = (A + B)/2`, and `(M − A)² = (A − B)²/4`. For
//! independent samples its expectation is the variance of `M`. Sobol points are not independent:
//! the second half fills the gaps of the first, so the halves deviate in opposite directions and the
//! difference exaggerates. If doubling divides the variance by ρ, then
//! `E (A − B)²/4 = (ρ − 1) Var M` (insert `Var A = Var B = ρ Var M` into
//! `Var M = (Var A + Var B + 2 Cov)/4`); ρ = 2 for independent samples. The same holds one pass
//! earlier, so ρ itself is the ratio of the differences of successive passes. Nets of some sizes are
//! better than their neighbours, so the mean ratio of the last three passes is taken. (Derived here.)

/// Smallest and largest divisor of the variance per doubling: independent points, and the best that
/// scrambled nets reach on smooth integrands (`n⁻³`).
const RATE: (f64, f64) = (2.0, 8.0);

/// Weighted squared differences between the means before and after a pass, over some pixels.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DifferenceSums {
    sum: f64,
    values: u64,
}

impl DifferenceSums {
    /// Takes a value in that went from `before` (of `n0` samples) to `after` (of `n1`).
    ///
    /// The square is divided by `after² + 0.01`, as relMSE does, and brought to what doubling
    /// would have shown.
    #[inline]
    pub(super) fn add(&mut self, before: f32, after: f32, n0: u32, n1: u32) {
        let difference = f64::from(after - before);
        let doubling = f64::from(n0) / f64::from(n1 - n0);
        self.sum += difference * difference * doubling / (f64::from(after) * f64::from(after) + 0.01);
        self.values += 1;
    }

    /// Takes in what other pixels have seen.
    pub fn merge(&mut self, other: Self) {
        self.sum += other.sum;
        self.values += other.values;
    }

    /// The sum and how many values are in it, for sending them elsewhere.
    #[must_use]
    pub const fn to_parts(self) -> (f64, u64) {
        (self.sum, self.values)
    }

    /// What [`DifferenceSums::to_parts`] was made from.
    #[must_use]
    pub const fn from_parts((sum, values): (f64, u64)) -> Self {
        Self { sum, values }
    }

    /// Mean over the values; `None` without any.
    fn mean(&self) -> Option<f64> {
        (self.values > 0).then(|| self.sum / self.values as f64)
    }
}

/// The record of a picture's passes, and the error that follows from it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Convergence {
    /// Mean squared differences of the last three passes that doubled the samples, newest first.
    doublings: [Option<f64>; 3],
    /// Samples after the last doubling, and now.
    doubled_at: u32,
    samples: u32,
}

impl Convergence {
    /// Nothing rendered yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Records a pass over the whole picture that brought its pixels to `samples` each.
    pub fn record(&mut self, samples: u32, sums: &DifferenceSums) {
        let doubled = self.samples > 0 && samples >= 2 * self.samples;
        self.samples = samples;
        if let (true, Some(mean)) = (doubled, sums.mean()) {
            let [last, previous, _] = self.doublings;
            self.doublings = [Some(mean), last, previous];
            self.doubled_at = samples;
        }
    }

    /// Estimated relMSE of the picture: `mean((I − R)² / (R² + 0.01))` over pixels and channels.
    /// `None` before the second sample.
    #[must_use]
    pub fn relative_mse(&self) -> Option<f64> {
        let [last, previous, earlier] = self.doublings;
        let last = last?;
        let rate = match (previous, earlier) {
            (_, Some(earlier)) if last > 0.0 => libm::sqrt(earlier / last),
            (Some(previous), None) if last > 0.0 => previous / last,
            _ => RATE.0,
        };
        let rate = rate.clamp(RATE.0, RATE.1);
        // Samples since the last doubling count as independent ones.
        let since = f64::from(self.doubled_at) / f64::from(self.samples);
        Some(last / (rate - 1.0) * since)
    }

    /// Estimated relative error `√relMSE`, as a fraction.
    #[must_use]
    pub fn relative_error(&self) -> Option<f64> {
        self.relative_mse().map(libm::sqrt)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rgb;
    use crate::estimate::{PixelStats, passes};
    use crate::sequence::{Dimension, Random, Sequence, Sobol};

    /// Estimated and true relMSE of a picture of `pixels` integrals of `f(pixel, point)`.
    fn errors(
        mut sequence: impl Sequence,
        samples: u32,
        f: impl Fn(f32, [f32; 2]) -> f32,
        exact: impl Fn(f32) -> f64,
    ) -> (f64, f64) {
        let mut pixels = [PixelStats::NEW; 2048];
        let mut convergence = Convergence::new();
        for pass in passes(samples) {
            let mut sums = DifferenceSums::default();
            for (i, pixel) in pixels.iter_mut().enumerate() {
                let before = *pixel;
                for sample in pass.clone() {
                    sequence.start(i as u32, sample);
                    let u = sequence.point(Dimension::Light(0), 0, 1);
                    pixel.add(Rgb::splat(f(i as f32 / 2048.0, u)));
                }
                if before.count() > 0 {
                    sums.add(before.mean().r, pixel.mean().r, before.count(), pixel.count());
                }
            }
            convergence.record(pass.end, &sums);
        }
        let truth = pixels.iter().enumerate().map(|(i, p)| {
            let r = exact(i as f32 / 2048.0);
            (f64::from(p.mean().r) - r).powi(2) / (r * r + 0.01)
        });
        (convergence.relative_mse().unwrap(), truth.sum::<f64>() / 2048.0)
    }

    /// A penumbra: a straight edge at a slant, at another place in each pixel.
    fn edge(p: f32, u: [f32; 2]) -> f32 {
        if u[0] + 0.3 * u[1] < 0.3 + 0.7 * p { 1.0 } else { 0.0 }
    }

    fn edge_exact(p: f32) -> f64 {
        0.15 + 0.7 * f64::from(p)
    }

    #[test]
    fn the_estimate_is_the_error_of_independent_samples() {
        for samples in [16, 64, 100, 256] {
            let (estimate, truth) = errors(Random::<rand_pcg::Pcg32>::new(3), samples, edge, edge_exact);
            assert!((estimate / truth - 1.0).abs() < 0.2, "{samples}: {estimate} {truth}");
        }
    }

    #[test]
    fn the_estimate_follows_the_faster_convergence_of_sobol_points() {
        for samples in [16, 64, 256] {
            let (estimate, truth) = errors(Sobol::new(3), samples, edge, edge_exact);
            assert!((0.6..1.6).contains(&(estimate / truth)), "{samples}: {estimate} {truth}");
        }
        // A smooth integrand converges as n⁻³; assuming independent halves would say seven times too much.
        let smooth = |p: f32, u: [f32; 2]| 1.0 + p * u[0] * u[1];
        for samples in [16, 64, 256] {
            let (estimate, truth) = errors(Sobol::new(3), samples, smooth, |p| 1.0 + 0.25 * f64::from(p));
            assert!((0.5..2.0).contains(&(estimate / truth)), "{samples}: {estimate} {truth}");
        }
    }

    #[test]
    fn one_sample_says_nothing() {
        let mut convergence = Convergence::new();
        convergence.record(1, &DifferenceSums::default());
        assert_eq!(convergence.relative_error(), None);
    }
}
