//! Scenes as Rust source: what is written, that it is the scene that it came from, and what the firmware
//! makes of it on the machines that it runs on.
#![cfg(feature = "load")]

#[path = "../../../tests/firmware/src/picture.rs"]
#[allow(unreachable_pub, reason = "what the firmware does not hide either")]
mod picture;
#[path = "../../../tests/firmware/scenes/mod.rs"]
#[allow(dead_code, unreachable_pub, reason = "a test does not use all that a program may")]
mod scenes;
mod sources;

use halflight::build::{Description, SceneBuffers};
use halflight::estimate::PixelStats;
use halflight::film::Film;
use halflight::light::Emitter;
use halflight::load::{ExportError, rust_source};
use halflight::material::Material;
use halflight::scene::BakedError;
use halflight::shape::Shape;
use halflight::{Camera, Scene};
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
fn what_is_not_written_is_refused_by_name() {
    let refused = |d: &Description| match rust_source(d) {
        Err(ExportError::NotBaked { what, .. }) => what,
        other => panic!("{other:?}"),
    };
    let morning = halflight::load::builtin::builtin("still-life");
    let textured =
        halflight::load::builtin::BUILTIN.iter().filter_map(|b| halflight::load::builtin::builtin(b.name));
    let any = textured.chain(morning).filter(|d| !d.environments.is_empty()).map(|d| refused(&d)).next();
    assert!(any.is_some_and(|what| what.contains("picture") || what.contains("textures")), "{any:?}");
}
