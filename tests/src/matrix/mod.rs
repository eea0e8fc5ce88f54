//! The conformance matrix: each light by each density, from touching to a million sizes away, facing
//! to behind, a micrometre to a thousand kilometres, round to a needle.
//!
//! A cell looks at its light with four receivers: one that faces it and one whose horizon cuts it,
//! with the light along the axes and turned. Truth is in double precision, for the very numbers that
//! the core was given; what rounding of these numbers changes is allowed, and no more than
//! 1e-5 of the irradiance. Where that is everything, a receiver is left out and counted.

mod axes;
mod examine;
mod kind;
mod setup;
mod table;
mod tally;
mod truth;

pub use axes::{Angle, Cell, DENSITIES, DISTANCES, Light, SCALES};
pub use kind::Kind;
pub use table::Table;

use crate::Verdict;
use std::collections::{BTreeMap, BTreeSet};
use tally::Tally;
use truth::Truth;

/// What a cell came out as.
#[derive(Debug, Clone, Default)]
pub struct Measured {
    /// Worst difference of a queried density from that of the sample, relatively.
    pub density_error: f64,
    /// Worst mean, in standard errors off the truth beyond what rounding may be.
    pub mean_sigmas: f64,
    /// Worst mean, relatively off the truth beyond what rounding may be.
    pub mean_error: f64,
    /// Means that were judged.
    pub means: u32,
    /// What the density was.
    pub kinds: BTreeSet<Kind>,
    /// What was left out, and how often.
    pub skipped: BTreeMap<&'static str, u32>,
    /// What is wrong.
    pub failures: Vec<String>,
}

impl Measured {
    /// Everything about one cell.
    #[must_use]
    pub fn of(cell: Cell) -> Self {
        let mut measured = Self::default();
        setup::run(cell, &mut measured);
        measured
    }

    fn note(&mut self, what: &str, verdict: Verdict) {
        if let Err(failure) = verdict {
            self.failures.push(format!("{what}: {}", failure.0));
        }
    }

    fn skip(&mut self, why: &'static str) {
        *self.skipped.entry(why).or_default() += 1;
    }

    /// Holds samples against the truth.
    fn judge(&mut self, what: &str, tally: &Tally, truth: &Truth, kind: Kind) {
        self.note(what, tally.check_places(truth, kind));
        match tally.check_mean(truth, kind) {
            Err(failure) => self.note(what, Err(failure)),
            Ok(None) => self.skip("a few samples decide the mean"),
            Ok(Some(mean)) => {
                self.means += 1;
                self.mean_sigmas = self.mean_sigmas.max(mean.sigmas);
                self.mean_error = self.mean_error.max(mean.relative);
                self.note(what, tally.check_variance(truth, kind));
            }
        }
    }
}
