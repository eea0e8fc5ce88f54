//! A light by someone else: nothing but the public interface.

use halflight::Rgb;
use halflight::bsdf::Lambert;
use halflight::bvh::{Bvh, Child, Node};
use halflight::choose::LightChoice;
use halflight::estimate::{Direct, Estimator, PixelStats, Probe, Technique};
use halflight::geom::{Frame, Ray};
use halflight::glam::Vec3;
use halflight::light::{Density, Emitter, LightSample, Receiver, SurfaceDensity};
use halflight::num::{FRAC_1_PI, PI};
use halflight::scene::{NONE, Scene, Surface, Tables};
use halflight::sequence::Sobol;
use halflight::shape::{Rectangle, Shape, SurfacePoint};
use halflight::warp;

/// An overcast sky: `L(θ) = L_z (1 + 2 cos θ) / 3` above the horizon, nothing below.
///
/// Source: Moon and Spencer 1942, *Illumination from a Non-Uniform Sky*, Illuminating Engineering 37.
#[derive(Debug, Clone, Copy)]
struct Overcast {
    zenith: Rgb,
}

impl Emitter for Overcast {
    fn sample(&self, from: &Receiver, _: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        let wi = Frame::from_normal(from.normal).to_world(warp::cosine_hemisphere(u));
        let pdf = self.pdf_escaping(from, wi);
        (pdf > 0.0).then(|| LightSample {
            wi,
            distance: f32::INFINITY,
            incident: self.radiance_escaping(wi),
            density: Density::SolidAngle(pdf),
        })
    }

    fn pdf_escaping(&self, from: &Receiver, wi: Vec3) -> f32 {
        warp::cosine_hemisphere_pdf(from.normal.dot(wi))
    }

    fn radiance_escaping(&self, wi: Vec3) -> Rgb {
        if wi.y > 0.0 { self.zenith * ((1.0 + 2.0 * wi.y) / 3.0) } else { Rgb::BLACK }
    }

    fn is_environment(&self) -> bool {
        true
    }

    fn power(&self, scene_radius: f32) -> f32 {
        2.0 * PI * PI * scene_radius * scene_radius * self.zenith.average()
    }
}

/// What looks at a plane of reflectance 0.5 under the sky.
fn outdoors(check: impl Fn(Scene<'_, Rectangle, Overcast, Lambert>)) {
    let ground = Rectangle::new(Vec3::ZERO, Vec3::X * 50.0, Vec3::NEG_Z * 50.0).unwrap();
    let surfaces = [Surface { shape: ground, material: 0, light: NONE, normals: NONE, uvs: NONE }];
    let nodes = [Node::EMPTY.with_child(0, Child::Leaf { first: 0, count: 1 }, ground.bounds())];
    let lights = [Overcast { zenith: Rgb::new(1.0, 2.0, 3.0) }];
    let materials = [Lambert::new(Rgb::splat(0.5)).unwrap()];
    let tables = Tables { surfaces: &surfaces, lights: &lights, materials: &materials, ..Tables::EMPTY };
    check(Scene::new(Bvh::new(&nodes, 1).unwrap(), tables).unwrap());
}

/// `E = 7π/9 L_z`, from `∫ (1 + 2 cos θ)/3 cos θ dω`.
const IRRADIANCE: f32 = 7.0 * PI / 9.0;

#[test]
fn irradiance_under_an_overcast_sky_is_seven_ninths_of_pi() {
    outdoors(|scene| {
        let probe = Probe { samples: 4096, surface: SurfaceDensity::Auto, choice: LightChoice::All };
        let from = SurfacePoint { point: Vec3::Y * 1e-3, error: Vec3::ZERO, normal: Vec3::Y };
        let seen = probe.irradiance(&scene, &from, &mut Sobol::new(1));
        assert!((seen.mean().g / (2.0 * IRRADIANCE) - 1.0).abs() < 1e-3, "{seen:?}");
        assert_eq!(seen.unshadowed, None);
    });
}

#[test]
fn by_light_by_bsdf_and_by_both_agree() {
    outdoors(|scene| {
        let eye = Vec3::new(0.0, 1.0, 2.0);
        let ray = Ray::new(eye, -eye.normalize());
        for technique in
            [Technique::Light, Technique::Bsdf, Technique::Mis(halflight::estimate::Heuristic::Power)]
        {
            let direct = Direct { technique, ..Direct::default() };
            let mut seen = PixelStats::NEW;
            let mut sequence = Sobol::new(3);
            for sample in 0..4096 {
                halflight::sequence::Sequence::start(&mut sequence, 0, sample);
                seen.add(direct.sample(&scene, &ray, f32::INFINITY, &mut sequence));
            }
            let exact = 0.5 * FRAC_1_PI * IRRADIANCE;
            assert!((seen.mean().r / exact - 1.0).abs() < 2e-3, "{technique:?} {:?}", seen.mean());
        }
    });
}
