//! `halflight tradeoff`.

use crate::auto::{FACTOR, lines_of_costs};
use crate::support::{EMITTER, Folder};
use serde_json::Value;
use std::{env, fs};

/// A short measurement.
const SHORT: &str = "tradeoff scene.xml --budget 0.5 --width 24";

/// The choices in the JSON.
fn choices(json: &Value) -> Vec<&Value> {
    json["choices"].as_array().unwrap().iter().collect()
}

#[test]
fn a_measurement_prints_a_table_and_writes_three_files() {
    let folder = Folder::new();
    let table = folder.good(SHORT);
    for word in ["auto takes --technique auto", "reference: ", "efficiency", "penumbra", "\nauto  ", "best: "]
    {
        assert!(table.contains(word), "no \"{word}\" in {table}");
    }
    for row in [
        "lights area",
        "lights solid-angle",
        "technique bsdf",
        "technique control",
        "sequence random",
        "adaptive on",
    ] {
        assert!(table.lines().any(|l| l.starts_with(row)), "no \"{row}\" in {table}");
    }
    assert!(table.ends_with("written: scene-tradeoff.svg scene-tradeoff.csv scene-tradeoff.json\n"));
    let svg = String::from_utf8(folder.bytes("scene-tradeoff.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg.contains("--lights area") && svg.contains("CPU time (s)"));
    let csv = String::from_utf8(folder.bytes("scene-tradeoff.csv")).unwrap();
    assert!(csv.starts_with("choice,samples_per_pixel,cpu_seconds,relmse,"));
    assert!(csv.lines().skip(1).all(|l| l.split(',').count() == 9), "{csv}");
}

#[test]
fn what_is_printed_as_json_is_what_is_written() {
    let folder = Folder::new();
    let printed: Value = serde_json::from_str(&folder.good(&format!("{SHORT} --json -o out"))).unwrap();
    let written: Value = serde_json::from_slice(&folder.bytes("out.json")).unwrap();
    assert_eq!(printed, written);
    assert_eq!((&printed["width"], &printed["height"]), (&24.into(), &16.into()));
    assert!(printed["reference"]["relmse"]["all"].as_f64().is_some_and(|e| e > 0.0 && e < 0.01), "{printed}");
    let choices = choices(&printed);
    assert_eq!((&choices[0]["choice"], &choices[0]["efficiency"]), (&"auto".into(), &1.0.into()));
    // BSDF samples rarely meet the small lamp: far worse at any time.
    let bsdf = choices.iter().find(|c| c["choice"] == "technique bsdf").unwrap();
    assert!(bsdf["efficiency"].as_f64().unwrap() < 0.5, "{bsdf}");
    for rung in bsdf["rungs"].as_array().unwrap() {
        assert!(rung["cpu_seconds"].as_f64().is_some_and(|s| s > 0.0), "{rung}");
    }
}

#[test]
fn a_reference_may_be_given() {
    let folder = Folder::new();
    folder.good("render scene.xml -o reference.exr --spp 4096 --quiet");
    let table = folder.good(&format!("{SHORT} --reference reference.exr"));
    assert!(table.contains("reference: as given"), "{table}");
    folder.good("render scene.xml -o cut.exr --spp 1 --crop 0,0,24,8 --quiet");
    let message = folder.refused("tradeoff scene.xml --reference cut.exr");
    assert!(message.contains("24×8") && message.contains("24×16"), "{message}");
}

#[test]
fn misuse_is_refused() {
    let folder = Folder::new();
    assert!(folder.refused("tradeoff scene.xml --budget 0").contains("--budget"));
    assert!(folder.refused("tradeoff scene.xml -o missing/out").contains("the folder missing"));
    assert!(Folder::with_change(EMITTER, "").refused("tradeoff scene.xml").contains("no lights"));
}

/// Every choice is at most [`FACTOR`] times as efficient as `auto`, within two standard errors, and samples
/// where the error is, which `auto` takes for an error or a time, are no less efficient than that. Returns
/// what was measured.
fn check_auto(folder: &Folder, scene: &str) -> Value {
    let line = format!("tradeoff {scene} --budget 40 --width 120 --json --quiet -o out");
    let json: Value = serde_json::from_str(&folder.good(&line)).unwrap();
    for choice in choices(&json) {
        let [gain, uncertainty] =
            ["efficiency", "efficiency_standard_error"].map(|k| choice[k].as_f64().unwrap());
        eprintln!("{scene}: {} {gain:.2} ± {uncertainty:.2}", choice["choice"]);
        let is_fine = match choice["choice"] == "adaptive on" {
            true => gain + 2.0 * uncertainty > 1.0 / FACTOR,
            false => gain - 2.0 * uncertainty < FACTOR,
        };
        assert!(is_fine, "{scene}: {}: {gain} ± {uncertainty}", choice["choice"]);
    }
    json
}

/// Takes about ten minutes: `cargo test --release -p halflight-cli auto_is -- --ignored --nocapture`. With
/// HALFLIGHT_ACCEPT_COSTS set, what samples cost is kept for the tests that take no time.
#[test]
#[ignore = "takes ten minutes"]
fn auto_is_nearly_the_best_choice_in_every_built_in_scene() {
    let folder = Folder::new();
    let scenes: Value = serde_json::from_str(&folder.good("scenes --json")).unwrap();
    let mut costs = "# scene, choice, CPU time of a sample over that with auto\n".to_owned();
    for scene in scenes.as_array().unwrap().iter().map(|scene| scene["name"].as_str().unwrap()) {
        costs += &lines_of_costs(scene, &check_auto(&folder, scene));
    }
    if env::var_os("HALFLIGHT_ACCEPT_COSTS").is_some() {
        fs::write(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cli/costs.txt"), costs).unwrap();
    }
}

/// The same for scene files, whose paths are in HALFLIGHT_SCENES, separated by colons.
#[test]
#[ignore = "takes a minute for each scene"]
fn auto_is_nearly_the_best_choice_in_other_scenes() {
    let Ok(paths) = env::var("HALFLIGHT_SCENES") else { return };
    let folder = Folder::new();
    for path in paths.split(':').filter(|p| !p.is_empty()) {
        check_auto(&folder, path);
    }
}
