//! `halflight render`: a scene to a picture.

use crate::args::{Environment, Portals, RenderArgs};
use crate::driver::{self, Rendered};
use crate::failure::{Exit, Failure};
use crate::interrupt::on_interrupt;
use crate::number::{bytes, counted};
use crate::output::Output;
use crate::picture::{Format, Picture};
use crate::plan::{self, Plan};
use crate::progress::{RenderBar, Step};
use crate::report::{Report, Seconds};
use crate::scene::{self, Found};
use crate::terminal;
use halflight::build::{Description, SceneBuffers};
use halflight::estimate::{Job, PixelStats};
use halflight::light::Emitter;
use halflight::{Camera, Film};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::hint::black_box;
use std::thread::available_parallelism;
use std::time::Instant;

/// Samples per pixel where neither the user nor the scene says.
const DEFAULT_SAMPLES: u32 = 64;

/// A scene ready for rendering.
#[derive(Debug)]
struct Prepared {
    found: Found,
    buffers: SceneBuffers,
    camera: Camera,
    film: Film,
    plan: Plan,
    samples: u32,
    seconds: Seconds,
    /// Whether the scene has portals, used or not.
    has_portals: bool,
}

/// Renders a scene and writes the picture.
pub(crate) fn run(args: &RenderArgs) -> Result<Exit, Failure> {
    let format = Format::of(&args.output)?;
    plan::check(&args.choices)?;
    let output = Output::check(&args.output)?;
    let pool = pool(args)?;
    let mut prepared = prepare(args)?;
    if args.exposure.is_some() && !format.is_8_bit() {
        prepared.warn(format!("--exposure has no effect on {}; it is for .png", args.output.display()));
    }
    without_effect(args, &prepared).into_iter().for_each(|text| prepared.warn(text.to_owned()));
    let start = Instant::now();
    let rendered = pool.install(|| render(args, &prepared))?;
    prepared.seconds.render = start.elapsed().as_secs_f64();
    if rendered.rejected() > 0 {
        let samples = counted(rendered.rejected(), "sample");
        prepared.warn(format!(
            "{samples} left out that came to no finite number; the picture misses their light"
        ));
    }
    let start = Instant::now();
    save(args, format, &output, &rendered, &prepared)?;
    prepared.seconds.save = start.elapsed().as_secs_f64();
    tell(args, &report(args, prepared, &rendered, pool.current_num_threads()))
}

/// What was asked for, or stands in the scene, in vain.
fn without_effect(args: &RenderArgs, prepared: &Prepared) -> Vec<&'static str> {
    let description = &prepared.found.description;
    let has_map = !description.environments.is_empty();
    let has_sky = has_map || description.lights.iter().any(Emitter::is_environment);
    let asked = [
        (
            args.choices.environment != Environment::Auto && !has_map,
            "--environment has no effect: the scene has no environment map",
        ),
        (
            args.choices.portals == Portals::Off && !prepared.has_portals,
            "--portals has no effect: the scene has no portals",
        ),
        (
            prepared.has_portals && !has_sky,
            "the portals have no effect: no light surrounds the scene; --sky puts one there",
        ),
    ];
    asked.into_iter().filter(|(in_vain, _)| *in_vain).map(|(_, text)| text).collect()
}

/// The threads that render.
fn pool(args: &RenderArgs) -> Result<ThreadPool, Failure> {
    let threads = args.threads.unwrap_or_else(|| available_parallelism().map_or(1, usize::from));
    ThreadPoolBuilder::new().num_threads(threads).build().map_err(|e| {
        Failure::new(format!("cannot start {}: {e}", counted(threads as u64, "thread")))
            .tip("ask for fewer with --threads")
    })
}

/// Everything before the first sample.
fn prepare(args: &RenderArgs) -> Result<Prepared, Failure> {
    let mut seconds = Seconds::default();
    let name = scene::shown(args.scene.as_deref());
    let (found, has_portals) = {
        let _step = Step::begin(format!("reading {name}"), args.quiet);
        let start = Instant::now();
        let mut found = scene::find(args.scene.as_deref(), &args.reading)?;
        let has_portals = !found.description.portals.is_empty();
        plan::choose_environment(&args.choices, &mut found.description);
        seconds.load = start.elapsed().as_secs_f64();
        (found, has_portals)
    };
    found.print_warnings();
    let (film, camera) = view(args, &found.description)?;
    let buffers = {
        let _step = Step::begin(format!("building the tree for {name}"), args.quiet);
        let start = Instant::now();
        let buffers =
            SceneBuffers::new(&found.description).map_err(|e| Failure::new(format!("{name}: {e}")))?;
        seconds.build = start.elapsed().as_secs_f64();
        buffers
    };
    let plan = plan::make(&args.choices, &found.description, &buffers.bind()).map_err(|e| e.about(&name))?;
    let samples = args.spp.or(found.description.samples_per_pixel).unwrap_or(DEFAULT_SAMPLES);
    if samples == 0 {
        return Err(Failure::new("0 samples per pixel make no picture")
            .about(&name)
            .tip("choose some with --spp"));
    }
    let degenerate = buffers.stats().degenerate as u64;
    let mut prepared = Prepared { found, buffers, camera, film, plan, samples, seconds, has_portals };
    if degenerate > 0 {
        prepared.warn(format!("{} without area left out", counted(degenerate, "triangle")));
    }
    Ok(prepared)
}

impl Prepared {
    /// Prints a warning and keeps it for the report.
    fn warn(&mut self, text: String) {
        terminal::warning(&text);
        self.found.warnings.push(text);
    }
}

/// The film and the camera, after the flags that change them.
fn view(args: &RenderArgs, description: &Description) -> Result<(Film, Camera), Failure> {
    let (width, height) = size(args, description);
    let mut film = Film::new(width, height, description.filter).map_err(Failure::new)?;
    if let Some(crop) = args.crop {
        film = film.with_crop(crop).map_err(|e| {
            Failure::new(e).tip(format!("the film is {width}×{height} pixels; choose --crop within it"))
        })?;
    }
    check_memory(&film)?;
    let camera = description.camera.camera(width, height).map_err(Failure::new)?;
    Ok((film, camera))
}

/// Asks for the film's memory once as a whole: piece by piece, the system would promise more than it
/// has, and end the program later.
fn check_memory(film: &Film) -> Result<(), Failure> {
    let pixels = film.crop().area();
    let mut probe = Vec::<PixelStats>::new();
    let granted = probe.try_reserve_exact(pixels).is_ok();
    black_box(&probe);
    if granted {
        return Ok(());
    }
    let (width, height) = (film.crop().width(), film.crop().height());
    let needed = bytes(pixels as u64 * size_of::<PixelStats>() as u64);
    Err(Failure::new(format!("{width}×{height} pixels need {needed} of memory, more than there is"))
        .tip("choose a smaller --width and --height, or a part with --crop"))
}

/// Columns and rows; one that is not given follows from the other, so that the picture keeps its shape.
fn size(args: &RenderArgs, description: &Description) -> (u32, u32) {
    let (width, height) = (f64::from(description.width), f64::from(description.height));
    let rounded = |pixels: f64| (pixels.round() as u32).max(1);
    match (args.width, args.height) {
        (Some(w), Some(h)) => (w, h),
        (Some(w), None) => (w, rounded(f64::from(w) * height / width)),
        (None, Some(h)) => (rounded(f64::from(h) * width / height), h),
        (None, None) => (description.width, description.height),
    }
}

/// Takes the samples.
fn render(args: &RenderArgs, prepared: &Prepared) -> Result<Rendered, Failure> {
    let Prepared { buffers, camera, film, plan, samples, .. } = prepared;
    let bound = buffers.bind();
    let job = Job {
        scene: bound.scene(),
        camera: *camera,
        film: *film,
        estimator: plan.estimator(buffers),
        sequence: plan.sequence(args.seed, film.width(), *samples),
    };
    let stop = on_interrupt()?;
    let bar = RenderBar::new(film.crop().area() as u64, *samples, args.quiet);
    let render_tile = |tile, samples, pixels: &mut [_]| job.render(tile, samples, pixels);
    Ok(driver::render(film.crop(), *samples, &stop, &render_tile, &|event| bar.show(event)))
}

/// Writes the picture.
fn save(
    args: &RenderArgs,
    format: Format,
    output: &Output,
    rendered: &Rendered,
    prepared: &Prepared,
) -> Result<(), Failure> {
    let _step = Step::begin(format!("writing {}", output.path().display()), args.quiet);
    let crop = prepared.film.crop();
    let pixels = rendered.pixels(|p| p.mean());
    let picture = Picture { width: crop.width(), height: crop.height(), pixels };
    output.write(&format.encode(&picture, args.exposure.unwrap_or(0.0))?)
}

/// The render in numbers.
fn report(args: &RenderArgs, prepared: Prepared, rendered: &Rendered, threads: usize) -> Report {
    let stats = prepared.buffers.stats();
    let crop = prepared.film.crop();
    Report {
        file: args.output.clone(),
        scene: prepared.found.description.name,
        size: (crop.width(), crop.height()),
        samples_per_pixel: rendered.samples_per_pixel(),
        samples: rendered.samples(),
        triangles: stats.triangles as u64,
        lights: stats.lights as u64,
        seconds: prepared.seconds,
        error: rendered.relative_error(),
        rejected: rendered.rejected(),
        interrupted: rendered.interrupted,
        seed: args.seed,
        threads,
        choices: prepared.plan.flags(),
        warnings: prepared.found.warnings,
    }
}

/// Says how it went.
fn tell(args: &RenderArgs, report: &Report) -> Result<Exit, Failure> {
    if report.interrupted {
        let (file, samples) = (report.file.display(), report.samples_per_pixel());
        terminal::remark(format!("interrupted: {file} holds what was rendered so far, {samples}"));
    }
    if args.json {
        terminal::json(&report.json())?;
    } else if !args.quiet {
        terminal::result(&report.line())?;
    }
    Ok(if report.interrupted { Exit::Interrupted } else { Exit::Good })
}
