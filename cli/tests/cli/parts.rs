//! Parts of a picture, and what becomes of them.

use crate::support::Folder;
use serde_json::Value;
use std::fs;

/// A picture of several tiles, some of them narrow.
const SIZE: &str = "--width 140 --height 70 --crop 3,2,137,69";

/// Renders all parts; returns their names.
fn parts(folder: &Folder, of: u32, arguments: &str) -> Vec<String> {
    (1..=of)
        .map(|i| {
            let name = format!("{i}.part");
            let threads = 1 + i % 3;
            folder
                .good(&format!("render scene.xml --part {i}/{of} -o {name} --threads {threads} {arguments}"));
            name
        })
        .collect()
}

/// A whole picture, and the same from its parts: the bytes, and what is said of the error.
///
/// * `showing` – flags of the picture, which parts do not take
fn assert_same(of: u32, arguments: &str, picture: &str, showing: &str) {
    let folder = Folder::new();
    let arguments = format!("{SIZE} {arguments}");
    let names = parts(&folder, of, &arguments).join(" ");
    let merged = folder.good(&format!("merge {names} -o merged.{picture} --json {showing}"));
    let once = folder.good(&format!("render scene.xml -o once.{picture} --json {arguments} {showing}"));
    let (merged, once): (Value, Value) =
        (serde_json::from_str(&merged).unwrap(), serde_json::from_str(&once).unwrap());
    for key in ["relative_error", "relative_error_interval", "samples_per_pixel", "samples", "missed_pixels"]
    {
        assert_eq!(merged[key], once[key], "{key} of {arguments}");
    }
    let same = folder.bytes(&format!("merged.{picture}")) == folder.bytes(&format!("once.{picture}"));
    assert!(same, "{of} parts, {arguments}");
}

#[test]
fn parts_with_samples_make_the_bits_of_one_run() {
    assert_same(1, "--spp 3", "exr", "");
    assert_same(3, "--spp 6", "exr", "");
    assert_same(7, "--spp 2 --seed 9", "hdr", "");
    assert_same(20, "--spp 1 --sequence sobol", "png", "--exposure 1");
}

#[test]
fn adaptive_parts_make_the_bits_of_one_run() {
    assert_same(4, "--error 4 --max-spp 256", "exr", "");
}

#[test]
fn parts_with_layers_make_the_bits_of_one_run() {
    for arguments in ["--width 70 --spp 5", "--width 70 --error 8 --max-spp 64"] {
        let folder = Folder::new();
        let names = parts(&folder, 3, &format!("{arguments} --layers")).join(" ");
        folder.good(&format!("merge {names} -o merged.exr --layers"));
        folder.good(&format!("render scene.xml -o once.exr {arguments} --layers"));
        assert!(folder.bytes("merged.exr") == folder.bytes("once.exr"), "{arguments}");
    }
}

#[test]
fn small_tiles_of_many_samples_make_the_bits_of_one_run() {
    let folder = Folder::new();
    let arguments = "--width 24 --spp 1030 --crop 0,4,24,12";
    let names = parts(&folder, 2, arguments).join(" ");
    folder.good(&format!("merge {names} -o merged.exr"));
    folder.good(&format!("render scene.xml -o once.exr {arguments}"));
    assert!(folder.bytes("merged.exr") == folder.bytes("once.exr"));
}

#[test]
fn pictures_of_pixels_are_made_of_parts_too() {
    let folder = Folder::new();
    let names = parts(&folder, 2, "--spp 4 --layers").join(" ");
    folder.good(&format!("merge {names} -o a.png --samples-image s.png --visibility-image v.png"));
    folder.good("render scene.xml --spp 4 -o b.png --samples-image t.png --visibility-image w.png");
    for (ours, theirs) in [("a.png", "b.png"), ("s.png", "t.png"), ("v.png", "w.png")] {
        assert!(folder.bytes(ours) == folder.bytes(theirs), "{ours}");
    }
}

#[test]
fn the_name_of_a_scene_does_not_matter_and_its_content_does() {
    let folder = Folder::new();
    fs::copy(folder.path("scene.xml"), folder.path("other.xml")).unwrap();
    folder.good("render scene.xml --part 1/2 -o 1.part");
    folder.good("render other.xml --part 2/2 -o 2.part");
    folder.good("merge 2.part 1.part -o out.png");
    let changed = fs::read_to_string(folder.path("scene.xml")).unwrap().replace("20, 20, 20", "20, 20, 21");
    fs::write(folder.path("other.xml"), changed).unwrap();
    folder.good("render other.xml --part 2/2 -o 2.part");
    let message = folder.refused("merge 1.part 2.part -o out.png");
    assert!(message.contains("2.part and 1.part are parts of different pictures"), "{message}");
    assert!(message.contains("its scene is another, or has been changed"), "{message}");
}

#[test]
fn parts_that_do_not_belong_together_are_named() {
    let folder = Folder::new();
    let names = parts(&folder, 5, "");
    folder.good("render scene.xml --part 2/5 --spp 5 -o spp.part");
    folder.good("render scene.xml --part 2/5 --technique light -o light.part");
    folder.good("render scene.xml --part 2/4 -o of.part");
    for (part, reason) in [
        ("spp.part", "its spp is 5, not 4"),
        ("light.part", "its technique is light"),
        ("of.part", "its picture is made of 4 parts, not 5"),
    ] {
        let message = folder.refused(&format!("merge 1.part {part} -o out.exr"));
        assert!(message.contains(reason) && message.contains(part), "{message}");
    }
    let message = folder.refused("merge 5.part 2.part 5.part -o out.exr");
    assert!(message.contains("part 5 of 5 is there twice: 5.part and 5.part"), "{message}");
    assert!(message.contains("parts 1, 3 to 4 of 5 are missing"), "{message}");
    let message = folder.refused(&format!("merge {} -o out.exr", names[1..].join(" ")));
    assert!(message.contains("part 1 of 5 is missing"), "{message}");
    let message = folder.refused(&format!("merge {} -o out.exr --layers", names.join(" ")));
    assert!(message.contains("the parts hold no layers"), "{message}");
}

#[test]
fn parts_that_are_none_are_refused() {
    let folder = Folder::new();
    parts(&folder, 2, "");
    let good = folder.bytes("2.part");
    for (bytes, reason) in [
        (&good[..good.len() - 1], "2.part is torn"),
        (&good[..good.len() / 2], "2.part is torn"),
        (&good[..20], "2.part is torn"),
        (&b"<scene/>"[..], "2.part is no part"),
        (b"", "2.part is no part"),
        (&[&good[..], b"."].concat(), "bytes behind its end"),
    ] {
        fs::write(folder.path("2.part"), bytes).unwrap();
        let message = folder.refused("merge 1.part 2.part -o out.exr");
        assert!(message.contains(reason) && message.contains("render it again"), "{message}");
    }
    for place in [good.len() / 3, good.len() / 2, good.len() - 20, good.len() - 2] {
        let mut altered = good.clone();
        altered[place] ^= 1;
        fs::write(folder.path("2.part"), altered).unwrap();
        let message = folder.refused("merge 1.part 2.part -o out.exr");
        assert!(message.contains("2.part is damaged"), "{message}");
    }
    assert!(folder.refused("merge 1.part 3.part -o out.exr").contains("cannot read 3.part"));
    assert!(folder.refused("merge 1.part . -o out.exr").contains("not a regular file"));
}

#[test]
fn flags_that_no_part_can_serve_are_refused() {
    let folder = Folder::new();
    for (arguments, reason) in [
        ("--part 1/2 -o a.png", "the name of a part ends in .part"),
        ("--part 1/2", "the name of a part ends in .part"),
        ("--part 1/2 -o a.part --time 1", "--time has no use with --part"),
        ("--part 1/2 -o a.part --error 5 --adaptive off", "no part knows the whole picture"),
        ("--part 1/2 -o a.part --exposure 1", "give --exposure to halflight merge"),
        ("--part 1/2 -o a.part --samples-image s.png", "give --samples-image to halflight merge"),
        ("--part 3/2 -o a.part", "3/16"),
        ("--checkpoint 1 --time 1", "--time has no use with --part or --checkpoint"),
        ("-o a.part", ".part"),
    ] {
        let message = folder.refused(&format!("render scene.xml {arguments}"));
        assert!(message.contains(reason), "{arguments}: {message}");
    }
}

#[test]
fn more_parts_than_tiles_are_no_harm() {
    let folder = Folder::new();
    let names = parts(&folder, 3, "").join(" ");
    folder.good(&format!("merge {names} -o merged.exr"));
    folder.good("render scene.xml -o once.exr");
    assert!(folder.bytes("merged.exr") == folder.bytes("once.exr"));
}

#[test]
fn more_parts_than_tiles_are_warned_of() {
    let folder = Folder::new();
    let run = folder.run("render scene.xml --width 60 --height 40 --part 5/9 -o 5.part --spp 1");
    assert_eq!(run.code, Some(0), "{run:?}");
    assert!(
        run.stderr.contains("only 4 of 9 parts can hold anything: the picture has 4 tiles of 32×32"),
        "{run:?}"
    );
    let run = folder.run("render scene.xml --width 60 --height 40 --part 1/4 -o 1.part --spp 1");
    assert!(!run.stderr.contains("hold anything"), "{run:?}");
}

#[test]
fn a_picture_without_light_is_warned_of() {
    let folder = Folder::with_change(
        "origin=\"0, 2, 6\" target=\"0, 0.8, 0\"",
        "origin=\"0, -2, 6\" target=\"0, -3, 0\"",
    );
    let run = folder.run("render scene.xml -o out.png --spp 1");
    assert!(run.stderr.contains("of the pixels are black"), "{run:?}");
}
