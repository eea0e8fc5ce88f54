//! Whatever is wrong with what goes in: code 2, one clear message, nothing overwritten.

#[cfg(target_os = "linux")]
use crate::support::Run;
#[cfg(unix)]
use crate::support::not_run;
use crate::support::{EMITTER, Folder, SCENE};
use std::fs;

/// Renders a scene that must be refused over a picture that must survive; returns the message.
fn refused(folder: &Folder) -> String {
    fs::write(folder.path("out.png"), "an older picture").unwrap();
    folder.refused("render scene.xml -o out.png")
}

/// Refuses [`SCENE`] after a change, with a message that holds all of `words`.
fn refuses(from: &str, to: &str, words: &[&str]) {
    let message = refused(&Folder::with_change(from, to));
    for word in words {
        assert!(message.contains(word), "no \"{word}\" in {message}");
    }
}

#[test]
fn a_missing_file() {
    let message = Folder::new().refused("render missing.xml");
    assert!(message.contains("missing.xml") && message.contains("halflight scenes"), "{message}");
}

#[test]
fn a_built_in_scene_misspelt() {
    let message = Folder::new().refused("render still-live");
    assert!(message.contains("did you mean still-life?"), "{message}");
}

#[test]
fn a_folder_in_place_of_a_file() {
    let folder = Folder::new();
    fs::create_dir(folder.path("folder.xml")).unwrap();
    assert!(folder.refused("render folder.xml").contains("it is a folder"));
}

#[cfg(unix)]
#[test]
fn a_file_that_may_not_be_read() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new();
    fs::set_permissions(folder.path("scene.xml"), fs::Permissions::from_mode(0o000)).unwrap();
    if fs::read(folder.path("scene.xml")).is_ok() {
        not_run("a_file_that_may_not_be_read", "this user may read everything");
        return;
    }
    assert!(refused(&folder).contains("scene.xml"));
}

#[cfg(target_os = "linux")]
#[test]
fn a_file_that_cannot_be_read() {
    let folder = Folder::new();
    // Reading address 0 of any process is an input/output error, for any user.
    std::os::unix::fs::symlink("/proc/self/mem", folder.path("broken.xml")).unwrap();
    assert!(folder.refused("render broken.xml").contains("broken.xml"));
}

#[test]
fn a_file_that_is_no_text() {
    let folder = Folder::new();
    fs::write(folder.path("scene.xml"), [0xff, 0xfe, 0x00, 0x80]).unwrap();
    assert!(refused(&folder).contains("scene.xml"));
}

#[test]
fn an_empty_file() {
    assert!(refused(&Folder::with_scene("")).contains("scene.xml"));
}

#[test]
fn xml_that_is_cut_off() {
    let half = &SCENE[..SCENE.len() / 2];
    let message = refused(&Folder::with_scene(half));
    let place = format!("scene.xml:{}:", half.matches('\n').count() + 1);
    assert!(message.contains(&place) && message.contains("it ends here"), "{place}: {message}");
    assert!(message.contains("tip: write, export or copy the file anew"), "{message}");
}

#[test]
fn every_refusal_says_what_to_do() {
    let folder = Folder::new();
    fs::write(folder.path("scene.txt"), "").unwrap();
    fs::write(folder.path("empty.glb"), "").unwrap();
    fs::create_dir(folder.path("folder")).unwrap();
    for (line, tip) in [
        ("render scene.txt", "export the scene as .glb"),
        ("render empty.glb", "export or copy the file anew"),
        ("render nowhere/room.glb", "it is looked for from"),
        ("render https://example.org/room.glb", "download it first"),
        ("render room", "halflight scenes lists"),
        ("render scene.xml -o folder", "-o folder/NAME.png"),
        ("render scene.xml --spp 1e3", "a whole number from 1"),
        ("compare scene.xml scene.xml", "pictures can be"),
        ("compare folder nothing.png", "a picture that is there"),
    ] {
        let message = folder.refused(line);
        assert!(message.contains(tip), "{line}: {message}");
    }
}

#[test]
fn an_unknown_plugin() {
    refuses(
        "<shape type=\"rectangle\">",
        "<shape type=\"rectangel\">",
        &["scene.xml:18", "rectangel", "rectangle"],
    );
}

#[test]
fn an_unknown_plugin_left_out_on_request() {
    let folder = Folder::with_change("<shape type=\"rectangle\">", "<shape type=\"teapot\">");
    let run = folder.run("render scene.xml -o out.png --lenient");
    assert_eq!(run.code, Some(0), "{run:?}");
    assert!(run.stderr.starts_with("warning: ") && run.stderr.contains("scene.xml:18"), "{run:?}");
}

#[test]
fn a_number_that_is_none() {
    refuses("name=\"radius\" value=\"1\"", "name=\"radius\" value=\"nan\"", &["scene.xml:", "nan"]);
    refuses("name=\"radius\" value=\"1\"", "name=\"radius\" value=\"big\"", &["scene.xml:", "big"]);
    refuses("20, 20, 20", "20, inf, 20", &["scene.xml:"]);
}

#[test]
fn a_film_without_pixels() {
    refuses("name=\"width\" value=\"24\"", "name=\"width\" value=\"0\"", &["scene.xml:"]);
    refuses("name=\"height\" value=\"16\"", "name=\"height\" value=\"-16\"", &["scene.xml:"]);
}

#[test]
fn negative_emission() {
    refuses("20, 20, 20", "20, -1, 20", &["scene.xml:", "negative"]);
}

#[test]
fn a_degenerate_transform() {
    refuses("<scale value=\"10\"/>", "<scale value=\"0\"/>", &["scene.xml:"]);
}

#[test]
fn bad_meshes() {
    let mesh = "<shape type=\"ply\"><string name=\"filename\" value=\"mesh.ply\"/></shape>\n</scene>";
    let folder = Folder::with_change("</scene>", mesh);
    assert!(refused(&folder).contains("mesh.ply"), "a mesh that is missing");
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n";
    for text in ["", "not a mesh", header] {
        fs::write(folder.path("mesh.ply"), text).unwrap();
        assert!(refused(&folder).contains("mesh.ply"), "{text}");
    }
}

#[test]
fn a_picture_without_samples() {
    refuses("name=\"spp\" value=\"4\"", "name=\"spp\" value=\"0\"", &["scene.xml:14", "above 0"]);
}

#[test]
fn an_empty_scene() {
    assert!(refused(&Folder::with_scene("<scene version=\"3.0.0\"/>")).contains("empty"));
}

#[test]
fn a_scene_without_lights() {
    refuses(EMITTER, "", &["no lights", "--technique occlusion"]);
    refuses("20, 20, 20", "0, 0, 0", &["dark"]);
}

#[test]
fn occlusion_needs_no_light() {
    let folder = Folder::with_change(EMITTER, "");
    folder.good("render scene.xml -o out.png --technique occlusion");
    assert_eq!(folder.names(), ["out.png", "scene.xml"]);
}

#[test]
fn outputs_that_cannot_be() {
    let folder = Folder::new();
    for (line, words) in [
        ("-o missing/out.png", "the folder missing does not exist"),
        ("-o out.bmp", "unknown format .bmp"),
        ("-o out.tiff", "end the name in .png or .jpg"),
        ("-o out", "no extension"),
        ("-o .", "no extension"),
        ("-o scene.xml/out.png", "scene.xml"),
    ] {
        let message = folder.refused(&format!("render scene.xml {line}"));
        assert!(message.contains(words), "{line}: {message}");
    }
}

#[test]
fn values_that_make_no_sense() {
    let folder = Folder::new();
    for (line, word) in [
        ("--crop 0,0,100,100", "24×16"),
        ("--crop 5,5,5,9", "--crop"),
        ("--crop 1,2,3", "--crop"),
        ("--crop -1,0,2,2", "--crop"),
        ("--spp 0", "--spp"),
        ("--spp many", "--spp"),
        ("--width 0", "--width"),
        ("--height 100000", "--height"),
        ("--threads 0", "--threads"),
        ("--exposure nan", "--exposure"),
        ("--view film", "khronos-neutral"),
        ("--depth 12", "8, 16"),
        ("--quality 0", "--quality"),
        ("--seed -1", "--seed"),
        ("--technique guess", "--technique"),
        ("--technique bsdf --heuristic power", "--heuristic"),
        ("--technique light --bsdf-samples 2", "--bsdf-samples"),
        ("--technique occlusion --lights area", "--lights"),
        ("--occlusion-distance 1", "--occlusion-distance"),
        ("-D spp", "-D"),
        ("--frobnicate", "--frobnicate"),
    ] {
        let message = folder.refused(&format!("render scene.xml -o out.png {line}"));
        assert!(message.contains(word), "{line}: {message}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_film_that_memory_cannot_hold() {
    let folder = Folder::new();
    let halflight = env!("CARGO_BIN_EXE_halflight");
    let script = format!(
        "ulimit -v 4000000; exec '{halflight}' render scene.xml -o out.png --threads 1 --width 65536 --height 65536"
    );
    let run: Run = std::process::Command::new("sh")
        .args(["-c", &script])
        .current_dir(folder.path(""))
        .output()
        .unwrap()
        .into();
    run.assert_refusal(&script);
    assert!(run.stderr.contains("about 288 GiB of memory") && run.stderr.contains("--crop"), "{run:?}");
}

#[test]
fn the_output_is_checked_before_the_scene_is_read() {
    let message = Folder::new().refused("render missing.xml -o missing/out.png");
    assert!(message.contains("the folder missing"), "{message}");
}

#[test]
fn a_scene_in_place_of_a_command() {
    let message = Folder::new().refused("scene.xml");
    assert!(Folder::new().refused("cornell").contains("halflight render cornell"));
    assert!(message.contains("halflight render scene.xml"), "{message}");
}

#[test]
fn a_parameter_for_a_built_in_scene() {
    assert!(Folder::new().refused("render cornell -D spp=4").contains("no parameter \"spp\""));
}

#[test]
fn an_export_over_the_scene_itself() {
    assert!(Folder::new().refused("export scene.xml").contains("is the scene itself"));
}

#[test]
fn an_export_to_something_else_than_xml() {
    assert!(Folder::new().refused("export cornell -o scene.json").contains(".xml"));
}
