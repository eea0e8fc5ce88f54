//! What is known, held against rays.

use super::*;
use crate::Rgb;
use crate::bsdf::{AnyBsdf, Lambert, TwoSided};
use crate::build::{
    CameraDescription, Description, Emission, Geometry, IntegratorDescription, Material as Named, Object,
    ProjectionDescription, SceneBuffers,
};
use crate::camera::View;
use crate::estimate::Direct;
use crate::film::Filter;
use crate::light::SurfaceDensity;
use crate::load::builtin::{BUILTIN, builtin};
use crate::num::{hash2, unit_f32};
use crate::sequence::{Dimension, Sequence, Sobol};
use crate::shape::{AnyShape, Rectangle, Sphere};
use std::vec;
use std::vec::Vec;

/// How many blocks of 2 × 2 pixels there are, of how many the surface is known, and how many are smooth.
#[derive(Debug, Default)]
struct Count {
    blocks: u32,
    seen: u32,
    smooth: u32,
}

/// Asks random rays of each block whether they find what is known.
fn compare(description: &Description) -> Count {
    let buffers = SceneBuffers::new(description).unwrap();
    let bound = buffers.bind();
    let (width, height) = (description.width, description.height);
    let job = Job {
        scene: bound.scene(),
        camera: description.camera.camera(width, height).unwrap(),
        film: Film::new(width, height, description.filter).unwrap(),
        estimator: Direct::default(),
        sequence: Sobol::new(1),
    };
    let mut count = Count::default();
    for (x, y) in (0..height).step_by(2).flat_map(|y| (0..width).step_by(2).map(move |x| (x, y))) {
        let (known, is_smooth) = job.look_ahead(PixelRect { x0: x, y0: y, x1: x + 2, y1: y + 2 });
        count.blocks += 1;
        count.seen += u32::from(known.met() != Met::Various);
        count.smooth += u32::from(is_smooth);
        for sample in 0..32 {
            let mut sequence = Sobol::new(sample);
            sequence.start(y * width + x, sample);
            let (px, py) = (x + (sample & 1), y + (sample >> 1 & 1));
            let place = job.film.place(px, py, sequence.point(Dimension::Film, 0, 1));
            let (ray, reach) = job.camera.ray(place.0, place.1);
            agree(&job.scene, known, &ray, reach, &mut sequence);
        }
    }
    count
}

/// One camera ray, and a shadow ray to each light.
fn agree<S: Shape, L: Emitter, M: Material>(
    scene: &Scene<'_, S, L, M>,
    known: Known,
    ray: &Ray,
    reach: f32,
    sequence: &mut Sobol,
) {
    let hit = scene.closest_hit(ray, reach);
    match known.met() {
        Met::Various => {}
        Met::Nothing => assert_eq!(hit, None),
        Met::Surface(index) => assert_eq!(hit.map(|h| h.surface), Some(index), "{ray:?}"),
    }
    assert_eq!(known.first_hit(scene, ray, reach), hit);
    let Some(hit) = hit else { return };
    let wo = -ray.direction;
    for (index, light) in scene.lights().iter().enumerate().filter(|(i, _)| Foreseen::from(known).is_open(*i))
    {
        let u = sequence.point(Dimension::Light(index as u32), 0, 1);
        let Some(sample) = light.sample(&hit.receiver(wo), SurfaceDensity::Area, u) else { continue };
        let is_outside = hit.at.normal.dot(sample.wi) * hit.at.normal.dot(wo) > 0.0;
        let arrives = scene.light_visible(&hit.at, sample.wi, sample.distance, index);
        assert!(arrives || !is_outside, "{hit:?} {sample:?}");
    }
}

#[test]
fn rays_find_what_is_known_of_every_builtin_scene() {
    for entry in BUILTIN {
        let mut description = builtin(entry.name).unwrap();
        (description.width, description.height) = (48, 32);
        compare(&description);
    }
}

/// Three uniforms in [−1, 1).
fn random(seed: u32, k: u32) -> Vec3 {
    let one = |i| 2.0 * unit_f32(hash2(seed, 3 * k + i)) - 1.0;
    Vec3::new(one(0), one(1), one(2))
}

/// A floor, a few plates and balls close above it and far, one of them a lamp, and a camera on either side.
fn clutter(seed: u32) -> Description {
    let scale = [1e-3, 1.0, 1e4][seed as usize % 3];
    let object = |shape, emission| Object {
        name: "".into(),
        geometry: Geometry::Shape(shape),
        material: 0,
        emission,
        object_space: None,
    };
    let tilt = unit(random(seed, 1) + Vec3::Y).unwrap_or(Vec3::Y);
    let across = unit(tilt.cross(Vec3::new(0.3, 0.2, 0.9))).unwrap();
    let plate = |centre: Vec3, half: f32| {
        AnyShape::Rectangle(Rectangle::new(centre, across * half, across.cross(tilt) * half).unwrap())
    };
    let mut objects = vec![object(plate(Vec3::ZERO, 6.0 * scale), None)];
    for k in 2..7 {
        let (at, form) = (random(seed, 2 * k), random(seed, 2 * k + 1));
        // From a ten-thousandth of the scene above the floor.
        let height = scale * 10.0_f32.powf(2.0 * form.x - 2.0);
        let centre = (across * at.x + across.cross(tilt) * at.z) * (3.0 * scale) + tilt * height;
        let half = scale * (0.5 + 0.45 * form.y);
        let ball = AnyShape::Sphere(Sphere::new(centre, 0.5 * half).unwrap());
        objects.push(object(if form.z > 0.5 { ball } else { plate(centre, half) }, None));
    }
    let lamp = tilt * (4.0 * scale) + random(seed, 20) * scale;
    let emission = Emission { radiance: Rgb::splat(3.0), texture: None, two_sided: true };
    objects.push(object(plate(lamp, 0.7 * scale), Some(emission)));
    let eye = tilt * (3.0 * scale) + random(seed, 21) * (2.0 * scale) + across * (4.0 * scale);
    let grey = AnyBsdf::Lambert(Lambert::new(Rgb::splat(0.5)).unwrap());
    Description {
        name: "clutter".into(),
        camera: CameraDescription {
            view: View::look_at(eye, Vec3::ZERO, tilt).unwrap(),
            projection: ProjectionDescription::Orthographic { half_width: 2.0 * scale },
            near: 0.0,
            far: 100.0 * scale,
        },
        width: 24,
        height: 16,
        filter: Filter::Tent { radius: 1.0 },
        integrator: IntegratorDescription::default(),
        samples_per_pixel: None,
        materials: vec![Named {
            name: "grey".into(),
            bsdf: TwoSided::both(grey),
            textures: <[_; 2]>::default(),
        }],
        objects,
        lights: vec![],
        environments: vec![],
        portals: vec![],
    }
}

#[test]
fn rays_find_what_is_known_of_clutter_close_to_a_floor() {
    let counts: Vec<Count> = (0..60).map(|seed| compare(&clutter(seed))).collect();
    let sum = |of: fn(&Count) -> u32| counts.iter().map(of).sum::<u32>();
    let (blocks, seen, smooth) = (sum(|c| c.blocks), sum(|c| c.seen), sum(|c| c.smooth));
    assert!(seen > blocks / 2 && smooth > blocks / 10, "{seen} {smooth} of {blocks}");
}

#[test]
fn much_of_a_bare_room_is_smooth() {
    let mut description = builtin("cornell").unwrap();
    (description.width, description.height) = (96, 96);
    let Count { blocks, seen, smooth } = compare(&description);
    assert!(seen > blocks * 6 / 10 && smooth > blocks / 10, "{seen} {smooth} of {blocks}");
}
