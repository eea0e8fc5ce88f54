//! Surfaces that emit: radiance, sides and the change of measure, once for every shape.

use super::error::check_emission;
use super::view::Keep;
use super::{
    Cone, Density, Emitter, LightBounds, LightError, LightSample, Painted, Receiver, SurfaceDensity,
    SurfaceRadiance, SurfaceView, UseView,
};
use crate::Rgb;
use crate::num::PI;
use crate::shape::{Shape, SurfacePoint};
use glam::Vec3;

/// Which sides of a surface emit.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Sides {
    /// The one that the normal points to.
    #[default]
    Front,
    /// Both.
    Both,
}

/// A shape whose surface can be sampled.
pub trait SampledShape: Shape {
    /// What a receiver sees of the shape.
    type View: SurfaceView;

    /// A point uniform over the surface, density `1 / area` (m⁻²).
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint;

    /// Inverse of [`SampledShape::sample_area`]; each in `[0, 1)`, to rounding.
    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2];

    /// The density over what `from` sees of the emitting sides; `None` when that is nothing.
    ///
    #[inline]
    fn view(&self, from: &Receiver, method: SurfaceDensity, sides: Sides) -> Option<Self::View> {
        self.with_view(from, method, sides, Keep)
    }

    /// Hands the view of [`SampledShape::view`] to `then`; `None` when nothing is seen.
    ///
    /// This is the only place that decides about a density. It depends on its arguments alone, so
    /// that sampled and queried directions have the same one.
    fn with_view<U: UseView<Self::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        sides: Sides,
        then: U,
    ) -> Option<U::Output>;

    /// True when the shape itself hides the surface point `at` from `from`. A shape whose closed form
    /// counts each direction once must know.
    #[inline]
    fn hides(&self, from: Vec3, at: &SurfacePoint) -> bool {
        let _ = (from, at);
        false
    }

    /// A cone that holds all normals of the surface.
    fn normals(&self) -> Cone {
        Cone::ALL
    }

    /// Projected solid angle of what `from` sees of the emitting sides above its horizon (sr), that
    /// is the irradiance for a radiance of 1; `None` for a shape without a closed form.
    fn projected_solid_angle(&self, from: &Receiver, sides: Sides) -> Option<f32> {
        let _ = (from, sides);
        None
    }
}

/// A surface that emits the same radiance into each direction of its side or sides.
///
/// * `R` – the radiance of its places: [`Rgb`] when all have the same
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaLight<S, R = Rgb> {
    shape: S,
    radiance: R,
    sides: Sides,
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
        Ok(Self { shape, radiance, sides: Sides::Front })
    }
}

impl<S: Copy> AreaLight<S> {
    /// A light that was checked before: for constants; see [`crate::Scene::baked`].
    ///
    /// * `radiance` (W m⁻² sr⁻¹)
    #[must_use]
    pub const fn baked(shape: S, radiance: Rgb, sides: Sides) -> Self {
        Self { shape, radiance, sides }
    }
}

impl<'a, S: SampledShape> AreaLight<S, Painted<'a>> {
    /// A light with a texture, emitting from the side that the shape's normal points to.
    #[must_use]
    pub const fn painted(shape: S, radiance: Painted<'a>) -> Self {
        Self { shape, radiance, sides: Sides::Front }
    }
}

impl<S: SampledShape, R: SurfaceRadiance> AreaLight<S, R> {
    /// The radiance of its places.
    #[must_use]
    pub const fn surface_radiance(&self) -> &R {
        &self.radiance
    }

    /// The same light, emitting from both sides.
    #[must_use]
    pub fn two_sided(self) -> Self {
        Self { sides: Sides::Both, ..self }
    }

    /// The surface.
    #[must_use]
    pub fn shape(&self) -> &S {
        &self.shape
    }

    /// Which sides emit.
    #[must_use]
    pub const fn sides(&self) -> Sides {
        self.sides
    }

    /// Radiance, as average over the channels (W m⁻² sr⁻¹).
    pub(super) fn mean_radiance(&self) -> f32 {
        self.radiance.mean().average()
    }

    /// The density over what `from` sees of the light: for embedders that draw many samples at one
    /// receiver, or that need the inverse.
    #[inline]
    #[must_use]
    pub fn view(&self, from: &Receiver, method: SurfaceDensity) -> Option<S::View> {
        self.shape.view(from, method, self.sides)
    }

    /// Hands what `from` sees of the light to `then`: in line, where the code for each density is made for
    /// its use.
    #[cfg(not(feature = "small"))]
    #[inline]
    fn seen<U: UseView<S::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        then: U,
    ) -> Option<U::Output> {
        self.shape.with_view(from, method, self.sides, then)
    }

    /// Hands what `from` sees of the light to `then`: out of line, where a shape has the code for each
    /// density once.
    #[cfg(feature = "small")]
    fn seen<U: UseView<S::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        then: U,
    ) -> Option<U::Output> {
        #[inline(never)]
        fn view<S: SampledShape>(
            shape: &S,
            from: &Receiver,
            method: SurfaceDensity,
            sides: Sides,
        ) -> Option<S::View> {
            shape.with_view(from, method, sides, Keep)
        }
        then.with(view(&self.shape, from, method, self.sides)?, |view| view)
    }

    /// Cosine on the emitting side; 0 or less where nothing is emitted.
    #[inline]
    pub(super) fn cos_light(&self, normal: Vec3, wi: Vec3) -> f32 {
        let cos = -normal.dot(wi);
        if self.sides == Sides::Both { cos.abs() } else { cos }
    }
}

impl<S: SampledShape, R: SurfaceRadiance> Emitter for AreaLight<S, R> {
    #[inline]
    fn sample(&self, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        self.seen(from, method, Draw { light: self, from, u })
    }

    #[inline]
    fn pdf_solid_angle(&self, from: &Receiver, method: SurfaceDensity, wi: Vec3, at: &SurfacePoint) -> f32 {
        let cos_light = self.cos_light(at.normal, wi);
        if !(cos_light > 0.0) {
            return 0.0;
        }
        self.seen(from, method, Query { at, wi, cos_light }).unwrap_or(0.0)
    }

    #[inline]
    fn radiance(&self, at: &SurfacePoint, wo: Vec3) -> Rgb {
        if self.sides == Sides::Both || at.normal.dot(wo) > 0.0 {
            self.radiance.at(&self.shape, at.point)
        } else {
            Rgb::BLACK
        }
    }

    /// `E = L` times the projected solid angle, when the radiance is the same everywhere.
    #[inline]
    fn unshadowed_irradiance(&self, from: &Receiver) -> Option<Rgb> {
        let irradiance = self.radiance.uniform()? * self.shape.projected_solid_angle(from, self.sides)?;
        irradiance.is_finite().then_some(irradiance)
    }

    fn bounds(&self) -> Option<LightBounds> {
        Some(self.light_bounds())
    }

    /// `π A L`, twice when both sides emit.
    fn power(&self, _scene_radius: f32) -> f32 {
        let sides = if self.sides == Sides::Both { 2.0 } else { 1.0 };
        sides * PI * self.shape.area() * self.radiance.mean().average()
    }

    fn check(&self) -> Result<(), LightError> {
        self.shape.check().map_err(LightError::Shape)?;
        // What is brighter in places was checked when it was painted.
        check_emission("the radiance", self.radiance.mean()).map(drop)
    }
}

/// Draws a sample.
struct Draw<'a, S, R> {
    light: &'a AreaLight<S, R>,
    from: &'a Receiver,
    u: [f32; 2],
}

impl<S: SampledShape, R: SurfaceRadiance> UseView<S::View> for Draw<'_, S, R> {
    type Output = LightSample;

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn with<V: SurfaceView>(self, view: V, _: impl FnOnce(V) -> S::View) -> Option<LightSample> {
        let Self { light, from, u } = self;
        let sample = view.sample(u)?;
        let cos_light = light.cos_light(sample.at.normal, sample.wi);
        if !(cos_light > 0.0) || (light.sides == Sides::Both && light.shape.hides(from.point, &sample.at)) {
            return None;
        }
        let pdf = view.pdf_solid_angle(&sample.at, sample.wi, cos_light)?;
        Some(LightSample {
            wi: sample.wi,
            distance: sample.distance,
            incident: light.radiance.at(&light.shape, sample.at.point),
            density: Density::SolidAngle(pdf),
        })
    }
}

/// Asks for the density of a direction.
struct Query<'a> {
    at: &'a SurfacePoint,
    wi: Vec3,
    cos_light: f32,
}

impl<A> UseView<A> for Query<'_> {
    type Output = f32;

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn with<V: SurfaceView>(self, view: V, _: impl FnOnce(V) -> A) -> Option<f32> {
        view.pdf_solid_angle(self.at, self.wi, self.cos_light)
    }
}
