//! `halflight render`: a scene to a picture.

use super::batch;
use super::keeping::{self, Destination};
use crate::args::{Environment, Portals, RenderArgs, Technique};
use crate::driver::{self, Goal, Rendered};
use crate::failure::{Exit, Failure};
use crate::fingerprint;
use crate::goal;
use crate::interrupt::on_interrupt;
use crate::keep::Keeper;
use crate::memory;
use crate::number::{counted, percent};
use crate::plan::{self, Plan};
use crate::preview::{Preview, Shown};
use crate::progress::{RenderBar, Step};
use crate::report::{Report, Seconds};
use crate::save::Saved;
use crate::scene::{self, Found};
use crate::terminal;
use crate::tiles::{self, Part, Stored};
use halflight::build::{Description, SceneBuffers};
use halflight::estimate::{Job, LayeredPixel, PixelStats};
use halflight::light::Emitter;
use halflight::{Camera, Film};
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::thread::available_parallelism;
use std::time::Instant;

/// A scene ready for rendering; its meshes are gone.
#[derive(Debug)]
pub(super) struct Prepared {
    pub(super) found: Found,
    pub(super) fingerprint: String,
    pub(super) buffers: SceneBuffers,
    pub(super) camera: Camera,
    pub(super) film: Film,
    pub(super) plan: Plan,
    pub(super) goal: Goal,
    seconds: Seconds,
    /// Whether the scene has portals, used or not.
    has_portals: bool,
}

/// Renders a scene and writes the picture.
pub(crate) fn run(args: &RenderArgs) -> Result<Exit, Failure> {
    run_keeping(args, true)
}

/// Renders a scene, and writes the part that there is at an interrupt when `keeps_parts`.
fn run_keeping(args: &RenderArgs, keeps_parts: bool) -> Result<Exit, Failure> {
    let begin = Instant::now();
    check(args)?;
    let to = Destination::check(args)?;
    let pool = pool(args.threads)?;
    let mut prepared = prepare(args, begin)?;
    prepared.warn_of(args, &to)?;
    prepared.picture(args, &to, &pool, keeps_parts)
}

/// Renders a scene as [`run`] does; what is interrupted is not written.
pub(super) fn run_whole(args: &RenderArgs) -> Result<Exit, Failure> {
    run_keeping(args, false)
}

/// Refuses flags that contradict each other.
pub(super) fn check(args: &RenderArgs) -> Result<(), Failure> {
    plan::check(&args.choices)?;
    goal::check(args)?;
    check_visibility(args)
}

/// Visibility is seen by light samples.
fn check_visibility(args: &RenderArgs) -> Result<(), Failure> {
    if args.visibility_image.is_some() && args.choices.technique == Technique::Bsdf {
        return Err(Failure::new(
            "--visibility-image has no use with --technique bsdf, which samples no light",
        )
        .tip("leave one of them out"));
    }
    Ok(())
}

/// Renders, writes and reports, with pixels that know as much as is asked for.
///
/// * `keeps_parts` – whether what was rendered until an interrupt is written
fn finish<P: Saved + Stored>(
    args: &RenderArgs,
    prepared: &mut Prepared,
    to: &Destination,
    pool: &ThreadPool,
    keeps_parts: bool,
) -> Result<Exit, Failure> {
    let keeper = keeping::keeper(args, prepared, to)?;
    prepared.warn_of_empty_parts(args);
    let start = Instant::now();
    let rendered = pool.install(|| render::<P>(args, prepared, &keeper))?;
    prepared.seconds.render = start.elapsed().as_secs_f64();
    if rendered.interrupted && !keeps_parts {
        return Ok(Exit::Interrupted);
    }
    if rendered.rejected() > 0 {
        let samples = counted(rendered.rejected(), "sample");
        prepared.warn(format!(
            "{samples} left out that came to no finite number; the picture misses their light"
        ));
    }
    prepared.warn_of_missed(&rendered);
    prepared.warn_of_the_dark(args, &rendered);
    let mut report = report(args, prepared, &rendered, pool.current_num_threads());
    let start = Instant::now();
    if let Destination::Picture(files) = to {
        let _step = Step::begin(format!("writing {}", args.output.display()), args.quiet);
        files.write(args, &rendered, &report.header())?;
    }
    if !rendered.interrupted {
        keeper.forget();
    }
    report.seconds.save = start.elapsed().as_secs_f64();
    tell(args, &report)
}

/// What was asked for, or stands in the scene, in vain.
fn without_effect(args: &RenderArgs, prepared: &Prepared) -> Vec<&'static str> {
    let description = &prepared.found.description;
    let has_map = !description.environments.is_empty();
    let has_sky = has_map || description.lights.iter().any(Emitter::is_environment);
    let asked = [
        (
            args.choices.bsdf_samples.is_some() && prepared.plan.has_paths(),
            "--bsdf-samples has no effect: a path goes on in one direction",
        ),
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

/// The share of black pixels that nobody wants.
const DARK: f64 = 0.99;

/// Bytes of a thread's stack: tiles are large where nothing is optimised away.
const STACK: usize = 16 << 20;

/// The threads that render.
///
/// * `threads` – how many; as many as there are cores where nobody says
pub(super) fn pool(threads: Option<usize>) -> Result<ThreadPool, Failure> {
    let threads = threads.unwrap_or_else(|| available_parallelism().map_or(1, usize::from));
    ThreadPoolBuilder::new().num_threads(threads).stack_size(STACK).build().map_err(|e| {
        Failure::new(format!("cannot start {}: {e}", counted(threads as u64, "thread")))
            .tip("ask for fewer with --threads")
    })
}

/// Everything before the first sample.
pub(super) fn prepare(args: &RenderArgs, begin: Instant) -> Result<Prepared, Failure> {
    let mut seconds = Seconds::default();
    let name = scene::shown(args.scene.as_deref());
    let (mut found, has_portals) = {
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
        memory::check_tree(found.description.triangle_count() as u64).map_err(|e| e.about(&name))?;
        let buffers =
            SceneBuffers::new(&found.description).map_err(|e| Failure::new(format!("{name}: {e}")))?;
        seconds.build = start.elapsed().as_secs_f64();
        buffers
    };
    let plan = plan::make(&args.choices, &found.description, &buffers.bind()).map_err(|e| e.about(&name))?;
    let goal = goal::make(args, &found.description, begin).map_err(|e| e.about(&name))?;
    let degenerate = buffers.stats().degenerate as u64;
    let fingerprint = fingerprint::of_scene(&mut found.description);
    found.description.forget_meshes();
    let mut prepared =
        Prepared { found, fingerprint, buffers, camera, film, plan, goal, seconds, has_portals };
    if degenerate > 0 {
        prepared.warn(format!("{} without area left out", counted(degenerate, "triangle")));
    }
    Ok(prepared)
}

impl Prepared {
    /// Renders, writes and reports, with pixels that know as much as is asked for.
    pub(super) fn picture(
        &mut self,
        args: &RenderArgs,
        to: &Destination,
        pool: &ThreadPool,
        keeps_parts: bool,
    ) -> Result<Exit, Failure> {
        if args.sees_layers() {
            finish::<LayeredPixel>(args, self, to, pool, keeps_parts)
        } else {
            finish::<PixelStats>(args, self, to, pool, keeps_parts)
        }
    }

    /// Warns of what has no effect.
    ///
    /// # Errors
    /// When the picture does not fit its format.
    pub(super) fn warn_of(&mut self, args: &RenderArgs, to: &Destination) -> Result<(), Failure> {
        if let Destination::Picture(files) = to {
            files.format().check_size(self.film.crop().width(), self.film.crop().height())?;
            for flag in args.showing.in_vain(files.format()) {
                self.warn(format!("{flag} has no effect on {}", args.output.display()));
            }
        }
        without_effect(args, self).into_iter().for_each(|text| self.warn(text.to_owned()));
        if let Some(path) = self.found.camera_path.as_ref().filter(|_| args.frames.is_none()) {
            let end = path.end();
            let last = (end * batch::RATE).ceil();
            self.warn(format!("the camera moves for {end} s: --frames 0..{last} renders its way"));
        }
        Ok(())
    }

    /// The choices that were made, by the names of their flags.
    pub(super) fn choices(&self) -> Vec<(String, String)> {
        self.plan.flags().into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// Prints a warning and keeps it for the report.
    fn warn(&mut self, text: String) {
        terminal::warning(&text);
        self.found.warnings.push(text);
    }

    /// Says which pixels have not reached the error that was asked for.
    fn warn_of_missed<P: Stored>(&mut self, rendered: &Rendered<P>) {
        if let (Goal::Error { target, most, .. }, 1..) = (self.goal, rendered.missed) {
            let (missed, all) = (counted(rendered.missed, "pixel"), rendered.area());
            let target = percent(target);
            self.warn(format!(
                "{missed} of {all} did not reach {target} with {most} samples each; --max-spp allows more"
            ));
        }
    }

    /// Says that there are more parts than tiles.
    fn warn_of_empty_parts(&mut self, args: &RenderArgs) {
        let side = driver::side(self.goal);
        let tiles = tiles::places(self.film.crop(), side, Part::WHOLE).count();
        if let Some(part) = args.part.filter(|part| part.of as usize > tiles) {
            self.warn(format!(
                "only {tiles} of {} parts can hold anything: the picture has {} of {side}×{side} pixels; more \
                 parts are of no use",
                part.of,
                counted(tiles as u64, "tile"),
            ));
        }
    }

    /// Says that next to nothing is to be seen.
    fn warn_of_the_dark<P: Stored>(&mut self, args: &RenderArgs, rendered: &Rendered<P>) {
        let share = rendered.dark() as f64 / rendered.area().max(1) as f64;
        if args.part.is_none() && share > DARK {
            self.warn(format!(
                "{} of the pixels are black: hardly any light reaches what the camera sees",
                percent(share)
            ));
        }
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
    let layers = args.sees_layers();
    let pixel = if layers { size_of::<LayeredPixel>() } else { size_of::<PixelStats>() };
    memory::check_film(&film, args.part.map_or(1, |part| part.of), pixel, layers)?;
    let camera = description.camera.camera(width, height).map_err(Failure::new)?;
    Ok((film, camera))
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
fn render<P: Saved + Stored>(
    args: &RenderArgs,
    prepared: &Prepared,
    keeper: &Keeper,
) -> Result<Rendered<P>, Failure> {
    let Prepared { buffers, camera, film, plan, goal, .. } = prepared;
    let bound = buffers.bind();
    let job = Job {
        scene: bound.scene(),
        camera: *camera,
        film: *film,
        estimator: plan.estimator(buffers),
        sequence: plan.sequence(args.seed, film.width(), goal.samples()),
    };
    let stop = on_interrupt()?;
    let preview = args.preview.and_then(|how| Preview::begin(how, film.crop(), args.showing));
    let work = Shown { work: &job, preview: preview.as_ref() };
    let places = tiles::places(film.crop(), driver::side(*goal), keeper.part());
    let pixels = places.map(|(_, rect)| rect.area() as u64).sum();
    let bar = RenderBar::new(pixels, *goal, args.quiet || preview.is_some());
    driver::render(film.crop(), *goal, (&stop, keeper), &work, &|event| bar.show(event))
}

/// The render in numbers.
fn report<P: Saved>(
    args: &RenderArgs,
    prepared: &Prepared,
    rendered: &Rendered<P>,
    threads: usize,
) -> Report {
    let stats = prepared.buffers.stats();
    let crop = prepared.film.crop();
    Report {
        file: args.output.clone(),
        scene: prepared.found.description.name.clone(),
        size: (crop.width(), crop.height()),
        at: (crop.x0, crop.y0),
        film: (prepared.film.width(), prepared.film.height()),
        part: args.part,
        pixels: rendered.area(),
        samples_per_pixel: rendered.samples_per_pixel(),
        samples: rendered.samples(),
        triangles: stats.triangles as u64,
        lights: stats.lights as u64,
        seconds: prepared.seconds,
        error: rendered.error,
        missed: rendered.missed,
        adaptive: prepared.goal.is_adaptive(),
        rejected: rendered.rejected(),
        interrupted: rendered.interrupted,
        seed: args.seed,
        threads,
        choices: prepared.choices(),
        warnings: prepared.found.warnings.clone(),
    }
}

/// Says how it went.
fn tell(args: &RenderArgs, report: &Report) -> Result<Exit, Failure> {
    if report.interrupted {
        let (file, samples) = (report.file.display(), report.samples_per_pixel());
        let holds = match args.part {
            None => format!("{file} holds what was rendered so far, {samples}"),
            Some(_) => format!("{file} was not written"),
        };
        let goes_on = match args.checkpoint {
            None => "",
            Some(_) => "; the same command goes on from its checkpoint",
        };
        terminal::remark(format!("interrupted: {holds}{goes_on}"));
    }
    let has_result = !(report.interrupted && args.part.is_some());
    if args.json {
        terminal::json(&report.json())?;
    } else if !args.quiet && has_result {
        terminal::result(&report.line())?;
    }
    Ok(match (report.interrupted, report.missed) {
        (true, _) => Exit::Interrupted,
        // A part is as good as it can be; merge says whether the picture is.
        (false, 0) => Exit::Good,
        (false, _) if args.part.is_some() => Exit::Good,
        _ => Exit::CheckFailed,
    })
}
