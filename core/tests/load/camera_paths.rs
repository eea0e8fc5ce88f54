//! Cameras that move.

use crate::gltf::{CORNERS, floats, glb, read_with, triangle};
use crate::{load_body, message};
use halflight::build::{CameraDescription, ProjectionDescription};
use halflight::glam::Vec3;
use halflight::load::{CameraPath, LoadOptions, Loaded};
use std::f32::consts::FRAC_1_SQRT_2;

const SHAPE: &str = r#"<shape type="sphere"><emitter type="area"/></shape>"#;

fn sensor(x: f32, fov: f32) -> String {
    format!(
        r#"<sensor type="perspective"><float name="fov" value="{fov}"/><transform name="to_world">
        <lookat origin="{x}, 0, 5" target="{x}, 0, 0" up="0, 1, 0"/></transform></sensor>"#
    )
}

#[test]
fn sensors_are_places_of_a_camera_a_second_apart() {
    let body = format!("{SHAPE}{}{}{}", sensor(0.0, 20.0), sensor(2.0, 40.0), sensor(2.0, 40.0));
    let Loaded { description, camera_path, warnings } = load_body("sensors", &body).unwrap();
    let path = camera_path.unwrap();
    assert!(warnings.is_empty(), "{warnings:?}");
    assert_eq!((path.end(), path.at(0.0)), (2.0, Some(description.camera)));
    let half = path.at(0.5).unwrap();
    assert!((half.view.origin - Vec3::new(1.0, 0.0, 5.0)).length() < 1e-6, "{half:?}");
    assert!(matches!(half.projection, ProjectionDescription::Perspective { fov: 30.0, .. }), "{half:?}");
}

#[test]
fn sensors_that_project_differently_are_no_path() {
    let flat = r#"<sensor type="orthographic"/>"#;
    for other in [flat, r#"<sensor type="fisheye"/>"#] {
        let body = format!("{SHAPE}{}{other}", sensor(0.0, 20.0));
        let loaded = load_body("different_sensors", &body).unwrap();
        assert!(loaded.camera_path.is_none());
        assert!(loaded.warnings[0].to_string().contains("only the first sensor is used"));
    }
    assert!(load_body("one_sensor", &format!("{SHAPE}{}", sensor(0.0, 20.0))).unwrap().camera_path.is_none());
}

/// A triangle, and a camera at a node below another one, both animated.
///
/// * `moves` – times of the upper node's places, those places, and between them
fn animated(times: &[f32], places: &[f32], how: &str) -> Result<Loaded, String> {
    let turns = [0.0, 0.0, 0.0, 1.0, 0.0, FRAC_1_SQRT_2, 0.0, FRAC_1_SQRT_2];
    let binary =
        [floats(&CORNERS), floats(times), floats(places), floats(&turns), floats(&[0.0, 2.0])].concat();
    let (t, p) = (4 * times.len(), 4 * places.len());
    let views = format!(
        r#"{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":{t}}},
        {{"buffer":0,"byteOffset":{},"byteLength":{p}}},{{"buffer":0,"byteOffset":{},"byteLength":32}},
        {{"buffer":0,"byteOffset":{},"byteLength":8}}"#,
        36 + t,
        36 + t + p,
        36 + t + p + 32
    );
    let accessor = |view: usize, count: usize, kind: &str| {
        format!(r#",{{"bufferView":{view},"componentType":5126,"count":{count},"type":"{kind}"}}"#)
    };
    let accessors = [
        accessor(1, times.len(), "SCALAR"),
        accessor(2, places.len() / 3, "VEC3"),
        accessor(3, 2, "VEC4"),
        accessor(4, 2, "SCALAR"),
    ];
    let json = triangle("", "", "")
        .replace(r#"{"mesh":0}"#, r#"{"mesh":0},{"children":[2]},{"camera":0,"translation":[0,0,3]}"#)
        .replace(
            r#""count":3,"type":"VEC3"}"#,
            &format!(r#""count":3,"type":"VEC3"}}{}"#, accessors.concat()),
        )
        .replace(r#"{"buffer":0,"byteLength":36}"#, &views)
        .replace(
            r#""buffers":[{"byteLength":36}]"#,
            &format!(
                r#""buffers":[{{"byteLength":{}}}],
            "cameras":[{{"type":"perspective","perspective":{{"yfov":0.8,"znear":0.1}}}}],
            "animations":[{{"channels":[{{"sampler":0,"target":{{"node":1,"path":"translation"}}}},
                {{"sampler":1,"target":{{"node":1,"path":"rotation"}}}}],
            "samplers":[{{"input":1,"output":2,"interpolation":"{how}"}},{{"input":4,"output":3}}]}}]"#,
                binary.len()
            ),
        );
    let files = [("scene.glb", &*glb(&json, &binary))];
    read_with("scene.glb", &files, &LoadOptions::default()).map_err(|error| message("scene.glb", &error))
}

fn path(times: &[f32], places: &[f32], how: &str) -> CameraPath {
    animated(times, places, how).unwrap().camera_path.unwrap()
}

#[track_caller]
fn assert_origin(camera: Option<CameraDescription>, expected: Vec3) {
    let origin = camera.unwrap().view.origin;
    assert!((origin - expected).length() < 1e-5, "{origin} is not {expected}");
}

#[test]
fn a_gltf_camera_moves_with_the_nodes_that_it_hangs_from() {
    let path = path(&[1.0, 3.0], &[0.0, 0.0, 0.0, 4.0, 0.0, 0.0], "LINEAR");
    assert_eq!(path.end(), 3.0);
    // The arm of 3 turns from z to x in 2 s, while its foot moves from 1 s to 3 s.
    assert_origin(path.at(0.0), Vec3::new(0.0, 0.0, 3.0));
    assert_origin(path.at(1.0), Vec3::new(1.0, 0.0, 1.0) * 3.0 * FRAC_1_SQRT_2);
    assert_origin(path.at(2.0), Vec3::new(5.0, 0.0, 0.0));
    assert_origin(path.at(99.0), Vec3::new(7.0, 0.0, 0.0));
    let end = path.at(3.0).unwrap();
    assert!((end.view.forward - Vec3::NEG_X).length() < 1e-6, "{end:?}");
}

#[test]
fn steps_and_splines_are_those_of_the_specification() {
    let at = |path: &CameraPath, time: f64| {
        path.at(time).unwrap().view.origin - path.at(time).unwrap().view.forward * -3.0
    };
    let steps = path(&[0.0, 2.0], &[0.0, 0.0, 0.0, 4.0, 0.0, 0.0], "STEP");
    assert_eq!([0.0, 1.9, 2.0].map(|t| at(&steps, t).x.round()), [0.0, 0.0, 4.0]);
    // Tangents of 1 per second on either end, over 2 s: Hermite's basis at a half is 1/2, 1/8, 1/2, -1/8.
    let keys = [[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0; 3]].concat();
    let spline = path(&[0.0, 2.0], &keys, "CUBICSPLINE");
    let half = at(&spline, 1.0).x;
    assert!((half - (2.0 + 2.0 / 8.0 - 2.0 / 8.0)).abs() < 1e-5, "{half}");
    let quarter = at(&spline, 0.5).x;
    let hermite = 4.0 * 0.15625 + 2.0 * 0.140_625 - 2.0 * 0.046_875;
    assert!((quarter - hermite).abs() < 1e-5, "{quarter} is not {hermite}");
}

#[test]
fn animations_that_make_no_sense_are_refused() {
    let place = [0.0; 6];
    for (times, places, how, words) in [
        (&[1.0, 1.0][..], &place[..], "LINEAR", "do not grow"),
        (&[0.0, f32::NAN], &place, "LINEAR", "do not grow"),
        (&[0.0, 1.0], &place[..3], "LINEAR", "2 times, but 1 values"),
        (&[0.0, 1.0], &place, "CUBICSPLINE", "2 times, but 2 values"),
        (&[0.0, 1.0], &[f32::INFINITY; 6], "LINEAR", "not finite"),
        (&[0.0, 1.0], &place, "BEZIER", "CUBICSPLINE"),
    ] {
        let error = animated(times, places, how).unwrap_err();
        assert!(error.contains("animations") && error.contains(words), "{error}");
    }
}
