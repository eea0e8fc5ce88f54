//! Several scenes, and the frames of a camera that moves.

use crate::support::{Folder, SCENE};
use std::fs;

/// A second place for the camera of [`SCENE`].
const SENSOR: &str = r#"<sensor type="perspective"><float name="fov" value="40"/>
    <transform name="to_world"><lookat origin="4, 2, 6" target="0, 0.8, 0" up="0, 1, 0"/></transform></sensor></scene>"#;

/// A folder whose scene has a camera that moves for a second.
fn moving() -> Folder {
    Folder::with_change("</scene>", SENSOR)
}

#[test]
fn every_scene_has_a_picture_of_its_own() {
    let folder = Folder::new();
    fs::write(folder.path("other.xml"), SCENE.replace("20, 20, 20", "10, 10, 10")).unwrap();
    fs::create_dir(folder.path("out")).unwrap();
    let lines = folder.good("render scene.xml other.xml -o out/");
    assert!(lines.starts_with("out/scene.png  24×16") && lines.contains("\nout/other.png  24×16"), "{lines}");
    assert_ne!(folder.bytes("out/scene.png"), folder.bytes("out/other.png"));
    folder.good("render scene.xml other.xml -o {name}.exr --quiet");
    folder.good("render other.xml -o alone.exr --quiet");
    assert_eq!(folder.bytes("other.exr"), folder.bytes("alone.exr"));
}

#[test]
fn several_pictures_need_several_names() {
    let folder = Folder::new();
    let message = folder.refused("render scene.xml cornell -o a.png");
    assert!(message.contains("2 scenes make 2 pictures") && message.contains("-o out/"), "{message}");
    fs::create_dir(folder.path("a")).unwrap();
    fs::write(folder.path("a/scene.xml"), SCENE).unwrap();
    let message = folder.refused("render scene.xml a/scene.xml -o {name}.png");
    assert!(message.contains("would both be written to scene.png"), "{message}");
    let message = folder.refused("render scene.xml cornell -o {name}.png --samples-image s.png");
    assert!(message.contains("--samples-image names one file"), "{message}");
}

#[test]
fn frames_go_the_way_of_the_camera() {
    let folder = moving();
    folder.good("render scene.xml -o out.exr --frames 0..2 --fps 2 --quiet");
    assert_eq!(folder.names(), ["out.0000.exr", "out.0001.exr", "out.0002.exr", "scene.xml"]);
    let still = Folder::new();
    still.good("render scene.xml -o out.exr --quiet");
    assert_eq!(folder.bytes("out.0000.exr"), still.bytes("out.exr"), "the first frame is the first sensor's");
    let ends = Folder::with_change("origin=\"0, 2, 6\"", "origin=\"4, 2, 6\"");
    ends.good("render scene.xml -o out.exr --quiet");
    let read = |bytes: Vec<u8>| image::load_from_memory(&bytes).unwrap().to_rgb32f();
    let (last, alone) = (read(folder.bytes("out.0002.exr")), read(ends.bytes("out.exr")));
    let apart = last.iter().zip(alone.iter()).map(|(a, b)| (a - b).abs()).sum::<f32>() / last.len() as f32;
    assert!(apart < 0.01, "the last frame is the second sensor's: {apart}");
    assert_ne!(read(folder.bytes("out.0001.exr")), last);
}

#[test]
fn frames_that_exist_whole_are_kept() {
    let folder = moving();
    let line = "render scene.xml -o out.##.png --frames 3..6 --width 12";
    folder.good(line);
    let whole = folder.bytes("out.04.png");
    fs::remove_file(folder.path("out.03.png")).unwrap();
    fs::write(folder.path("out.04.png"), &whole[..whole.len() / 2]).unwrap();
    fs::write(folder.path("out.05.png"), "").unwrap();
    let run = folder.run(line);
    assert_eq!(run.stdout.lines().count(), 3, "{run:?}");
    assert!(run.stderr.contains("kept 1 picture that exist"), "{run:?}");
    assert_eq!(folder.bytes("out.04.png"), whole);
    assert_eq!(folder.good(&format!("{line} --overwrite")).lines().count(), 4);
    assert_eq!(folder.good(line), "");
}

#[test]
fn a_camera_that_stands_still_has_no_frames() {
    let folder = Folder::new();
    let message = folder.refused("render scene.xml --frames 0..3");
    assert!(message.contains("does not move") && message.contains("<sensor>"), "{message}");
    assert!(folder.refused("render scene.xml --frames 3..1").contains("before the first"));
    assert!(folder.refused("render scene.xml --fps 3").contains("--frames"));
    let run = moving().run("render scene.xml -o out.png");
    assert!(run.stderr.contains("moves for 1 s: --frames 0..24"), "{run:?}");
}
