//! What a receiver sees of a surface, ready to be sampled.

use super::{Receiver, SampledShape};
use crate::geom::unit;
use crate::measure::area_to_solid_angle;
use crate::num;
use crate::shape::SurfacePoint;
use glam::Vec3;

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
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[must_use]
    pub fn toward(from: Vec3, at: SurfacePoint) -> Option<Self> {
        let v = at.point - from;
        let wi = unit(v)?;
        Some(Self { at, wi, distance: v.dot(wi) })
    }
}

/// A density over the directions in which a receiver sees a surface: sampler, density and inverse.
///
/// What sampling costs once per receiver (solid angles, frames) is in the view; a sample adds the
/// rest. [`SurfaceView::pdf_solid_angle`] is the only density, of sampled and of queried directions.
pub trait SurfaceView: Copy {
    /// Draws a point; `None` where the receiver does not see it.
    ///
    /// * `u` – two independent uniforms, each in `[0, 1)`
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample>;

    /// Density of the unit direction `wi` that meets the surface at `at` (sr⁻¹), positive and
    /// finite; `None` where it is never drawn.
    ///
    /// * `cos_light` – cosine between the emitting side's normal and `−wi`, above 0
    fn pdf_solid_angle(&self, at: &SurfacePoint, wi: Vec3, cos_light: f32) -> Option<f32>;

    /// The uniforms for which [`SurfaceView::sample`] draws the direction `wi` that meets the
    /// surface at `at`, each in `[0, 1)`; `None` where it is never drawn.
    fn invert(&self, at: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]>;
}

/// A view that stays where it was made.
impl<V: SurfaceView> SurfaceView for &V {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        V::sample(self, u)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn pdf_solid_angle(&self, at: &SurfacePoint, wi: Vec3, cos_light: f32) -> Option<f32> {
        V::pdf_solid_angle(self, at, wi, cos_light)
    }

    fn invert(&self, at: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        V::invert(self, at, wi)
    }
}

/// What is done with a view, whichever density it has.
///
/// A view can be some hundred bytes of which a query needs four: handed to its user, it stays in
/// registers, and what is not asked for is not computed.
///
/// * `A` – any view of the shape
pub trait UseView<A> {
    /// What comes out.
    type Output;

    /// Uses the view; `any` makes it one among those of the shape.
    fn with<V: SurfaceView>(self, view: V, any: impl FnOnce(V) -> A) -> Option<Self::Output>;
}

/// Keeps the view.
pub(super) struct Keep;

impl<A> UseView<A> for Keep {
    type Output = A;

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn with<V: SurfaceView>(self, view: V, any: impl FnOnce(V) -> A) -> Option<A> {
        Some(any(view))
    }
}

/// Uniform over the whole surface, `1 / area` (m⁻²), seen or not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AreaView<S> {
    shape: S,
    from: Vec3,
}

impl<S: SampledShape> AreaView<S> {
    /// The surface as a whole, from a receiver.
    #[inline]
    #[must_use]
    pub fn new(shape: S, from: &Receiver) -> Self {
        Self { shape, from: from.point }
    }
}

impl<S: SampledShape> SurfaceView for AreaView<S> {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        SurfaceSample::toward(self.from, self.shape.sample_area(u))
    }

    #[inline]
    fn pdf_solid_angle(&self, at: &SurfacePoint, _: Vec3, cos_light: f32) -> Option<f32> {
        area_to_solid_angle(1.0 / self.shape.area(), at.point.distance_squared(self.from), cos_light)
    }

    fn invert(&self, at: &SurfacePoint, _: Vec3) -> Option<[f32; 2]> {
        // A point at the edge is rounded to either side of it.
        Some(self.shape.sample_area_inverse(at.point).map(num::clamp_unit))
    }
}

/// The view of a density that a shape does not have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NoView {}

impl SurfaceView for NoView {
    fn sample(&self, _: [f32; 2]) -> Option<SurfaceSample> {
        match *self {}
    }

    fn pdf_solid_angle(&self, _: &SurfacePoint, _: Vec3, _: f32) -> Option<f32> {
        match *self {}
    }

    fn invert(&self, _: &SurfacePoint, _: Vec3) -> Option<[f32; 2]> {
        match *self {}
    }
}

/// One view for each density that a shape has.
///
/// * `W` – uniform over solid angle
/// * `P` – uniform over projected solid angle
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum View<S, W, P> {
    /// Uniform over the surface.
    Area(AreaView<S>),
    /// Uniform over solid angle, or close to it.
    SolidAngle(W),
    /// Uniform over projected solid angle, or close to it.
    Projected(P),
}

impl<S: SampledShape, W: SurfaceView, P: SurfaceView> SurfaceView for View<S, W, P> {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        match self {
            Self::Area(v) => v.sample(u),
            Self::SolidAngle(v) => v.sample(u),
            Self::Projected(v) => v.sample(u),
        }
    }

    #[inline]
    fn pdf_solid_angle(&self, at: &SurfacePoint, wi: Vec3, cos_light: f32) -> Option<f32> {
        match self {
            Self::Area(v) => v.pdf_solid_angle(at, wi, cos_light),
            Self::SolidAngle(v) => v.pdf_solid_angle(at, wi, cos_light),
            Self::Projected(v) => v.pdf_solid_angle(at, wi, cos_light),
        }
    }

    fn invert(&self, at: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        match self {
            Self::Area(v) => v.invert(at, wi),
            Self::SolidAngle(v) => v.invert(at, wi),
            Self::Projected(v) => v.invert(at, wi),
        }
    }
}
