//! Whole pictures: their bits do not depend on tiles, passes or the unit of length.

use crate::estimators::{ball, point, several};
use halflight::build::SceneBuffers;
use halflight::estimate::{Direct, Job, PixelStats};
use halflight::film::{Film, PixelRect};
use halflight::light::AnyLight;
use halflight::sequence::Sobol;
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Triangle};
use halflight_tests::scenes::{Stage, checksum};

/// A picture of 16 × 12 pixels.
///
/// * `passes` – how many samples there are after each
fn picture(stage: &Stage, buffers: &SceneBuffers, tiles: &[PixelRect], passes: &[u32]) -> Vec<PixelStats> {
    let description = &stage.0;
    let bound = buffers.bind();
    let job = Job {
        scene: bound.scene(),
        camera: description.camera.camera(description.width, description.height).unwrap(),
        film: Film::new(description.width, description.height, description.filter).unwrap(),
        estimator: Direct::default(),
        sequence: Sobol::new(5),
    };
    let mut picture = vec![PixelStats::NEW; job.film.crop().area()];
    for tile in tiles {
        let mut pixels = vec![PixelStats::NEW; tile.area()];
        let mut start = 0;
        for &end in passes {
            job.render(*tile, start..end, &mut pixels);
            start = end;
        }
        for (row, line) in pixels.chunks(tile.width() as usize).enumerate() {
            let start = (tile.y0 as usize + row) * description.width as usize + tile.x0 as usize;
            picture[start..start + line.len()].copy_from_slice(line);
        }
    }
    picture
}

const WHOLE: [PixelRect; 1] = [PixelRect { x0: 0, y0: 0, x1: 16, y1: 12 }];

#[test]
fn tiles_and_passes_do_not_change_a_bit() {
    let stage = several();
    let buffers = stage.build();
    let whole = picture(&stage, &buffers, &WHOLE, &[16]);
    let tiles = [
        PixelRect { x0: 7, y0: 0, x1: 16, y1: 5 },
        PixelRect { x0: 0, y0: 5, x1: 16, y1: 12 },
        PixelRect { x0: 0, y0: 0, x1: 7, y1: 5 },
    ];
    assert_eq!(picture(&stage, &buffers, &tiles, &[1, 2, 9, 16]), whole);
}

/// All lengths times `k`, with the radiances kept.
pub(crate) fn scaled(stage: &Stage, k: f32) -> Stage {
    use halflight::build::Geometry;
    let mut stage = stage.clone();
    stage.0.camera.view.origin *= k;
    for object in &mut stage.0.objects {
        let Geometry::Shape(shape) = &mut object.geometry else { continue };
        *shape = match *shape {
            AnyShape::Triangle(t) => {
                let [a, b, c] = t.corners().map(|p| p * k);
                AnyShape::Triangle(Triangle::new(a, b, c).unwrap())
            }
            AnyShape::Rectangle(r) => {
                AnyShape::Rectangle(Rectangle::new(r.centre() * k, r.half_u() * k, r.half_v() * k).unwrap())
            }
            AnyShape::Disk(d) => {
                AnyShape::Disk(Disk::new(d.centre() * k, d.axis_u() * k, d.axis_v() * k).unwrap())
            }
            AnyShape::Sphere(s) => ball(s.centre() * k, s.radius() * k),
            AnyShape::Cylinder(c) => {
                AnyShape::Cylinder(Cylinder::new(c.base() * k, c.axis() * k, c.radius() * k).unwrap())
            }
        };
    }
    for light in &mut stage.0.lights {
        if let AnyLight::Point(p) = *light {
            *light = point(p.position() * k, p.intensity().g * k * k);
        }
    }
    stage
}

#[test]
fn the_unit_of_length_does_not_matter() {
    let stage = several();
    let reference = picture(&stage, &stage.build(), &WHOLE, &[64]);
    // A power of two scales every intermediate exactly.
    for k in [1.0 / 1024.0, 1024.0] {
        let other = scaled(&stage, k);
        assert_eq!(picture(&other, &other.build(), &WHOLE, &[64]), reference, "{k}");
    }
    // Others are rounded anew: a few samples fall on the other side of an edge.
    for k in [1e-3, 1e3] {
        let other = scaled(&stage, k);
        let picture = picture(&other, &other.build(), &WHOLE, &[64]);
        let off = picture.iter().zip(&reference).filter(|(a, b)| {
            let (a, b) = (a.mean().g, b.mean().g);
            (a - b).abs() > 1e-3 * b
        });
        assert!(off.count() <= 4, "{k}");
    }
}

#[test]
fn the_picture_is_the_same_bits_everywhere() {
    let stage = several();
    let sum = checksum(&picture(&stage, &stage.build(), &WHOLE, &[16]));
    // A change of any sampler changes this number; a change of machine must not.
    assert_eq!(sum, 0xe4cf_4d26, "{sum:#010x}");
}
