//! Random lights with receivers, over the whole range of sizes, distances and angles.

use halflight::geom::Frame;
use halflight::glam::Vec3;
use halflight::light::{Receiver, SurfaceDensity};
use halflight::num::{ONE_MINUS_EPSILON, PI, unit_f32};
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Sphere, Triangle};
use halflight::warp::uniform_sphere;
use proptest::prelude::*;

/// A light's shape seen from a receiver, and how it is sampled.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Case {
    pub(crate) shape: AnyShape,
    pub(crate) from: Receiver,
    pub(crate) method: SurfaceDensity,
    pub(crate) two_sided: bool,
    pub(crate) u: [f32; 2],
    /// The smallest extent of the shape (m).
    pub(crate) minor: f32,
    /// The largest coordinate that enters (m).
    pub(crate) reach: f32,
}

/// What a case is made of, one after the other: numbers in `[0, 1)`.
struct Units<'a>(std::slice::Iter<'a, u32>);

impl Units<'_> {
    fn one(&mut self) -> f32 {
        unit_f32(self.0.next().copied().unwrap_or_default())
    }

    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.one()
    }

    /// Log-uniform between powers of ten.
    fn power(&mut self, low: f32, high: f32) -> f32 {
        10.0_f32.powf(self.between(low, high))
    }

    fn below(&mut self, n: usize) -> usize {
        (self.one() * n as f32) as usize
    }

    /// A direction: any, or an axis.
    fn direction(&mut self) -> Vec3 {
        let (axis, u) = (self.below(9), [self.one(), self.one()]);
        match axis {
            0 => Vec3::X,
            1 => Vec3::NEG_Y,
            2 => Vec3::Z,
            _ => uniform_sphere(u),
        }
    }

    /// A uniform, often the first or the last one.
    fn uniform(&mut self) -> f32 {
        let u = self.one();
        match self.below(8) {
            0 => 0.0,
            1 => ONE_MINUS_EPSILON,
            _ => u,
        }
    }
}

/// Cases: sizes from 1e-6 to 1e6 m, aspects up to 1e6, distances of 0 and from 1e-6 to 1e6 sizes,
/// angles from facing through grazing and in the plane to behind.
pub(crate) fn cases() -> impl Strategy<Value = Case> {
    prop::array::uniform32(any::<u32>()).prop_filter_map("a degenerate shape", |words| {
        let mut units = Units(words.iter());
        let (size, aspect) = (units.power(-6.0, 6.0), units.power(0.0, 6.0));
        let frame = Frame::from_normal(units.direction());
        let centre = Vec3::new(units.one(), units.one(), units.one()) * (size * units.below(2) as f32);
        let shape = shape(&mut units, centre, &frame, size, size / aspect)?;
        let minor = match shape {
            AnyShape::Sphere(_) => size,
            _ => size / aspect,
        };
        let from = receiver(&mut units, centre, &frame, size);
        let method = METHODS[units.below(4)];
        let two_sided = units.below(2) == 1;
        let u = [units.uniform(), units.uniform()];
        let reach = from.point.abs().max_element() + centre.abs().max_element() + size;
        Some(Case { shape, from, method, two_sided, u, minor, reach })
    })
}

const METHODS: [SurfaceDensity; 4] =
    [SurfaceDensity::Area, SurfaceDensity::SolidAngle, SurfaceDensity::Projected, SurfaceDensity::Auto];

/// `size` long and `minor` wide.
fn shape(units: &mut Units<'_>, centre: Vec3, frame: &Frame, size: f32, minor: f32) -> Option<AnyShape> {
    let (u, v) = (frame.s * size, frame.t * minor);
    let (kind, flip, lean) = (units.below(5), units.below(2) == 1, units.between(-1.0, 2.0));
    Some(match kind {
        0 => {
            let shape = Triangle::new(centre, centre + u, centre + u * lean + v).ok()?;
            AnyShape::Triangle(if flip { shape.flipped() } else { shape })
        }
        1 => {
            let shape = Rectangle::new(centre, u, v).ok()?;
            AnyShape::Rectangle(if flip { shape.flipped() } else { shape })
        }
        2 => {
            let shape = Disk::new(centre, u, v).ok()?;
            AnyShape::Disk(if flip { shape.flipped() } else { shape })
        }
        3 => {
            let shape = Sphere::new(centre, size).ok()?;
            AnyShape::Sphere(if flip { shape.flipped() } else { shape })
        }
        _ => {
            let long = units.below(2) == 1;
            let (axis, radius) = if long { (u, minor) } else { (frame.n * minor, size) };
            let shape = Cylinder::new(centre, axis, radius).ok()?;
            AnyShape::Cylinder(if flip { shape.flipped() } else { shape })
        }
    })
}

/// Anywhere around, grazing and in the plane more often than they are.
fn receiver(units: &mut Units<'_>, centre: Vec3, frame: &Frame, size: f32) -> Receiver {
    let distance = units.power(-6.0, 6.0) * [1.0, 1.0, 1.0, 1.0, 0.0][units.below(5)];
    let around = units.between(-PI, PI);
    let across = frame.s * around.cos() + frame.t * around.sin();
    let height = match units.below(6) {
        0 => 0.0,
        1 => 1e-3,
        2 => 1.0,
        _ => units.between(-1.0, 1.0),
    };
    let out = (across * (1.0 - height * height).sqrt() + frame.n * height).normalize();
    // From the middle, or from a place as far aside as the light is large.
    let foot = centre + across * (size * [0.0, 1.0, 0.3][units.below(3)]);
    let normal = if units.below(3) == 0 { -out } else { units.direction() };
    Receiver { point: foot + out * (distance * size), normal }
}
