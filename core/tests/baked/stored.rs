//! Scenes as bytes: the same pictures, and whatever is wrong with the bytes is refused.

use super::{sources, words};
use halflight::build::{Description, SceneBuffers};
use halflight::estimate::{Direct, Estimator};
use halflight::geom::Ray;
use halflight::glam::Vec3;
use halflight::light::AnyLight;
use halflight::load::builtin::builtin;
use halflight::load::{ExportError, rust_source, scene_bytes};
use halflight::sequence::Sobol;
use halflight::stored::{Aligned, Head, NO_LIGHT, NO_MATERIAL, StoredError, StoredScene, checksum};
use std::fs;
use std::path::Path;

/// Room for the largest of the scenes.
const ROOM: usize = 1 << 16;

/// Bytes at an address that 16 divides.
fn aligned(bytes: &[u8]) -> Box<Aligned<[u8; ROOM]>> {
    let mut room = Box::new(Aligned([0; ROOM]));
    room.0[..bytes.len()].copy_from_slice(bytes);
    room
}

#[test]
fn the_bytes_that_are_kept_are_those_that_are_written() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../tests/firmware/scenes/cornell.scene");
    let bytes = scene_bytes(&sources::cornell()).unwrap();
    if std::env::var_os("HALFLIGHT_ACCEPT_SCENES").is_some() {
        fs::write(&path, &bytes).unwrap();
    }
    let place = path.display();
    assert!(
        fs::read(&path).unwrap() == bytes,
        "{place} is not what is written now; HALFLIGHT_ACCEPT_SCENES=1 keeps it"
    );
}

/// The picture of bytes is the one of the scene.
fn check(description: &Description) {
    let bytes = scene_bytes(description).unwrap();
    let room = aligned(&bytes);
    let stored = StoredScene::new(&room.0[..bytes.len()]).unwrap();
    let (mut lights, mut materials) = ([NO_LIGHT; 16], [NO_MATERIAL; 16]);
    let scene = stored.scene(&mut lights, &mut materials).unwrap();
    let buffers = SceneBuffers::new(description).unwrap();
    let bound = buffers.bind();
    let (camera, film) = (stored.camera().unwrap(), stored.film().unwrap());
    assert_eq!(camera, description.camera.camera(description.width, description.height).unwrap());
    assert!(words(scene, camera, film) == words(bound.scene(), camera, film), "{}", description.name);
}

#[test]
fn pictures_are_the_same_from_bytes() {
    for description in [sources::cornell(), sources::sky(), sources::everything()] {
        check(&description);
    }
}

#[test]
fn nodes_and_surfaces_stay_where_they_are() {
    let bytes = scene_bytes(&sources::cornell()).unwrap();
    let room = aligned(&bytes);
    let (mut lights, mut materials) = ([NO_LIGHT; 2], [NO_MATERIAL; 4]);
    let stored = StoredScene::new(&room.0[..bytes.len()]).unwrap();
    let scene = stored.scene(&mut lights, &mut materials).unwrap();
    let inside = room.0.as_ptr_range();
    assert!(inside.contains(&scene.bvh().nodes().as_ptr().cast()));
    assert!(inside.contains(&scene.surfaces().as_ptr().cast()));
}

/// What is said about bytes.
fn refused(bytes: &[u8]) -> Option<StoredError> {
    let room = aligned(bytes);
    let (mut lights, mut materials) = ([NO_LIGHT; 16], [NO_MATERIAL; 16]);
    let stored = match StoredScene::new(&room.0[..bytes.len()]) {
        Ok(stored) => stored,
        Err(error) => return Some(error),
    };
    let _ = (stored.camera(), stored.film());
    let scene = match stored.scene(&mut lights, &mut materials) {
        Ok(scene) => scene,
        Err(error) => return Some(error),
    };
    let ray = Ray::new(Vec3::new(0.28, 0.27, -0.8), Vec3::new(0.01, 0.02, 1.0).normalize());
    let _ = Direct::default().sample(&scene, &ray, f32::INFINITY, &mut Sobol::new(1));
    None
}

#[test]
fn bytes_that_have_changed_are_refused() {
    let bytes = scene_bytes(&sources::everything()).unwrap();
    assert_eq!(refused(&bytes), None);
    for index in 0..bytes.len() {
        let mut broken = bytes.clone();
        broken[index] ^= 1 << (index % 8);
        assert!(refused(&broken).is_some(), "{index}");
    }
    for length in [0, 3, 4, 100, bytes.len() - 4, bytes.len() - 1] {
        assert!(refused(&bytes[..length]).is_some(), "{length}");
    }
    let room = aligned(&bytes);
    let mut moved = room.0;
    moved.copy_within(..bytes.len(), 4);
    let moved = Aligned(moved);
    let shifted = StoredScene::new(&moved.0[4..][..bytes.len()]);
    assert_eq!(shifted.err(), Some(StoredError::Misaligned));
}

#[test]
fn bytes_with_a_checksum_to_match_never_panic() {
    let bytes = scene_bytes(&sources::everything()).unwrap();
    let mut accepted = 0;
    for index in 16..bytes.len() / 4 * 4 {
        for value in [0, 1, 0x7f, 0xff] {
            let mut broken = bytes.clone();
            broken[index] = value;
            sign(&mut broken);
            accepted += u32::from(refused(&broken).is_none());
        }
    }
    assert!(accepted > 0);
}

/// Makes the checksum fit.
fn sign(bytes: &mut [u8]) {
    let words: Vec<u32> = bytes.chunks_exact(4).map(|w| u32::from_le_bytes(w.try_into().unwrap())).collect();
    bytes[12..16].copy_from_slice(&checksum(&words[4..]).to_le_bytes());
}

#[test]
fn too_little_room_and_unknown_kinds_are_named() {
    let bytes = scene_bytes(&sources::everything()).unwrap();
    let room = aligned(&bytes);
    let stored = StoredScene::new(&room.0[..bytes.len()]).unwrap();
    let (needed, _) = stored.room();
    let error = stored.scene(&mut [NO_LIGHT; 3], &mut [NO_MATERIAL; 16]).err();
    assert_eq!(error, Some(StoredError::Room { table: "lights", needed, has: 3 }));
    let mut broken = bytes.clone();
    let count = u32::from_le_bytes(bytes[16..20].try_into().unwrap()) as usize;
    let kind = size_of::<Head>() + 112 * count;
    broken[kind] = 9;
    sign(&mut broken);
    assert_eq!(refused(&broken), Some(StoredError::Kind { table: "surfaces", index: 0 }));
}

#[test]
fn what_is_not_written_is_refused_as_in_rust() {
    for name in ["morning", "still-life", "gallery"] {
        let scene = builtin(name).unwrap();
        let as_rust = rust_source(&scene).map(drop).map_err(|e| e.to_string());
        let as_bytes = scene_bytes(&scene).map(drop).map_err(|e| e.to_string());
        assert_eq!(as_rust, as_bytes, "{name}");
    }
    let mut scene = sources::sky();
    scene.width = 0;
    assert!(matches!(scene_bytes(&scene), Err(ExportError::Scene { .. })));
    assert!(matches!(sources::sky().lights[0], AnyLight::Constant(_)));
}
