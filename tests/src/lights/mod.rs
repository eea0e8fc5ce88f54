//! Lights under test: what they are seen as from one receiver, and the checks that each must pass.

mod checks;
mod extremes;
mod fixtures;
mod painted;
mod specimen;

pub use checks::*;
pub use extremes::extreme_distances_stay_finite;
pub use fixtures::*;
pub use painted::{Pictured, painted_rectangle, painted_sphere, painted_triangle};
pub use specimen::Specimen;

use halflight::geom::{PreparedRay, Ray};
use halflight::glam::Vec3;
use halflight::light::{AreaLight, Density, Emitter, LightSample, Receiver, SurfaceDensity};

/// What a direction meets of a light.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    /// Density of the direction (sr⁻¹).
    pub pdf: f32,
    /// Radiance from there.
    pub radiance: f32,
    /// How far it is.
    pub distance: f32,
    /// Cosine between the surface's normal and the way back; 1 for an environment.
    pub cos_light: f32,
}

/// A light as it is seen from one receiver.
pub trait Subject {
    /// Where it is looked at from.
    fn from(&self) -> Receiver;

    /// A direction toward the light.
    fn sample(&self, u: [f32; 2]) -> Option<LightSample>;

    /// The first that a direction meets of the light.
    fn seen(&self, wi: Vec3) -> Option<Seen>;

    /// A cone that holds the light: axis and `1 − cos` of its half-angle.
    fn cone(&self) -> (Vec3, f64);

    /// The light's size, as a length.
    fn size(&self) -> f32;

    /// `∫ weight dω` over the light.
    fn measure(&self) -> f64;

    /// What is integrated over the light's directions; 1 gives the solid angle.
    fn weight(&self, _wi: Vec3) -> f64 {
        1.0
    }

    /// A sample with its density, unless a nearer part of the light hides it.
    fn draw(&self, u: [f32; 2]) -> Option<(LightSample, f32)> {
        let sample = self.sample(u)?;
        let Density::SolidAngle(pdf) = sample.density else { return None };
        let nearer = sample.distance * (1.0 - 4.0 * f32::EPSILON) - 1e-3 * self.size();
        let hidden = self.seen(sample.wi).is_some_and(|s| s.distance < nearer);
        (!hidden).then_some((sample, pdf))
    }
}

/// A surface that emits.
#[derive(Debug, Clone, Copy)]
pub struct Area<S> {
    /// The light.
    pub light: AreaLight<S>,
    /// Where it is looked at from.
    pub from: Receiver,
    /// How it is sampled.
    pub method: SurfaceDensity,
    /// Solid angle, or projected solid angle.
    pub measure: f64,
    /// True when `measure` is projected on the receiver.
    pub projected: bool,
    /// True when both sides emit.
    pub two_sided: bool,
}

impl<S: Specimen> Area<S> {
    /// The same with another way of sampling the surface.
    #[must_use]
    pub fn by(self, method: SurfaceDensity) -> Self {
        Self { method, ..self }
    }

    /// The same over projected solid angle, where the density goes to 0 at the horizon.
    #[must_use]
    pub fn projected(self) -> Self {
        let from = &self.from;
        let measure = self.light.shape().irradiance(from.point, from.normal);
        Self { method: SurfaceDensity::Projected, measure, projected: true, ..self }
    }

    /// The same emitting from both sides.
    #[must_use]
    pub fn two_sided(self) -> Self {
        Self { light: self.light.two_sided(), two_sided: true, ..self }
    }
}

impl<S: Specimen> Subject for Area<S> {
    fn from(&self) -> Receiver {
        self.from
    }

    fn sample(&self, u: [f32; 2]) -> Option<LightSample> {
        self.light.sample(&self.from, self.method, u)
    }

    fn seen(&self, wi: Vec3) -> Option<Seen> {
        let ray = Ray::new(self.from.point, wi);
        let hit = self.light.shape().intersect(&PreparedRay::new(ray), f32::INFINITY)?;
        let at = self.light.shape().surface_point(&ray, &hit);
        Some(Seen {
            pdf: self.light.pdf_solid_angle(&self.from, self.method, wi, &at),
            radiance: self.light.radiance(&at, -wi).g,
            distance: hit.t,
            cos_light: -at.normal.dot(wi),
        })
    }

    fn cone(&self) -> (Vec3, f64) {
        let (centre, radius) = self.light.shape().bounding_sphere();
        let v = (centre - self.from.point).as_dvec3();
        let sin = f64::from(radius) / v.length();
        if sin >= 1.0 {
            return (self.from.normal, 2.0);
        }
        // A little more, for directions that are rounded.
        let slack = 1.01 * sin * sin / (1.0 + (1.0 - sin * sin).sqrt());
        (v.normalize().as_vec3(), slack.min(2.0))
    }

    fn size(&self) -> f32 {
        self.light.shape().bounding_sphere().1
    }

    fn measure(&self) -> f64 {
        self.measure
    }

    fn weight(&self, wi: Vec3) -> f64 {
        if self.projected { f64::from(self.from.normal.dot(wi).max(0.0)) } else { 1.0 }
    }
}

/// A light around the scene. The weight is the cosine, which keeps the mean of `1 / p` finite where
/// the density goes to 0 with it.
#[derive(Debug, Clone, Copy)]
pub struct Environment<E> {
    /// The light.
    pub light: E,
    /// Where it is looked at from.
    pub from: Receiver,
}

impl<E: Emitter> Subject for Environment<E> {
    fn from(&self) -> Receiver {
        self.from
    }

    fn sample(&self, u: [f32; 2]) -> Option<LightSample> {
        self.light.sample(&self.from, SurfaceDensity::SolidAngle, u)
    }

    fn seen(&self, wi: Vec3) -> Option<Seen> {
        Some(Seen {
            pdf: self.light.pdf_escaping(&self.from, wi),
            radiance: self.light.radiance_escaping(wi).g,
            distance: f32::INFINITY,
            cos_light: 1.0,
        })
    }

    fn cone(&self) -> (Vec3, f64) {
        (self.from.normal, 2.0)
    }

    fn size(&self) -> f32 {
        1.0
    }

    fn measure(&self) -> f64 {
        std::f64::consts::PI
    }

    fn weight(&self, wi: Vec3) -> f64 {
        f64::from(self.from.normal.dot(wi).max(0.0))
    }
}

/// A light that lies about its density: what the checks must notice.
#[derive(Debug, Clone, Copy)]
pub struct Lying<T> {
    /// The honest light.
    pub subject: T,
    /// Factor on the density of samples.
    pub sampled: f32,
    /// Factor on queried densities, above and below the middle of the light's cone.
    pub queried: [f32; 2],
}

impl<T: Subject> Subject for Lying<T> {
    fn from(&self) -> Receiver {
        self.subject.from()
    }

    fn sample(&self, u: [f32; 2]) -> Option<LightSample> {
        let sample = self.subject.sample(u)?;
        let Density::SolidAngle(pdf) = sample.density else { return Some(sample) };
        Some(LightSample { density: Density::SolidAngle(pdf * self.sampled), ..sample })
    }

    fn seen(&self, wi: Vec3) -> Option<Seen> {
        let seen = self.subject.seen(wi)?;
        let (axis, _) = self.cone();
        let side = usize::from(axis.any_orthonormal_vector().dot(wi) > 0.0);
        Some(Seen { pdf: seen.pdf * self.queried[side], ..seen })
    }

    fn cone(&self) -> (Vec3, f64) {
        self.subject.cone()
    }

    fn size(&self) -> f32 {
        self.subject.size()
    }

    fn measure(&self) -> f64 {
        self.subject.measure()
    }

    fn weight(&self, wi: Vec3) -> f64 {
        self.subject.weight(wi)
    }
}
