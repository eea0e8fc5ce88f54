//! Lights as numbers.

use super::StoredShape;
use crate::Rgb;
use crate::light::{
    AnyLight, AreaLight, Constant, Directional, DistantDisk, Emitter, Point, SampledShape, Sides, Spot,
};
use crate::shape::AnyShape;
use bytemuck::{Pod, Zeroable};
use glam::Vec3;

/// A light without textures or pictures, as sixteen words.
///
/// | kind | light | numbers |
/// |---|---|---|
/// | 0–4 | a surface | nine of the [`StoredShape`] of that kind, radiance; the flag is 1 when both sides emit |
/// | 5 | point | position, intensity |
/// | 6 | spot | position, axis, intensity, angles of beam and cutoff |
/// | 7 | directional | direction, irradiance |
/// | 8 | constant | radiance |
/// | 9 | distant disk | axis, radiance, squared sine of its angular radius |
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct StoredLight {
    kind: u32,
    flag: u32,
    numbers: [f32; 14],
}

const POINT: u32 = 5;
const SPOT: u32 = 6;
const DIRECTIONAL: u32 = 7;
const CONSTANT: u32 = 8;
const DISTANT: u32 = 9;

impl StoredLight {
    /// The numbers of a light; `None` for one with a texture, a picture or portals.
    #[must_use]
    pub fn new(light: &AnyLight<'_>) -> Option<Self> {
        let plain = |kind, vectors: &[[f32; 3]], rest: &[f32]| {
            let mut numbers = [0.0; 14];
            let given = vectors.iter().flatten().chain(rest).copied();
            numbers.iter_mut().zip(given).for_each(|(place, number)| *place = number);
            Self { kind, flag: 0, numbers }
        };
        let v = Vec3::to_array;
        Some(match light {
            AnyLight::Rectangle(l) => Self::area(l, AnyShape::Rectangle(*l.shape())),
            AnyLight::Disk(l) => Self::area(l, AnyShape::Disk(*l.shape())),
            AnyLight::Sphere(l) => Self::area(l, AnyShape::Sphere(*l.shape())),
            AnyLight::Triangle(l) => Self::area(l, AnyShape::Triangle(*l.shape())),
            AnyLight::Cylinder(l) => Self::area(l, AnyShape::Cylinder(*l.shape())),
            AnyLight::Point(l) => plain(POINT, &[v(&l.position()), l.intensity().to_array()], &[]),
            AnyLight::Spot(l) => {
                let (beam, cutoff) = l.angles();
                plain(SPOT, &[v(&l.position()), v(&l.axis()), l.intensity().to_array()], &[beam, cutoff])
            }
            AnyLight::Directional(l) => {
                plain(DIRECTIONAL, &[v(&l.direction()), l.irradiance().to_array()], &[])
            }
            AnyLight::Constant(l) => plain(CONSTANT, &[l.radiance_escaping(Vec3::Z).to_array()], &[]),
            AnyLight::DistantDisk(l) => {
                let (axis, radiance) = (l.axis(), l.radiance_escaping(l.axis()));
                plain(DISTANT, &[v(&axis), radiance.to_array()], &[l.sin2_radius()])
            }
            AnyLight::Painted(_)
            | AnyLight::EnvironmentMap(_)
            | AnyLight::ConstantPortals(_)
            | AnyLight::EnvironmentPortals(_) => return None,
        })
    }

    /// A surface that emits.
    fn area<S: SampledShape>(light: &AreaLight<S>, of: AnyShape) -> Self {
        let (kind, shape) = StoredShape::new(&of).parts();
        let mut numbers = [0.0; 14];
        let given = shape.into_iter().chain(light.surface_radiance().to_array());
        numbers.iter_mut().zip(given).for_each(|(place, number)| *place = number);
        Self { kind, flag: u32::from(light.sides() == Sides::Both), numbers }
    }

    /// The light, unchecked; `None` when there is no such kind.
    #[must_use]
    pub fn light(&self) -> Option<AnyLight<'static>> {
        let [a, b, c, d, e, f, g, h, i, j, k, l, ..] = self.numbers;
        let (first, second) = (Vec3::new(a, b, c), Vec3::new(d, e, f));
        let colour = Rgb::new(d, e, f);
        Some(match self.kind {
            POINT => AnyLight::Point(Point::baked(first, colour)),
            SPOT => AnyLight::Spot(Spot::baked(first, second, Rgb::new(g, h, i), j, k)),
            DIRECTIONAL => AnyLight::Directional(Directional::baked(first, colour)),
            CONSTANT => AnyLight::Constant(Constant::baked(Rgb::new(a, b, c))),
            DISTANT => AnyLight::DistantDisk(DistantDisk::baked(first, g, colour)),
            kind => {
                let shape = StoredShape::from_parts(kind, [a, b, c, d, e, f, g, h, i]);
                return shape.is_known().then(|| self.emitting(&shape, Rgb::new(j, k, l)));
            }
        })
    }

    /// A surface that emits.
    fn emitting(&self, shape: &StoredShape, radiance: Rgb) -> AnyLight<'static> {
        let sides = if self.flag == 0 { Sides::Front } else { Sides::Both };
        match shape.shape() {
            AnyShape::Triangle(s) => AnyLight::Triangle(AreaLight::baked(s, radiance, sides)),
            AnyShape::Rectangle(s) => AnyLight::Rectangle(AreaLight::baked(s, radiance, sides)),
            AnyShape::Disk(s) => AnyLight::Disk(AreaLight::baked(s, radiance, sides)),
            AnyShape::Sphere(s) => AnyLight::Sphere(AreaLight::baked(s, radiance, sides)),
            AnyShape::Cylinder(s) => AnyLight::Cylinder(AreaLight::baked(s, radiance, sides)),
        }
    }
}
