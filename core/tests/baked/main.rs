//! Scenes as Rust source and as bytes: what is written, that it is the scene that it came from, and what the firmware
//! makes of it on the machines that it runs on.
#![cfg(feature = "load")]

#[path = "../../../tests/firmware/src/picture.rs"]
#[allow(unreachable_pub, reason = "what the firmware does not hide either")]
mod picture;
#[path = "../../../tests/firmware/scenes/mod.rs"]
#[allow(dead_code, unreachable_pub, reason = "a test does not use all that a program may")]
mod scenes;
mod sources;
mod stored;

use halflight::bsdf::{Bsdf, Phong, RoughPlastic};
use halflight::build::{Description, SceneBuffers};
use halflight::estimate::{
    ByArea, ByLight, ByProjected, BySolidAngle, Direct, Estimator, PixelStats, StaticDensity, Technique,
};
use halflight::film::Film;
use halflight::glam::Vec3;
use halflight::light::{AnyLight, Directional, Emitter};
use halflight::load::builtin::{BUILTIN, builtin};
use halflight::load::{ExportError, rust_source};
use halflight::material::Material;
use halflight::scene::{BakedError, CornerNormals, Surface, Tables};
use halflight::sequence::{Dimension, Sequence, Sobol};
use halflight::shape::{AnyShape, Shape, Triangle};
use halflight::{Camera, Rgb, Scene};
use std::fs;
use std::path::Path;

/// Every bit of a picture.
fn words<S: Shape, L: Emitter, M: Material>(
    scene: Scene<'_, S, L, M>,
    camera: Camera,
    film: Film,
) -> Vec<[u32; 8]> {
    let mut words = Vec::new();
    picture::render(scene, camera, film, |_, _, pixel: &PixelStats| words.push(pixel.to_words()));
    words
}

/// The source is the one that is kept, which gives the picture that the scene gives.
fn check<S: Shape, L: Emitter, M: Material>(
    name: &str,
    description: &Description,
    baked: Result<Scene<'static, S, L, M>, BakedError>,
    (camera, film): (Camera, Film),
) {
    let source = rust_source(description).unwrap();
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../tests/firmware/scenes")
        .join(name)
        .with_extension("rs");
    if std::env::var_os("HALFLIGHT_ACCEPT_SCENES").is_some() {
        fs::write(&path, &source).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap();
    let place = path.display();
    assert!(source == kept, "{place} is not what is written now; HALFLIGHT_ACCEPT_SCENES=1 keeps it");
    let buffers = SceneBuffers::new(description).unwrap();
    let bound = buffers.bind();
    let of = description.camera.camera(description.width, description.height).unwrap();
    assert_eq!(camera, of);
    let seen = words(bound.scene(), camera, film);
    assert!(seen.iter().any(|pixel| f32::from_bits(pixel[0]) > 0.0), "{name} is black");
    assert!(words(baked.unwrap(), camera, film) == seen, "{name}: the pictures differ");
}

#[test]
fn cornell_is_the_same_from_its_source() {
    use scenes::cornell as baked;
    check("cornell", &sources::cornell(), baked::scene(), (baked::CAMERA, baked::FILM));
}

#[test]
fn cornell_under_a_sky_is_the_same_from_its_source() {
    use scenes::sky as baked;
    check("sky", &sources::sky(), baked::scene(), (baked::CAMERA, baked::FILM));
}

#[test]
fn everything_is_the_same_from_its_source() {
    use scenes::everything as baked;
    check("everything", &sources::everything(), baked::scene(), (baked::CAMERA, baked::FILM));
}

#[test]
fn the_firmware_prints_what_this_machine_computes() {
    let sum = |pixels: Vec<[u32; 8]>| pixels.iter().fold(picture::Checksum::NEW, |sum, p| sum.with(p));
    use scenes::{cornell, sky};
    let cornell = sum(words(cornell::scene().unwrap(), cornell::CAMERA, cornell::FILM));
    let sky = sum(words(sky::scene().unwrap(), sky::CAMERA, sky::FILM));
    assert_eq!(cornell.0, picture::CORNELL, "0x{:016x}", cornell.0);
    assert_eq!(sky.0, picture::SKY, "0x{:016x}", sky.0);
}

#[test]
fn an_estimator_without_choices_draws_the_same_samples() {
    use scenes::cornell as baked;
    fn same<D: StaticDensity>() {
        let direct = Direct { technique: Technique::Light, surface: D::SURFACE, ..Direct::default() };
        let (mut few, mut all) = (Sobol::new(1), Sobol::new(1));
        let scene = baked::scene().unwrap();
        for sample in 0..1024 {
            few.start(0, sample);
            all.start(0, sample);
            let [x, y] = few.point(Dimension::Film, 0, 1).map(|u| 2.0 * u - 1.0);
            let (ray, reach) = baked::CAMERA.ray(x, y);
            let small = ByLight::<D>::new().sample(&scene, &ray, reach, &mut few);
            assert_eq!(small, direct.sample(&scene, &ray, reach, &mut all), "{:?}", D::SURFACE);
        }
    }
    same::<ByArea>();
    same::<BySolidAngle>();
    same::<ByProjected>();
}

#[test]
fn a_broken_entry_is_named() {
    use scenes::everything as baked;
    let refused =
        |surfaces: &[Surface<AnyShape>], lights: &[AnyLight<'static>], normals: &[CornerNormals]| {
            let materials = &baked::MATERIALS;
            let tables = Tables { surfaces, lights, normals, materials, ..Tables::EMPTY };
            Scene::baked(&baked::NODES, tables).err()
        };
    assert_eq!(refused(&baked::SURFACES, &baked::LIGHTS, &baked::NORMALS), None);
    let mut surfaces = baked::SURFACES;
    surfaces[3].shape = AnyShape::Triangle(Triangle::baked([Vec3::X; 3]));
    let shape = refused(&surfaces, &baked::LIGHTS, &baked::NORMALS);
    assert!(matches!(shape, Some(BakedError::Shape { surface: 3, .. })), "{shape:?}");
    let mut lights = baked::LIGHTS;
    lights[7] = AnyLight::Directional(Directional::baked(Vec3::ONE, Rgb::WHITE));
    let light = refused(&baked::SURFACES, &lights, &baked::NORMALS);
    assert!(matches!(light, Some(BakedError::Light { light: 7, .. })), "{light:?}");
    let normals = refused(&baked::SURFACES, &baked::LIGHTS, &[CornerNormals([Vec3::NAN; 3])]);
    assert_eq!(normals, Some(BakedError::Normals { index: 0 }));
    let missing = refused(&baked::SURFACES, &baked::LIGHTS, &[]);
    assert!(matches!(missing, Some(BakedError::Scene(_))), "{missing:?}");
}

#[test]
fn numbers_that_do_not_follow_are_refused() {
    let phong = Phong::new(Rgb::splat(0.3), Rgb::splat(0.2), 9.0).unwrap();
    assert!(Phong::baked(phong.diffuse(), phong.specular(), 9.0, phong.specular_pmf()).check().is_ok());
    assert!(Phong::baked(phong.diffuse(), phong.specular(), 9.0, 0.9).check().is_err());
    let plastic = RoughPlastic::new(0.2, 1.5).unwrap();
    let numbers = plastic.to_numbers();
    assert_eq!(RoughPlastic::baked(numbers), plastic);
    assert!(plastic.check().is_ok());
    for index in 0..numbers.len() {
        let mut broken = numbers;
        broken[index] = f32::NAN;
        // The flag is a number that is not 0.
        assert!(index == 8 || RoughPlastic::baked(broken).check().is_err(), "{index}");
    }
}

#[test]
fn what_is_not_written_is_refused_by_name() {
    // Textures, pictures of the surroundings: every scene is written, or says what it has.
    let (mut written, mut refused) = (0, 0);
    for scene in BUILTIN.iter().filter_map(|b| builtin(b.name)) {
        match rust_source(&scene) {
            Ok(_) => written += 1,
            Err(ExportError::NotBaked { what, .. }) => {
                assert!(what.contains("texture") || what.contains("picture") || what.contains("portals"));
                refused += 1;
            }
            Err(other) => panic!("{}: {other}", scene.name),
        }
    }
    assert!(written >= 2 && refused >= 1, "{written} {refused}");
}
