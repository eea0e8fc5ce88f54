//! Less memory than is needed: a message and no file, and not a process that is ended.

use crate::support::{Folder, Run};
use std::fmt::Write as _;
use std::fs;
use std::process::Command;

/// Runs the program with at most so many KiB of addresses.
fn run(folder: &Folder, kib: u32, line: &str) -> Run {
    let halflight = env!("CARGO_BIN_EXE_halflight");
    let script = format!("ulimit -v {kib}; exec '{halflight}' {line}");
    Command::new("sh").args(["-c", &script]).current_dir(folder.path("")).output().unwrap().into()
}

#[test]
fn pixels_that_do_not_fit_are_refused() {
    let folder = Folder::new();
    fs::write(folder.path("out.exr"), "an older picture").unwrap();
    let line = "render scene.xml --threads 1 --width 6000 --height 4000 --spp 1 -o out.exr";
    let refused = run(&folder, 1_000_000, line);
    refused.assert_refusal(line);
    assert!(refused.stderr.contains("6000×4000 pixels need about"), "{refused:?}");
    assert_eq!(folder.bytes("out.exr"), b"an older picture");
    assert_eq!(folder.names(), ["out.exr", "scene.xml"]);
    // A part of it fits.
    let line = line.replace("out.exr", "out.part --part 64/64 --quiet");
    let part = run(&folder, 1_000_000, &line);
    assert_eq!(part.code, Some(0), "{part:?}");
}

/// A grid of triangles as a text file.
fn grid(side: usize) -> String {
    let mut obj = String::new();
    for (x, y) in (0..side).flat_map(|x| (0..side).map(move |y| (x, y))) {
        let _ = writeln!(obj, "v {x} {y} {}", x * y % 7);
    }
    for (x, y) in (1..side).flat_map(|x| (1..side).map(move |y| (x, y))) {
        let at = |x: usize, y: usize| x * side + y + 1;
        let corners = (at(x - 1, y - 1), at(x, y - 1), at(x, y), at(x - 1, y));
        let _ = writeln!(obj, "f {} {} {} {}", corners.0, corners.1, corners.2, corners.3);
    }
    obj
}

#[test]
fn a_mesh_and_a_tree_that_do_not_fit_are_refused() {
    let xml = r#"<scene version="3.0.0"><emitter type="constant"/>
        <shape type="obj"><string name="filename" value="grid.obj"/></shape></scene>"#;
    let folder = Folder::with_scene(xml);
    fs::write(folder.path("grid.obj"), grid(700)).unwrap();
    let line = "render scene.xml --threads 1 --width 8 --height 8 --spp 1 -o out.png --quiet";
    let whole = run(&folder, 1_000_000, line);
    assert_eq!(whole.code, Some(0), "{whole:?}");
    fs::remove_file(folder.path("out.png")).unwrap();
    // Above what the program and a thread take (100 MiB), and below what it comes to with the tree.
    let refused = run(&folder, 230_000, line);
    assert_eq!(refused.code, Some(2), "{refused:?}");
    assert!(refused.stderr.contains("the tree over 977 202 triangles needs about 136 MiB"), "{refused:?}");
    assert_eq!(folder.names(), ["grid.obj", "scene.xml"]);
}

/// A limit that happens to be reached in the middle may end the process, but leaves no torn file.
#[test]
fn whatever_the_limit_a_picture_is_whole_or_not_there() {
    let folder = Folder::new();
    let line = "render scene.xml --threads 2 --width 600 --height 400 --spp 1 -o out.png --quiet";
    folder.good(line);
    let whole = folder.bytes("out.png");
    let mut refused = 0;
    for kib in (16_000..160_000).step_by(8000) {
        fs::remove_file(folder.path("out.png")).unwrap_or_default();
        let run = run(&folder, kib, line);
        match run.code {
            Some(0) => assert!(folder.bytes("out.png") == whole, "{kib} KiB"),
            // The loader of the program itself says 127.
            Some(2 | 127) => {
                refused += 1;
                assert_eq!(folder.names(), ["scene.xml"], "{kib} KiB: {run:?}");
            }
            _ => assert!(!folder.path("out.png").exists(), "{kib} KiB: {run:?}"),
        }
    }
    assert!(refused > 0, "no limit was felt");
}
