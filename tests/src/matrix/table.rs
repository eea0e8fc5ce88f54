//! The matrix on paper.

use super::{Cell, DENSITIES, Kind, Light, Measured};
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// What the cells of one light and density came out as.
#[derive(Debug, Clone, Default)]
struct Entry {
    cells: u32,
    failed: u32,
    density_error: f64,
    mean_error: f64,
    mean_sigmas: f64,
    kinds: BTreeSet<Kind>,
}

impl Entry {
    fn take(&mut self, measured: &Measured) {
        self.cells += 1;
        self.failed += u32::from(!measured.failures.is_empty());
        self.density_error = self.density_error.max(measured.density_error);
        self.mean_error = self.mean_error.max(measured.mean_error);
        self.mean_sigmas = self.mean_sigmas.max(measured.mean_sigmas);
        self.kinds.extend(&measured.kinds);
    }

    /// The numbers as words of fixed width.
    fn words(&self) -> [String; 5] {
        let kinds: String = self.kinds.iter().map(|k| k.letter()).collect();
        let query =
            if self.density_error == 0.0 { "exact".into() } else { format!("{:.0e}", self.density_error) };
        let (mean, sigmas) =
            (format!("{:.2}%", 100.0 * self.mean_error), format!("{:.1}σ", self.mean_sigmas));
        [kinds, query, mean, sigmas, format!("{}/{}", self.failed, self.cells)]
    }
}

/// Every result, by light and density.
#[derive(Debug, Clone, Default)]
pub struct Table {
    entries: BTreeMap<(usize, usize), Entry>,
    skipped: BTreeMap<&'static str, u32>,
    means: u32,
    failing: Vec<(String, String)>,
}

/// Widths of the words of an entry.
const WIDTHS: [usize; 5] = [3, 5, 6, 4, 7];

/// What the letters and numbers are.
const LEGEND: &str = "\
Each entry: the densities that were met (A area, S solid angle, P projected solid angle, o one of its
own); the worst difference of queried and sampled density; the worst mean, off the truth beyond what
rounding may be, in percent and in standard errors; failed cells of all.";

impl Table {
    /// Takes in one cell.
    pub fn take(&mut self, cell: &Cell, measured: &Measured) {
        let light = Light::ALL.iter().position(|l| *l == cell.light).unwrap_or_default();
        self.entries.entry((light, cell.density)).or_default().take(measured);
        self.means += measured.means;
        for (why, count) in &measured.skipped {
            *self.skipped.entry(why).or_default() += count;
        }
        if let Some(first) = measured.failures.first() {
            self.failing.push((cell.name(), first.clone()));
        }
    }

    /// True when no cell fails.
    #[must_use]
    pub fn is_clean(&self) -> bool {
        self.failing.is_empty()
    }

    /// The table as text, with at most `listed` of the cells that fail.
    #[must_use]
    pub fn plain(&self, listed: usize) -> String {
        let width = WIDTHS.iter().sum::<usize>() + WIDTHS.len() - 1;
        let mut out = format!("{:<9}", "");
        for density in self.densities() {
            let _ = write!(out, "   {:<width$}", DENSITIES[density].1.replace('_', " "));
        }
        out = format!("{}\n", out.trim_end());
        for light in self.lights() {
            let _ = write!(out, "{:<9}", Light::ALL[light].name());
            for density in self.densities() {
                let words = self.entries.get(&(light, density)).map(Entry::words).unwrap_or_default();
                let _ = write!(out, "   {:<1$}", words[0], WIDTHS[0]);
                for (word, width) in words.iter().zip(WIDTHS).skip(1) {
                    let _ = write!(out, " {word:>width$}");
                }
            }
            out.push('\n');
        }
        let _ = write!(out, "\n{LEGEND}\n\n{}", self.summary());
        for (name, failure) in self.failing.iter().take(listed) {
            let _ = write!(out, "\n{name}\n    {failure}");
        }
        let more = self.failing.len().saturating_sub(listed);
        if more > 0 {
            let _ = write!(out, "\n… and {more} more");
        }
        out
    }

    /// The table for a README.
    #[must_use]
    pub fn markdown(&self) -> String {
        let mut out = String::from("| |");
        for density in self.densities() {
            let _ = write!(out, " {} |", DENSITIES[density].1.replace('_', " "));
        }
        let _ = write!(out, "\n|---|{}", "---|".repeat(self.densities().len()));
        for light in self.lights() {
            let _ = write!(out, "\n| {} |", Light::ALL[light].name());
            for density in self.densities() {
                let words = self.entries.get(&(light, density)).map(Entry::words).unwrap_or_default();
                let _ = write!(out, " {} · {} · {} · {} |", words[0], words[1], words[3], words[4]);
            }
        }
        out
    }

    /// What was judged, and what was not.
    fn summary(&self) -> String {
        let cells: u32 = self.entries.values().map(|e| e.cells).sum();
        let mut out =
            format!("{} of {cells} cells fail; {} means were judged", self.failing.len(), self.means);
        for (why, count) in &self.skipped {
            let _ = write!(out, "; {count} times {why}");
        }
        out + "."
    }

    fn lights(&self) -> BTreeSet<usize> {
        self.entries.keys().map(|(light, _)| *light).collect()
    }

    fn densities(&self) -> BTreeSet<usize> {
        self.entries.keys().map(|(_, density)| *density).collect()
    }
}
