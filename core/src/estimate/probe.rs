//! Numbers instead of pictures: what arrives at a point, whether a light is seen from there, and what a
//! ray brings back. One call each, on borrowed data.

use super::{Arrival, Estimator, PixelStats};
use crate::Rgb;
use crate::choose::LightChoice;
use crate::geom::Ray;
use crate::light::{Emitter, SurfaceDensity};
use crate::material::Material;
use crate::num;
use crate::scene::{Interaction, NONE, Scene};
use crate::sequence::{Dimension, Sequence};
use crate::shape::{Shape, SurfacePoint};
use glam::Vec2;

/// What arrives at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Irradiance {
    /// The samples that were taken, shadows included (W m⁻²).
    pub samples: PixelStats,
    /// The irradiance if nothing were in the way, in closed form (W m⁻²); `None` when a light has none.
    pub unshadowed: Option<Rgb>,
}

impl Irradiance {
    /// The estimate (W m⁻²).
    #[must_use]
    pub const fn mean(&self) -> Rgb {
        self.samples.mean()
    }

    /// Standard error of the estimate, as if its samples were independent (W m⁻²): those of a
    /// [`crate::sequence::Sobol`] sequence fill each other's gaps, so that the error is smaller. 0 before the
    /// second sample.
    #[must_use]
    pub fn standard_error(&self) -> Rgb {
        let count = self.samples.count().max(1) as f32;
        self.samples.variance().map(|v| num::sqrt(v / count))
    }
}

/// How points are asked about: the number of samples, and how each is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Probe<'a> {
    /// Samples; powers of two serve best.
    pub samples: u32,
    /// How a light's surface is sampled.
    pub surface: SurfaceDensity,
    /// Which lights are sampled.
    pub choice: LightChoice<'a>,
}

impl Probe<'_> {
    /// Irradiance at a point from the side that its normal is on, shadows included.
    ///
    /// * `from` – a point that [`Shape::surface_point`] gave, or any point with `error` zero in free space
    /// * `sequence` – asked for the samples of pixel 0
    pub fn irradiance<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        from: &SurfacePoint,
        sequence: &mut impl Sequence,
    ) -> Irradiance {
        let at = facing(from);
        let arrival = Arrival { light_samples: 1, surface: self.surface, choice: self.choice };
        let mut samples = PixelStats::NEW;
        for sample in 0..self.samples {
            sequence.start(0, sample);
            let mut sum = Rgb::BLACK;
            arrival.each_ray(scene, &at, from.normal, sequence, |ray| {
                sum += if ray.arrives { ray.irradiance } else { Rgb::BLACK };
            });
            samples.add(sum);
        }
        let receiver = at.receiver(from.normal);
        let unshadowed = scene.lights().iter().try_fold(Rgb::BLACK, |sum, light| {
            light.unshadowed_irradiance(&receiver).map(|irradiance| sum + irradiance)
        });
        Irradiance { samples, unshadowed }
    }

    /// How much of a light is seen from a point, in `[0, 1]`: its irradiance there over that without
    /// shadows. `None` when nothing of it would arrive in any case, or there is no such light.
    ///
    /// * `from` – as for [`Probe::irradiance`]
    /// * `light` – its index
    pub fn visibility<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        from: &SurfacePoint,
        light: usize,
        sequence: &mut impl Sequence,
    ) -> Option<f32> {
        let emitter = scene.lights().get(light)?;
        let receiver = facing(from).receiver(from.normal);
        let (mut arriving, mut whole) = (0.0, 0.0);
        for sample in 0..self.samples {
            sequence.start(0, sample);
            let u = sequence.point(Dimension::Light(0), 0, 1);
            let Some(drawn) = emitter.sample(&receiver, self.surface, u) else { continue };
            let weight = drawn.density.weight() * receiver.normal.dot(drawn.wi) * drawn.incident.luminance();
            if weight > 0.0 {
                whole += weight;
                let seen = scene.light_visible(from, drawn.wi, drawn.distance, light);
                arriving += if seen { weight } else { 0.0 };
            }
        }
        (whole > 0.0).then(|| arriving / whole)
    }

    /// What arrives along a ray from within `reach` (m), with its variance (W m⁻² sr⁻¹).
    ///
    /// * `sequence` – asked for the samples of pixel 0
    pub fn radiance<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        estimator: &impl Estimator,
        (ray, reach): (&Ray, f32),
        sequence: &mut impl Sequence,
    ) -> PixelStats {
        let mut samples = PixelStats::NEW;
        for sample in 0..self.samples {
            sequence.start(0, sample);
            samples.add(estimator.sample(scene, ray, reach, sequence));
        }
        samples
    }
}

/// A point as if a ray had met it on the side of its normal.
fn facing(from: &SurfacePoint) -> Interaction {
    Interaction {
        at: *from,
        shading_normal: from.normal,
        distance: 0.0,
        material: NONE,
        light: NONE,
        surface: NONE,
        place: Vec2::ZERO,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bsdf::Lambert;
    use crate::bvh::{Bvh, Child, Node};
    use crate::estimate::Direct;
    use crate::light::AreaLight;
    use crate::scene::{Surface, Tables};
    use crate::sequence::Random;
    use crate::shape::Rectangle;
    use glam::Vec3;

    const PROBE: Probe<'static> =
        Probe { samples: 4096, surface: SurfaceDensity::Area, choice: LightChoice::All };

    /// A panel of 1 × 1 m at a height of 2 m, and a screen at 1 m whose edge is above the origin.
    fn with_screen(check: impl Fn(&Scene<'_, Rectangle, AreaLight<Rectangle>, Lambert>)) {
        let panel = Rectangle::new(Vec3::Y * 2.0, Vec3::X * 0.5, Vec3::Z * 0.5).unwrap();
        let screen = Rectangle::new(Vec3::new(1.0, 1.0, 0.0), Vec3::X, Vec3::Z).unwrap();
        let surface = |shape, light| Surface { shape, material: 0, light, normals: NONE, uvs: NONE };
        let surfaces = [surface(panel, 0), surface(screen, NONE)];
        let leaf = Child::Leaf { first: 0, count: 2 };
        let nodes = [Node::EMPTY.with_child(0, leaf, panel.bounds().union(screen.bounds()))];
        let lights = [AreaLight::new(panel, Rgb::splat(3.0)).unwrap()];
        let materials = [Lambert::new(Rgb::splat(0.5)).unwrap()];
        let tables = Tables { surfaces: &surfaces, lights: &lights, materials: &materials, ..Tables::EMPTY };
        check(&Scene::new(Bvh::new(&nodes, surfaces.len()).unwrap(), tables).unwrap());
    }

    fn floor(x: f32) -> SurfacePoint {
        SurfacePoint { point: Vec3::X * x, error: Vec3::ZERO, normal: Vec3::Y }
    }

    #[test]
    fn irradiance_is_the_closed_form_where_nothing_is_in_the_way() {
        with_screen(|scene| {
            let seen = PROBE.irradiance(scene, &floor(-1.0), &mut Random::<rand_pcg::Pcg32>::new(1));
            let (exact, error) = (seen.unshadowed.unwrap().r, seen.standard_error().r);
            assert!(error > 0.0 && error < 0.01 * exact);
            assert!((seen.mean().r - exact).abs() < 5.0 * error, "{} {exact} {error}", seen.mean().r);
        });
    }

    #[test]
    fn a_screen_hides_half_all_or_nothing() {
        with_screen(|scene| {
            let mut sequence = Random::<rand_pcg::Pcg32>::new(2);
            let mut seen = |x| PROBE.visibility(scene, &floor(x), 0, &mut sequence).unwrap();
            assert_eq!((seen(-1.0), seen(1.0)), (1.0, 0.0));
            // A fraction of 4096 samples, all of about the same weight.
            assert!((seen(0.0) - 0.5).abs() < 5.0 * 0.5 / 64.0);
            let below = SurfacePoint { normal: Vec3::NEG_Y, ..floor(0.0) };
            assert_eq!(PROBE.visibility(scene, &below, 0, &mut sequence), None);
            assert_eq!(PROBE.visibility(scene, &floor(0.0), 1, &mut sequence), None);
            let lit = PROBE.irradiance(scene, &floor(0.0), &mut sequence);
            let (half, error) = (0.5 * lit.unshadowed.unwrap().g, lit.standard_error().g);
            assert!((lit.mean().g - half).abs() < 5.0 * error, "{lit:?}");
        });
    }

    #[test]
    fn a_ray_to_the_panel_brings_its_radiance_back() {
        with_screen(|scene| {
            let ray = Ray::new(Vec3::NEG_X * 0.25, Vec3::Y);
            let mut sequence = Random::<rand_pcg::Pcg32>::new(3);
            let probe = Probe { samples: 4, ..PROBE };
            let seen = probe.radiance(scene, &Direct::default(), (&ray, f32::INFINITY), &mut sequence);
            assert_eq!((seen.mean(), seen.variance(), seen.count()), (Rgb::splat(3.0), Rgb::BLACK, 4));
        });
    }
}
