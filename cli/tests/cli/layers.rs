//! What is written beside the picture.

use crate::support::Folder;

/// A channel of an EXR file, row by row.
fn channel(folder: &Folder, file: &str, name: &str) -> Vec<f32> {
    let image = exr::prelude::read_first_flat_layer_from_file(folder.path(file)).unwrap();
    let mut channels = image.layer_data.channel_data.list.into_iter();
    let found = channels.find(|c| c.name.to_string() == name);
    let found = found.unwrap_or_else(|| panic!("{file} has no {name}"));
    found.sample_data.values_as_f32().collect()
}

/// Values at places that are known: on the floor before the ball, on the ball, in the sky.
fn at(folder: &Folder, name: &str) -> [f32; 3] {
    let values = channel(folder, "out.exr", name);
    [(46, 60), (48, 30), (2, 2)].map(|(x, y)| values[y * 96 + x])
}

#[test]
fn layers_say_what_is_seen() {
    let folder = Folder::new();
    folder.good("render scene.xml -o out.exr --width 96 --spp 16 --layers");
    assert_eq!(at(&folder, "samples"), [16.0; 3]);
    assert_eq!(at(&folder, "albedo.G"), [0.5, 0.5, 0.0]);
    let [floor, ball, sky] = at(&folder, "Z");
    assert!(4.0 < ball && ball < 6.0 && floor > 3.0 && sky == 0.0, "{floor} {ball} {sky}");
    let [floor, ball, sky] = at(&folder, "N.Z");
    assert!(floor.abs() < 1e-6 && ball > 0.5 && sky == 0.0, "{floor} {ball} {sky}");
    assert_eq!(at(&folder, "N.Y")[0], 1.0);
    let visibility = channel(&folder, "out.exr", "visibility");
    assert!(visibility.iter().all(|v| (0.0..=1.0).contains(v)));
    let has = |part: &dyn Fn(f32) -> bool| visibility.iter().any(|v| part(*v));
    assert!(has(&|v| v == 0.0) && has(&|v| v == 1.0) && has(&|v| 0.1 < v && v < 0.9));
    assert!(at(&folder, "error.R").iter().all(|e| (0.0..0.1).contains(e)));
}

#[test]
fn layers_do_not_change_the_picture() {
    let folder = Folder::new();
    folder.good("render scene.xml -o plain.exr --error 5");
    folder.good("render scene.xml -o layers.exr --error 5 --layers --seed 0");
    for name in ["R", "G", "B"] {
        assert_eq!(channel(&folder, "plain.exr", name), channel(&folder, "layers.exr", name));
    }
    let read = |name| image::open(folder.path(name)).unwrap().to_rgb32f();
    assert_eq!(read("plain.exr"), read("layers.exr"), "other readers see the picture alone");
}

#[test]
fn samples_and_visibility_are_pictures_on_request() {
    let folder = Folder::new();
    folder.good("render scene.xml -o a.png --error 2 --samples-image s.png --visibility-image v.png --quiet");
    assert_eq!(folder.names(), ["a.png", "s.png", "scene.xml", "v.png"]);
    for (name, darkest) in [("s.png", 1), ("v.png", 0)] {
        let picture = image::open(folder.path(name)).unwrap().to_rgb8();
        assert_eq!(picture.dimensions(), (24, 16));
        let values = || picture.pixels().map(|p| p.0[0]);
        assert_eq!(values().max(), Some(255), "{name}");
        assert!(values().min() >= Some(darkest), "{name}");
    }
}

#[test]
fn layers_without_a_place_are_refused() {
    let folder = Folder::new();
    assert!(folder.refused("render scene.xml -o a.png --layers").contains("only .exr has them"));
    assert!(folder.refused("render scene.xml --samples-image a.exr").contains("it is to be a .png"));
    let line = "render scene.xml --visibility-image v.png --technique bsdf";
    assert!(folder.refused(line).contains("samples no light"));
}

#[test]
fn the_header_tells_of_the_render() {
    let folder = Folder::new();
    folder.good("render scene.xml -o a.exr --spp 8 --seed 3 --threads 1");
    folder.good("render scene.xml -o b.exr --spp 8 --seed 3 --threads 2");
    assert_eq!(folder.bytes("a.exr"), folder.bytes("b.exr"), "equal renders are equal files");
    let image = exr::prelude::read_first_flat_layer_from_file(folder.path("a.exr")).unwrap();
    let own = &image.layer_data.attributes;
    let comment = own.comments.as_ref().unwrap().to_string();
    assert!(comment.starts_with("scene, 8 samples/pixel, seed 3, error "), "{comment}");
    let settings = own.other.values().next().unwrap().to_text().unwrap().to_string();
    let settings: serde_json::Value = serde_json::from_str(&settings).unwrap();
    assert_eq!((&settings["seed"], &settings["choices"]["sequence"]), (&3.into(), &"zsobol".into()));
    assert!(settings["relative_error"].as_f64().is_some_and(|e| e > 0.0), "{settings}");
}
