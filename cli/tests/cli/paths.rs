//! Indirect light, where the scene or the command line asks for it.

use crate::support::Folder;
use serde_json::Value;

const PATH: &str = r#"<integrator type="path"><integer name="max_depth" value="6"/></integrator>"#;

/// The scene with indirect light.
fn with_path() -> Folder {
    Folder::with_change(r#"<integrator type="direct"/>"#, PATH)
}

fn auto(folder: &Folder) -> Value {
    let inspected: Value = serde_json::from_str(&folder.good("inspect scene.xml --json")).unwrap();
    inspected["auto"].clone()
}

#[test]
fn a_scene_asks_for_as_much_as_it_wants() {
    let (direct, path) = (Folder::new(), with_path());
    assert_eq!(auto(&direct)["max-depth"], Value::Null);
    assert_eq!(auto(&path)["max-depth"], "6");
    assert!(direct.good("inspect scene.xml").contains("indirect light (the scene asks for direct light)"));
    assert!(!path.good("inspect scene.xml").contains("indirect light"));
    for (folder, line) in [(&direct, "-o direct.exr"), (&path, "-o path.exr")] {
        let run = folder.run(&format!("render scene.xml {line} --spp 8"));
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""));
    }
    assert_ne!(direct.bytes("direct.exr"), path.bytes("path.exr"));
}

#[test]
fn the_command_line_asks_for_more_or_less() {
    let (direct, path) = (Folder::new(), with_path());
    direct.good("render scene.xml --spp 8 -o picture.exr");
    path.good("render scene.xml --spp 8 -o picture.exr --max-depth 2");
    assert_eq!(path.bytes("picture.exr"), direct.bytes("picture.exr"), "two segments are direct light");
    path.good("render scene.xml --spp 8 -o picture.exr");
    direct.good("render scene.xml --spp 8 -o picture.exr --max-depth 6");
    assert_eq!(path.bytes("picture.exr"), direct.bytes("picture.exr"));
    let json = direct.good("render scene.xml --spp 1 -o all.exr --max-depth -1 --json");
    let report: Value = serde_json::from_str(&json).unwrap();
    assert_eq!(report["choices"]["max-depth"], "-1");
}

#[test]
fn samples_go_where_the_error_is() {
    let folder = with_path();
    let json = folder.good("render scene.xml -o adaptive.exr --layers --error 4 --json");
    let report: Value = serde_json::from_str(&json).unwrap();
    assert!(report["relative_error"].as_f64().is_some_and(|e| e < 0.05), "{report}");
    assert_eq!(report["rejected_samples"], 0);
}

#[test]
fn what_has_no_use_is_said() {
    let folder = Folder::new();
    assert!(folder.refused("render scene.xml --max-depth 0").contains("-1 for paths without end"));
    let refused = folder.refused("render scene.xml --max-depth 3 --technique occlusion");
    assert!(refused.contains("--max-depth has no use with --technique occlusion"), "{refused}");
    let run = folder.run("render scene.xml --spp 1 --max-depth 3 --bsdf-samples 2");
    assert!(run.stderr.contains("--bsdf-samples has no effect"), "{run:?}");
}
