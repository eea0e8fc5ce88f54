//! Means with their standard errors, and the chi-square test.

use crate::{Verdict, ensure};

/// How many standard errors a mean may be off: one false alarm in 1.7 million tests.
pub const SIGMAS: f64 = 5.0;

/// Running mean and variance, after Welford 1962.
#[derive(Debug, Clone, Copy, Default)]
pub struct Moments {
    count: f64,
    mean: f64,
    squares: f64,
}

impl Moments {
    /// Of some numbers.
    pub fn of(values: impl IntoIterator<Item = f64>) -> Self {
        let mut moments = Self::default();
        values.into_iter().for_each(|v| moments.add(v));
        moments
    }

    /// Takes one more number in.
    pub fn add(&mut self, value: f64) {
        self.count += 1.0;
        let off = value - self.mean;
        self.mean += off / self.count;
        self.squares += off * (value - self.mean);
    }

    /// Mean.
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.mean
    }

    /// Variance of one number, unbiased.
    #[must_use]
    pub fn variance(&self) -> f64 {
        self.squares / (self.count - 1.0)
    }

    /// Standard error of the mean.
    #[must_use]
    pub fn standard_error(&self) -> f64 {
        (self.variance() / self.count).sqrt()
    }

    /// Checks the mean against its true value.
    ///
    /// * `rounding` – relative error that single precision may add
    ///
    /// # Errors
    /// When they are more than [`SIGMAS`] standard errors and the rounding apart.
    pub fn check_mean(&self, what: &str, truth: f64, rounding: f64) -> Verdict {
        let tolerance = SIGMAS * self.standard_error() + rounding * truth.abs();
        let off = self.mean - truth;
        ensure!(
            off.abs() <= tolerance,
            "{what}: {} ± {:.2e} instead of {truth}, {:.1} standard errors off",
            self.mean,
            self.standard_error(),
            off / self.standard_error()
        );
        Ok(())
    }

    /// Checks that two estimates are of the same thing.
    ///
    /// # Errors
    /// When they differ by more than [`SIGMAS`] standard errors of the difference and the rounding.
    pub fn check_same(&self, what: &str, other: &Self, rounding: f64) -> Verdict {
        let error = self.standard_error().hypot(other.standard_error());
        let off = self.mean - other.mean;
        ensure!(
            off.abs() <= SIGMAS * error + rounding * self.mean.abs(),
            "{what}: {} and {} are {:.1} standard errors apart",
            self.mean,
            other.mean,
            off / error
        );
        Ok(())
    }
}

/// Checks the variance of a sample against its true value.
///
/// # Errors
/// When it is more than [`SIGMAS`] of its own standard errors off; these come from the fourth moment.
pub fn check_variance(what: &str, values: &[f64], truth: f64, rounding: f64) -> Verdict {
    let moments = Moments::of(values.iter().copied());
    let (mean, variance) = (moments.mean(), moments.variance());
    let fourth = Moments::of(values.iter().map(|v| (v - mean).powi(4))).mean();
    let error = ((fourth - variance * variance) / values.len() as f64).max(0.0).sqrt();
    ensure!(
        (variance - truth).abs() <= SIGMAS * error + rounding * mean * mean,
        "{what}: variance {variance} ± {error:.2e} instead of {truth}"
    );
    Ok(())
}

/// Fewer expected than this, and a cell is pooled with others.
const POOLED_BELOW: f64 = 5.0;

/// Probability of a false alarm in the whole suite, which [`chi_square`] divides among its uses.
const SIGNIFICANCE: f64 = 1e-4;

/// At most this many chi-square tests are in the suite.
const TESTS: i32 = 200;

/// Pearson's test of counts against expected counts.
///
/// * `quadrature` – relative error of the expected counts
///
/// Cells with few expected are pooled. The significance is corrected after Šidák for the number of
/// tests in the suite.
///
/// # Errors
/// When the counts are too unlikely, or many fall where none should.
pub fn chi_square(what: &str, observed: &[u64], expected: &[f64], quadrature: f64) -> Verdict {
    let (mut statistic, mut cells) = (0.0, 0_u32);
    let (mut pool_observed, mut pool_expected) = (0.0, 0.0);
    let mut add = |o: f64, e: f64| {
        // What the quadrature may be off adds to the spread of the counts.
        let spread = e + (quadrature * e).powi(2);
        statistic += (o - e).powi(2) / spread;
        cells += 1;
    };
    for (&o, &e) in observed.iter().zip(expected) {
        if e < POOLED_BELOW {
            pool_observed += o as f64;
            pool_expected += e;
        } else {
            add(o as f64, e);
        }
    }
    if pool_expected >= POOLED_BELOW {
        add(pool_observed, pool_expected);
    } else {
        // A sliver of the light in a cell may have been missed by the quadrature.
        let slivers = 1e-4 * expected.iter().sum::<f64>();
        let bound = pool_expected + SIGMAS * pool_expected.sqrt() + slivers;
        ensure!(pool_observed <= bound, "{what}: {pool_observed} in cells that hold {pool_expected}");
    }
    ensure!(cells > 1, "{what}: only {cells} cells hold anything");
    let p = chi_square_tail(statistic, f64::from(cells - 1));
    ensure!(
        p >= 1.0 - (1.0 - SIGNIFICANCE).powf(1.0 / f64::from(TESTS)),
        "{what}: χ² = {statistic:.1} over {cells} cells, p = {p:.1e}"
    );
    Ok(())
}

/// Less likely than this, and a test of one of the 20 000 of the matrix fails: one false alarm in
/// 200 runs.
pub const MATRIX_LEVEL: f64 = 2.5e-7;

/// Probability that χ² with `freedom` degrees exceeds `x`: `Q(freedom/2, x/2)`.
#[must_use]
pub fn chi_square_tail(x: f64, freedom: f64) -> f64 {
    let (a, x) = (0.5 * freedom, 0.5 * x);
    if x <= 0.0 {
        return 1.0;
    }
    let scale = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 { 1.0 - scale * lower_series(a, x) } else { scale * upper_fraction(a, x) }
}

/// Series of the lower incomplete gamma function (Abramowitz and Stegun 6.5.29).
fn lower_series(a: f64, x: f64) -> f64 {
    let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
    while term > sum * 1e-16 {
        n += 1.0;
        term *= x / n;
        sum += term;
    }
    sum
}

/// Continued fraction of the upper one (Abramowitz and Stegun 6.5.31), by Lentz's method.
fn upper_fraction(a: f64, x: f64) -> f64 {
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1.0 / 1e-300, 1.0 / b);
    let mut h = d;
    for i in 1..100_000 {
        let k = -f64::from(i) * (f64::from(i) - a);
        b += 2.0;
        d = 1.0 / (k * d + b);
        c = b + k / c;
        h *= c * d;
        if (c * d - 1.0).abs() < 1e-15 {
            break;
        }
    }
    h
}

/// `ln Γ(x)` for x > 0: Stirling's series after shifting the argument beyond 10.
fn ln_gamma(x: f64) -> f64 {
    let (mut shift, mut y) = (0.0, x);
    while y < 10.0 {
        shift += y.ln();
        y += 1.0;
    }
    let z = 1.0 / (y * y);
    let series = (1.0 / 12.0 - z * (1.0 / 360.0 - z * (1.0 / 1260.0 - z / 1680.0))) / y;
    (y - 0.5) * y.ln() - y + 0.5 * (2.0 * std::f64::consts::PI).ln() + series - shift
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Uniforms;

    #[test]
    fn tails_are_those_of_the_tables() {
        // Abramowitz and Stegun, table 26.8.
        for (x, freedom, p) in
            [(3.841_46, 1.0, 0.05), (18.3070, 10.0, 0.05), (124.342, 100.0, 0.05), (149.449, 100.0, 0.001)]
        {
            assert!((chi_square_tail(x, freedom) / p - 1.0).abs() < 2e-4, "{x} {freedom}");
        }
        assert!((ln_gamma(0.5) - 0.5 * std::f64::consts::PI.ln()).abs() < 1e-12);
    }

    #[test]
    fn uniform_counts_pass_and_two_percent_off_do_not() {
        let mut u = Uniforms::new(1);
        let mut counts = [0_u64; 64];
        for _ in 0..1 << 20 {
            counts[u.below(64)] += 1;
        }
        let even = [f64::from(1 << 14); 64];
        chi_square("even", &counts, &even, 0.0).unwrap();
        let tilted: Vec<f64> = (0..64).map(|i| even[i] * (1.0 + 0.02 * (-1.0_f64).powi(i as i32))).collect();
        assert!(chi_square("tilted", &counts, &tilted, 0.0).is_err());
        let mut hole = even;
        hole[3] = 0.0;
        assert!(chi_square("hole", &counts, &hole, 0.0).is_err());
    }

    #[test]
    fn a_mean_two_percent_off_is_seen() {
        let mut u = Uniforms::new(2);
        let moments = Moments::of((0..1 << 18).map(|_| f64::from(u.one())));
        moments.check_mean("mean of uniforms", 0.5, 0.0).unwrap();
        assert!(moments.check_mean("mean of uniforms", 0.51, 0.0).is_err());
        assert!((moments.variance() - 1.0 / 12.0).abs() < 1e-3);
        let values: Vec<f64> = (0..1 << 18).map(|_| f64::from(u.one())).collect();
        check_variance("variance of uniforms", &values, 1.0 / 12.0, 0.0).unwrap();
        assert!(check_variance("variance of uniforms", &values, 1.04 / 12.0, 0.0).is_err());
    }
}
