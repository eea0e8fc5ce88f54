//! (a) One rectangle over a matte floor, without a tree.

use core::hint::black_box;
use halflight::Rgb;
use halflight::bsdf::{Bsdf, Lambert};
use halflight::glam::Vec3;
use halflight::light::{AreaLight, Emitter, Receiver, Sides, SurfaceDensity};
use halflight::sequence::{Dimension, Random, Sequence};
use halflight::shape::Rectangle;

static LIGHT: AreaLight<Rectangle> = AreaLight::baked(
    Rectangle::baked(Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.5)),
    Rgb::WHITE,
    Sides::Front,
);
static FLOOR: Lambert = Lambert::baked(Rgb::splat(0.5));

/// Light that the floor reflects upward, from 64 samples.
#[inline(never)]
pub fn run() {
    let (light, floor) = (black_box(&LIGHT), black_box(&FLOOR));
    if light.check().is_err() || floor.check().is_err() {
        return;
    }
    let mut sequence = Random::<rand_pcg::Pcg32>::new(1);
    let from = Receiver { point: black_box(Vec3::ZERO), normal: Vec3::Y };
    let mut sum = Rgb::BLACK;
    for sample in 0..64 {
        sequence.start(0, sample);
        let u = sequence.point(Dimension::Light(0), 0, 1);
        if let Some(drawn) = light.sample(&from, SurfaceDensity::Area, u) {
            sum += floor.eval(Vec3::Z, Vec3::Z) * drawn.incident * (drawn.wi.y * drawn.density.weight());
        }
    }
    black_box(sum);
}
