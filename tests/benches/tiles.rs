//! Whole tiles of the built-in scenes, as `halflight render` makes them: what a sample costs from the camera
//! to the pixel.
//!
//! ```text
//! cargo bench -p halflight-tests --bench tiles
//! ```

use criterion::{Criterion, Throughput};
use halflight::build::{FEW_LIGHTS, SceneBuffers};
use halflight::choose::LightChoice;
use halflight::estimate::{Direct, Heuristic, Job, PixelStats};
use halflight::film::{Film, PixelRect};
use halflight::load::builtin::{BUILTIN, builtin};
use halflight::sequence::ZSobol;
use std::time::Duration;

const SAMPLES: u32 = 16;

fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(2))
        .sample_size(10)
        .configure_from_args();
    let mut group = criterion.benchmark_group("tile");
    for scene in BUILTIN {
        let description = builtin(scene.name).expect("a built-in scene");
        let buffers = SceneBuffers::new(&description).expect("a proper scene");
        let bound = buffers.bind();
        let (width, height) = (description.width, description.height);
        let technique = description.required_technique(description.integrator, Heuristic::Power);
        let many = bound.scene().lights().len() > FEW_LIGHTS;
        let choice = if many { LightChoice::Tree(buffers.light_tree()) } else { LightChoice::All };
        let job = Job {
            scene: bound.scene(),
            camera: description.camera.camera(width, height).expect("a camera"),
            film: Film::new(width, height, description.filter).expect("a film"),
            estimator: Direct { technique, choice, ..Direct::default() },
            sequence: ZSobol::new(0, width, SAMPLES),
        };
        // The middle of the picture.
        let (x0, y0) = ((width / 2) & !31, (height / 2) & !31);
        let tile = PixelRect { x0, y0, x1: x0 + 32, y1: y0 + 32 };
        group.throughput(Throughput::Elements(u64::from(SAMPLES) * tile.area() as u64));
        group.bench_function(scene.name, |bencher| {
            bencher.iter(|| {
                let mut pixels = vec![PixelStats::NEW; tile.area()];
                job.render(tile, 0..SAMPLES, &mut pixels);
                pixels
            });
        });
    }
}
