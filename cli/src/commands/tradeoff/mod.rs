//! `halflight tradeoff`: error against time for each choice that a scene makes possible.

mod choices;
mod figure;
mod ladder;
mod outcome;
mod race;
mod reference;
mod refined;
mod region;
mod table;

use super::render::pool;
use crate::args::TradeoffArgs;
use crate::failure::{Exit, Failure};
use crate::interrupt::on_interrupt;
use crate::output::Output;
use crate::picture::{Picture, read};
use crate::progress::Step;
use crate::{plot, scene, terminal};
use choices::Field;
use halflight::build::Description;
use halflight::{Camera, Film};
use ladder::Stage;
use outcome::Outcomes;
use race::{Measured, Terms};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use table::Circumstances;

/// Columns of the pictures where nobody says.
const WIDTH: u32 = 200;

/// Measures the choices, prints the table and writes the files.
pub(crate) fn run(args: &TradeoffArgs) -> Result<Exit, Failure> {
    let name = scene::shown(args.scene.as_deref());
    let outputs = Outputs::check(args, &name)?;
    let given = args.reference.as_deref().map(finite).transpose()?;
    let (mut found, field) = {
        let _step = Step::begin(format!("reading {name}"), args.quiet);
        let mut found = scene::find(args.scene.as_deref(), &args.reading)?;
        let field = Field::of(&mut found.description).map_err(|e| e.about(&name))?;
        (found, field)
    };
    found.print_warnings();
    let description = &mut found.description;
    let (film, camera) = view(args, description, given.as_ref())?;
    let stop = on_interrupt()?;
    let pool = pool(args.threads)?;
    let threads = pool.current_num_threads();
    let stage = Stage { field: &field, camera, film, stop: &stop };
    let Some(measured) = pool.install(|| measure(args, &stage, threads, given)) else {
        return Ok(Exit::Interrupted);
    };
    let about = Circumstances {
        scene: description.name.clone(),
        size: (film.width(), film.height()),
        threads,
        seed: args.seed,
        auto: field.candidates[0].plan.flags(),
    };
    tell(args, &outputs, &about, &measured, &Outcomes::of(&field, &measured))?;
    Ok(if stop.load(Ordering::Relaxed) { Exit::Interrupted } else { Exit::Good })
}

/// Takes all measurements, on the current threads; `None` when interrupted too early.
fn measure(
    args: &TradeoffArgs,
    stage: &Stage<'_>,
    threads: usize,
    given: Option<Picture>,
) -> Option<Measured> {
    let terms = Terms { budget: f64::from(args.budget), threads, seed: args.seed, quiet: args.quiet };
    let bound = stage.field.buffers[0].bind();
    let regions = {
        let _step = Step::begin("looking for penumbrae", args.quiet);
        region::regions(&bound.scene(), &stage.camera, &stage.film)
    };
    race::measure(stage, &terms, regions, given.map(|p| p.pixels))
}

/// Prints and writes what has come out.
fn tell(
    args: &TradeoffArgs,
    outputs: &Outputs,
    about: &Circumstances,
    measured: &Measured,
    outcomes: &Outcomes,
) -> Result<(), Failure> {
    let object = table::object(about, measured, outcomes);
    outputs.svg.write(plot::svg(&figure::figure(about, measured, outcomes))?.as_bytes())?;
    outputs.csv.write(table::csv(outcomes).as_bytes())?;
    outputs.json.write(format!("{object:#}\n").as_bytes())?;
    if args.json {
        return terminal::json(&object);
    }
    let files = [&outputs.svg, &outputs.csv, &outputs.json].map(|o| o.path().display().to_string());
    let text = table::text(about, measured, outcomes);
    terminal::result(&format!("{text}\n\nwritten: {}", files.join(" ")))
}

/// Reads a reference, all of whose values must be numbers.
fn finite(path: &Path) -> Result<Picture, Failure> {
    let picture = read(path)?;
    match picture.pixels.iter().all(|p| p.is_finite()) {
        true => Ok(picture),
        false => Err(Failure::new(format!("{}: not all pixels are finite numbers", path.display()))),
    }
}

/// The film and the camera: small, as the choices compare alike at any size.
fn view(
    args: &TradeoffArgs,
    description: &Description,
    reference: Option<&Picture>,
) -> Result<(Film, Camera), Failure> {
    let shape = f64::from(description.height) / f64::from(description.width);
    let width = match (args.width, reference) {
        (Some(width), _) => width,
        (None, Some(picture)) => picture.width,
        (None, None) => description.width.min(WIDTH),
    };
    let height = ((f64::from(width) * shape).round() as u32).max(1);
    if let Some(picture) = reference
        && (picture.width, picture.height) != (width, height)
    {
        return Err(Failure::new(format!(
            "the reference is {}×{} pixels, the picture {width}×{height}",
            picture.width, picture.height
        ))
        .tip("render the reference without --crop, in the shape of the scene"));
    }
    let film = Film::new(width, height, description.filter).map_err(Failure::new)?;
    Ok((film, description.camera.camera(width, height).map_err(Failure::new)?))
}

/// The files.
#[derive(Debug)]
struct Outputs {
    svg: Output,
    csv: Output,
    json: Output,
}

impl Outputs {
    /// Checks that they can be written.
    fn check(args: &TradeoffArgs, scene: &str) -> Result<Self, Failure> {
        let stem = Path::new(scene).file_stem().unwrap_or_default().to_string_lossy();
        let base = args.output.clone().unwrap_or_else(|| PathBuf::from(format!("{stem}-tradeoff")));
        let with = |extension: &str| {
            let mut name = base.clone().into_os_string();
            name.push(extension);
            Output::check(Path::new(&name))
        };
        Ok(Self { svg: with(".svg")?, csv: with(".csv")?, json: with(".json")? })
    }
}
