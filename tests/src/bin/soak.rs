//! Renders random scenes for a long time, and looks for what may never happen.

use clap::Parser;
use halflight::build::{Description, SceneBuffers};
use halflight::choose::LightChoice;
use halflight::estimate::{AdaptiveTile, Direct, Heuristic, Job, PixelStats, TILE, Target, Technique};
use halflight::film::PixelRect;
use halflight::load::{Encoding, LoadOptions, export_mitsuba, load, read_image};
use halflight::sequence::Sobol;
use halflight::{Film, Rgb};
use halflight_tests::soak::scene;
use std::cell::Cell;
use std::panic::{set_hook, take_hook};
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;
use std::time::{Duration, Instant};

/// Random scenes: exported as Mitsuba XML and read again, rendered with 4 samples a pixel whole and in two
/// parts, which must give the same bits; adaptively too. Every pixel must be finite and not negative.
///
/// The exit code is 1 when something is wrong; a panic names its seed.
#[derive(Debug, Parser)]
#[command(name = "soak")]
struct Arguments {
    /// How long
    #[arg(long, default_value_t = 60.0)]
    minutes: f64,
    /// The first seed; each scene takes the next one
    #[arg(long, default_value_t = 0)]
    seed: u64,
    /// Threads
    #[arg(long, default_value_t = 1)]
    threads: usize,
    /// The command line; with it, each 16th scene is rendered in two parts and merged by it, too
    #[arg(long)]
    cli: Option<PathBuf>,
}

/// What was found.
#[derive(Debug, Default)]
struct Found {
    scenes: u64,
    pixels: u64,
    bad_pixels: u64,
    rejected_samples: u64,
    /// Not exported, built or read; scenes may be refused, but what was exported must be read.
    not_exported: u64,
    not_built: u64,
    by_cli: u64,
    wrong: Vec<String>,
}

thread_local! {
    /// The seed that this thread is at.
    static SEED: Cell<u64> = const { Cell::new(0) };
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let usual = take_hook();
    set_hook(Box::new(move |info| {
        eprintln!("seed {}:", SEED.get());
        usual(info);
    }));
    let (next, found) = (AtomicU64::new(arguments.seed), Mutex::new(Found::default()));
    let end = Instant::now() + Duration::from_secs_f64(arguments.minutes * 60.0);
    thread::scope(|scope| {
        for _ in 0..arguments.threads.max(1) {
            let work = || {
                let folder = tempfile::tempdir().expect("a temporary folder");
                while Instant::now() < end {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    SEED.set(seed);
                    let one = examine(seed, folder.path(), arguments.cli.as_deref());
                    found.lock().expect("no thread has panicked").take(one);
                }
            };
            // Tiles are large, and nothing may be optimised away.
            let builder = thread::Builder::new().stack_size(16 << 20);
            builder.spawn_scoped(scope, work).expect("a thread");
        }
    });
    let found = found.into_inner().expect("no thread has panicked");
    println!("seeds {} to {}: {found:#?}", arguments.seed, next.into_inner() - 1);
    ExitCode::from(u8::from(found.bad_pixels > 0 || !found.wrong.is_empty()))
}

impl Found {
    /// Takes in what was found in another scene.
    fn take(&mut self, other: Self) {
        self.scenes += other.scenes;
        self.pixels += other.pixels;
        self.bad_pixels += other.bad_pixels;
        self.rejected_samples += other.rejected_samples;
        self.not_exported += other.not_exported;
        self.not_built += other.not_built;
        self.by_cli += other.by_cli;
        self.wrong.extend(other.wrong);
    }

    /// Looks at radiances.
    fn look(&mut self, what: &str, seed: u64, pixels: impl Iterator<Item = Rgb>) {
        let before = self.bad_pixels;
        for pixel in pixels {
            self.pixels += 1;
            self.bad_pixels += u64::from(!pixel.is_valid());
        }
        if self.bad_pixels > before {
            self.wrong.push(format!("seed {seed}: {} bad pixels {what}", self.bad_pixels - before));
        }
    }
}

/// One scene.
fn examine(seed: u64, folder: &Path, cli: Option<&Path>) -> Found {
    let mut found = Found { scenes: 1, ..Found::default() };
    let mut description = scene(seed);
    let path = folder.join("scene.xml");
    if export_mitsuba(&description, &path).is_ok() {
        match load(&path, &LoadOptions::default()) {
            Ok(loaded) => description = loaded.description,
            Err(e) => found.wrong.push(format!("seed {seed}: exported and not read: {e}")),
        }
        if let (0, Some(cli)) = (seed % 16, cli) {
            by_cli(cli, folder, seed, &mut found);
        }
    } else {
        found.not_exported = 1;
    }
    match SceneBuffers::new(&description) {
        Ok(buffers) => in_core(seed, &description, &buffers, &mut found),
        Err(_) => found.not_built = 1,
    }
    found
}

/// Whole, in parts, and adaptively.
fn in_core(seed: u64, description: &Description, buffers: &SceneBuffers, found: &mut Found) {
    let (width, height) = (description.width, description.height);
    let film = Film::new(width, height, description.filter).expect("a film");
    let camera = description.camera.camera(width, height).expect("a camera");
    let bound = buffers.bind();
    let power = Heuristic::Power;
    let techniques = [
        Technique::Light,
        Technique::Bsdf,
        Technique::Mis(power),
        Technique::Auto(power),
        Technique::Control(power),
    ];
    let choices = [LightChoice::All, LightChoice::Uniform, LightChoice::Tree(buffers.light_tree())];
    let technique = techniques[seed as usize % techniques.len()];
    let choice = choices[seed as usize / techniques.len() % choices.len()];
    let estimator = Direct { technique, choice, ..Direct::default() };
    let job = Job { scene: bound.scene(), camera, film, estimator, sequence: Sobol::new(seed as u32) };
    let mut whole = vec![PixelStats::NEW; film.crop().area()];
    job.render(film.crop(), 0..4, &mut whole);
    found.rejected_samples += whole.iter().map(|p| u64::from(p.rejected())).sum::<u64>();
    found.look("in the whole picture", seed, whole.iter().map(PixelStats::mean));
    // Two parts, the second after its first two samples elsewhere.
    for (number, rows) in [(0, 0..height / 2), (1, height / 2..height)] {
        let rect = PixelRect { x0: 0, y0: rows.start, x1: width, y1: rows.end };
        let mut part = vec![PixelStats::NEW; rect.area()];
        job.render(rect, 0..2, &mut part);
        let mut part: Vec<_> = part.iter().map(|p| PixelStats::from_words(p.to_words())).collect();
        job.render(rect, 2..4, &mut part);
        let start = (rows.start * width) as usize;
        if part.iter().zip(&whole[start..]).any(|(ours, theirs)| ours.to_words() != theirs.to_words()) {
            found.wrong.push(format!("seed {seed}: part {number} differs"));
        }
    }
    let rect = PixelRect { x0: 0, y0: 0, x1: width.min(TILE), y1: height.min(TILE) };
    let (mut tile, mut pixels) = (AdaptiveTile::new(rect), vec![PixelStats::NEW; rect.area()]);
    let target = Target::new(0.2, 32);
    while job.refine(&mut tile, &target, &mut pixels, || true) > 0 {
        match AdaptiveTile::from_words(rect, &tile.to_words()) {
            Some(again) => tile = again,
            None => found.wrong.push(format!("seed {seed}: a tile that cannot be kept")),
        }
    }
    found.look("in an adaptive tile", seed, pixels.iter().map(PixelStats::mean));
}

/// Two parts and their merging, by the command line.
fn by_cli(cli: &Path, folder: &Path, seed: u64, found: &mut Found) {
    let mut run = |arguments: &str| {
        let output = Command::new(cli).args(arguments.split(' ')).current_dir(folder).output();
        let output = output.expect("the command line runs");
        // 2: refused with a message, as a scene without light is.
        if !matches!(output.status.code(), Some(0 | 2)) {
            let said = String::from_utf8_lossy(&output.stderr);
            found.wrong.push(format!("seed {seed}: {arguments}: {}: {said}", output.status));
        }
        output.status.success()
    };
    let render = "render scene.xml --spp 4 --threads 1 --quiet";
    let all = run(&format!("{render} --part 1/2 -o 1.part"))
        && run(&format!("{render} --part 2/2 -o 2.part"))
        && run("merge 1.part 2.part -o merged.exr --quiet")
        && run(&format!("{render} -o once.exr"));
    if !all {
        return;
    }
    found.by_cli += 1;
    let picture = |name: &str| read_image(&folder.join(name), Encoding::Linear).expect("a picture");
    let (merged, once) = (picture("merged.exr"), picture("once.exr"));
    if merged.texels != once.texels {
        found.wrong.push(format!("seed {seed}: the merged picture differs"));
    }
    found.look("in the merged picture", seed, merged.texels.into_iter());
}
