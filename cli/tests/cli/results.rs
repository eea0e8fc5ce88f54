//! What is printed when all is well.

use crate::support::Folder;
use serde_json::Value;

/// Runs a command with --json.
fn json(folder: &Folder, line: &str) -> Value {
    serde_json::from_str(&folder.good(line)).unwrap_or_else(|e| panic!("{line}: {e}"))
}

#[test]
fn the_summary_is_one_line() {
    let line = Folder::new().good("render scene.xml -o out.png");
    assert!(line.starts_with("out.png  24×16  4 samples/pixel  0 triangles  1 light  "), "{line}");
    assert!(line.contains(" samples/s  error ") && line.contains(" % ± "), "{line}");
    assert!(line.contains("  half the error: ") && line.ends_with("× the time\n"), "{line}");
    assert_eq!(line.lines().count(), 1);
}

#[test]
fn quiet_is_quiet() {
    let run = Folder::new().run("render scene.xml -o out.png --quiet");
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (Some(0), "", ""));
}

#[test]
fn no_progress_where_there_is_no_terminal() {
    assert_eq!(Folder::new().run("render scene.xml -o out.png").stderr, "");
}

#[test]
fn a_render_in_json() {
    let render = json(&Folder::new(), "render scene.xml -o out.png --spp 5 --seed 3 --threads 2 --json");
    assert_eq!(render["file"], "out.png");
    assert_eq!((&render["width"], &render["height"]), (&24.into(), &16.into()));
    assert_eq!(render["samples_per_pixel"], serde_json::json!({ "min": 5, "mean": 5.0, "max": 5 }));
    assert_eq!(render["samples"], 24 * 16 * 5);
    assert_eq!((&render["seed"], &render["threads"]), (&3.into(), &2.into()));
    assert!(render["relative_error"].as_f64().is_some_and(|e| e > 0.0), "{render}");
    assert_eq!(render["rejected_samples"], 0);
    assert_eq!(render["interrupted"], false);
}

#[test]
fn flags_override_what_the_scene_says() {
    let folder = Folder::new();
    let line = |arguments: &str| folder.good(&format!("render scene.xml -o out.png {arguments}"));
    assert!(line("-D spp=2").contains("  2 samples/pixel  "));
    assert!(line("-D spp=2 --spp 3").contains("  3 samples/pixel  "));
    assert!(line("--width 48").contains("  48×32  "));
    assert!(line("--height 8").contains("  12×8  "));
    assert!(line("--width 10 --height 10").contains("  10×10  "));
}

#[test]
fn every_choice_renders() {
    let folder = Folder::new();
    for choice in [
        "--lights area",
        "--lights solid-angle",
        "--technique light",
        "--technique bsdf --bsdf-samples 2",
        "--technique mis --heuristic balance --light-samples 2",
        "--technique occlusion --occlusion-distance 2",
        "--choose all",
        "--choose uniform",
        "--choose power",
        "--choose tree",
        "--sequence random",
    ] {
        let render = json(&folder, &format!("render scene.xml -o out.hdr --json {choice}"));
        for pair in choice.split("--").skip(1) {
            let (flag, value) = pair.trim().split_once(' ').unwrap();
            assert_eq!(render["choices"][flag], value, "{choice}");
        }
    }
}

#[test]
fn exposure_brightens_png_and_nothing_else() {
    let folder = Folder::new();
    folder.good("render scene.xml -o a.png --exposure -2");
    folder.good("render scene.xml -o b.png");
    let mean = |name| {
        let picture = image::open(folder.path(name)).unwrap().to_rgb8();
        picture.pixels().map(|p| u64::from(p.0[1])).sum::<u64>()
    };
    assert!(mean("a.png") < mean("b.png"));
    let run = folder.run("render scene.xml -o a.exr --exposure 1");
    assert_eq!(run.code, Some(0));
    assert!(run.stderr.starts_with("warning: --exposure has no effect"), "{run:?}");
    folder.good("render scene.xml -o b.exr");
    assert_eq!(folder.bytes("a.exr"), folder.bytes("b.exr"));
}

#[test]
fn a_view_changes_what_is_shown_and_nothing_else() {
    let folder = Folder::new();
    let mut seen = Vec::new();
    for view in ["standard", "agx", "aces", "khronos-neutral", "none"] {
        folder.good(&format!("render scene.xml -o out.png --view {view}"));
        seen.push(folder.bytes("out.png"));
    }
    folder.good("render scene.xml -o out.png");
    assert_eq!(seen[0], folder.bytes("out.png"), "standard is the default");
    for (i, j) in (0..seen.len()).flat_map(|i| (0..i).map(move |j| (i, j))) {
        assert_ne!(seen[i], seen[j], "views {i} and {j}");
    }
    let run = folder.run("render scene.xml -o a.hdr --view agx");
    assert!(run.stderr.starts_with("warning: --view has no effect on a.hdr"), "{run:?}");
    folder.good("render scene.xml -o b.hdr");
    assert_eq!(folder.bytes("a.hdr"), folder.bytes("b.hdr"));
}

#[test]
fn colours_are_for_terminals_unless_they_are_asked_for() {
    let folder = Folder::new();
    let error = |more: &str| folder.run(&format!("render missing.xml {more}")).stderr;
    assert!(!error("").contains('\u{1b}') && !error("--color never").contains('\u{1b}'));
    assert!(error("--color always").starts_with("\u{1b}["), "{}", error("--color always"));
    let mut command = folder.command("render missing.xml");
    let forbidden = command.env("NO_COLOR", "1").env("CLICOLOR_FORCE", "0").output().unwrap();
    assert!(!forbidden.stderr.contains(&0x1b));
}

#[test]
fn every_format_holds_the_picture() {
    let folder = Folder::new();
    for (name, more) in [("a.jpg", "--quality 100"), ("a.pfm", ""), ("a.png", "--depth 16"), ("a.exr", "")] {
        let run = folder.run(&format!("render scene.xml -o {name} {more}"));
        assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{name}");
    }
    folder.good("compare a.pfm a.exr --max-relmse 0");
    let decibels = |line: &str| json(&folder, line)["psnr"].as_f64().unwrap();
    assert!(decibels("compare a.png a.exr --json") > 90.0, "16 bits");
    assert!(decibels("compare a.jpg a.exr --json") > 40.0);
    let warned = folder.run("render scene.xml -o b.jpg --depth 16").stderr;
    assert!(warned.contains("--depth has no effect on b.jpg"), "{warned}");
    let refused = folder.refused("render scene.xml -o a.jpg --width 65536 --height 1");
    assert!(refused.contains("at most 65535"), "{refused}");
}

#[test]
fn a_spare_command_line_renders_the_first_scene() {
    // Only that it is the same as naming it: the whole picture takes long.
    let folder = Folder::new();
    let render = json(&folder, "render --width 16 --spp 1 --json");
    assert_eq!((&render["file"], &render["scene"]), (&"halflight.png".into(), &"still-life".into()));
    assert_eq!(render["relative_error"], Value::Null, "one sample says nothing of its error");
    let inspected = json(&folder, "inspect --json");
    assert_eq!(inspected["film"]["width"], 960);
    assert_eq!(inspected["film"]["height"], 640);
}

#[test]
fn scenes_are_listed_and_render() {
    let folder = Folder::new();
    let scenes = json(&folder, "scenes --json");
    let text = folder.good("scenes");
    for scene in scenes.as_array().unwrap() {
        let name = scene["name"].as_str().unwrap();
        assert!(text.lines().any(|l| l.starts_with(name) && l.ends_with(scene["about"].as_str().unwrap())));
        folder.good(&format!("render {name} -o out.png --width 16 --spp 1 --quiet"));
    }
}

#[test]
fn a_scene_is_inspected() {
    let folder = Folder::new();
    let scene = json(&folder, "inspect scene.xml --json");
    assert_eq!(scene["surfaces"], serde_json::json!({ "rectangle": 1, "sphere": 2 }));
    assert_eq!(scene["lights"], serde_json::json!({ "sphere": 1 }));
    assert_eq!(scene["samples_per_pixel"], 4);
    let text = folder.good("inspect scene.xml");
    for word in ["2 spheres, 1 rectangle", "24×16", "perspective, 40°", "stack ", "--technique auto"] {
        assert!(text.contains(word), "{word}: {text}");
    }
}

#[test]
fn an_exported_scene_renders_to_the_same_picture() {
    let folder = Folder::new();
    assert_eq!(folder.good("export cornell"), "cornell.xml\n");
    folder.good("render cornell -o a.exr --width 32 --spp 4 --quiet");
    folder.good("render cornell.xml -o b.exr --width 32 --spp 4 --quiet");
    folder.good("compare b.exr a.exr --max-relmse 1e-4");
}

#[test]
fn a_preview_is_shown_on_a_terminal_or_when_forced() {
    let folder = Folder::new();
    let run = folder.run("render scene.xml -o a.png --preview");
    assert_eq!((run.code, run.stdout.lines().count()), (Some(0), 1), "{run:?}");
    assert!(run.stderr.contains("--preview has no effect"), "{run:?}");
    for (how, mark) in [("blocks", "▀"), ("kitty", "\u{1b}_Ga=T"), ("sixel", "\u{1b}Pq")] {
        let shown = folder.good(&format!("render scene.xml -o b.png --preview={how} --error 5"));
        assert!(shown.contains(mark), "{how}: {shown:?}");
    }
    folder.good("render scene.xml -o b.png --preview=blocks");
    assert_eq!(folder.bytes("a.png"), folder.bytes("b.png"));
}
