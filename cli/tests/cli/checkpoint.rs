//! Renders that are killed, and go on.

use crate::interrupt::begin;
use crate::support::{Folder, Run};
use std::fs;
use std::process::Command;
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A picture that takes some seconds.
const SIZE: &str = "--width 144 --height 96";

/// Milliseconds, different each time and the same in each run of the test.
struct Delays(u64);

impl Delays {
    fn below(&mut self, most: u64) -> Duration {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        Duration::from_micros((self.0 >> 33) % (most * 1000))
    }
}

/// Kills a render so many times, at random moments that come later and later, and lets it go on each time.
/// Whenever it comes to an end, the picture must be that of a render that nobody disturbed.
fn kill(times: u64, arguments: &str) {
    let folder = Folder::new();
    let line = format!("render scene.xml {SIZE} {arguments}");
    folder.good(&format!("{line} -o undisturbed.exr --quiet"));
    let expected = folder.bytes("undisturbed.exr");
    let line = format!("{line} -o out.exr --checkpoint 0.004");
    let (mut kills, mut resumed, mut delays, mut most) = (0, 0, Delays(times), 40);
    while kills < times {
        let mut child = folder.command(&line).spawn().unwrap();
        // Later where this machine is too busy to come to a first checkpoint.
        most += if folder.path("out.exr.checkpoint").exists() { 1 } else { 15 };
        sleep(delays.below(most));
        child.kill().unwrap();
        let run: Run = child.wait_with_output().unwrap().into();
        resumed += u32::from(run.stderr.contains("going on from the checkpoint"));
        if run.code.is_none() {
            kills += 1;
        } else {
            assert_eq!(run.code, Some(0), "{run:?}");
            assert!(folder.bytes("out.exr") == expected, "{arguments}, after {kills} kills");
            fs::remove_file(folder.path("out.exr")).unwrap();
        }
    }
    folder.good(&line);
    assert!(folder.bytes("out.exr") == expected, "{arguments}");
    assert!(resumed > 0, "{resumed} of {times} runs went on from a checkpoint");
    // A kill while it is tried whether a file can be made leaves that file, which is empty.
    let is_tried = |name: &String| name.starts_with(".halflight-");
    let names: Vec<_> = folder.names().into_iter().filter(|name| !is_tried(name)).collect();
    assert_eq!(names, ["out.exr", "scene.xml", "undisturbed.exr"]);
}

#[test]
fn killed_forty_times_a_picture_of_samples_is_the_same() {
    kill(40, "--spp 400");
}

#[test]
fn killed_forty_times_an_adaptive_picture_is_the_same() {
    kill(40, "--error 0.5 --max-spp 4096");
}

#[test]
fn killed_twenty_times_a_uniform_picture_of_an_error_is_the_same() {
    kill(20, "--error 0.8 --adaptive off --max-spp 4096 --layers");
}

/// Starts a render, waits until it has a checkpoint, and sends it a signal.
fn stopped(folder: &Folder, line: &str, checkpoint: &str, signal: &str) -> Run {
    let mut child = begin(folder, line);
    let start = Instant::now();
    while !folder.path(checkpoint).exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "there is never a checkpoint");
        assert!(child.try_wait().unwrap().is_none(), "it has ended");
        sleep(Duration::from_millis(2));
    }
    let kill = format!("kill -{signal} {}", child.id());
    assert!(Command::new("sh").args(["-c", &kill]).status().unwrap().success());
    child.wait_with_output().unwrap().into()
}

#[test]
fn a_render_that_is_asked_to_end_goes_on_to_the_same_bits() {
    for goal in ["--spp 300", "--error 0.6 --max-spp 4096"] {
        let folder = Folder::new();
        let line = format!("render scene.xml {SIZE} {goal}");
        folder.good(&format!("{line} -o undisturbed.exr"));
        let line = format!("{line} -o out.exr --checkpoint 0.01");
        for signal in ["TERM", "INT"] {
            let run = stopped(&folder, &line, "out.exr.checkpoint", signal);
            assert_eq!(run.code, Some(130), "{run:?}");
            assert!(run.stderr.contains("the same command goes on from its checkpoint"), "{run:?}");
        }
        folder.good(&line);
        assert!(folder.bytes("out.exr") == folder.bytes("undisturbed.exr"), "{goal}");
        assert!(!folder.names().iter().any(|name| name.contains("checkpoint")), "{:?}", folder.names());
    }
}

#[test]
fn a_killed_part_goes_on_and_an_unfinished_one_is_not_merged() {
    let folder = Folder::new();
    let line = format!("render scene.xml {SIZE} --spp 300");
    folder.good(&format!("{line} -o once.exr"));
    let part = format!("{line} --part 1/2 -o 1.part --checkpoint 0.01");
    let run = stopped(&folder, &part, "1.part.checkpoint", "TERM");
    assert_eq!((run.code, run.stdout.as_str()), (Some(130), ""), "{run:?}");
    assert!(run.stderr.contains("1.part was not written"), "{run:?}");
    assert!(!folder.path("1.part").exists());
    folder.good(&format!("{line} --part 2/2 -o 2.part"));
    let message = folder.refused("merge 1.part.checkpoint 2.part -o out.exr");
    assert!(message.contains("has not come to its end"), "{message}");
    let other = folder.refused(&part.replace("1/2", "2/2"));
    assert!(other.contains("it is of another part"), "{other}");
    folder.good(&part);
    folder.good("merge 1.part 2.part -o out.exr");
    assert!(folder.bytes("out.exr") == folder.bytes("once.exr"));
}

#[test]
fn checkpoints_that_cannot_be_used_are_refused() {
    let folder = Folder::new();
    let line = format!("render scene.xml {SIZE} --spp 3000 -o out.exr --checkpoint 0.01");
    stopped(&folder, &line, "out.exr.checkpoint", "KILL");
    let _ = fs::remove_file(folder.path("out.exr.checkpoint.unfinished"));
    let message = folder.refused(&line.replace("3000", "301"));
    assert!(message.contains("of another render: its spp is 3000, not 301"), "{message}");
    let message = folder.refused(&line.replace("--spp", "--seed 3 --spp"));
    assert!(message.contains("its seed is 0, not 3"), "{message}");
    let good = folder.bytes("out.exr.checkpoint");
    for (bytes, reason) in [
        (&good[..good.len() - 5], "out.exr.checkpoint is torn"),
        (&good[..30], "out.exr.checkpoint is torn"),
        (b"something else", "out.exr.checkpoint is no part or checkpoint"),
    ] {
        fs::write(folder.path("out.exr.checkpoint"), bytes).unwrap();
        let message = folder.refused(&line);
        assert!(message.contains(reason) && message.contains("it is not used"), "{message}");
    }
    let mut altered = good.clone();
    altered[good.len() / 2] ^= 0x10;
    fs::write(folder.path("out.exr.checkpoint"), altered).unwrap();
    assert!(folder.refused(&line).contains("is damaged"));
    let scene = fs::read_to_string(folder.path("scene.xml")).unwrap();
    fs::write(folder.path("out.exr.checkpoint"), good).unwrap();
    fs::write(folder.path("scene.xml"), scene.replace("0, 1, 0", "0, 1.001, 0")).unwrap();
    assert!(folder.refused(&line).contains("its scene is another"));
}
