//! What is shown on a terminal while it works; nothing where stderr is no terminal.

use crate::driver::{Event, Goal};
use crate::number::{duration, percent, significant};
use crate::terminal::remark;
use console::Term;
use indicatif::{ProgressBar, ProgressState, ProgressStyle};
use std::fmt::Write;
use std::time::{Duration, Instant};

/// How often a step that cannot tell how far it is shows that it is alive.
const TICK: Duration = Duration::from_millis(120);

/// Columns for the words beside the bar, and for a ^C.
const WORDS: usize = 56;

/// Shows that a step is under way until it is dropped.
#[derive(Debug)]
pub(crate) struct Step(ProgressBar);

impl Step {
    /// Begins a step, for example "reading scene.xml"; in silence when `quiet`.
    pub(crate) fn begin(what: impl Into<String>, quiet: bool) -> Self {
        if quiet {
            return Self(ProgressBar::hidden());
        }
        let bar = ProgressBar::new_spinner().with_message(what.into());
        bar.set_style(style("{spinner} {wide_msg}").tick_chars("·•● "));
        bar.enable_steady_tick(TICK);
        Self(bar)
    }
}

impl Drop for Step {
    fn drop(&mut self) {
        self.0.finish_and_clear();
    }
}

/// The bar of a render.
#[derive(Debug)]
pub(crate) struct RenderBar {
    bar: ProgressBar,
    goal: Goal,
    begin: Instant,
    quiet: bool,
}

/// Steps of a bar whose goal is not a number of samples.
const STEPS: u64 = 1000;

impl RenderBar {
    /// A bar for so many pixels and that goal; invisible when `quiet`.
    pub(crate) fn new(pixels: u64, goal: Goal, quiet: bool) -> Self {
        let steps = if let Goal::Samples(samples) = goal { pixels * u64::from(samples) } else { STEPS };
        let bar = if quiet { ProgressBar::hidden() } else { ProgressBar::new(steps) };
        let template = format!("{{percent:>3}} %  {}{{left}}{{wide_msg}}", graphic());
        bar.set_style(style(&template).progress_chars("██░").with_key("left", left));
        bar.set_message(message(0.0, goal, None));
        bar.enable_steady_tick(TICK);
        Self { bar, goal, begin: Instant::now(), quiet }
    }

    /// Takes in what has happened.
    pub(crate) fn show(&self, event: Event) {
        match (event, self.goal) {
            (Event::Resumed, _) if self.quiet => {}
            (Event::Resumed, _) => self.bar.suspend(|| remark("going on from the checkpoint")),
            (Event::Samples(n), Goal::Samples(_)) => self.bar.inc(n),
            (Event::Samples(_), Goal::Time { deadline, .. }) => {
                let all = deadline.saturating_duration_since(self.begin).as_secs_f64().max(1e-9);
                let done = self.begin.elapsed().as_secs_f64() / all;
                self.bar.set_position((done.min(1.0) * STEPS as f64) as u64);
            }
            (Event::Samples(_), Goal::Error { .. }) => {}
            (Event::Round { samples, error }, goal) => {
                self.bar.set_message(message(samples, goal, error));
                if let (Goal::Error { target, .. }, Some(error)) = (goal, error) {
                    // Roughly so much of the samples: the error falls with their root, or faster.
                    let done = (target / error).powf(1.5).min(1.0);
                    self.bar.set_position((done * STEPS as f64) as u64);
                }
            }
        }
    }
}

impl Drop for RenderBar {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

/// The bar itself, as wide as leaves room for the words. The line must not reach the right margin:
/// the ^C that the terminal prints after it would begin a line of its own.
fn graphic() -> String {
    let columns = Term::stderr().size_checked().map_or(80, |(_, columns)| usize::from(columns));
    match columns.saturating_sub(WORDS).min(30) {
        0..6 => String::new(),
        width => format!("{{bar:{width}}}  "),
    }
}

/// "4 of 64 spp  error 1.8 %", "23.1 spp  error 1.8 % → 1.0 %".
fn message(samples: f64, goal: Goal, error: Option<f64>) -> String {
    let samples = if samples.fract() == 0.0 { samples.to_string() } else { significant(samples) };
    let error = error.map_or_else(String::new, |e| format!("  error {}", percent(e)));
    match goal {
        Goal::Samples(of) => format!("{samples} of {of} spp{error}"),
        Goal::Error { target, .. } => format!("{samples} spp{error} → {}", percent(target)),
        Goal::Time { .. } => format!("{samples} spp{error}"),
    }
}

/// "12 s left  ".
fn left(state: &ProgressState, text: &mut dyn Write) {
    let _ = match state.eta().as_secs_f64() {
        seconds if seconds > 0.0 => write!(text, "{} left  ", duration(seconds)),
        _ => Ok(()),
    };
}

/// A style from one of the templates above.
fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}
