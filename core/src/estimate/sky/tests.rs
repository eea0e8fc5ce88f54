//! What is known of the sky, held against rays.

use super::*;
use crate::build::SceneBuffers;
use crate::estimate::Direct;
use crate::film::Film;
use crate::load::builtin::builtin;
use crate::num::{TAU, hash2, unit_f32};

#[test]
fn nothing_is_in_the_way_of_a_clear_sky() {
    let description = builtin("morning").unwrap();
    let buffers = SceneBuffers::new(&description).unwrap();
    let bound = buffers.bind();
    let (width, height) = (96, 64);
    let job = Job {
        scene: bound.scene(),
        camera: description.camera.camera(width, height).unwrap(),
        film: Film::new(width, height, description.filter).unwrap(),
        estimator: Direct::default(),
        sequence: (),
    };
    let (mut seen, mut open, mut above) = (0, 0, 0);
    for (x, y) in (0..height).step_by(8).flat_map(|y| (0..width).step_by(8).map(move |x| (x, y))) {
        let part = PixelRect { x0: x, y0: y, x1: x + 8, y1: y + 8 };
        let Some(Sky::Seen { light, normal, clear }) = job.look_up(part) else { continue };
        let map = job.scene.lights()[light].environment_map().unwrap();
        seen += 1;
        for i in 0..400 {
            let u: [f32; 4] = core::array::from_fn(|k| unit_f32(hash2(i, k as u32)));
            let place = job.film.place(x + i % 8, y + i / 8 % 8, [u[0], u[1]]);
            let (ray, reach) = job.camera.ray(place.0, place.1);
            let hit = job.scene.closest_hit(&ray, reach).unwrap();
            let z = 2.0 * u[2] - 1.0;
            let (sin, cos) = libm::sincosf(TAU * u[3]);
            let wi = Vec3::new(sin * num::sqrt(1.0 - z * z), z, cos * num::sqrt(1.0 - z * z));
            above += u32::from(normal.dot(wi) > 0.0);
            if map.is_clear(&clear, wi) {
                open += 1;
                assert!(normal.dot(wi) > 0.0, "{part:?} {wi}");
                assert!(job.scene.light_visible(&hit.at, wi, f32::INFINITY, light), "{part:?} {wi}");
            }
        }
    }
    assert!(seen > 20 && open > above / 2, "{seen} groups, {open} of {above} directions");
}
