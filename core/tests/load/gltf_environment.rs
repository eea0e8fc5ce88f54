//! glTF: light from all around, as six pictures.

use crate::gltf::{CORNERS, floats, glb, read_with, triangle};
use halflight::Rgb;
use halflight::build::{Image, SceneBuffers};
use halflight::glam::Vec3;
use halflight::load::{LoadError, LoadOptions, Loaded, write_exr};
use std::io::Cursor;

/// Where the columns and the rows of a picture lead, and where it stands.
const FACES: [[Vec3; 3]; 6] = [
    [Vec3::NEG_Z, Vec3::Y, Vec3::X],
    [Vec3::Z, Vec3::Y, Vec3::NEG_X],
    [Vec3::X, Vec3::NEG_Z, Vec3::Y],
    [Vec3::X, Vec3::Z, Vec3::NEG_Y],
    [Vec3::X, Vec3::Y, Vec3::Z],
    [Vec3::NEG_X, Vec3::Y, Vec3::NEG_Z],
];

/// A colour that tells the place on the cube.
fn colour(place: Vec3) -> Rgb {
    Rgb::from((0.5 * place + 0.5).to_array())
}

/// A face as a file.
fn face([across, along, toward]: [Vec3; 3], width: u32, height: u32) -> Vec<u8> {
    let at = |i: u32, of: u32| (2.0 * i as f32 + 1.0) / of as f32 - 1.0;
    let texel = |x, y| colour(toward + across * at(x, width) + along * at(y, height));
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| texel(x, y))).collect();
    let mut bytes = Cursor::new(Vec::new());
    write_exr(&Image { width, height, texels }, &mut bytes).expect("a picture can be written");
    bytes.into_inner()
}

/// Nine coefficients.
fn coefficients() -> String {
    format!("[{}]", ["[1,2,3]"; 9].join(","))
}

/// A light of six pictures.
fn light(images: &str, size: &str, more: &str) -> String {
    let coefficients = coefficients();
    format!(
        r#"{{"irradianceCoefficients":{coefficients},"specularImages":[{images}],"specularImageSize":{size}{more}}}"#
    )
}

/// A triangle under lights, the scenes of which are given, with pictures behind it.
fn scene(scenes: &str, lights: &str, images: &[Vec<u8>]) -> Vec<u8> {
    let mut binary = floats(&CORNERS);
    let (mut views, mut list) = (r#"{"buffer":0,"byteLength":36}"#.to_owned(), Vec::new());
    for (index, image) in images.iter().enumerate() {
        views += &format!(r#",{{"buffer":0,"byteOffset":{},"byteLength":{}}}"#, binary.len(), image.len());
        list.push(format!(r#"{{"bufferView":{}}}"#, index + 1));
        binary.extend(image);
    }
    let more = format!(
        r#","images":[{}],"scenes":{scenes},"extensionsUsed":["EXT_lights_image_based"],
        "extensions":{{"EXT_lights_image_based":{{"lights":[{lights}]}}}}"#,
        list.join(",")
    );
    let json =
        triangle("", "", &more).replace(r#"[{"buffer":0,"byteLength":36}]"#, &format!("[{views}]")).replace(
            r#""buffers":[{"byteLength":36}]"#,
            &format!(r#""buffers":[{{"byteLength":{}}}]"#, binary.len()),
        );
    glb(&json, &binary)
}

/// One scene, lit by the first light.
const LIT: &str = r#"[{"nodes":[0],"extensions":{"EXT_lights_image_based":{"light":0}}}]"#;

fn read(file: &[u8]) -> Result<Loaded, LoadError> {
    read_with("scene.glb", &[("scene.glb", file)], &LoadOptions::default())
}

#[track_caller]
fn well(file: &[u8]) -> Loaded {
    read(file).unwrap_or_else(|error| panic!("{error}"))
}

/// The radiance that comes from directions.
fn radiance(loaded: &Loaded, directions: &[Vec3]) -> Vec<Rgb> {
    let buffers = SceneBuffers::new(&loaded.description).expect("a scene");
    let bound = buffers.bind();
    let scene = bound.scene();
    directions.iter().map(|d| scene.radiance_escaping(d.normalize())).collect()
}

#[test]
fn a_direction_sees_its_place_on_the_turned_cube() {
    let images: Vec<_> = FACES.iter().map(|axes| face(*axes, 8, 8)).collect();
    let turned = r#","rotation":[0.5,0.5,0.5,0.5],"intensity":3"#;
    let loaded = well(&scene(LIT, &light("[0,1,2,3,4,5]", "8", turned), &images));
    assert_eq!(loaded.warnings.len(), 1, "only the camera is missing: {:?}", loaded.warnings);
    let places: Vec<Vec3> = FACES
        .iter()
        .flat_map(|[u, v, n]| {
            [[0.0, 0.0], [0.7, 0.2], [-0.4, 0.8], [-0.8, -0.6], [0.5, -0.8]]
                .map(|[a, b]| *n + *u * a + *v * b)
        })
        .collect();
    // The quaternion takes x to y, y to z and z to x.
    let seen: Vec<Vec3> = places.iter().map(|p| Vec3::new(p.z, p.x, p.y)).collect();
    for (place, seen) in places.iter().zip(radiance(&loaded, &seen)) {
        let off = seen * (1.0 / 3.0) - colour(*place);
        let largest = off.to_array().iter().fold(0.0_f32, |m, v| m.max(v.abs()));
        assert!(largest < 0.01, "{place}: {seen:?} instead of {:?} three times", colour(*place));
    }
}

/// One texel of sRGB codes 188, 94 and 0, to be divided by 51/255.
const RGBD: &[u8] =
    b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR\x00\x00\x00\x01\x00\x00\x00\x01\x08\x06\x00\x00\x00\
    \x1f\x15\xc4\x89\x00\x00\x00\rIDATx\x9cc\xd8\x13\xc7`\x0c\x00\x04B\x01N#|>!\x00\x00\x00\
    \x00IEND\xaeB`\x82";

#[test]
fn colours_are_divided_by_alpha() {
    let loaded = well(&scene(LIT, &light("[0,0,0,0,0,0]", "1", ""), &[RGBD.to_vec()]));
    let [seen] = radiance(&loaded, &[Vec3::new(0.3, 0.5, -0.2)])[..] else { panic!("one direction") };
    for (seen, expected) in seen.to_array().into_iter().zip([2.514_432, 0.559_662, 0.0]) {
        assert!((seen - expected).abs() < 1e-4, "{seen} instead of {expected}");
    }
}

#[test]
fn a_scene_has_the_light_that_it_names() {
    let images = [face([Vec3::ZERO, Vec3::ZERO, Vec3::ZERO], 1, 1)];
    let lights = [1, 2].map(|i| light("[0,0,0,0,0,0]", "1", &format!(r#","intensity":{i}"#))).join(",");
    let named = |light: &str| format!(r#"{{"nodes":[0]{light}}}"#);
    let by =
        |index: u32| named(&format!(r#","extensions":{{"EXT_lights_image_based":{{"light":{index}}}}}"#));
    let scenes = format!(r#"[{},{},{}],"scene":1"#, by(0), by(1), named(""));
    let loaded = well(&scene(&scenes, &lights, &images));
    assert_eq!(radiance(&loaded, &[Vec3::Y]), [Rgb::splat(1.0)]);
    let third = scenes.replace(r#""scene":1"#, r#""scene":2"#);
    let loaded = well(&scene(&third, &lights, &images));
    assert!(loaded.description.environments.is_empty() && loaded.description.lights.len() == 1);
}

#[track_caller]
fn refused(scenes: &str, lights: &str, why: &str) {
    let axes = FACES[0];
    let images = [face(axes, 2, 2), face(axes, 4, 2), face(axes, 4, 4)];
    let error = read(&scene(scenes, lights, &images)).expect_err("it is refused").to_string();
    assert!(error.contains(why), "{error}\nshould contain: {why}");
}

#[test]
fn what_breaks_the_rules_is_refused() {
    let good = |more: &str| light("[0,0,0,0,0,0]", "2", more);
    let pictures = |images: &str, size: &str| light(images, size, "");
    well(&scene(LIT, &good(""), &[face(FACES[0], 2, 2)]));
    refused(&LIT.replace("\"light\":0", "\"light\":7"), &good(""), "lights[7] does not exist; there are 1");
    refused(LIT, &pictures("[0,0,0,0,0]", "2"), "invalid length 5");
    refused(LIT, &pictures("[0,0,0,0,0,3]", "2"), "images[3] does not exist; there are 3");
    refused(LIT, &pictures("[0,0,0,0,0,0],[0,0,0,0,0,99]", "2"), "images[99] does not exist");
    refused(LIT, &pictures("", "2"), "no specularImages");
    refused(LIT, &pictures("[1,1,1,1,1,1]", "4"), "images[1] has 4×2 texels instead of 4×4");
    refused(LIT, &pictures("[0,0,0,2,0,0]", "2"), "images[2] has 4×4 texels instead of 2×2");
    refused(LIT, &pictures("[0,0,0,0,0,0]", "2.5"), "instead of 2.5×2.5");
    for size in ["4000", "1e30"] {
        refused(LIT, &pictures("[0,0,0,0,0,0]", size), "in longitude and latitude: more than");
    }
    refused(LIT, &pictures("[0,0,0,0,0,0]", "-2"), "instead of -2×-2");
    refused(LIT, &good("").replacen("[1,2,3],", "", 1), "invalid length 8");
    refused(LIT, &good("").replacen("[1,2,3]", "[1,2]", 1), "invalid length 2");
    refused(LIT, &good("").replacen("1,2,3", "1e39,2,3", 1), "not finite");
    refused(LIT, &good(r#","rotation":[0,0,0,0]"#), "no length");
    refused(LIT, &good(r#","rotation":[0,0,1]"#), "invalid length 3");
    for intensity in ["-1", "1e39"] {
        refused(LIT, &good(&format!(r#","intensity":{intensity}"#)), "its intensity is");
    }
    refused(LIT, r#"{"specularImages":[],"specularImageSize":1}"#, "missing field `irradianceCoefficients`");
}
