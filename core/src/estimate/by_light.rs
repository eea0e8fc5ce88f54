//! The smallest estimator: nothing about it is chosen at run time.

use super::shading::Shading;
use super::{Estimator, Observer};
use crate::Rgb;
use crate::bsdf::Bsdf;
use crate::geom::Ray;
use crate::light::{Emitter, SurfaceDensity};
use crate::material::Material;
use crate::scene::Scene;
use crate::sequence::{Dimension, Sequence};
use crate::shape::Shape;
use core::marker::PhantomData;

/// A [`SurfaceDensity`] as a type, so that a program links no other.
pub trait StaticDensity {
    /// The density.
    const SURFACE: SurfaceDensity;
}

/// [`SurfaceDensity::Area`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ByArea;

/// [`SurfaceDensity::SolidAngle`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct BySolidAngle;

/// [`SurfaceDensity::Projected`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ByProjected;

impl StaticDensity for ByArea {
    const SURFACE: SurfaceDensity = SurfaceDensity::Area;
}

impl StaticDensity for BySolidAngle {
    const SURFACE: SurfaceDensity = SurfaceDensity::SolidAngle;
}

impl StaticDensity for ByProjected {
    const SURFACE: SurfaceDensity = SurfaceDensity::Projected;
}

/// Direct light from one sample of each light, for programs that count bytes: the samples of
/// [`super::Direct`] with [`super::Technique::Light`], one light sample and all lights, to the last bit, and
/// no code for anything else.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct ByLight<D>(PhantomData<D>);

impl<D> ByLight<D> {
    /// The estimator.
    #[must_use]
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

impl<D: StaticDensity> ByLight<D> {
    /// One sample of the light with that index.
    #[inline]
    fn toward<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        scene: &Scene<'_, S, L, M, STACK>,
        shading: &Shading<'_, M::Bsdf<'_>>,
        (index, light): (usize, &L),
        u: [f32; 2],
        observer: &mut impl Observer,
    ) -> Option<Rgb> {
        let sample = light.sample(&shading.receiver, D::SURFACE, u)?;
        let reflected = shading.reflect(sample.wi).filter(|_| !sample.incident.is_black())?;
        let arrives = shading.is_outside(sample.wi)
            && scene.light_visible(&shading.at.at, sample.wi, sample.distance, index);
        let light = reflected.f_cos * sample.incident * sample.density.weight();
        observer.light(arrives, || light.average());
        arrives.then_some(light)
    }
}

impl<D: StaticDensity> Estimator for ByLight<D> {
    #[inline]
    fn observe<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb {
        let Some(hit) = scene.closest_hit(ray, reach) else {
            return scene.radiance_escaping(ray.direction);
        };
        let wo = -ray.direction;
        let emitted = scene.emitted(&hit, wo);
        let Some(material) = scene.materials().get(hit.material as usize) else { return emitted };
        let bsdf = material.at(|| scene.uv(&hit));
        observer.surface(&hit, wo, || bsdf.albedo());
        if bsdf.is_black() {
            return emitted;
        }
        let shading = Shading::new(&hit, &bsdf, wo, || scene.tangent(&hit));
        let mut sum = Rgb::BLACK;
        for light in scene.lights().iter().enumerate() {
            let u = sequence.point(Dimension::Light(light.0 as u32), 0, 1);
            sum += Self::toward(scene, &shading, light, u, observer).unwrap_or(Rgb::BLACK);
        }
        emitted + sum
    }
}
