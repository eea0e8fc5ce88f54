//! (b) Triangles under a rectangle, matte, in a tree. The triangles are data, and not counted.

use crate::scenes::sky;
use core::hint::black_box;
use halflight::bsdf::{Lambert, TwoSided};
use halflight::estimate::{ByArea, ByLight, Estimator, PixelStats};
use halflight::glam::Vec3;
use halflight::light::{AreaLight, Sides};
use halflight::scene::Tables;
use halflight::sequence::{Dimension, Random, Sequence};
use halflight::shape::{Rectangle, Triangle};
use halflight::{Rgb, Scene};

static LIGHTS: [AreaLight<Rectangle>; 1] = [AreaLight::baked(
    Rectangle::baked(Vec3::new(0.3, 0.5, 0.3), Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.1)),
    Rgb::WHITE,
    Sides::Front,
)];

/// Entries of the traversal stack: enough for the trees of thousands of triangles.
const STACK: usize = 32;

type Triangles = Scene<'static, Triangle, AreaLight<Rectangle>, TwoSided<Lambert>, STACK>;

/// One pixel, from 64 samples by light.
#[inline(never)]
pub fn run() {
    let tables = Tables {
        surfaces: black_box(&sky::SURFACES[..]),
        lights: black_box(&LIGHTS[..]),
        materials: black_box(&sky::MATERIALS[..]),
        ..Tables::EMPTY
    };
    let scene: Result<Triangles, _> = Scene::baked_with_stack(black_box(&sky::NODES[..]), tables);
    let Ok(scene) = scene else { return };
    let mut sequence = Random::<rand_pcg::Pcg32>::new(1);
    let estimator = ByLight::<ByArea>::new();
    let mut pixel = PixelStats::NEW;
    for sample in 0..64 {
        sequence.start(0, sample);
        let [x, y] = sequence.point(Dimension::Film, 0, 1);
        let (ray, reach) = sky::CAMERA.ray(2.0 * x - 1.0, 2.0 * y - 1.0);
        pixel.add(estimator.sample(&scene, &ray, reach, &mut sequence));
    }
    black_box(pixel);
}
