//! From rungs to what is told of a choice.

use super::choices::{ADAPTIVE, AUTO, Candidate, Field};
use super::ladder::{Errors, Rung};
use super::race::Measured;

/// How far above the noise of the reference an error must be to be believed (as relMSE).
const ABOVE_NOISE: f64 = 4.0;

/// The error that users wait for.
const TARGET: f64 = 0.01;

/// A rung, over all rounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Point {
    /// Samples per pixel, mean of the rounds.
    pub(super) samples: f64,
    /// The relative error that was asked for (a fraction), where one was.
    pub(super) target: Option<f64>,
    /// CPU time, median of the rounds (s).
    pub(super) seconds: f64,
    /// relMSE without the noise of the reference, mean of the rounds.
    pub(super) relmse: Errors,
    /// Standard error of its first part.
    pub(super) standard_error: f64,
    /// True when it is well above that noise.
    pub(super) trusted: bool,
}

/// What has become of one choice.
#[derive(Debug)]
pub(super) struct Outcome {
    pub(super) name: String,
    pub(super) flag: &'static str,
    pub(super) curve: Vec<Point>,
    /// relMSE after the common time.
    pub(super) relmse: Errors,
    /// False where the reference cannot tell how small the error is: `relmse` and `gain` are bounds.
    pub(super) trusted: bool,
    /// `1 / (relMSE × CPU time)` over that of `auto`, and its standard error.
    pub(super) gain: (f64, f64),
    /// The error falls as samples to the minus this power.
    pub(super) order: Option<f64>,
    /// CPU time to the error that `auto` has after the common time (s); `None` where the rungs do not tell.
    pub(super) time_to_auto: Option<f64>,
    /// CPU time to an error of 1 % (s), and whether it was reached.
    pub(super) time_to_target: Option<(f64, bool)>,
}

/// What has become of all.
#[derive(Debug)]
pub(super) struct Outcomes {
    /// CPU time at which they are compared (s).
    pub(super) time: f64,
    /// In the order of the field, `auto` first.
    pub(super) all: Vec<Outcome>,
}

impl Outcomes {
    /// Draws the conclusions.
    pub(super) fn of(field: &Field, measured: &Measured) -> Self {
        let noise = measured.reference.noise;
        let curves: Vec<_> = measured.ladders.iter().map(|rounds| curve(rounds, noise)).collect();
        let time = common_time(&curves, measured.slice);
        let judged = |(ladders, curve): (&Vec<Vec<Rung>>, &Vec<Point>)| at_time(ladders, curve, noise, time);
        let at: Vec<_> = measured.ladders.iter().zip(&curves).map(judged).collect();
        let auto = at[0];
        let rows = field.candidates.iter().zip(curves).zip(at);
        let outcome = |(i, ((candidate, curve), at)): (usize, ((&_, Vec<Point>), At))| {
            let candidate: &Candidate = candidate;
            let ratio = auto.relmse.all / at.relmse.all;
            let own = if i == 0 { 0.0 } else { auto.uncertainty };
            Outcome {
                name: candidate.name.clone(),
                flag: candidate.flag,
                relmse: at.relmse,
                trusted: at.trusted,
                gain: (ratio, ratio * at.uncertainty.hypot(own)),
                order: order(&curve),
                time_to_auto: time_to(&curve, auto.relmse.all.sqrt()).filter(|_| auto.trusted),
                time_to_target: time_to_target(&curve),
                curve,
            }
        };
        Self { time, all: rows.enumerate().map(outcome).collect() }
    }

    /// What `auto` has come to.
    pub(super) fn auto(&self) -> &Outcome {
        &self.all[0]
    }

    /// The choice that puts samples where the error is.
    pub(super) fn adaptive(&self) -> Option<&Outcome> {
        self.all.iter().find(|o| o.flag == ADAPTIVE)
    }

    /// The best choice by a measure of its relMSE, all with the same samples for every pixel; `auto` unless
    /// another is better by two standard errors.
    pub(super) fn best(&self, part: impl Fn(&Errors) -> f64) -> &Outcome {
        let clearly = |o: &&Outcome| {
            let uncertainty = o.gain.1 / o.gain.0;
            o.name != AUTO
                && o.flag != ADAPTIVE
                && part(&o.relmse) * (1.0 + 2.0 * uncertainty) < part(&self.auto().relmse)
        };
        let better = self.all.iter().filter(clearly);
        better.min_by(|a, b| part(&a.relmse).total_cmp(&part(&b.relmse))).unwrap_or_else(|| self.auto())
    }
}

/// A choice after the common time.
#[derive(Clone, Copy)]
struct At {
    relmse: Errors,
    /// Relative standard error of `relmse.all`, that of the time included.
    uncertainty: f64,
    trusted: bool,
}

/// Without the noise of the reference; what is left is at least a tenth, as the noise is an estimate.
fn corrected(measured: Errors, noise: Errors) -> Errors {
    measured.zip(noise, |m, n| if m.is_nan() { m } else { (m - n).max(0.1 * m) })
}

/// Puts the rounds together, rung by rung.
fn curve(rounds: &[Vec<Rung>], noise: Errors) -> Vec<Point> {
    let rungs = rounds.first().map_or(0, Vec::len);
    (0..rungs)
        .map(|rung| {
            let of =
                |part: &dyn Fn(&Rung) -> f64| -> Vec<f64> { rounds.iter().map(|r| part(&r[rung])).collect() };
            let all = Moments::of(&of(&|r| r.relmse.all));
            let mean = Errors {
                all: all.mean,
                open: Moments::of(&of(&|r| r.relmse.open)).mean,
                penumbra: Moments::of(&of(&|r| r.relmse.penumbra)).mean,
            };
            Point {
                samples: Moments::of(&of(&|r| r.samples)).mean,
                target: rounds[0][rung].target,
                seconds: median(of(&|r| r.seconds)).max(1e-9),
                relmse: corrected(mean, noise),
                standard_error: all.standard_error,
                trusted: mean.all > ABOVE_NOISE * noise.all,
            }
        })
        .collect()
}

/// The time at which choices are compared: what nearly all ladders reach, and where all errors are
/// above the noise of the reference, as far as that can be (s).
fn common_time(curves: &[Vec<Point>], slice: f64) -> f64 {
    let believed = |curve: &&Vec<Point>| curve.get(1).is_some_and(|p| p.trusted);
    let end = |curve: &Vec<Point>| {
        let last = curve.iter().rfind(|p| p.trusted).map_or(f64::INFINITY, |p| p.seconds);
        if curve.last().is_some_and(|p| p.trusted) { f64::INFINITY } else { last }
    };
    curves.iter().filter(believed).map(end).fold(0.5 * slice, f64::min)
}

/// A choice after `time` (s).
fn at_time(rounds: &[Vec<Rung>], curve: &[Point], noise: Errors, time: f64) -> At {
    let seconds: Vec<_> = curve.iter().map(|p| p.seconds).collect();
    let at = |value: &dyn Fn(usize) -> f64| {
        interpolated(&seconds, &(0..curve.len()).map(value).collect::<Vec<_>>(), time)
    };
    let relmse = Errors {
        all: at(&|i| curve[i].relmse.all),
        open: at(&|i| curve[i].relmse.open),
        penumbra: at(&|i| curve[i].relmse.penumbra),
    };
    let rounds_at: Vec<_> =
        rounds.iter().map(|rungs| at(&|i| corrected(rungs[i].relmse, noise).all)).collect();
    let errors = Moments::of(&rounds_at);
    let costs: Vec<_> = rounds.iter().filter_map(|r| r.last()).map(|r| r.seconds.max(1e-9).ln()).collect();
    let slope = 2.0 * order(curve).unwrap_or(0.5);
    let uncertainty = (errors.standard_error / errors.mean).hypot(slope * Moments::of(&costs).standard_error);
    let trusted = relmse.all > (ABOVE_NOISE - 1.0) * noise.all;
    let floor = if trusted { 0.0 } else { ABOVE_NOISE * noise.all };
    At { relmse: Errors { all: relmse.all.max(floor), ..relmse }, uncertainty, trusted }
}

/// A positive value over positive places, on a straight line between logarithms, and beyond the ends.
fn interpolated(places: &[f64], values: &[f64], place: f64) -> f64 {
    let [Some(&first), Some(&value)] = [places.first(), values.first()] else { return f64::NAN };
    if places.len() == 1 {
        return value * first / place;
    }
    let right = places.iter().position(|p| *p >= place).unwrap_or(places.len() - 1).max(1);
    let [(x0, y0), (x1, y1)] = [right - 1, right].map(|i| (places[i].ln(), values[i].ln()));
    let slope = if x1 > x0 { (y1 - y0) / (x1 - x0) } else { 0.0 };
    (y0 + slope * (place.ln() - x0)).exp()
}

/// The order of convergence: a straight line through the logarithms of samples and error, by least
/// squares. The first samples, which are no sequence yet, and what the reference cannot judge are left out.
fn order(curve: &[Point]) -> Option<f64> {
    let points: Vec<_> = curve
        .iter()
        .filter(|p| p.trusted && p.samples >= 4.0)
        .map(|p| (p.samples.ln(), 0.5 * p.relmse.all.ln()))
        .collect();
    let n = points.len() as f64;
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(f).sum::<f64>() / n;
    let (x, y) = (mean(&|p| p.0), mean(&|p| p.1));
    let (xx, xy) = (mean(&|p| (p.0 - x).powi(2)), mean(&|p| (p.0 - x) * (p.1 - y)));
    (points.len() >= 3 && xx > 0.0).then(|| -xy / xx)
}

/// CPU time to the target (s), and whether the ladder has got there.
fn time_to_target(curve: &[Point]) -> Option<(f64, bool)> {
    let believed: Vec<_> = curve.iter().filter(|p| p.trusted).collect();
    let errors: Vec<_> = believed.iter().map(|p| p.relmse.all.sqrt()).collect();
    let seconds: Vec<_> = believed.iter().map(|p| p.seconds).collect();
    if errors.first().is_some_and(|e| *e <= TARGET) {
        return Some((seconds[0], true));
    }
    // From its end, a curve goes on at its average slope: the last step alone is too noisy. Independent
    // samples are the worst that there is; what seems slower has met a rare, bright sample.
    let (last, at) = (*errors.last()?, *seconds.last()?);
    if last > TARGET {
        let time = at * (last / TARGET).powf(1.0 / order(curve).unwrap_or(0.5).max(0.5));
        return Some((time, false));
    }
    time_to(curve, TARGET).map(|time| (time, true))
}

/// CPU time to an error (s), between two rungs that are believed.
fn time_to(curve: &[Point], error: f64) -> Option<f64> {
    let believed: Vec<_> = curve.iter().filter(|p| p.trusted).collect();
    let [before, after] = believed.windows(2).find_map(|pair| {
        let [before, after] = [pair[0], pair[1]].map(|p| (p.relmse.all.sqrt(), p.seconds));
        (after.0 <= error && error <= before.0).then_some([before, after])
    })?;
    Some(interpolated(&[after.0, before.0], &[after.1, before.1], error))
}

/// Mean of some numbers, and how well it is known.
struct Moments {
    mean: f64,
    standard_error: f64,
}

impl Moments {
    fn of(values: &[f64]) -> Self {
        let n = values.len() as f64;
        let mean = values.iter().sum::<f64>() / n;
        let squares = values.iter().map(|v| (v - mean).powi(2)).sum::<f64>();
        let standard_error = if values.len() > 1 { (squares / (n - 1.0) / n).sqrt() } else { 0.0 };
        Self { mean, standard_error }
    }
}

/// The middle one, or the mean of the two in the middle.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    0.5 * (values[(n - 1) / 2] + values[n / 2])
}

#[cfg(test)]
mod tests {
    use super::*;

    const NO_NOISE: Errors = Errors { all: 0.0, open: 0.0, penumbra: 0.0 };

    /// Three rounds of a choice that takes `cost` seconds a sample and whose relMSE is
    /// `variance / samples^(2 order)`.
    fn rounds(cost: f64, variance: f64, order: f64) -> Vec<Vec<Rung>> {
        let rung = |wobble: f64, i: u32| {
            let samples = 1 << i;
            let e = wobble * variance * f64::from(samples).powf(-2.0 * order);
            Rung {
                samples: f64::from(samples),
                target: None,
                seconds: cost * f64::from(samples),
                relmse: Errors { all: e, open: e, penumbra: e },
            }
        };
        [0.9, 1.0, 1.1].iter().map(|w| (0..=6).map(|i| rung(*w, i)).collect()).collect()
    }

    #[test]
    fn the_order_and_the_time_are_those_that_were_put_in() {
        for (cost, variance, power) in [(1e-3, 0.04, 0.5), (0.1, 0.01, 0.75), (2.0, 1e-3, 1.5)] {
            let curve = curve(&rounds(cost, variance, power), NO_NOISE);
            assert!((order(&curve).unwrap() - power).abs() < 1e-9);
            let (time, _) = time_to_target(&curve).unwrap();
            let truth = cost * (variance.sqrt() / TARGET).powf(1.0 / power);
            assert!((time / truth - 1.0).abs() < 1e-6, "{time} {truth}");
            let error = 0.5 * variance.sqrt();
            let truth = cost * 2_f64.powf(1.0 / power);
            assert!((time_to(&curve, error).unwrap() / truth - 1.0).abs() < 1e-6);
            assert_eq!(time_to(&curve, 2.0 * variance.sqrt()), None);
        }
    }

    #[test]
    fn the_noise_of_the_reference_is_taken_off_and_what_is_below_it_is_not_believed() {
        let noise = Errors { all: 1e-3, open: 1e-3, penumbra: f64::NAN };
        let mut ladders = rounds(1.0, 0.1, 0.5);
        for rung in ladders.iter_mut().flatten() {
            rung.relmse = Errors { penumbra: f64::NAN, ..rung.relmse.zip(noise, |a, b| a + b) };
        }
        let curve = curve(&ladders, noise);
        assert!(curve.iter().all(|p| (p.relmse.open * p.samples / 0.1 - 1.0).abs() < 1e-9));
        assert!(curve.iter().all(|p| p.relmse.penumbra.is_nan()));
        assert_eq!(curve.iter().filter(|p| p.trusted).count(), 6);
        assert_eq!(common_time(&[curve], 1e9), 32.0);
    }

    #[test]
    fn a_choice_is_judged_between_its_rungs() {
        let ladders = rounds(1.0, 0.1, 0.5);
        let at = at_time(&ladders, &curve(&ladders, NO_NOISE), NO_NOISE, 24.0);
        assert!((at.relmse.all * 240.0 - 1.0).abs() < 1e-9);
        assert!((at.uncertainty - 0.1 / 3.0_f64.sqrt()).abs() < 1e-9);
    }
}
