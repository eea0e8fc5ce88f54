//! The outcomes as a figure: error over CPU time, one panel for each part of the picture.

use super::choices::{ADAPTIVE, AUTO};
use super::ladder::Errors;
use super::outcome::{Outcome, Outcomes};
use super::race::Measured;
use super::region::Region;
use super::table::Circumstances;
use crate::plot::{Curve, Figure, Panel, Style};

/// A part of the picture smaller than this has no panel: its error is that of a few pixels.
const SMALLEST_SHARE: f64 = 0.01;

/// Flags, in the order of their colours.
const FLAGS: [&str; 7] = ["lights", "technique", "choose", "environment", "sequence", "heuristic", "portals"];

/// Draws up the figure.
pub(super) fn figure(about: &Circumstances, measured: &Measured, outcomes: &Outcomes) -> Figure {
    type Part = (Region, &'static str, fn(&Errors) -> f64);
    let parts: [Part; 2] =
        [(Region::Open, "lights seen in full", |e| e.open), (Region::Penumbra, "penumbrae", |e| e.penumbra)];
    let shown = |(region, name, part): &Part| {
        let share = measured.reference.share(*region);
        let title = format!("{name} ({:.0} % of the pixels)", 100.0 * share);
        (share >= SMALLEST_SHARE).then(|| panel(title, outcomes, *part))
    };
    let mut panels: Vec<_> = parts.iter().filter_map(shown).collect();
    if panels.is_empty() {
        panels.push(panel("all pixels".to_owned(), outcomes, |e| e.all));
    }
    Figure {
        title: format!("{}, {}×{} pixels", about.scene, about.size.0, about.size.1),
        x: "CPU time (s)".to_owned(),
        y: "relative RMS error (%)".to_owned(),
        panels,
    }
}

/// One panel.
fn panel(title: String, outcomes: &Outcomes, part: impl Fn(&Errors) -> f64) -> Panel {
    let mut members = [0; FLAGS.len()];
    let curve = |outcome: &Outcome| {
        let style = match FLAGS.iter().position(|f| *f == outcome.flag) {
            Some(colour) => {
                members[colour] += 1;
                Style::Coloured { colour, member: members[colour] - 1 }
            }
            None if outcome.flag == ADAPTIVE => Style::Dashed,
            None => Style::Plain,
        };
        let believed = outcome.curve.iter().filter(|p| p.trusted);
        let points = believed.map(|p| (p.seconds, 100.0 * part(&p.relmse).sqrt()));
        let points = points.filter(|(_, error)| error.is_finite() && *error > 0.0).collect();
        let name = if outcome.name == AUTO { AUTO.to_owned() } else { format!("--{}", outcome.name) };
        Curve { name, style, points }
    };
    Panel { title, curves: outcomes.all.iter().map(curve).collect() }
}
