//! Samples of a light, counted by the places that they meet, and what they must add up to.

use super::kind::Kind;
use super::truth::Truth;
use crate::oracle::CELLS;
use crate::statistics::{MATRIX_LEVEL, Moments, SIGMAS, check_variance, chi_square_tail};
use crate::{Verdict, ensure};

/// A mean whose standard error is a larger share than this is not judged: a few samples decide it.
const HEAVY: f64 = 0.05;

/// Fewer expected than this, and a cell is pooled with others.
const POOLED_BELOW: f64 = 8.0;

/// Cells with less than this share of the irradiance are not judged alone.
const SLIVER: f64 = 1e-3;

/// What a mean came out as.
#[derive(Debug, Clone, Copy)]
pub(super) struct Mean {
    /// Off the truth beyond what rounding may be, relatively.
    pub(super) relative: f64,
    /// Off the truth, in standard errors, after what rounding may be off.
    pub(super) sigmas: f64,
}

/// Samples in cells, and what each is worth.
#[derive(Debug, Clone)]
pub(super) struct Tally {
    counts: [u32; CELLS],
    worth: Vec<f64>,
    by_cell: [Moments; CELLS],
}

impl Tally {
    /// Of `n` draws, each a cell and what the sample is worth, or nothing.
    pub(super) fn of(n: u32, mut draw: impl FnMut() -> Option<(usize, f64)>) -> Self {
        let mut tally = Self {
            counts: [0; CELLS],
            worth: Vec::with_capacity(n as usize),
            by_cell: [Moments::default(); CELLS],
        };
        for _ in 0..n {
            let drawn = draw();
            if let Some((cell, worth)) = drawn {
                tally.counts[cell] += 1;
                tally.by_cell[cell].add(worth);
            }
            tally.worth.push(drawn.map_or(0.0, |(_, worth)| worth));
        }
        tally
    }

    fn count(&self) -> f64 {
        self.worth.len() as f64
    }

    /// The mean of what samples are worth is the irradiance; `None` when a few samples decide it.
    ///
    /// # Errors
    /// When it is not.
    pub(super) fn check_mean(&self, truth: &Truth, kind: Kind) -> Result<Option<Mean>, crate::Failure> {
        let moments = Moments::of(self.worth.iter().copied());
        let exact = kind.variance(truth).map(|v| (v / self.count()).sqrt());
        // The true spread where it is known: heavy tails hide theirs from the samples.
        let error = exact.unwrap_or_else(|| moments.standard_error());
        let irradiance = truth.total.irradiance;
        if error > HEAVY * irradiance {
            return Ok(None);
        }
        let off = (moments.mean() - irradiance).abs();
        let beyond = (off - truth.rounding()).max(0.0);
        let sigmas = if beyond > 0.0 { beyond / error } else { 0.0 };
        ensure!(
            sigmas <= SIGMAS,
            "irradiance {:e} instead of {irradiance:e}: {sigmas:.1} standard errors of {error:.1e} off",
            moments.mean()
        );
        Ok(Some(Mean { relative: beyond / irradiance, sigmas }))
    }

    /// Places are as frequent as the density says: Pearson's test over cells of the light.
    ///
    /// # Errors
    /// When the counts are too unlikely.
    pub(super) fn check_places(&self, truth: &Truth, kind: Kind) -> Verdict {
        let n = self.count();
        let mut test = Pearson::default();
        let (mut seen, mut slack) = (0.0, 0.0);
        for (i, (part, loose)) in truth.cells.iter().zip(&truth.slack).enumerate() {
            let (Some(share), Some(off)) = (kind.share(part, truth), kind.share(loose, truth)) else {
                return self.check_cells(truth);
            };
            test.add(f64::from(self.counts[i]), n * share, n * off);
            seen += share;
            slack += off;
        }
        let none = n - self.counts.iter().map(|&c| f64::from(c)).sum::<f64>();
        test.add(none, n * (1.0 - seen).max(0.0), n * (1e-6 + slack));
        test.verdict()
    }

    /// Each cell sends its share of the irradiance: what can be said of any density.
    ///
    /// # Errors
    /// When one does not.
    fn check_cells(&self, truth: &Truth) -> Verdict {
        for (i, moments) in self.by_cell.iter().enumerate() {
            let part = truth.cells[i].irradiance;
            if part < SLIVER * truth.total.irradiance {
                continue;
            }
            // Mean and spread of samples that are worth nothing in other cells.
            let p = f64::from(self.counts[i]) / self.count();
            ensure!(self.counts[i] > 1, "cell {i} is never met");
            let mean = p * moments.mean();
            let second = p * (moments.variance() + moments.mean().powi(2));
            let error = ((second - mean * mean).max(0.0) / self.count()).sqrt();
            if error > HEAVY * part {
                continue;
            }
            let off = (mean - part).abs();
            let rounding = truth.rounding() + truth.slack[i].irradiance;
            ensure!(
                off <= SIGMAS * error + rounding,
                "cell {i} sends {mean:e} instead of {part:e}, ± {error:.1e}"
            );
        }
        Ok(())
    }

    /// The variance is the exact one, where that is known and not of a few samples.
    ///
    /// # Errors
    /// When it is not.
    pub(super) fn check_variance(&self, truth: &Truth, kind: Kind) -> Verdict {
        let Some(variance) = kind.variance(truth) else { return Ok(()) };
        let irradiance = truth.total.irradiance;
        if variance > irradiance.powi(2) {
            return Ok(());
        }
        // In units of the irradiance: its square may be too small for squares.
        let worth: Vec<f64> = self.worth.iter().map(|w| w / irradiance).collect();
        let rounding = 4.0 * truth.rounding() / irradiance;
        check_variance("relative", &worth, variance / irradiance.powi(2), rounding)
    }
}

/// Pearson's test, cell by cell.
#[derive(Debug, Default)]
struct Pearson {
    statistic: f64,
    cells: u32,
    pool: [f64; 3],
}

impl Pearson {
    /// One more cell.
    ///
    /// * `slack` – what the expected count may be off
    fn add(&mut self, observed: f64, expected: f64, slack: f64) {
        if expected < POOLED_BELOW {
            self.pool = [self.pool[0] + observed, self.pool[1] + expected, self.pool[2] + slack];
        } else {
            self.statistic += (observed - expected).powi(2) / (expected + slack * slack);
            self.cells += 1;
        }
    }

    fn verdict(mut self) -> Verdict {
        let [observed, expected, slack] = self.pool;
        if expected >= POOLED_BELOW {
            self.pool = [0.0; 3];
            self.add(observed, expected, slack);
        } else {
            let bound = expected + SIGMAS * expected.sqrt() + slack + 3.0;
            ensure!(observed <= bound, "{observed} places in cells that hold {expected:.1}");
        }
        if self.cells < 2 {
            return Ok(());
        }
        let p = chi_square_tail(self.statistic, f64::from(self.cells - 1));
        let (statistic, cells) = (self.statistic, self.cells);
        ensure!(p >= MATRIX_LEVEL, "places: χ² = {statistic:.1} over {cells} cells, p = {p:.1e}");
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::setup::Setup;
    use crate::random::Uniforms;
    use halflight::Rgb;
    use halflight::glam::{DVec3, Vec3};
    use halflight::light::{AreaLight, Receiver, SurfaceDensity};
    use halflight::shape::Sphere;

    /// A sphere two radii away: by area, or by the cone that it fills.
    fn ball() -> Setup<Sphere> {
        Setup {
            shape: Sphere::new(Vec3::Z * 2.0, 1.0).unwrap(),
            from: Receiver { point: Vec3::ZERO, normal: Vec3::Z },
            grid: DVec3::splat(1e-7),
            size: 2.0,
            aligned: true,
            what: "facing",
        }
    }

    /// Samples worth `1 / factor` of what they are, with `half` of them in half of the uniforms.
    fn tally(method: SurfaceDensity, factor: f64, half: f32, n: u32) -> (Tally, std::sync::Arc<Truth>) {
        let setup = ball();
        let truth = Truth::of(&setup);
        let light = AreaLight::new(setup.shape, Rgb::WHITE).unwrap();
        let view = light.view(&setup.from, method).unwrap();
        let mut random = Uniforms::new(1);
        let tally = Tally::of(n, || {
            let [u, v] = random.two();
            let v = if v < half { 0.5 * v / half } else { 0.5 + 0.5 * (v - half) / (1.0 - half) };
            let drawn = crate::matrix::examine::draw(&view, [u, v])?;
            let worth = f64::from(drawn.sample.wi.z / drawn.pdf) / factor;
            Some((truth.outlook.cell(drawn.sample.at.point.as_dvec3()), worth))
        });
        (tally, truth)
    }

    const BOTH: [(SurfaceDensity, Kind); 2] =
        [(SurfaceDensity::Area, Kind::Area), (SurfaceDensity::SolidAngle, Kind::SolidAngle)];

    #[test]
    fn honest_densities_pass() {
        for (method, kind) in BOTH {
            let (tally, truth) = tally(method, 1.0, 0.5, 1 << 17);
            tally.check_mean(&truth, kind).unwrap().expect("light tails");
            tally.check_places(&truth, kind).unwrap();
            tally.check_places(&truth, Kind::Own).unwrap();
            tally.check_variance(&truth, kind).unwrap();
        }
    }

    #[test]
    fn a_density_two_percent_off_fails_by_mean_by_cell_and_by_variance() {
        let (tally, truth) = tally(SurfaceDensity::SolidAngle, 1.02, 0.5, 1 << 18);
        assert!(tally.check_mean(&truth, Kind::SolidAngle).is_err());
        assert!(tally.check_mean(&truth, Kind::Own).is_err());
        assert!(tally.check_places(&truth, Kind::Own).is_err());
        assert!(tally.check_variance(&truth, Kind::SolidAngle).is_err());
    }

    #[test]
    fn places_two_percent_denser_on_one_half_fail() {
        for (method, kind) in BOTH {
            // Three of four places by area are out of sight.
            let n = if kind == Kind::Area { 1 << 20 } else { 1 << 18 };
            let (tally, truth) = tally(method, 1.0, 0.51, n);
            assert!(tally.check_places(&truth, kind).is_err(), "{kind:?}");
        }
    }
}
