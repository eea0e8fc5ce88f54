//! `halflight merge`: a picture from its parts.

use crate::args::{MergeArgs, RenderArgs};
use crate::driver::{self, Goal, Rendered};
use crate::failure::{Exit, Failure};
use crate::keep::{open, refused};
use crate::memory;
use crate::number::{counted, percent};
use crate::report::{Report, Seconds};
use crate::save::{Files, Saved};
use crate::terminal;
use crate::tiles::{Aim, Header, State, Stored, Tile};
use halflight::estimate::{AdaptiveTile, LayeredPixel, PixelStats, Target};
use std::path::{Path, PathBuf};

/// Puts the parts together, and writes the picture.
pub(crate) fn run(args: &MergeArgs) -> Result<Exit, Failure> {
    let picture = RenderArgs {
        output: args.output.clone(),
        showing: args.showing,
        layers: args.layers,
        samples_image: args.samples_image.clone(),
        visibility_image: args.visibility_image.clone(),
        ..RenderArgs::default()
    };
    let files = Files::check(&picture)?;
    let header = check(&args.parts)?;
    files.format().check_size(header.crop.width(), header.crop.height())?;
    for flag in args.showing.in_vain(files.format()) {
        terminal::warning(&format!("{flag} has no effect on {}", args.output.display()));
    }
    let has_layers = header.pixels == LayeredPixel::KIND;
    if picture.sees_layers() && !has_layers {
        let flag = if args.layers { "--layers" } else { "--visibility-image" };
        return Err(Failure::new(format!("{flag} has no use here: the parts hold no layers"))
            .tip("render them with --layers"));
    }
    if has_layers {
        finish::<LayeredPixel>(args, &header, |rendered, report| {
            files.write(&picture, rendered, &report.header())
        })
    } else {
        finish::<PixelStats>(args, &header, |rendered, report| {
            files.write(&picture, rendered, &report.header())
        })
    }
}

/// Checks that the files are all the parts of one picture; returns what the first says of itself.
fn check(paths: &[PathBuf]) -> Result<Header, Failure> {
    let mut headers = Vec::with_capacity(paths.len());
    for path in paths {
        headers.push(open(path)?.header().clone());
    }
    let (Some(first), Some(first_path)) = (headers.first(), paths.first()) else {
        return Err(Failure::new("there are no parts to merge"));
    };
    let known = [LayeredPixel::KIND, PixelStats::KIND];
    for (path, header) in paths.iter().zip(&headers) {
        let path = path.display();
        if !header.complete {
            return Err(Failure::new(format!("{path} is of a render that has not come to its end"))
                .tip("run the command that made it again: it goes on from there"));
        }
        let unknown = (!known.contains(&header.pixels.as_str())).then(|| "its pixels are unknown".to_owned());
        if let Some(difference) = header.difference(first).or(unknown) {
            return Err(Failure::new(format!(
                "{path} and {} are parts of different pictures: {difference}",
                first_path.display()
            ))
            .tip("leave out the one that does not belong, or render it again"));
        }
    }
    match shortcomings(paths, &headers) {
        Some(text) => {
            Err(Failure::new(text).tip("name each part once; render --part makes those that are missing"))
        }
        None => Ok(first.clone()),
    }
}

/// "part 3 of 16 is there twice: a.part and b.part; parts 2, 5 to 7 of 16 are missing".
fn shortcomings(paths: &[PathBuf], headers: &[Header]) -> Option<String> {
    let of = headers.first()?.part.of;
    let mut found: Vec<Option<&Path>> = vec![None; of as usize];
    let mut texts = Vec::new();
    for (path, header) in paths.iter().zip(headers) {
        let number = header.part.number;
        match &mut found[number as usize - 1] {
            Some(other) => {
                let (one, other) = (other.display(), path.display());
                texts.push(format!("part {number} of {of} is there twice: {one} and {other}"));
            }
            empty => *empty = Some(path),
        }
    }
    let missing: Vec<u32> = (1..).zip(&found).filter(|(_, path)| path.is_none()).map(|(i, _)| i).collect();
    match missing[..] {
        [] => {}
        [one] => texts.push(format!("part {one} of {of} is missing")),
        _ => texts.push(format!("parts {} of {of} are missing", ranges(&missing))),
    }
    (!texts.is_empty()).then(|| texts.join("; "))
}

/// "2, 5 to 7".
fn ranges(numbers: &[u32]) -> String {
    let runs = numbers.chunk_by(|a, b| a + 1 == *b).map(|run| match run {
        [first, .., last] => format!("{first} to {last}"),
        _ => run.iter().map(u32::to_string).collect(),
    });
    runs.collect::<Vec<_>>().join(", ")
}

/// The picture, with pixels that know as much as the parts do.
fn finish<P: Saved + Stored>(
    args: &MergeArgs,
    header: &Header,
    write: impl FnOnce(&Rendered<P>, &Report) -> Result<(), Failure>,
) -> Result<Exit, Failure> {
    memory::check_merge(header.crop.area() as u64, size_of::<P>(), args.layers)?;
    let rendered = match header.aim {
        Aim::Error { target, most, adaptive: true } => {
            let target = Target::new(target, most);
            driver::refined(tiles::<P, Box<AdaptiveTile>>(&args.parts, header)?, header.crop, Some(&target))
        }
        Aim::Error { target, most, adaptive } => {
            let goal = Goal::Error { target, most, adaptive };
            driver::passed(tiles(&args.parts, header)?, header.crop, goal)
        }
        Aim::Samples(samples) => {
            driver::passed(tiles(&args.parts, header)?, header.crop, Goal::Samples(samples))
        }
    };
    warn(&rendered, header);
    let report = report(args, header, &rendered);
    write(&rendered, &report)?;
    tell(args, header, &report)
}

/// The tiles of all parts, in order.
fn tiles<P: Stored, S: State>(paths: &[PathBuf], header: &Header) -> Result<Vec<Tile<P, S>>, Failure> {
    let mut tiles = Vec::new();
    for path in paths {
        let reader = open(path)?;
        if let Some(difference) = reader.header().difference(header) {
            return Err(Failure::new(format!("{} has just been changed: {difference}", path.display()))
                .tip("merge when all parts are there"));
        }
        tiles.extend(reader.tiles().map_err(|e| refused(path, &e))?);
    }
    tiles.sort_unstable_by_key(|tile: &Tile<P, S>| tile.index);
    Ok(tiles)
}

/// Says what the picture lacks.
fn warn<P: Stored>(rendered: &Rendered<P>, header: &Header) {
    if rendered.rejected() > 0 {
        let samples = counted(rendered.rejected(), "sample");
        terminal::warning(&format!(
            "{samples} left out that came to no finite number; the picture misses their light"
        ));
    }
    if let (Aim::Error { target, most, .. }, 1..) = (header.aim, rendered.missed) {
        let (missed, all) = (counted(rendered.missed, "pixel"), rendered.area());
        let target = percent(target);
        terminal::warning(&format!("{missed} of {all} did not reach {target} with {most} samples each"));
    }
}

/// The picture in numbers, as if it had been rendered at once.
fn report<P: Stored>(args: &MergeArgs, header: &Header, rendered: &Rendered<P>) -> Report {
    let about = header.about.clone();
    Report {
        file: args.output.clone(),
        scene: header.scene.clone(),
        size: rendered.size(),
        part: None,
        pixels: rendered.area(),
        at: (header.crop.x0, header.crop.y0),
        film: about.film,
        samples_per_pixel: rendered.samples_per_pixel(),
        samples: rendered.samples(),
        triangles: about.triangles,
        lights: about.lights,
        seconds: Seconds::default(),
        error: rendered.error,
        missed: rendered.missed,
        adaptive: matches!(header.aim, Aim::Error { adaptive: true, .. }),
        rejected: rendered.rejected(),
        interrupted: false,
        seed: about.seed,
        threads: 1,
        choices: about.choices,
        warnings: Vec::new(),
    }
}

/// Says how it went.
fn tell(args: &MergeArgs, header: &Header, report: &Report) -> Result<Exit, Failure> {
    if args.json {
        let mut json = report.json();
        if let Some(object) = json.as_object_mut() {
            // How long it took is known where the parts were made.
            for name in ["part", "seconds", "samples_per_second", "threads", "interrupted", "warnings"] {
                object.remove(name);
            }
            object.insert("parts".to_owned(), header.part.of.into());
        }
        terminal::json(&json)?;
    } else if !args.quiet {
        let (width, height) = report.size;
        let line = [
            args.output.display().to_string(),
            format!("{width}×{height}"),
            report.samples_per_pixel(),
            counted(u64::from(header.part.of), "part"),
            report.error(),
        ];
        terminal::result(&line.join("  "))?;
    }
    Ok(if report.missed > 0 { Exit::CheckFailed } else { Exit::Good })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_numbers_are_short() {
        assert_eq!(ranges(&[2, 5, 6, 7, 9, 10]), "2, 5 to 7, 9 to 10");
        assert_eq!(ranges(&[4]), "4");
    }
}
