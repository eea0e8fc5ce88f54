//! Surfaces that emit: radiance, sides and the change of measure, once for every shape.

use super::error::check_emission;
use super::{Density, Emitter, LightError, LightSample, Receiver};
use crate::Rgb;
use crate::geom::unit;
use crate::measure::area_to_solid_angle;
use crate::num::PI;
use crate::shape::{Shape, SurfacePoint};
use glam::Vec3;

/// How a light's surface is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum SurfaceDensity {
    /// Uniform over the whole surface.
    Area,
    /// Uniform over the solid angle that the light fills, for the shapes that have it: the sphere.
    /// The others fall back to their area, in sampling and in querying alike.
    #[default]
    SolidAngle,
}

/// A point drawn on a light's surface, as seen from a receiver.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceSample {
    /// The point.
    pub at: SurfacePoint,
    /// Unit direction from the receiver to the point.
    pub wi: Vec3,
    /// Its distance (m).
    pub distance: f32,
}

impl SurfaceSample {
    /// Looks at a surface point from `from`; `None` when the two coincide.
    #[inline]
    #[must_use]
    pub fn toward(from: Vec3, at: SurfacePoint) -> Option<Self> {
        let v = at.point - from;
        let wi = unit(v)?;
        Some(Self { at, wi, distance: v.dot(wi) })
    }
}

/// A shape whose surface can be sampled.
///
/// One function, [`SampledShape::pdf_solid_angle`], decides the density for sampled and for queried
/// directions alike, so the two cannot disagree.
pub trait SampledShape: Shape {
    /// A point uniform over the surface, density `1 / area` (m⁻²).
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint;

    /// Inverse of [`SampledShape::sample_area`].
    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2];

    /// A point drawn by `method`, as seen from `from`; `None` when there is none to be seen.
    #[inline]
    fn sample_surface(&self, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) -> Option<SurfaceSample> {
        let _ = method;
        SurfaceSample::toward(from.point, self.sample_area(u))
    }

    /// Density of the direction `wi` that meets the surface at `at` (sr⁻¹); `None` where it is
    /// never drawn.
    ///
    /// * `cos_light` – cosine between the emitting side's normal and `−wi`, above 0
    #[inline]
    fn pdf_solid_angle(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        at: &SurfacePoint,
        cos_light: f32,
    ) -> Option<f32> {
        let _ = method;
        area_to_solid_angle(1.0 / self.area(), at.point.distance_squared(from.point), cos_light)
    }
}

/// A surface that emits the same radiance from each point into each direction of its side or sides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaLight<S> {
    shape: S,
    radiance: Rgb,
    two_sided: bool,
}

impl<S: SampledShape> AreaLight<S> {
    /// A light that emits from the side that the shape's normal points to.
    ///
    /// * `radiance` (W m⁻² sr⁻¹)
    ///
    /// # Errors
    /// When the radiance is negative, NaN or infinite.
    pub fn new(shape: S, radiance: Rgb) -> Result<Self, LightError> {
        let radiance = check_emission("the radiance", radiance)?;
        Ok(Self { shape, radiance, two_sided: false })
    }

    /// The same light, emitting from both sides.
    #[must_use]
    pub fn two_sided(self) -> Self {
        Self { two_sided: true, ..self }
    }

    /// The surface.
    #[must_use]
    pub fn shape(&self) -> &S {
        &self.shape
    }

    /// Cosine on the emitting side; 0 or less where nothing is emitted.
    #[inline]
    fn cos_light(&self, normal: Vec3, wi: Vec3) -> f32 {
        let cos = -normal.dot(wi);
        if self.two_sided { cos.abs() } else { cos }
    }
}

impl<S: SampledShape> Emitter for AreaLight<S> {
    #[inline]
    fn sample(&self, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        let sample = self.shape.sample_surface(from, method, u)?;
        let cos_light = self.cos_light(sample.at.normal, sample.wi);
        if !(cos_light > 0.0) {
            return None;
        }
        let pdf = self.shape.pdf_solid_angle(from, method, &sample.at, cos_light)?;
        Some(LightSample {
            wi: sample.wi,
            distance: sample.distance,
            incident: self.radiance,
            density: Density::SolidAngle(pdf),
        })
    }

    #[inline]
    fn pdf_solid_angle(&self, from: &Receiver, method: SurfaceDensity, wi: Vec3, at: &SurfacePoint) -> f32 {
        let cos_light = self.cos_light(at.normal, wi);
        if !(cos_light > 0.0) {
            return 0.0;
        }
        self.shape.pdf_solid_angle(from, method, at, cos_light).unwrap_or(0.0)
    }

    #[inline]
    fn radiance(&self, normal: Vec3, wo: Vec3) -> Rgb {
        if self.two_sided || normal.dot(wo) > 0.0 { self.radiance } else { Rgb::BLACK }
    }

    /// `π A L`, twice when both sides emit.
    fn power(&self, _scene_radius: f32) -> f32 {
        let sides = if self.two_sided { 2.0 } else { 1.0 };
        sides * PI * self.shape.area() * self.radiance.average()
    }
}
