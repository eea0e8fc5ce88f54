//! `halflight compare`.

use crate::support::Folder;
use serde_json::Value;

/// A folder with two renders of one scene that differ by their noise, and one of another size.
fn pictures() -> Folder {
    let folder = Folder::new();
    folder.good("render scene.xml -o a.exr --quiet --sequence random");
    folder.good("render scene.xml -o b.exr --quiet --sequence random --seed 1");
    folder.good("render scene.xml -o small.exr --quiet --width 12");
    folder
}

#[test]
fn equal_pictures_are_equal() {
    let folder = pictures();
    let line = folder.good("compare a.exr a.exr --max-relmse 0");
    assert_eq!(line, "RMSE 0  relMSE 0  PSNR ∞ dB  SSIM 1.0000  FLIP 0  mean 1.00000\n");
}

#[test]
fn a_check_that_fails_is_code_1() {
    let folder = pictures();
    let run = folder.run("compare a.exr b.exr --max-relmse 1e-9");
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(run.stdout.starts_with("RMSE ") && run.stderr.contains("above 1.00e-9"), "{run:?}");
    folder.good("compare a.exr b.exr --max-relmse 1e9");
    folder.good("compare a.exr b.exr");
}

#[test]
fn json_holds_the_measures() {
    let folder = pictures();
    let json: Value = serde_json::from_str(&folder.good("compare a.exr b.exr --json")).unwrap();
    for measure in ["rmse", "relmse", "psnr", "ssim", "flip", "mean_ratio"] {
        assert!(json[measure].as_f64().is_some_and(|v| v > 0.0), "{measure}: {json}");
    }
    assert_eq!(json["passed"], true);
}

#[test]
fn pictures_of_different_size_are_refused() {
    let message = pictures().refused("compare a.exr small.exr");
    assert!(message.contains("24×16") && message.contains("12×8"), "{message}");
}

#[test]
fn what_is_no_picture_is_refused() {
    let folder = pictures();
    assert!(folder.refused("compare a.exr scene.xml").contains("scene.xml"));
    assert!(folder.refused("compare missing.exr a.exr").contains("missing.exr"));
    assert!(folder.refused("compare a.exr b.exr --max-relmse -1").contains("--max-relmse"));
}

#[test]
fn the_same_picture_in_three_formats_is_nearly_the_same() {
    let folder = Folder::new();
    for format in ["exr", "hdr", "png"] {
        folder.good(&format!("render scene.xml -o a.{format} --quiet"));
    }
    folder.good("compare a.hdr a.exr --max-relmse 1e-4");
    // The lamp is brighter than white: PNG cuts it off, and 8 bits cannot tell 20 from 1.
    let json: Value = serde_json::from_str(&folder.good("compare a.png a.exr --json")).unwrap();
    assert!(json["psnr"].as_f64().is_some_and(|decibels| decibels > 48.0), "{json}");
}

#[test]
fn the_difference_is_written_as_a_picture() {
    let folder = pictures();
    folder.good("compare a.exr b.exr -o difference.png --exposure 2");
    let difference = image::open(folder.path("difference.png")).unwrap().to_rgb8();
    assert_eq!(difference.dimensions(), (24, 16));
    assert!(difference.pixels().any(|p| p.0 != [0; 3]));
}

#[test]
fn noise_is_told_from_a_difference() {
    let folder = Folder::new();
    for (name, more) in [("a", ""), ("b", "--seed 1"), ("sky", "--seed 2 --sky 40,0")] {
        folder.good(&format!("render scene.xml -o {name}.exr --quiet --layers --spp 64 {more}"));
    }
    let same = folder.good("compare a.exr b.exr --heat heat.png");
    assert!(same.contains("they agree within noise"), "{same}");
    assert!(image::open(folder.path("heat.png")).is_ok());
    let run = folder.run("compare a.exr sky.exr");
    assert_eq!(run.code, Some(1), "{run:?}");
    assert!(run.stderr.contains("differ by more than noise"), "{run:?}");
    let json: Value = serde_json::from_str(&folder.run("compare a.exr sky.exr --json").stdout).unwrap();
    assert_eq!((&json["passed"], &json["noise"]["agree"]), (&false.into(), &false.into()));
}

#[test]
fn parts_of_a_film_are_compared_in_their_place() {
    let folder = Folder::new();
    for (name, crop) in [("a.exr", "4,4,12,12"), ("b.exr", "4,4,12,12"), ("c.exr", "0,0,24,16")] {
        folder.good(&format!("render scene.xml -o {name} --quiet --crop {crop}"));
    }
    folder.good("compare a.exr b.exr --max-relmse 0");
    let json: Value = serde_json::from_str(&folder.good("compare a.exr c.exr --json")).unwrap();
    assert!(json["mean_ratio"].as_f64().is_some_and(|ratio| ratio < 0.9), "black around it: {json}");
    folder.good("render scene.xml -o a.pfm --quiet --crop 4,4,12,12");
    folder.good("compare a.exr a.pfm --max-relmse 0");
}
