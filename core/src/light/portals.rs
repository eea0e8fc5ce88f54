//! The sky through windows.

use super::{AreaLight, Density, Emitter, LightError, LightSample, Receiver, SurfaceDensity};
use crate::Rgb;
use crate::geom::{PreparedRay, Ray};
use crate::num::ONE_MINUS_EPSILON;
use crate::shape::{Rectangle, Shape};
use glam::Vec3;

/// Of the samples at a receiver that faces a portal, how many go through portals; the others are drawn
/// as without them.
const SHARE: f32 = 0.5;

/// How a portal is sampled: in proportion to the receiver's cosine, whatever it costs, because the sky
/// behind it is mostly even.
const THROUGH: SurfaceDensity = SurfaceDensity::Projected;

/// An opening through which an environment is seen: a rectangle without matter, whose normal points
/// into the room.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Portal(AreaLight<Rectangle>);

impl Portal {
    /// An opening whose front faces the room.
    ///
    /// # Errors
    /// Never for a rectangle that was made by [`Rectangle::new`].
    pub fn new(shape: Rectangle) -> Result<Self, LightError> {
        AreaLight::new(shape, Rgb::WHITE).map(Self)
    }

    /// The opening.
    #[must_use]
    pub fn shape(&self) -> &Rectangle {
        self.0.shape()
    }

    /// Projected solid angle that a receiver in the room sees of it (sr).
    #[inline]
    fn seen(&self, from: &Receiver) -> f32 {
        self.0.unshadowed_irradiance(from).map_or(0.0, |irradiance| irradiance.r)
    }

    /// Density of a direction (sr⁻¹); 0 where it does not go through.
    #[inline]
    fn pdf(&self, from: &Receiver, ray: &PreparedRay, direction: &Ray) -> f32 {
        let Some(hit) = self.shape().intersect(ray, f32::INFINITY) else { return 0.0 };
        let at = self.shape().surface_point(direction, &hit);
        self.0.pdf_solid_angle(from, THROUGH, direction.direction, &at)
    }
}

/// An environment whose light comes in through portals, for the most part.
///
/// Half of the samples go through the portals, evenly over the projected solid angle that the receiver
/// sees of all of them; the other half goes where the environment's own density sends it, so that
/// light from elsewhere is not lost. Their density is that of the mixture (one-sample MIS with the
/// balance heuristic: Veach 1997, *Robust Monte Carlo Methods for Light Transport Simulation*, section
/// 9.2.4), so that it can be asked for any direction. A receiver that sees no portal's front gets the
/// environment's own density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Portals<'a, L> {
    light: L,
    portals: &'a [Portal],
}

impl<'a, L: Emitter> Portals<'a, L> {
    /// An environment behind portals.
    ///
    /// * `light` – surrounds the scene
    /// * `portals` – should not overlap; where they do, the light is sampled more often than it need be
    #[must_use]
    pub const fn new(light: L, portals: &'a [Portal]) -> Self {
        Self { light, portals }
    }

    /// The environment.
    #[must_use]
    pub const fn environment(&self) -> &L {
        &self.light
    }

    /// The openings.
    #[must_use]
    pub const fn portals(&self) -> &'a [Portal] {
        self.portals
    }
}

/// Projected solid angle that a receiver sees of all portals (sr).
#[inline]
fn seen_of_all(portals: &[Portal], from: &Receiver) -> f32 {
    portals.iter().map(|portal| portal.seen(from)).sum()
}

/// A direction through one of the portals, which is chosen in proportion to what is seen of it;
/// that portal's index, and its density of the direction (sr⁻¹).
#[inline]
fn through(portals: &[Portal], from: &Receiver, seen: f32, mut u: [f32; 2]) -> Option<(Vec3, usize, f32)> {
    let mut left = u[0] * seen;
    let mut chosen = None;
    for (index, portal) in portals.iter().enumerate() {
        let own = portal.seen(from);
        if !(own > 0.0) {
            continue;
        }
        chosen = Some(index);
        u[0] = (left / own).min(ONE_MINUS_EPSILON);
        if left < own {
            break;
        }
        left -= own;
    }
    let index = chosen?;
    let sample = portals.get(index)?.0.sample(from, THROUGH, u)?;
    match sample.density {
        Density::SolidAngle(pdf) => Some((sample.wi, index, pdf)),
        Density::Delta => None,
    }
}

/// Density of the mixture (sr⁻¹).
///
/// * `escaping` – that of the environment itself
/// * `drawn` – the portal that the direction was drawn through, and its density
#[inline]
fn mixture(
    portals: &[Portal],
    from: &Receiver,
    wi: Vec3,
    seen: f32,
    escaping: f32,
    drawn: Option<(usize, f32)>,
) -> f32 {
    let ray = Ray::new(from.point, wi);
    let prepared = PreparedRay::new(ray);
    let mut pdf = 0.0;
    for (index, portal) in portals.iter().enumerate() {
        // At the edge a rounded direction might miss the portal that it was drawn through.
        let own = match drawn {
            Some((through, own)) if through == index => own,
            _ => portal.pdf(from, &prepared, &ray),
        };
        if own > 0.0 {
            pdf += own * portal.seen(from);
        }
    }
    SHARE * pdf / seen + (1.0 - SHARE) * escaping
}

impl<L: Emitter> Emitter for Portals<'_, L> {
    #[inline]
    fn sample(&self, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        let seen = seen_of_all(self.portals, from);
        if !(seen > 0.0) {
            return self.light.sample(from, method, u);
        }
        let (wi, drawn) = if u[0] < SHARE {
            let (wi, index, pdf) = through(self.portals, from, seen, [u[0] / SHARE, u[1]])?;
            (wi, Some((index, pdf)))
        } else {
            let rest = ((u[0] - SHARE) / (1.0 - SHARE)).min(ONE_MINUS_EPSILON);
            (self.light.sample(from, method, [rest, u[1]])?.wi, None)
        };
        let pdf = mixture(self.portals, from, wi, seen, self.light.pdf_escaping(from, wi), drawn);
        (pdf > 0.0 && pdf.is_finite()).then(|| LightSample {
            wi,
            distance: f32::INFINITY,
            incident: self.light.radiance_escaping(wi),
            density: Density::SolidAngle(pdf),
        })
    }

    #[inline]
    fn pdf_escaping(&self, from: &Receiver, wi: Vec3) -> f32 {
        let seen = seen_of_all(self.portals, from);
        let escaping = self.light.pdf_escaping(from, wi);
        if seen > 0.0 { mixture(self.portals, from, wi, seen, escaping, None) } else { escaping }
    }

    #[inline]
    fn radiance_escaping(&self, wi: Vec3) -> Rgb {
        self.light.radiance_escaping(wi)
    }

    fn unshadowed_irradiance(&self, from: &Receiver) -> Option<Rgb> {
        self.light.unshadowed_irradiance(from)
    }

    fn is_environment(&self) -> bool {
        self.light.is_environment()
    }

    fn leaves_to_bsdf(&self) -> bool {
        self.light.leaves_to_bsdf()
    }

    fn power(&self, scene_radius: f32) -> f32 {
        self.light.power(scene_radius)
    }
}
