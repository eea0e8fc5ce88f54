//! Ctrl-C.

use crate::support::{Folder, Run};
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Starts a render and waits until it listens for Ctrl-C.
pub(crate) fn begin(folder: &Folder, line: &str) -> Child {
    let mut child = folder.command(line).spawn().unwrap();
    let start = Instant::now();
    while !listens(child.id()) {
        assert!(start.elapsed() < Duration::from_secs(60), "it never begins to render");
        assert!(child.try_wait().unwrap().is_none(), "it has ended");
        sleep(Duration::from_millis(10));
    }
    child
}

/// True when the process has a handler for SIGINT, as the kernel tells.
#[cfg(target_os = "linux")]
fn listens(pid: u32) -> bool {
    const SIGINT: u64 = 1 << 1;
    let status = std::fs::read_to_string(format!("/proc/{pid}/status")).unwrap_or_default();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
    caught.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).is_some_and(|mask| mask & SIGINT != 0)
}

/// Elsewhere nobody tells; the scene is small.
#[cfg(not(target_os = "linux"))]
fn listens(_: u32) -> bool {
    sleep(Duration::from_secs(2));
    true
}

/// Sends SIGINT, as Ctrl-C does.
fn interrupt(child: &Child) {
    let kill = format!("kill -INT {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
}

/// Waits for the end.
fn end(child: Child) -> Run {
    child.wait_with_output().unwrap().into()
}

#[test]
fn ctrl_c_saves_what_there_is() {
    let folder = Folder::new();
    let child = begin(&folder, "render scene.xml -o out.exr --width 96 --spp 1000000000");
    sleep(Duration::from_millis(300));
    interrupt(&child);
    let run = end(child);
    assert_eq!(run.code, Some(130), "{run:?}");
    assert!(run.stderr.contains("interrupted: out.exr holds") && run.stderr.contains("/pixel"), "{run:?}");
    assert_eq!(folder.names(), ["out.exr", "scene.xml"]);
    let picture = image::open(folder.path("out.exr")).unwrap().to_rgb32f();
    assert_eq!(picture.dimensions(), (96, 64));
    assert!(picture.get_pixel(5, 60).0.iter().all(|v| *v > 0.0), "every pixel has a sample");
}

#[test]
fn without_arguments_the_first_scene_is_rendered() {
    let folder = Folder::new();
    // All its samples would take a while; the first of each pixel shows as much.
    let child = begin(&folder, "");
    interrupt(&child);
    let run = end(child);
    assert_eq!(run.code, Some(130), "{run:?}");
    assert!(run.stdout.starts_with("halflight.png  960×640  "), "{run:?}");
    assert_eq!(folder.names(), ["halflight.png", "scene.xml"]);
    assert_eq!(image::image_dimensions(folder.path("halflight.png")).unwrap(), (960, 640));
}

#[test]
fn a_second_ctrl_c_ends_it_at_once() {
    let folder = Folder::new();
    // The first sample of each pixel is taken in any case: here that takes a while.
    let line = "render scene.xml -o out.exr --width 2400 --light-samples 100";
    let child = begin(&folder, line);
    interrupt(&child);
    sleep(Duration::from_millis(100));
    interrupt(&child);
    let run = end(child);
    assert_eq!(run.code, Some(130), "{run:?}");
    assert_eq!(folder.names(), ["scene.xml"], "neither picture nor partial file");
}
