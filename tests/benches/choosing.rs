//! What choosing one of many lights costs, by how many there are, and what building the tree takes.
//!
//! ```text
//! cargo bench -p halflight-tests --bench choosing
//! ```

use criterion::{BenchmarkId, Criterion};
use halflight::Rgb;
use halflight::build::LightTreeBuffers;
use halflight::light::{AnyLight, AreaLight, Receiver};
use halflight::shape::Triangle;
use halflight_tests::random::Uniforms;
use std::hint::black_box;
use std::time::Duration;

const COUNTS: [usize; 5] = [1, 10, 300, 10_000, 1_000_000];

/// Small triangles in a cube.
fn lights(count: usize) -> Vec<AnyLight<'static>> {
    let mut random = Uniforms::new(1);
    let size = 0.3 / (count as f32).sqrt();
    let mut light = || {
        let (at, n) = (random.in_cube(), random.direction());
        let s = n.any_orthonormal_vector() * size;
        let shape = Triangle::new(at, at + s, at + n.cross(s)).expect("a triangle");
        AnyLight::Triangle(AreaLight::new(shape, Rgb::splat(random.one())).expect("a radiance"))
    };
    (0..count).map(|_| light()).collect()
}

fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(800))
        .sample_size(10)
        .configure_from_args();
    let mut random = Uniforms::new(2);
    let mut draw = || {
        let from = Receiver { point: random.in_cube(), normal: random.direction() };
        (from, random.two())
    };
    let draws: Vec<_> = (0..512).map(|_| draw()).collect();
    for count in COUNTS {
        let lights = lights(count);
        let mut group = criterion.benchmark_group("light tree");
        group.bench_function(BenchmarkId::new("build", count), |b| {
            b.iter(|| LightTreeBuffers::new(black_box(&lights)));
        });
        let buffers = LightTreeBuffers::new(&lights);
        let tree = buffers.tree().expect("what was built is a tree");
        let mut places = draws.iter().cycle();
        group.bench_function(BenchmarkId::new("choose", count), |b| {
            b.iter(|| places.next().map(|(from, [u, more])| tree.choose(black_box(from), *u, || *more)));
        });
        let (mut places, mut light) = (draws.iter().cycle(), 0);
        group.bench_function(BenchmarkId::new("probability", count), |b| {
            b.iter(|| {
                light = (light + 7919) % count;
                places.next().map(|(from, _)| tree.pmf(black_box(from), light))
            });
        });
    }
    criterion.final_summary();
}
