//! How much of the light arrives: the numbers behind umbra and penumbra, and the rays that gave them.

use super::{Estimator, Observer};
use crate::Rgb;
use crate::choose::LightChoice;
use crate::geom::Ray;
use crate::light::{Density, Emitter, Receiver, SurfaceDensity};
use crate::material::Material;
use crate::scene::{Interaction, Scene};
use crate::sequence::{Dimension, Sequence};
use crate::shape::Shape;
use glam::Vec3;

/// A light sample at a surface point, and what came of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightRay {
    /// Index of the light.
    pub light: usize,
    /// Unit direction toward it.
    pub wi: Vec3,
    /// How far it is (m); may be infinite.
    pub distance: f32,
    /// How likely `wi` was, given the light.
    pub density: Density,
    /// How likely the light was.
    pub pmf: f32,
    /// Irradiance by this sample when nothing is in the way: `L cos θ / (p · pmf)` (W m⁻²).
    pub irradiance: Rgb,
    /// True when nothing is in the way.
    pub arrives: bool,
}

/// The estimator of the irradiance `E = ∫ L V cos θ dω` beside that without shadows,
/// `E₀ = ∫ L cos θ dω`, from the same light samples. `E / E₀` is 0 in the umbra, 1 in full light and
/// between the two in the penumbra.
///
/// As an [`Estimator`] it puts the luminance of `E` in red, that of `E₀` in green, and in blue 1
/// where the camera ray meets a surface and 0 elsewhere. The light samples are those of
/// [`super::Direct`] with the same choices.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrival<'a> {
    /// Light samples per camera sample, and per light when all lights are sampled.
    pub light_samples: u32,
    /// How a light's surface is sampled.
    pub surface: SurfaceDensity,
    /// Which lights are sampled.
    pub choice: LightChoice<'a>,
}

impl Arrival<'_> {
    /// Hands each light sample of one camera sample to `take`; samples that bring no light to the side
    /// from which the point is seen are left out. How many there were for each light: divide by that.
    ///
    /// * `wo` – unit direction to the viewer
    #[inline]
    pub fn each_ray<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        at: &Interaction,
        wo: Vec3,
        sequence: &mut impl Sequence,
        mut take: impl FnMut(LightRay),
    ) -> u32 {
        let lights = scene.lights().len();
        let draws = self.light_samples.max(1);
        let receiver = at.receiver(wo);
        let chooses = self.choice != LightChoice::All;
        let mut toward = |light: usize, pmf: f32, u: [f32; 2]| {
            if let Some(ray) = self.toward(scene, at, wo, &receiver, light, pmf, u) {
                take(ray);
            }
        };
        for light in self.choice.not_chosen(lights) {
            let dimension = Dimension::Light(light as u32 + u32::from(chooses));
            (0..draws).for_each(|draw| toward(light, 1.0, sequence.point(dimension, draw, draws)));
        }
        for draw in 0..if chooses { draws } else { 0 } {
            let u = sequence.choice(Dimension::Light(0), draw, draws);
            let more = || sequence.choice(Dimension::Choice, draw, draws);
            if let Some((light, pmf)) = self.choice.choose(&receiver, lights, u, more) {
                toward(light, pmf, sequence.point(Dimension::Light(0), draw, draws));
            }
        }
        draws
    }

    /// One sample of one light.
    #[expect(clippy::too_many_arguments, reason = "what a sample depends on, once")]
    fn toward<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        at: &Interaction,
        wo: Vec3,
        receiver: &Receiver,
        light: usize,
        pmf: f32,
        u: [f32; 2],
    ) -> Option<LightRay> {
        let sample = scene.lights()[light].sample(receiver, self.surface, u)?;
        let (wi, distance) = (sample.wi, sample.distance);
        let cos_theta = receiver.normal.dot(wi);
        let outside = (at.at.normal.dot(wo) >= 0.0) == (at.at.normal.dot(wi) > 0.0);
        if !(cos_theta > 0.0 && outside) || sample.incident.is_black() {
            return None;
        }
        let density = match sample.density {
            Density::Delta => 1.0,
            Density::SolidAngle(pdf) => pdf,
        };
        let irradiance = sample.incident * (cos_theta / (density * pmf));
        let arrives = scene.light_visible(&at.at, wi, distance, light);
        Some(LightRay { light, wi, distance, density: sample.density, pmf, irradiance, arrives })
    }
}

impl Estimator for Arrival<'_> {
    #[inline]
    fn observe<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
        sequence: &mut impl Sequence,
        observer: &mut impl Observer,
    ) -> Rgb {
        let Some(hit) = scene.closest_hit(ray, reach) else { return Rgb::BLACK };
        observer.surface(&hit, -ray.direction, || Rgb::WHITE);
        let (mut arriving, mut unshadowed) = (0.0, 0.0);
        let draws = self.each_ray(scene, &hit, -ray.direction, sequence, |ray| {
            let luminance = ray.irradiance.luminance();
            observer.light(ray.arrives, || ray.irradiance.average());
            unshadowed += luminance;
            arriving += if ray.arrives { luminance } else { 0.0 };
        });
        Rgb::new(arriving / draws as f32, unshadowed / draws as f32, 1.0)
    }
}

#[cfg(all(test, feature = "build"))]
mod tests {
    use super::*;
    use crate::bsdf::{AnyBsdf, Lambert, TwoSided};
    use crate::build::{
        CameraDescription, Description, Emission, Geometry, IntegratorDescription, Material as Named, Object,
        ProjectionDescription, SceneBuffers,
    };
    use crate::camera::View;
    use crate::estimate::PixelStats;
    use crate::film::Filter;
    use crate::sequence::Sobol;
    use crate::shape::{AnyShape, Rectangle};
    use std::vec;

    /// A floor under a panel of 1 × 1 m at a height of 2 m, and a screen halfway that hides the half of
    /// the panel with x > 0 from the origin.
    fn half_hidden() -> Description {
        let shape = |centre: Vec3, u: Vec3, v: Vec3| {
            Geometry::Shape(AnyShape::Rectangle(Rectangle::new(centre, u, v).unwrap()))
        };
        let object = |geometry, emission| Object {
            name: "".into(),
            geometry,
            material: 0,
            emission,
            object_space: None,
        };
        let grey = AnyBsdf::Lambert(Lambert::new(Rgb::splat(0.5)).unwrap());
        let emission = Emission { radiance: Rgb::splat(3.0), texture: None, two_sided: false };
        Description {
            name: "half hidden".into(),
            camera: CameraDescription {
                view: View::look_at(Vec3::new(0.0, 0.5, 2.0), Vec3::ZERO, Vec3::Y).unwrap(),
                projection: ProjectionDescription::Orthographic { half_width: 1.0 },
                near: 0.0,
                far: 100.0,
            },
            width: 1,
            height: 1,
            filter: Filter::PIXEL,
            integrator: IntegratorDescription::default(),
            samples_per_pixel: None,
            materials: vec![Named {
                name: "grey".into(),
                bsdf: TwoSided::both(grey),
                textures: <[_; 2]>::default(),
            }],
            objects: vec![
                object(shape(Vec3::ZERO, Vec3::X * 5.0, Vec3::NEG_Z * 5.0), None),
                object(shape(Vec3::Y * 2.0, Vec3::X * 0.5, Vec3::Z * 0.5), Some(emission)),
                object(shape(Vec3::new(1.0, 1.0, 0.0), Vec3::X, Vec3::Z), None),
            ],
            lights: vec![],
            environments: vec![],
            portals: vec![],
        }
    }

    #[test]
    fn half_of_a_half_hidden_panel_arrives_and_the_whole_is_the_closed_form() {
        let buffers = SceneBuffers::new(&half_hidden()).unwrap();
        let bound = buffers.bind();
        let (scene, mut sequence) = (bound.scene(), Sobol::new(5));
        let eye = Vec3::new(0.0, 0.5, 2.0);
        let ray = Ray::new(eye, -eye.normalize());
        for surface in [SurfaceDensity::Area, SurfaceDensity::SolidAngle, SurfaceDensity::Projected] {
            let arrival = Arrival { light_samples: 1, surface, choice: LightChoice::All };
            let mut seen = PixelStats::NEW;
            for sample in 0..4096 {
                sequence.start(0, sample);
                seen.add(arrival.sample(&scene, &ray, f32::INFINITY, &mut sequence));
            }
            let Rgb { r, g, b } = seen.mean();
            let floor = Receiver { point: Vec3::ZERO, normal: Vec3::Y };
            let whole = scene.lights()[0].unshadowed_irradiance(&floor).unwrap().luminance();
            assert!((g / whole - 1.0).abs() < 1e-3, "{surface:?}: {g} {whole}");
            assert!((r / g - 0.5).abs() < 2e-3, "{surface:?}: {r} {g}");
            assert_eq!(b, 1.0);
        }
    }

    #[test]
    fn rays_end_on_the_light_and_say_whether_they_arrive() {
        let buffers = SceneBuffers::new(&half_hidden()).unwrap();
        let bound = buffers.bind();
        let (scene, mut sequence) = (bound.scene(), Sobol::new(5));
        let eye = Vec3::new(0.0, 0.5, 2.0);
        let hit = scene.closest_hit(&Ray::new(eye, -eye.normalize()), f32::INFINITY).unwrap();
        let arrival =
            Arrival { light_samples: 64, surface: SurfaceDensity::Projected, choice: LightChoice::All };
        sequence.start(0, 0);
        let mut rays = vec![];
        assert_eq!(arrival.each_ray(&scene, &hit, eye.normalize(), &mut sequence, |ray| rays.push(ray)), 64);
        assert_eq!(rays.len(), 64);
        for ray in rays {
            let end = hit.at.point + ray.wi * ray.distance;
            assert!((end.y - 2.0).abs() < 1e-4 && end.abs().max_element() < 2.001, "{end}");
            assert_eq!(ray.arrives, end.x < 0.0, "{end}");
        }
    }
}
