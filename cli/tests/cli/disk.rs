//! Disks that are full, and output that goes nowhere.

use crate::support::Folder;
#[cfg(unix)]
use crate::support::{Run, not_run};
use std::fs;

#[cfg(unix)]
#[test]
fn a_file_that_outgrows_its_limit_leaves_the_old_one() {
    let folder = Folder::new();
    fs::write(folder.path("out.exr"), "an older picture").unwrap();
    // One block per file, and an error in place of the signal that would end the process.
    let halflight = env!("CARGO_BIN_EXE_halflight");
    let script = format!("trap '' XFSZ; ulimit -f 1; exec '{halflight}' render scene.xml -o out.exr --quiet");
    let run: Run = std::process::Command::new("sh")
        .args(["-c", &script])
        .current_dir(folder.path(""))
        .output()
        .unwrap()
        .into();
    run.assert_refusal(&script);
    assert!(run.stderr.contains("cannot write out.exr"), "{run:?}");
    assert_eq!(folder.bytes("out.exr"), b"an older picture");
    assert_eq!(folder.names(), ["out.exr", "scene.xml"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_the_old_file() {
    let folder = Folder::new();
    fs::create_dir(folder.path("disk")).unwrap();
    let disk = folder.path("disk");
    let mounted = std::process::Command::new("mount")
        .args(["-t", "tmpfs", "-o", "size=16k", "tmpfs"])
        .arg(&disk)
        .output()
        .is_ok_and(|o| o.status.success());
    if !mounted {
        not_run("a_full_disk_leaves_the_old_file", "a small disk cannot be mounted here");
        return;
    }
    fs::write(disk.join("out.exr"), "an older picture").unwrap();
    let run = folder.run("render scene.xml -o disk/out.exr --quiet --width 120");
    let old = fs::read(disk.join("out.exr"));
    let names = fs::read_dir(&disk).unwrap().count();
    assert!(std::process::Command::new("umount").arg(&disk).status().unwrap().success());
    run.assert_refusal("on a full disk");
    assert!(run.stderr.contains("no space left"), "{run:?}");
    assert_eq!(old.unwrap(), b"an older picture");
    assert_eq!(names, 1, "a partial file is left");
}

/// Runs the program with files of a few kilobytes at most, and an error in place of the signal.
#[cfg(unix)]
fn cramped(folder: &Folder, line: &str) -> Run {
    let halflight = env!("CARGO_BIN_EXE_halflight");
    let script = format!("trap '' XFSZ; ulimit -f 8; exec '{halflight}' {line}");
    let mut sh = std::process::Command::new("sh");
    sh.args(["-c", &script]).current_dir(folder.path("")).output().unwrap().into()
}

#[cfg(unix)]
#[test]
fn a_part_that_finds_no_room_leaves_the_old_one() {
    let folder = Folder::new();
    fs::write(folder.path("1.part"), "an older part").unwrap();
    let line = "render scene.xml --part 1/2 --width 100 -o 1.part --quiet";
    let run = cramped(&folder, line);
    run.assert_refusal(line);
    assert!(run.stderr.contains("cannot write 1.part"), "{run:?}");
    assert_eq!(folder.bytes("1.part"), b"an older part");
    assert_eq!(folder.names(), ["1.part", "scene.xml"]);
}

#[cfg(unix)]
#[test]
fn a_merged_picture_that_finds_no_room_leaves_parts_and_the_old_one() {
    let folder = Folder::new();
    for i in [1, 2] {
        folder.good(&format!("render scene.xml --part {i}/2 --width 100 -o {i}.part --quiet"));
    }
    let parts = [folder.bytes("1.part"), folder.bytes("2.part")];
    fs::write(folder.path("out.exr"), "an older picture").unwrap();
    let line = "merge 1.part 2.part -o out.exr";
    let run = cramped(&folder, line);
    run.assert_refusal(line);
    assert!(run.stderr.contains("cannot write out.exr"), "{run:?}");
    assert_eq!(folder.bytes("out.exr"), b"an older picture");
    assert_eq!([folder.bytes("1.part"), folder.bytes("2.part")], parts);
    assert_eq!(folder.names(), ["1.part", "2.part", "out.exr", "scene.xml"]);
}

#[cfg(unix)]
#[test]
fn a_checkpoint_that_finds_no_room_does_not_end_the_render() {
    let folder = Folder::new();
    let line = "render scene.xml -o out.png --width 24 --spp 4000 --quiet";
    folder.good(line);
    let undisturbed = folder.bytes("out.png");
    let run = cramped(&folder, &format!("{line} --checkpoint 0.001"));
    assert_eq!(run.code, Some(0), "{run:?}");
    assert!(run.stderr.contains("warning: cannot write out.png.checkpoint"), "{run:?}");
    assert!(folder.bytes("out.png") == undisturbed);
    assert_eq!(folder.names(), ["out.png", "scene.xml"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_is_no_place_for_a_picture() {
    let folder = Folder::new();
    std::os::unix::fs::symlink("/dev/full", folder.path("out.png")).unwrap();
    let message = folder.refused("render scene.xml -o out.png");
    assert!(message.contains("not a regular file"), "{message}");
}

#[cfg(target_os = "linux")]
#[test]
fn results_that_cannot_be_printed_are_an_error() {
    let folder = Folder::new();
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let run: Run = folder.command("scenes").stdout(full).output().unwrap().into();
    run.assert_refusal("scenes > /dev/full");
    assert!(run.stderr.contains("no space left"), "{run:?}");
}

#[test]
fn a_write_protected_picture_is_kept() {
    let folder = Folder::new();
    fs::write(folder.path("out.png"), "precious").unwrap();
    let mut permissions = fs::metadata(folder.path("out.png")).unwrap().permissions();
    permissions.set_readonly(true);
    fs::set_permissions(folder.path("out.png"), permissions).unwrap();
    assert!(folder.refused("render scene.xml -o out.png").contains("write-protected"));
}

#[test]
fn a_reader_that_goes_away_has_had_enough() {
    let folder = Folder::new();
    for line in ["scenes", "inspect scene.xml", "render scene.xml -o out.png", "render --help"] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = folder.command(line).stdout(writer).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{line}: {output:?}");
        assert!(output.stderr.is_empty(), "{line}: {output:?}");
    }
    assert_eq!(folder.names(), ["out.png", "scene.xml"]);
}
