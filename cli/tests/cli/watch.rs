//! `halflight render --watch`.

use crate::support::{EMITTER, Folder, SCENE};
use std::fs;
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A program that must not outlive its test.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = (self.0.kill(), self.0.wait());
    }
}

/// Waits for something to become true.
#[track_caller]
fn wait_for(what: &str, is_so: impl Fn() -> bool) {
    let start = Instant::now();
    while !is_so() {
        assert!(start.elapsed() < Duration::from_secs(60), "{what}: not within a minute");
        sleep(Duration::from_millis(20));
    }
}

#[test]
fn a_change_renders_again_and_an_error_is_waited_out() {
    let mesh = "<shape type=\"ply\"><string name=\"filename\" value=\"mesh.ply\"/></shape>\n</scene>";
    let folder = Folder::with_change("</scene>", mesh);
    let ply = |z: f32| {
        let head =
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
        let rest = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
        fs::write(folder.path("mesh.ply"), format!("{head}{rest}-1 0 {z}\n1 0 {z}\n0 2 {z}\n3 0 1 2\n"))
            .unwrap();
    };
    ply(0.5);
    let log = fs::File::create(folder.path("log")).unwrap();
    let mut command = folder.command("render scene.xml -o out.png --watch");
    let mut child = Running(command.stderr(log).spawn().unwrap());
    let said = |text: &str| String::from_utf8_lossy(&folder.bytes("log")).matches(text).count();
    wait_for("the first picture", || said("watching 2 files") == 1);
    let first = folder.bytes("out.png");
    ply(2.0);
    wait_for("the picture of another mesh", || said("watching 2 files") == 2);
    assert_ne!(folder.bytes("out.png"), first);
    let scene = fs::read_to_string(folder.path("scene.xml")).unwrap();
    fs::write(folder.path("scene.xml"), scene.replace(EMITTER, "")).unwrap();
    wait_for("the error", || said("error: ") == 1 && said("watching") == 3);
    fs::write(folder.path("scene.xml"), SCENE).unwrap();
    wait_for("the mended picture", || said("watching") == 4);
    let kill = format!("kill -INT {}", child.0.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
    assert_eq!(child.0.wait().unwrap().code(), Some(130));
    folder.good("render scene.xml -o alone.png");
    assert_eq!(folder.bytes("out.png"), folder.bytes("alone.png"));
}

#[test]
fn a_built_in_scene_is_no_file_to_watch() {
    let message = Folder::new().refused("render cornell --watch");
    assert!(message.contains("nothing to watch") && message.contains("halflight export"), "{message}");
}
