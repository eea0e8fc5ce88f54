//! Stack of each entry point, painted: on a scene under a rectangle, matte, and on one that may hold anything.
#![no_std]
#![no_main]

use core::hint::black_box;
use halflight::choose::LightChoice;
use halflight::estimate::{ByArea, ByLight, Direct, Estimator, Occlusion, Path, Probe};
use halflight::geom::Ray;
use halflight::glam::Vec3;
use halflight::light::{Emitter, SurfaceDensity};
use halflight::material::Material;
use halflight::scene::BakedError;
use halflight::sequence::{Sequence, Sobol};
use halflight::shape::{Shape, SurfacePoint};
use halflight::{Camera, Scene};
use halflight_firmware::machine::{entry, exit, println, stack_of};
use halflight_firmware::scenes::{cornell, everything};

/// Samples of each: enough for all that is rare.
const SAMPLES: u32 = 256;

/// What is worked out for nobody.
fn keep<T>(value: T) {
    black_box(value);
}

type Made<S, L, M> = Result<Scene<'static, S, L, M>, BakedError>;

fn estimator<S: Shape, L: Emitter, M: Material>(
    scene: &Scene<'_, S, L, M>,
    camera: &Camera,
    estimator: &impl Estimator,
) -> usize {
    stack_of(|| {
        let mut sequence = Sobol::new(1);
        for sample in 0..SAMPLES {
            sequence.start(0, sample);
            let [x, y] = sequence.point(halflight::sequence::Dimension::Film, 0, 1);
            let (ray, reach) = camera.ray(2.0 * x - 1.0, 2.0 * y - 1.0);
            keep(estimator.sample(scene, &ray, reach, &mut sequence));
        }
    })
}

fn all<S: Shape, L: Emitter, M: Material>(name: &str, make: fn() -> Made<S, L, M>, camera: &Camera) {
    let checked = stack_of(|| keep(make().is_ok()));
    let Ok(scene) = make() else { exit(false) };
    let floor = SurfacePoint { point: Vec3::new(0.278, 1e-3, 0.28), error: Vec3::ZERO, normal: Vec3::Y };
    let up = black_box(Ray::new(floor.point, Vec3::Y));
    let hit = stack_of(|| keep(scene.closest_hit(&up, f32::INFINITY).is_some()));
    let visible = stack_of(|| keep(scene.visible(&floor, Vec3::Y, 1.0)));
    let probe = black_box(Probe { samples: 64, surface: SurfaceDensity::Auto, choice: LightChoice::All });
    let irradiance = stack_of(|| keep(probe.irradiance(&scene, &floor, &mut Sobol::new(1)).samples));
    let visibility = stack_of(|| {
        for light in 0..scene.lights().len() {
            keep(probe.visibility(&scene, &floor, light, &mut Sobol::new(1)));
        }
    });
    println!("{}: check {} closest_hit {} visible {}", name, checked, hit, visible);
    println!("{}: Probe::irradiance {} Probe::visibility {}", name, irradiance, visibility);
    let by_area = estimator(&scene, camera, &ByLight::<ByArea>::new());
    let direct = estimator(&scene, camera, &black_box(Direct::default()));
    let occlusion = estimator(&scene, camera, &Occlusion::default());
    let path = estimator(&scene, camera, &black_box(Path::default()));
    let (up, by_light) = ((&up, f32::INFINITY), ByLight::<ByArea>::new());
    let radiance = stack_of(|| keep(probe.radiance(&scene, &by_light, up, &mut Sobol::new(1))));
    println!("{}: Probe::radiance of ByLight {}", name, radiance);
    println!("{}: ByLight {} Direct {} Occlusion {} Path {}", name, by_area, direct, occlusion, path);
}

#[entry]
fn main() -> ! {
    all("cornell", cornell::scene, &cornell::CAMERA);
    all("everything", everything::scene, &everything::CAMERA);
    exit(true)
}

halflight_firmware::panics_end!();
