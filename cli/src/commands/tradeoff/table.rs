//! What is printed and written: a table for people, CSV and JSON for programs.

use super::ladder::Errors;
use super::outcome::{Outcome, Outcomes, Point};
use super::race::Measured;
use super::region::Region;
use crate::number::{percent, significant};
use serde_json::{Value, json};

/// What is known besides the outcomes.
#[derive(Debug)]
pub(super) struct Circumstances {
    pub(super) scene: String,
    pub(super) size: (u32, u32),
    pub(super) threads: usize,
    pub(super) seed: u32,
    /// What `auto` takes, by the names of the flags.
    pub(super) auto: Vec<(&'static str, String)>,
}

/// The heading, the table and the conclusion.
pub(super) fn text(about: &Circumstances, measured: &Measured, outcomes: &Outcomes) -> String {
    let mut rows = vec![
        ["choice", &format!("error at {}", seconds(outcomes.time)), "time to 1 %", "efficiency", "order"]
            .map(str::to_owned)
            .to_vec(),
    ];
    rows[0].extend(["open", "penumbra"].map(str::to_owned));
    rows.extend(outcomes.all.iter().map(row));
    [heading(about, measured), aligned(&rows), conclusion(measured, outcomes)].join("\n\n")
}

/// The scene, what `auto` takes, and what was measured by.
fn heading(about: &Circumstances, measured: &Measured) -> String {
    let flags: Vec<_> = about.auto.iter().map(|(flag, value)| format!("--{flag} {value}")).collect();
    let reference = &measured.reference;
    let made = match reference.samples {
        Some(samples) => format!("{samples} samples/pixel, {} of CPU time", seconds(reference.seconds)),
        None => "as given".to_owned(),
    };
    let part = |region| format!("{:.0} %", 100.0 * reference.share(region));
    format!(
        "{}  {}×{}  lights seen in full by {} of the pixels, in part by {}\nauto takes {}\nreference: {made}, its own error {}",
        about.scene,
        about.size.0,
        about.size.1,
        part(Region::Open),
        part(Region::Penumbra),
        flags.join(" "),
        percent(reference.noise.all.sqrt()),
    )
}

/// One choice.
fn row(outcome: &Outcome) -> Vec<String> {
    let error = |relmse: f64| if relmse.is_nan() { "–".to_owned() } else { percent(relmse.sqrt()) };
    let Outcome { name, relmse, trusted, gain, order, time_to_target, .. } = outcome;
    let (below, above) = if *trusted { ("", "") } else { ("≤ ", "≥ ") };
    let time = time_to_target.map_or_else(
        || "–".to_owned(),
        |(t, reached)| format!("{}{}", if reached { "" } else { "~" }, seconds(t)),
    );
    vec![
        name.clone(),
        format!("{below}{}", error(relmse.all)),
        time,
        format!("{above}{}", with_uncertainty(*gain)),
        order.map_or_else(|| "–".to_owned(), |o| format!("{o:.2}")),
        error(relmse.open),
        error(relmse.penumbra),
    ]
}

/// "0.48 ± 0.01": one digit of what is uncertain; "2.31e-5" of what is next to nothing.
fn with_uncertainty((value, uncertainty): (f64, f64)) -> String {
    if value < 0.01 {
        return significant(value);
    }
    let decimals = (-uncertainty.max(1e-4).log10()).ceil().max(0.0) as usize;
    format!("{value:.decimals$} ± {uncertainty:.decimals$}")
}

/// "0.52 s", also for short times.
fn seconds(t: f64) -> String {
    if t < 0.0995 { format!("{} ms", significant(1e3 * t)) } else { format!("{} s", significant(t)) }
}

/// Columns under one another, the first to the left, the others to the right.
fn aligned(rows: &[Vec<String>]) -> String {
    let width = |column: usize| rows.iter().map(|r| r[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<_> = (0..rows[0].len()).map(width).collect();
    let cell = |(column, text): (usize, &String)| {
        let gap = " ".repeat(widths[column] - text.chars().count());
        if column == 0 { format!("{text}{gap}") } else { format!("{gap}{text}") }
    };
    let line = |row: &Vec<String>| row.iter().enumerate().map(cell).collect::<Vec<_>>().join("  ");
    rows.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// Which choice `auto` should have made, in all and for the parts of the picture.
fn conclusion(measured: &Measured, outcomes: &Outcomes) -> String {
    let best = outcomes.best(|e| e.all);
    let mut lines = vec![if std::ptr::eq(best, outcomes.auto()) {
        "best: auto; no single change of it is clearly better".to_owned()
    } else {
        format!("best: --{}, {} times as efficient as auto", best.name, with_uncertainty(best.gain))
    }];
    type Part = (Region, &'static str, fn(&Errors) -> f64);
    let parts: [Part; 2] = [
        (Region::Open, "where lights are seen in full", |e| e.open),
        (Region::Penumbra, "in penumbrae", |e| e.penumbra),
    ];
    for (region, place, part) in parts {
        let better = outcomes.best(part);
        if measured.reference.share(region) > 0.0 && better.name != best.name {
            let ratio = part(&outcomes.auto().relmse) / part(&better.relmse);
            lines.push(match ratio {
                1.0 => format!("      {place}: auto"),
                _ => format!(
                    "      {place}: --{}, {} times as efficient as auto",
                    better.name,
                    significant(ratio)
                ),
            });
        }
    }
    lines.extend(outcomes.adaptive().map(|outcome| where_the_error_is(outcomes, outcome)));
    lines.join("\n")
}

/// What samples gain that go where the error is.
fn where_the_error_is(outcomes: &Outcomes, adaptive: &Outcome) -> String {
    let gain = with_uncertainty(adaptive.gain);
    let share = adaptive.time_to_auto.map_or_else(String::new, |time| {
        format!(", and the error of auto in {} of its time", significant(time / outcomes.time))
    });
    format!("samples where the error is, as --error and --time take them: {gain} times as efficient{share}")
}

/// Every rung of every choice, one to a line.
pub(super) fn csv(outcomes: &Outcomes) -> String {
    let mut text = "choice,samples_per_pixel,cpu_seconds,relmse,relmse_standard_error,relmse_open,\
                    relmse_penumbra,above_reference_noise,target_error\n"
        .to_owned();
    for outcome in &outcomes.all {
        for Point { samples, target, seconds, relmse: e, standard_error, trusted } in &outcome.curve {
            let number = |x: f64| if x.is_nan() { String::new() } else { format!("{x:e}") };
            let fields = [
                outcome.name.clone(),
                samples.to_string(),
                number(*seconds),
                number(e.all),
                number(*standard_error),
                number(e.open),
                number(e.penumbra),
                trusted.to_string(),
                target.map_or_else(String::new, number),
            ];
            text += &(fields.join(",") + "\n");
        }
    }
    text
}

/// Everything as one object.
pub(super) fn object(about: &Circumstances, measured: &Measured, outcomes: &Outcomes) -> Value {
    let reference = &measured.reference;
    let auto: serde_json::Map<_, _> =
        about.auto.iter().map(|(flag, value)| ((*flag).to_owned(), json!(value))).collect();
    json!({
        "scene": about.scene,
        "width": about.size.0,
        "height": about.size.1,
        "threads": about.threads,
        "seed": about.seed,
        "auto": auto,
        "rounds": measured.ladders.first().map_or(0, Vec::len),
        "open_pixels": reference.share(Region::Open),
        "penumbra_pixels": reference.share(Region::Penumbra),
        "reference": {
            "samples_per_pixel": reference.samples,
            "cpu_seconds": reference.seconds,
            "relmse": errors(&reference.noise),
        },
        "compared_at_cpu_seconds": outcomes.time,
        "best": outcomes.best(|e| e.all).name,
        "best_open": outcomes.best(|e| e.open).name,
        "best_penumbra": outcomes.best(|e| e.penumbra).name,
        "choices": outcomes.all.iter().map(choice).collect::<Vec<_>>(),
    })
}

/// One choice as an object; what is unknown is null.
fn choice(outcome: &Outcome) -> Value {
    let rung = |p: &Point| {
        json!({
            "samples_per_pixel": p.samples,
            "target_error": p.target,
            "cpu_seconds": p.seconds,
            "relmse": errors(&p.relmse),
            "relmse_standard_error": p.standard_error,
            "above_reference_noise": p.trusted,
        })
    };
    json!({
        "choice": outcome.name,
        "relmse": errors(&outcome.relmse),
        "above_reference_noise": outcome.trusted,
        "efficiency": outcome.gain.0,
        "efficiency_standard_error": outcome.gain.1,
        "order": outcome.order,
        "cpu_seconds_to_error_of_auto": outcome.time_to_auto,
        "cpu_seconds_to_1_percent": outcome.time_to_target.map(|(t, _)| t),
        "reached_1_percent": outcome.time_to_target.map(|(_, reached)| reached),
        "rungs": outcome.curve.iter().map(rung).collect::<Vec<_>>(),
    })
}

/// The parts of a measure; NaN becomes null.
fn errors(e: &Errors) -> Value {
    json!({ "all": e.all, "open": e.open, "penumbra": e.penumbra })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uncertain_digits_are_not_shown() {
        assert_eq!(with_uncertainty((0.4812, 0.0123)), "0.48 ± 0.01");
        assert_eq!(with_uncertainty((12.3, 0.8)), "12.3 ± 0.8");
        assert_eq!(with_uncertainty((35.2, 4.0)), "35 ± 4");
        assert_eq!(with_uncertainty((2.314e-5, 1e-6)), "2.31e-5");
    }

    #[test]
    fn columns_stand_under_one_another() {
        let rows = [["a", "10 %"], ["longer", "± 2"]].map(|r| r.map(str::to_owned).to_vec());
        assert_eq!(aligned(&rows), "a       10 %\nlonger   ± 2");
    }
}
