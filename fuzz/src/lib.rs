//! What the fuzz targets share: numbers from bytes, and what must hold for them.

use halflight::Film;
use halflight::Rgb;
use halflight::build::SceneBuffers;
use halflight::estimate::{Direct, Job, PixelStats};
use halflight::film::PixelRect;
use halflight::geom::{PreparedRay, Ray};
use halflight::glam::{DVec3, Vec3};
use halflight::light::{AreaLight, Density, Emitter, Receiver, SampledShape, SurfaceDensity, SurfaceView};
use halflight::load::{Files, LoadOptions, load, load_from};
use halflight::num::unit_f32;
use halflight::sequence::Sobol;
use halflight::shape::SurfacePoint;
use std::path::PathBuf;
use std::{env, fs, process};

/// Bytes as numbers; zeros when they have run out.
#[derive(Debug)]
pub struct Numbers<'a> {
    bytes: &'a [u8],
    /// True when numbers are any bits, false when they are of a size that scenes have.
    raw: bool,
}

impl<'a> Numbers<'a> {
    /// The first byte says whether numbers are any bits, NaN and infinity included.
    #[must_use]
    pub fn new(bytes: &'a [u8]) -> Self {
        let mut numbers = Self { bytes, raw: true };
        numbers.raw = numbers.flag();
        numbers
    }

    /// A byte.
    pub fn byte(&mut self) -> u8 {
        let Some((&byte, rest)) = self.bytes.split_first() else { return 0 };
        self.bytes = rest;
        byte
    }

    /// True or false.
    pub fn flag(&mut self) -> bool {
        self.byte() & 1 == 1
    }

    /// 32 bits.
    pub fn word(&mut self) -> u32 {
        u32::from_le_bytes([0; 4].map(|_| self.byte()))
    }

    /// Any `f32`, or one of the sizes that scenes have, with few digits.
    pub fn number(&mut self) -> f32 {
        if self.raw {
            return f32::from_bits(self.word());
        }
        let (mantissa, exponent) = (self.byte() as i8, self.byte() as i8);
        f32::from(mantissa) * 10.0_f32.powi(i32::from(exponent) % 11)
    }

    /// Three of them.
    pub fn vector(&mut self) -> Vec3 {
        Vec3::new(self.number(), self.number(), self.number())
    }

    /// Three of them.
    pub fn colour(&mut self) -> Rgb {
        Rgb::new(self.number(), self.number(), self.number())
    }

    /// Two uniforms in `[0, 1)`.
    pub fn uniforms(&mut self) -> [f32; 2] {
        [0; 2].map(|_| unit_f32(self.word()))
    }

    /// Anywhere; its normal is of unit length, or NaN.
    pub fn receiver(&mut self) -> Receiver {
        let (point, normal) = (self.vector(), self.vector().as_dvec3());
        Receiver { point, normal: normal.normalize_or(DVec3::NAN).as_vec3() }
    }
}

/// A density of light or nothing: never NaN, infinite or negative.
fn is_density(pdf: f32) -> bool {
    (0.0..f32::INFINITY).contains(&pdf)
}

/// Sampler, densities, radiance and irradiance of any light.
pub fn emitter(light: &impl Emitter, from: &Receiver, u: [f32; 2]) {
    for method in METHODS {
        let Some(sample) = light.sample(from, method, u) else { continue };
        assert!((sample.wi.length() - 1.0).abs() < 1e-5, "{method:?}: {sample:?}");
        assert!(sample.distance > 0.0, "{method:?}: {sample:?}");
        assert!(sample.incident.is_valid(), "{method:?}: {sample:?}");
        if let Density::SolidAngle(pdf) = sample.density {
            assert!(pdf > 0.0 && is_density(pdf), "{method:?}: {sample:?}");
        }
        let at = SurfacePoint { point: from.point, error: Vec3::ZERO, normal: -sample.wi };
        assert!(is_density(light.pdf_escaping(from, sample.wi)), "{method:?}: {sample:?}");
        assert!(is_density(light.pdf_solid_angle(from, method, sample.wi, &at)), "{method:?}: {sample:?}");
        assert!(light.radiance_escaping(sample.wi).is_valid());
    }
    let e = light.unshadowed_irradiance(from);
    assert!(e.is_none_or(Rgb::is_valid), "irradiance {e:?}");
    assert!(light.power(1.0) >= 0.0, "power {}", light.power(1.0));
}

const METHODS: [SurfaceDensity; 4] =
    [SurfaceDensity::Area, SurfaceDensity::SolidAngle, SurfaceDensity::Projected, SurfaceDensity::Auto];

/// A shape that emits, as what a receiver samples, asks for and meets.
pub fn area_light<S: SampledShape + std::fmt::Debug>(shape: S, n: &mut Numbers) {
    let light = AreaLight::new(shape, Rgb::WHITE).expect("a proper radiance");
    let light = if n.flag() { light.two_sided() } else { light };
    let (from, u) = (n.receiver(), n.uniforms());
    emitter(&light, &from, u);
    for method in METHODS {
        sampled(&light, &from, method, u);
        // And a direction that was not sampled.
        let at = shape.sample_area(n.uniforms());
        let wi = (at.point - from.point).try_normalize().unwrap_or(Vec3::Z);
        queried(&light, &from, method, wi, &at);
    }
    if let Some(Rgb { g, .. }) = light.unshadowed_irradiance(&from) {
        assert!(g <= 3.141_594, "irradiance {g} at {from:?} from {shape:?}");
    }
    let ray = Ray::new(n.vector(), n.vector());
    if let Some(hit) = shape.intersect(&PreparedRay::new(ray), n.number()) {
        assert!(hit.t > 0.0 && hit.t < f32::INFINITY, "{hit:?} along {ray:?} on {shape:?}");
        assert!(!shape.surface_point(&ray, &hit).point.is_nan(), "{hit:?} along {ray:?} on {shape:?}");
    }
}

/// The density of a sample is the queried one, and its uniforms are uniforms.
fn sampled<S: SampledShape>(light: &AreaLight<S>, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) {
    let Some(sample) = light.sample(from, method, u) else { return };
    assert!(sample.distance.is_finite(), "{method:?}: {sample:?}");
    let drawn = light.view(from, method).and_then(|view| view.sample(u)).expect("what was sampled");
    let pdf = light.pdf_solid_angle(from, method, sample.wi, &drawn.at);
    assert_eq!(sample.density, Density::SolidAngle(pdf), "{method:?}: {sample:?}");
    queried(light, from, method, sample.wi, &drawn.at);
}

fn queried<S: SampledShape>(
    light: &AreaLight<S>,
    from: &Receiver,
    method: SurfaceDensity,
    wi: Vec3,
    at: &SurfacePoint,
) {
    let pdf = light.pdf_solid_angle(from, method, wi, at);
    assert!(is_density(pdf), "{method:?}: density {pdf} toward {wi} at {at:?}");
    assert!(light.radiance(at, -wi).is_valid());
    if let Some(u) = light.view(from, method).filter(|_| pdf > 0.0).and_then(|view| view.invert(at, wi)) {
        assert!(u.iter().all(|u| (0.0..1.0).contains(u)), "{method:?}: {u:?} for {wi} at {at:?}");
    }
}

/// A file of this process, overwritten by each run.
fn file(name: &str) -> PathBuf {
    let folder = env::temp_dir().join(format!("halflight-fuzz-{}", process::id()));
    fs::create_dir_all(&folder).expect("temporary folders can be made");
    folder.join(name)
}

/// Any bytes as a scene; what is read must also build, or say why not.
pub fn load_file(name: &str, bytes: &[u8]) {
    let path = file(name);
    fs::write(&path, bytes).expect("temporary files can be written");
    let options = LoadOptions { lenient: true, ..LoadOptions::default() };
    if let Ok(loaded) = load(&path, &options) {
        let _ = halflight::build::SceneBuffers::new(&loaded.description);
    }
}

/// Any bytes as a mesh in a scene.
pub fn load_mesh(kind: &str, bytes: &[u8]) {
    fs::write(file(&format!("mesh.{kind}")), bytes).expect("temporary files can be written");
    let scene = format!(
        r#"<scene version="3.0.0">
    <sensor type="perspective"><float name="fov" value="40"/></sensor>
    <shape type="{kind}"><string name="filename" value="mesh.{kind}"/></shape>
</scene>"#
    );
    load_file("scene.xml", scene.as_bytes());
}

/// Any bytes as the files of a scene; what is read and built gives a pixel in its middle whose light is finite
/// and not negative.
pub fn render_files(scene: &str, files: &[(&str, &[u8])]) {
    let files = Files::in_memory(files.iter().map(|(name, bytes)| (PathBuf::from(name), bytes.to_vec())));
    let options = LoadOptions { lenient: true, ..LoadOptions::default() };
    let Ok(loaded) = load_from(&files, scene.as_ref(), &options) else { return };
    let description = &loaded.description;
    let Ok(buffers) = SceneBuffers::new(description) else { return };
    let (width, height) = (description.width.min(64), description.height.min(64));
    let Ok(camera) = description.camera.camera(width, height) else { return };
    let Ok(film) = Film::new(width, height, description.filter) else { return };
    let bound = buffers.bind();
    let job =
        Job { scene: bound.scene(), camera, film, estimator: Direct::default(), sequence: Sobol::new(0) };
    let (x, y) = (width / 2, height / 2);
    let mut pixel = [PixelStats::NEW];
    job.render(PixelRect { x0: x, y0: y, x1: x + 1, y1: y + 1 }, 0..4, &mut pixel);
    let mean = pixel[0].mean();
    assert!(mean.is_valid(), "{mean:?}");
}
