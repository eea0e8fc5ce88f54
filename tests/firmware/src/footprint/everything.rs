//! (c) and (d): a scene with every shape, light and material, in a tree, under surroundings, of which nothing is
//! known when the program is built. How its lights are sampled is fixed then in (c), as in (b); in (d) that is
//! chosen at run time too, from every density, technique and choice among lights.

use crate::scenes::everything;
use core::hint::black_box;
use halflight::Scene;
use halflight::bsdf::{AnyBsdf, TwoSided};
use halflight::estimate::{ByArea, ByLight, Direct, Estimator, PixelStats};
use halflight::light::AnyLight;
use halflight::scene::Tables;
use halflight::sequence::{Dimension, Sequence, Sobol};
use halflight::shape::AnyShape;

/// Entries of the traversal stack, as in (b).
const STACK: usize = 32;

type Everything = Scene<'static, AnyShape, AnyLight<'static>, TwoSided<AnyBsdf>, STACK>;

/// (c): one pixel, from 64 samples by light.
#[inline(never)]
pub fn run_by_area() {
    run(&ByLight::<ByArea>::new());
}

/// (d): one pixel, from 64 samples.
#[inline(never)]
pub fn run_any() {
    run(&black_box(Direct::default()));
}

fn run(estimator: &impl Estimator) {
    let tables = Tables {
        surfaces: black_box(&everything::SURFACES[..]),
        normals: black_box(&everything::NORMALS[..]),
        lights: black_box(&everything::LIGHTS[..]),
        materials: black_box(&everything::MATERIALS[..]),
        ..Tables::EMPTY
    };
    let scene: Result<Everything, _> = Scene::baked_with_stack(black_box(&everything::NODES[..]), tables);
    let Ok(scene) = scene else { return };
    let mut sequence = Sobol::new(1);
    let mut pixel = PixelStats::NEW;
    for sample in 0..64 {
        sequence.start(0, sample);
        let [x, y] = sequence.point(Dimension::Film, 0, 1);
        let (ray, reach) = everything::CAMERA.ray(2.0 * x - 1.0, 2.0 * y - 1.0);
        pixel.add(estimator.sample(&scene, &ray, reach, &mut sequence));
    }
    black_box(pixel);
}
