//! What must not change a picture: the unit of length, and where the axes point.

use crate::pictures::scaled;
use halflight::build::{Emission, Geometry};
use halflight::camera::View;
use halflight::estimate::Direct;
use halflight::geom::Ray;
use halflight::glam::{Quat, Vec3};
use halflight::light::{AnyLight, SurfaceDensity};
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Sphere, Triangle};
use halflight_tests::scenes::{Stage, seen};
use halflight_tests::statistics::Moments;
use halflight_tests::{Verdict, ensure};

const DENSITIES: [SurfaceDensity; 4] =
    [SurfaceDensity::Area, SurfaceDensity::SolidAngle, SurfaceDensity::Projected, SurfaceDensity::Auto];

/// What single precision may add to a mean.
const ROUNDING: f64 = 1e-4;

/// Eyes on the floor from above: where they are and where they look, in metres.
fn rays() -> impl Iterator<Item = (Vec3, Vec3)> {
    [Vec3::ZERO, Vec3::new(0.7, 0.0, -0.4), Vec3::new(-0.9, 0.0, 0.3)]
        .into_iter()
        .map(|target| (target + Vec3::new(0.3, 0.2, 0.5), target))
}

/// One of each surface, with a floor.
fn stage() -> Stage {
    crate::estimators::several().lit(
        AnyShape::Disk(Disk::new(Vec3::new(0.8, 1.2, -1.0), Vec3::X * 0.3, Vec3::Z * 0.2).expect("a disk")),
        5.0,
    )
}

/// What the eyes see, with the same random numbers each time.
///
/// * `place` – from the stage's metres to those of the changed one
fn looks(stage: &Stage, surface: SurfaceDensity, place: impl Fn(Vec3) -> Vec3) -> Vec<Moments> {
    let buffers = stage.build();
    let direct = Direct { surface, ..Direct::default() };
    rays()
        .map(|(eye, target)| {
            let (eye, target) = (place(eye), place(target));
            seen(&buffers, &direct, &Ray::new(eye, (target - eye).normalize()), 1 << 12)
        })
        .collect()
}

#[test]
fn the_unit_of_length_changes_no_mean() -> Verdict {
    let stage = stage();
    for density in DENSITIES {
        let reference = looks(&stage, density, |p| p);
        for k in [1e-6, 1e-3, 1e3, 1e6] {
            let other = looks(&scaled(&stage, k), density, |p| p * k);
            for (a, b) in other.iter().zip(&reference) {
                let off = (a.mean() / b.mean() - 1.0).abs();
                ensure!(b.mean() > 0.0 && off <= ROUNDING, "{density:?} times {k}: {off:e} off {}", b.mean());
            }
        }
    }
    Ok(())
}

#[test]
fn the_axes_change_no_mean() -> Verdict {
    let (stage, turn) = (stage(), Quat::from_xyzw(0.3, -0.5, 0.2, 0.7).normalize());
    let turned = turned(&stage, turn);
    for density in DENSITIES {
        let reference = looks(&stage, density, |p| p);
        for (a, b) in looks(&turned, density, |p| turn * p).iter().zip(&reference) {
            a.check_same(&format!("{density:?} turned"), b, ROUNDING)?;
        }
    }
    Ok(())
}

#[test]
fn two_percent_of_a_light_are_noticed() {
    let (stage, mut brighter) = (stage(), stage());
    for object in &mut brighter.0.objects {
        if let Some(Emission { radiance, .. }) = &mut object.emission {
            *radiance *= 1.02;
        }
    }
    let [a, b] = [&stage, &brighter].map(|s| looks(s, SurfaceDensity::Auto, |p| p)[0].mean());
    assert!((a / b - 1.0).abs() > ROUNDING);
}

/// The stage with everything turned about the origin.
fn turned(stage: &Stage, turn: Quat) -> Stage {
    let mut stage = stage.clone();
    let view = &mut stage.0.camera.view;
    *view = View {
        origin: turn * view.origin,
        right: turn * view.right,
        up: turn * view.up,
        forward: turn * view.forward,
    };
    for object in &mut stage.0.objects {
        if let Geometry::Shape(shape) = &mut object.geometry {
            *shape = turned_shape(*shape, turn).expect("a proper shape");
        }
    }
    for light in &mut stage.0.lights {
        if let AnyLight::Point(p) = *light {
            *light = crate::estimators::point(turn * p.position(), p.intensity().g);
        }
    }
    stage
}

fn turned_shape(shape: AnyShape, turn: Quat) -> Result<AnyShape, halflight::shape::ShapeError> {
    match shape {
        AnyShape::Triangle(t) => {
            let [a, b, c] = t.corners().map(|p| turn * p);
            Triangle::new(a, b, c).map(AnyShape::Triangle)
        }
        AnyShape::Rectangle(r) => {
            Rectangle::new(turn * r.centre(), turn * r.half_u(), turn * r.half_v()).map(AnyShape::Rectangle)
        }
        AnyShape::Disk(d) => {
            Disk::new(turn * d.centre(), turn * d.axis_u(), turn * d.axis_v()).map(AnyShape::Disk)
        }
        AnyShape::Sphere(s) => Sphere::new(turn * s.centre(), s.radius()).map(AnyShape::Sphere),
        AnyShape::Cylinder(c) => {
            Cylinder::new(turn * c.base(), turn * c.axis(), c.radius()).map(AnyShape::Cylinder)
        }
    }
}
