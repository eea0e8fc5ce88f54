//! What each density of each light costs, beside the variance that it leaves: the trade as a table.
//!
//! ```text
//! cargo bench -p halflight-tests --bench lights
//! ```
//!
//! Times are criterion's; the table at the end repeats the fastest run of each. The variance is that
//! of one sample of the unshadowed irradiance, divided by its square, averaged over the receivers.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion};
use halflight::Rgb;
use halflight::geom::{Ray, offset_origin};
use halflight::glam::Vec3;
use halflight::light::{
    AreaLight, Density, Emitter, LightSample, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceView,
};
use halflight::shape::{Cylinder, Disk, Polygon, Rectangle, Sphere, Triangle};
use halflight_tests::random::Uniforms;
use halflight_tests::scenes::bumpy_ground;
use halflight_tests::statistics::Moments;
use std::hint::black_box;
use std::time::{Duration, Instant};

const DENSITIES: [(&str, SurfaceDensity); 4] = [
    ("area", SurfaceDensity::Area),
    ("solid angle", SurfaceDensity::SolidAngle),
    ("projected", SurfaceDensity::Projected),
    ("auto", SurfaceDensity::Auto),
];

/// Receivers for each measurement, so that no branch is learnt by heart.
const RECEIVERS: usize = 512;

/// Heights at which variances are given, in sizes of the light.
const HEIGHTS: [f32; 4] = [0.1, 0.5, 2.0, 8.0];

/// Height at which times are measured.
const TIMED: f32 = 0.5;

/// One line of the table.
struct Line {
    light: &'static str,
    density: &'static str,
    sample: f64,
    query: f64,
    variances: [f64; HEIGHTS.len()],
}

fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(200))
        .measurement_time(Duration::from_millis(800))
        .configure_from_args();
    let mut lines = Vec::new();
    let half = 0.5;
    let corners = |n: usize| -> Vec<Vec3> {
        let turn = |i: usize| std::f32::consts::TAU * i as f32 / n as f32;
        (0..n).map(|i| Vec3::new(turn(i).cos(), -turn(i).sin(), 0.0) * half).collect()
    };
    let rectangle = Rectangle::new(Vec3::ZERO, Vec3::Y * half, Vec3::X * half).expect("a rectangle");
    light(&mut criterion, &mut lines, "rectangle", rectangle);
    let [a, b, c] = [0, 1, 2].map(|i| corners(3)[i]);
    light(&mut criterion, &mut lines, "triangle", Triangle::new(a, b, c).expect("a triangle"));
    light(&mut criterion, &mut lines, "polygon", Polygon::new(&corners(6)).expect("a hexagon"));
    let disk = Disk::new(Vec3::ZERO, Vec3::Y * half, Vec3::X * half).expect("a disk");
    light(&mut criterion, &mut lines, "disk", disk);
    light(&mut criterion, &mut lines, "sphere", Sphere::new(Vec3::Z * half, half).expect("a sphere"));
    let tube = Cylinder::new(Vec3::new(-half, 0.0, 0.1), Vec3::X, 0.1).expect("a tube");
    light(&mut criterion, &mut lines, "cylinder", tube);
    let ray = shadow_ray(&mut criterion);
    criterion.final_summary();
    print(&lines, ray);
}

/// Measures one light with each density.
fn light<S: SampledShape>(criterion: &mut Criterion, lines: &mut Vec<Line>, name: &'static str, shape: S) {
    let light = AreaLight::new(shape, Rgb::WHITE).expect("a radiance");
    let mut group = criterion.benchmark_group(name);
    for (density, method) in DENSITIES {
        let sample = time_samples(&mut group, density, &light, method);
        let query = time_queries(&mut group, density, &light, method);
        let variances = HEIGHTS.map(|h| relative_variance(&light, method, h));
        lines.push(Line { light: name, density, sample, query, variances });
    }
    group.finish();
}

/// Receivers under a light at the origin that faces down, each of them tilted a little.
fn receivers(height: f32) -> Vec<Receiver> {
    let mut random = Uniforms::new(31);
    let mut receiver = || {
        let aside = random.in_cube() * Vec3::new(1.0, 1.0, 0.0);
        let normal = (Vec3::Z + 0.4 * random.in_cube()).normalize();
        Receiver { point: aside - Vec3::Z * height, normal }
    };
    (0..RECEIVERS).map(|_| receiver()).collect()
}

/// Nanoseconds for one sample with its density, nothing kept between receivers.
fn time_samples<S: SampledShape>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    density: &str,
    light: &AreaLight<S>,
    method: SurfaceDensity,
) -> f64 {
    let mut random = Uniforms::new(32);
    let calls: Vec<_> = receivers(TIMED).into_iter().map(|r| (r, random.two())).collect();
    fastest(group, &format!("sample/{density}"), || {
        for (from, u) in &calls {
            black_box(light.sample(black_box(from), method, *u).map_or(0.0, |s| share(from, &s)));
        }
    })
}

/// Nanoseconds for the density of a direction that was met by chance.
fn time_queries<S: SampledShape>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    density: &str,
    light: &AreaLight<S>,
    method: SurfaceDensity,
) -> f64 {
    let mut random = Uniforms::new(33);
    let mut calls = Vec::new();
    while calls.len() < RECEIVERS {
        for from in receivers(TIMED) {
            let view = light.shape().view(&from, SurfaceDensity::Area, Sides::Front);
            let met = view.and_then(|v| v.sample(random.two()));
            calls.extend(met.filter(|m| m.at.normal.dot(m.wi) < 0.0).map(|m| (from, m)));
        }
    }
    calls.truncate(RECEIVERS);
    fastest(group, &format!("query/{density}"), || {
        for (from, met) in &calls {
            black_box(light.pdf_solid_angle(black_box(from), method, met.wi, &met.at));
        }
    })
}

/// Nanoseconds for a shadow ray among 100 000 triangles.
fn shadow_ray(criterion: &mut Criterion) -> f64 {
    let buffers = bumpy_ground(224);
    let bound = buffers.bind();
    let scene = bound.scene();
    let mut random = Uniforms::new(34);
    let mut rays = Vec::new();
    while rays.len() < RECEIVERS {
        let above = Vec3::new(random.between(-1.0, 1.0), 3.0, random.between(-1.0, 1.0));
        let Some(hit) = scene.closest_hit(&Ray::new(above, Vec3::NEG_Y), 10.0) else { continue };
        let lamp = Vec3::new(random.between(-0.5, 0.5), 1.0, random.between(-0.5, 0.5));
        let wi = (lamp - hit.at.point).normalize();
        let origin = offset_origin(hit.at.point, hit.at.error, hit.at.normal, wi);
        rays.push((hit.at, wi, origin.distance(lamp)));
    }
    let mut group = criterion.benchmark_group("shadow ray");
    fastest(&mut group, "100k triangles", || {
        for (at, wi, distance) in &rays {
            black_box(scene.visible(black_box(at), *wi, *distance));
        }
    })
}

/// Has criterion measure `run`, and returns the fastest nanoseconds for each of its calls.
fn fastest(group: &mut BenchmarkGroup<'_, WallTime>, id: &str, mut run: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    group.bench_function(id, |bencher| {
        bencher.iter_custom(|iterations| {
            let start = Instant::now();
            for _ in 0..iterations {
                run();
            }
            let all = start.elapsed();
            best = best.min(all.as_secs_f64() * 1e9 / (iterations as f64 * RECEIVERS as f64));
            all / RECEIVERS as u32
        });
    });
    best
}

/// What one sample makes of the irradiance.
#[inline]
fn share(from: &Receiver, sample: &LightSample) -> f32 {
    match sample.density {
        Density::SolidAngle(pdf) => from.normal.dot(sample.wi).max(0.0) * sample.incident.g / pdf,
        Density::Delta => 0.0,
    }
}

/// Variance of one sample of the irradiance over its square, averaged over the receivers.
fn relative_variance<S: SampledShape>(light: &AreaLight<S>, method: SurfaceDensity, height: f32) -> f64 {
    let mut random = Uniforms::new(35);
    let of = |from: &Receiver, random: &mut Uniforms| {
        let mut draw = || light.sample(from, method, random.two()).map_or(0.0, |s| share(from, &s));
        let moments = Moments::of((0..2048).map(|_| f64::from(draw())));
        (moments.mean() > 0.0).then(|| moments.variance() / moments.mean().powi(2))
    };
    let all = receivers(height);
    Moments::of(all.iter().filter_map(|from| of(from, &mut random))).mean()
}

fn print(lines: &[Line], ray: f64) {
    println!("{:10} {:12} {:>10} {:>9}   relative variance at height", "", "", "sample ns", "query ns");
    print!("{:10} {:12} {:>10} {:>9}", "light", "density", "", "");
    HEIGHTS.iter().for_each(|h| print!(" {h:>9}"));
    println!();
    for line in lines {
        print!("{:10} {:12} {:>10.1} {:>9.1}", line.light, line.density, line.sample, line.query);
        line.variances.iter().for_each(|v| print!(" {v:>9.2e}"));
        println!();
    }
    println!("{:10} {:12} {ray:>10.1}", "shadow ray", "100k triangles");
}
