//! (c) Every shape, light, material and density, chosen at run time.

use crate::scenes::everything;
use core::hint::black_box;
use halflight::Scene;
use halflight::bsdf::{AnyBsdf, TwoSided};
use halflight::estimate::{Direct, Estimator, PixelStats};
use halflight::light::AnyLight;
use halflight::scene::Tables;
use halflight::sequence::{Dimension, Sequence, Sobol};
use halflight::shape::AnyShape;

type Everything = Scene<'static, AnyShape, AnyLight<'static>, TwoSided<AnyBsdf>>;

/// One pixel, from 64 samples.
#[inline(never)]
pub fn run() {
    let tables = Tables {
        surfaces: black_box(&everything::SURFACES[..]),
        normals: black_box(&everything::NORMALS[..]),
        lights: black_box(&everything::LIGHTS[..]),
        materials: black_box(&everything::MATERIALS[..]),
        ..Tables::EMPTY
    };
    let scene: Result<Everything, _> = Scene::baked(black_box(&everything::NODES[..]), tables);
    let Ok(scene) = scene else { return };
    let direct = black_box(Direct::default());
    let mut sequence = Sobol::new(1);
    let mut pixel = PixelStats::NEW;
    for sample in 0..64 {
        sequence.start(0, sample);
        let [x, y] = sequence.point(Dimension::Film, 0, 1);
        let (ray, reach) = everything::CAMERA.ray(2.0 * x - 1.0, 2.0 * y - 1.0);
        pixel.add(direct.sample(&scene, &ray, reach, &mut sequence));
    }
    black_box(pixel);
}
