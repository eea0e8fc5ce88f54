//! Surfaces that emit: radiance, sides and the change of measure, once for every shape.

use super::error::check_emission;
use super::view::Keep;
use super::{
    Cone, Density, Emitter, LightBounds, LightError, LightSample, Painted, Receiver, SurfaceDensity,
    SurfaceRadiance, SurfaceSample, SurfaceView, UseView,
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

impl Sides {
    /// Cosine on the emitting side; 0 or less where nothing is emitted.
    #[inline]
    pub(super) fn cos_light(self, normal: Vec3, wi: Vec3) -> f32 {
        let cos = -normal.dot(wi);
        if self == Self::Both { cos.abs() } else { cos }
    }
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

    /// The density over what `from` sees, for several questions.
    #[cfg(not(feature = "shared"))]
    pub(super) fn density(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
    ) -> Option<impl SurfaceView + use<S, R>> {
        self.view(from, method)
    }

    /// The density over what `from` sees, worked out anew for each question.
    #[cfg(feature = "shared")]
    pub(super) fn density<'s>(
        &'s self,
        from: &'s Receiver,
        method: SurfaceDensity,
    ) -> Option<impl SurfaceView + 's> {
        self.ask(from, method, Question::Seen).map(|_| Again { light: self, from, method })
    }

    /// Answers from what `from` sees of the light; `None` when that is nothing, or not drawn.
    #[inline(always)]
    pub(super) fn ask(&self, from: &Receiver, method: SurfaceDensity, question: Question) -> Option<Answer> {
        ask(&self.shape, from, method, self.sides, question)
    }
}

impl<S: SampledShape, R: SurfaceRadiance> Emitter for AreaLight<S, R> {
    #[inline]
    fn sample(&self, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        let Answer { sample, pdf_solid_angle } = self.ask(from, method, Question::Draw(u))?;
        let SurfaceSample { at, wi, distance } = sample;
        let incident = self.radiance.at(&self.shape, at.point);
        Some(LightSample { wi, distance, incident, density: Density::SolidAngle(pdf_solid_angle) })
    }

    #[inline]
    fn pdf_solid_angle(&self, from: &Receiver, method: SurfaceDensity, wi: Vec3, at: &SurfacePoint) -> f32 {
        if !(self.sides.cos_light(at.normal, wi) > 0.0) {
            return 0.0;
        }
        self.ask(from, method, Question::density(at, wi)).map_or(0.0, |answer| answer.pdf_solid_angle)
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
    #[cfg_attr(not(feature = "shared"), inline)]
    #[cfg_attr(feature = "shared", inline(never))]
    fn unshadowed_irradiance(&self, from: &Receiver) -> Option<Rgb> {
        let irradiance = self.radiance.uniform()? * self.shape.projected_solid_angle(from, self.sides)?;
        irradiance.is_finite().then_some(irradiance)
    }

    fn bounds(&self) -> Option<LightBounds> {
        Some(self.light_bounds())
    }

    fn outline(&self) -> Option<[Vec3; 4]> {
        self.shape.outline()
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

/// What a light asks of the density over what is seen of it.
#[derive(Debug, Clone, Copy)]
pub(super) enum Question {
    /// A direction, from two uniforms in `[0, 1)`.
    Draw([f32; 2]),
    /// The density of a direction; how far it goes does not matter.
    Density(SurfaceSample),
    /// Whether anything is seen at all.
    #[cfg(feature = "shared")]
    Seen,
}

impl Question {
    /// For the density of the unit direction `wi` that meets the surface at `at`.
    #[inline]
    fn density(at: &SurfacePoint, wi: Vec3) -> Self {
        Self::Density(SurfaceSample { at: *at, wi, distance: 0.0 })
    }
}

/// The density of a direction that was drawn or given.
#[derive(Debug, Clone, Copy)]
pub(super) struct Answer {
    /// The direction.
    pub(super) sample: SurfaceSample,
    /// Its density (sr⁻¹), positive and finite.
    pub(super) pdf_solid_angle: f32,
}

#[cfg(feature = "shared")]
impl Answer {
    /// To whether anything is seen.
    const SEEN: Self = {
        let at = SurfacePoint { point: Vec3::ZERO, error: Vec3::ZERO, normal: Vec3::Z };
        Self { sample: SurfaceSample { at, wi: Vec3::Z, distance: 0.0 }, pdf_solid_angle: 0.0 }
    };
}

/// Answers a question about a shape: in line, where the code of each density is made for its use, or with
/// feature `shared` out of line, where a shape has the code of each once, whatever it emits.
#[cfg_attr(not(feature = "shared"), inline(always))]
#[cfg_attr(feature = "shared", inline(never))]
fn ask<S: SampledShape>(
    shape: &S,
    from: &Receiver,
    method: SurfaceDensity,
    sides: Sides,
    question: Question,
) -> Option<Answer> {
    shape.with_view(from, method, sides, Asked { shape, from: from.point, sides, question })
}

/// A question, and about what.
struct Asked<'a, S> {
    shape: &'a S,
    from: Vec3,
    sides: Sides,
    question: Question,
}

impl<S: SampledShape> UseView<S::View> for Asked<'_, S> {
    type Output = Answer;

    #[cfg_attr(not(feature = "shared"), inline(always))]
    fn with<V: SurfaceView>(self, view: V, _: impl FnOnce(V) -> S::View) -> Option<Answer> {
        let (sample, is_drawn) = match self.question {
            Question::Draw(u) => (view.sample(u)?, true),
            Question::Density(sample) => (sample, false),
            #[cfg(feature = "shared")]
            Question::Seen => return Some(Answer::SEEN),
        };
        let SurfaceSample { at, wi, .. } = &sample;
        let cos_light = self.sides.cos_light(at.normal, *wi);
        let hidden = is_drawn && self.sides == Sides::Both && self.shape.hides(self.from, at);
        if !(cos_light > 0.0) || hidden {
            return None;
        }
        let pdf_solid_angle = view.pdf_solid_angle(at, *wi, cos_light)?;
        Some(Answer { sample, pdf_solid_angle })
    }
}

/// A density that is worked out for each question.
#[cfg(feature = "shared")]
struct Again<'a, S, R> {
    light: &'a AreaLight<S, R>,
    from: &'a Receiver,
    method: SurfaceDensity,
}

#[cfg(feature = "shared")]
impl<S, R> Clone for Again<'_, S, R> {
    fn clone(&self) -> Self {
        *self
    }
}

#[cfg(feature = "shared")]
impl<S, R> Copy for Again<'_, S, R> {}

#[cfg(feature = "shared")]
impl<S: SampledShape, R: SurfaceRadiance> SurfaceView for Again<'_, S, R> {
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        self.light.ask(self.from, self.method, Question::Draw(u)).map(|answer| answer.sample)
    }

    fn pdf_solid_angle(&self, at: &SurfacePoint, wi: Vec3, _: f32) -> Option<f32> {
        let answer = self.light.ask(self.from, self.method, Question::density(at, wi))?;
        Some(answer.pdf_solid_angle)
    }

    fn invert(&self, at: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        self.light.view(self.from, self.method)?.invert(at, wi)
    }
}
