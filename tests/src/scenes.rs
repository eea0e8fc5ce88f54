//! Small scenes whose light is known.

use crate::random::Uniforms;
use crate::statistics::Moments;
use halflight::Rgb;
use halflight::bsdf::{AnyBsdf, Lambert, Phong, TwoSided};
use halflight::build::{
    CameraDescription, Description, Emission, FovAxis, Geometry, IntegratorDescription, Material, Mesh,
    Object, ProjectionDescription, SceneBuffers,
};
use halflight::camera::View;
use halflight::estimate::{Estimator, PixelStats};
use halflight::film::Filter;
use halflight::geom::Ray;
use halflight::glam::Vec3;
use halflight::light::AnyLight;
use halflight::sequence::{Random, Sequence};
use halflight::shape::{AnyShape, Rectangle};

/// A scene in the making.
#[derive(Debug, Clone)]
pub struct Stage(pub Description);

impl Stage {
    /// Nothing but a camera above the origin, and three materials: black, white, and half glossy.
    #[must_use]
    pub fn empty() -> Self {
        let matte = |r| AnyBsdf::Lambert(Lambert::new(Rgb::splat(r)).expect("a reflectance"));
        let glossy = Phong::new(Rgb::splat(0.4), Rgb::splat(0.5), 40.0).expect("reflectances");
        let material = |name: &str, bsdf| {
            let textures = <[_; 2]>::default();
            Material { name: name.into(), bsdf: TwoSided::both(bsdf), textures }
        };
        let view = View::look_at(Vec3::new(0.0, 3.0, 6.0), Vec3::Y * 0.5, Vec3::Y).expect("a view");
        Self(Description {
            name: "stage".into(),
            camera: CameraDescription {
                view,
                projection: ProjectionDescription::Perspective { fov: 50.0, axis: FovAxis::X },
                near: 0.0,
                far: f32::INFINITY,
            },
            width: 16,
            height: 12,
            filter: Filter::PIXEL,
            integrator: IntegratorDescription::default(),
            samples_per_pixel: None,
            materials: vec![
                material("black", matte(0.0)),
                material("white", matte(1.0)),
                material("glossy", AnyBsdf::Phong(glossy)),
            ],
            objects: Vec::new(),
            lights: Vec::new(),
            environments: Vec::new(),
            portals: Vec::new(),
        })
    }

    /// A large floor of the given material.
    #[must_use]
    pub fn floor(material: usize) -> Self {
        let floor = Rectangle::new(Vec3::ZERO, Vec3::X * 20.0, Vec3::NEG_Z * 20.0).expect("a floor");
        Self::empty().with(AnyShape::Rectangle(floor), material)
    }

    /// With a surface that does not emit.
    #[must_use]
    pub fn with(mut self, shape: AnyShape, material: usize) -> Self {
        let name = format!("object {}", self.0.objects.len());
        self.0.objects.push(Object {
            name,
            geometry: Geometry::Shape(shape),
            material,
            emission: None,
            object_space: None,
        });
        self
    }

    /// With a black surface that emits.
    #[must_use]
    pub fn lit(mut self, shape: AnyShape, radiance: f32) -> Self {
        self = self.with(shape, 0);
        let emission = Emission { radiance: Rgb::splat(radiance), texture: None, two_sided: false };
        if let Some(object) = self.0.objects.last_mut() {
            object.emission = Some(emission);
        }
        self
    }

    /// The last surface emits from both sides.
    #[must_use]
    pub fn two_sided(mut self) -> Self {
        if let Some(emission) = self.0.objects.last_mut().and_then(|o| o.emission.as_mut()) {
            emission.two_sided = true;
        }
        self
    }

    /// With a light that is no surface.
    #[must_use]
    pub fn lit_by(mut self, light: AnyLight<'static>) -> Self {
        self.0.lights.push(light);
        self
    }

    /// The tables.
    #[must_use]
    pub fn build(&self) -> SceneBuffers {
        SceneBuffers::new(&self.0).expect("a proper scene")
    }
}

/// Hilly ground of 2 m by 2 m: `2 n²` triangles.
#[must_use]
pub fn bumpy_ground(n: u32) -> SceneBuffers {
    let at = |i: u32| 2.0 * i as f32 / n as f32 - 1.0;
    let height = |x: f32, z: f32| 0.15 * (7.0 * x).sin() * (5.0 * z).cos() + 0.02 * (41.0 * (x + z)).sin();
    let grid = (0..=n).flat_map(|i| (0..=n).map(move |j| (at(i), at(j))));
    let corner = |i: u32, j: u32| i * (n + 1) + j;
    let triangles = (0..n).flat_map(|i| (0..n).map(move |j| (i, j))).flat_map(|(i, j)| {
        let [a, b] = [corner(i, j), corner(i, j + 1)];
        let [c, d] = [corner(i + 1, j), corner(i + 1, j + 1)];
        [[a, b, c], [c, b, d]]
    });
    let mesh = Mesh {
        positions: grid.map(|(x, z)| Vec3::new(x, height(x, z), z)).collect(),

        triangles: triangles.collect(),
        ..Mesh::default()
    };
    let mut stage = Stage::empty();
    let (name, geometry) = ("ground".into(), Geometry::Mesh(mesh));
    stage.0.objects.push(Object { name, geometry, material: 1, emission: None, object_space: None });
    stage.build()
}

/// What an eye half a millimetre away sees of the origin, from the side of `toward`.
pub fn seen_at_origin(
    buffers: &SceneBuffers,
    estimator: &impl Estimator,
    toward: Vec3,
    samples: u32,
) -> Moments {
    seen(buffers, estimator, &to_origin(toward), samples)
}

/// From half a millimetre away, on the side of `toward`.
#[must_use]
pub fn to_origin(toward: Vec3) -> Ray {
    let direction = -toward.normalize();
    Ray::new(direction * -5e-4, direction)
}

/// What arrives along a ray, from independent samples, none of them negative.
pub fn seen(buffers: &SceneBuffers, estimator: &impl Estimator, ray: &Ray, samples: u32) -> Moments {
    arriving(buffers, estimator, ray, samples, Rgb::is_valid)
}

/// The same where a sample may be negative.
pub fn seen_as_difference(
    buffers: &SceneBuffers,
    estimator: &impl Estimator,
    ray: &Ray,
    samples: u32,
) -> Moments {
    arriving(buffers, estimator, ray, samples, Rgb::is_finite)
}

fn arriving(
    buffers: &SceneBuffers,
    estimator: &impl Estimator,
    ray: &Ray,
    samples: u32,
    is_proper: fn(Rgb) -> bool,
) -> Moments {
    let bound = buffers.bind();
    let scene = bound.scene();
    let mut sequence: Random = Random::new(101);
    Moments::of((0..samples).map(|sample| {
        sequence.start(7, sample);
        let radiance = estimator.sample(&scene, ray, f32::INFINITY, &mut sequence);
        assert!(is_proper(radiance), "{radiance:?} along {ray:?}");
        f64::from(radiance.g)
    }))
}

/// A hash of the bits of a picture (FNV-1a).
#[must_use]
pub fn checksum(pixels: &[PixelStats]) -> u32 {
    let bytes = pixels.iter().flat_map(|p| p.mean().to_array()).flat_map(|v| v.to_bits().to_le_bytes());
    bytes.fold(0x811c_9dc5, |hash, byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

/// Points of the upper hemisphere, for eyes.
pub fn eyes(count: usize) -> impl Iterator<Item = Vec3> {
    let mut random = Uniforms::new(102);
    (0..count).map(move |_| {
        let d = random.direction();
        Vec3::new(d.x, d.y.abs() + 0.2, d.z).normalize()
    })
}
