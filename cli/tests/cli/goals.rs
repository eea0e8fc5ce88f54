//! Asking for an error or a time.

use crate::support::{Folder, SCENE};
use serde_json::Value;
use std::time::Instant;

/// Runs a render with --json; returns its code and what it printed.
fn render(folder: &Folder, arguments: &str) -> (Option<i32>, Value) {
    let run = folder.run(&format!("render scene.xml -o out.exr --json {arguments}"));
    let json = serde_json::from_str(&run.stdout).unwrap_or_else(|e| panic!("{arguments}: {e}: {run:?}"));
    (run.code, json)
}

fn number(json: &Value, key: &str) -> f64 {
    json[key].as_f64().unwrap_or_else(|| panic!("{key}: {json}"))
}

/// relMSE of one picture against another.
fn relmse(folder: &Folder, a: &str, b: &str) -> f64 {
    let json = folder.good(&format!("compare {a} {b} --json"));
    number(&serde_json::from_str(&json).unwrap(), "relmse")
}

#[test]
fn the_error_is_what_was_asked_for() {
    let folder = Folder::new();
    for seed in [1001, 1002] {
        folder.good(&format!("render scene.xml -o {seed}.exr --width 96 --spp 2048 --seed {seed} --quiet"));
    }
    let between = relmse(&folder, "1001.exr", "1002.exr");
    let mut held = 0;
    // A coarser target is met by the fewest samples, and outdone.
    for (percent, adaptive) in [(1.0, "on"), (1.0, "off")] {
        for seed in 0..4 {
            let goal = format!("--width 96 --error {percent} --adaptive {adaptive} --seed {seed}");
            let (code, json) = render(&folder, &goal);
            assert_eq!(code, Some(0), "{goal}");
            // The noise of the references drops out of this product.
            let product = relmse(&folder, "out.exr", "1001.exr") + relmse(&folder, "out.exr", "1002.exr");
            let ratio = 100.0 / percent * (0.5 * (product - between)).sqrt();
            assert!((0.5..1.1).contains(&ratio), "{goal}: {ratio} {json}");
            // Without adaption all pixels are refined at once: the last step may divide the error by √8.
            let least = if adaptive == "on" { 0.5 } else { 0.35 };
            let estimate = 100.0 / percent * number(&json, "relative_error");
            assert!((least..=1.0 + 1e-6).contains(&estimate), "{goal}: {estimate}");
            let interval = 100.0 / percent * number(&json, "relative_error_interval");
            held += u32::from((ratio - estimate).abs() <= interval);
        }
    }
    assert!(held >= 6, "the intervals held {held} of 8 true errors");
}

#[test]
fn samples_go_where_the_error_is_and_save_some() {
    let folder = Folder::new();
    let mean = |adaptive: &str| {
        let line = format!("render cornell -o out.exr --json --width 64 --error 1 --adaptive {adaptive}");
        let json: Value = serde_json::from_str(&folder.good(&line)).unwrap();
        assert_eq!(json["adaptive"], adaptive == "on");
        number(&json["samples_per_pixel"], "mean")
    };
    assert!(mean("on") < 0.7 * mean("off"));
}

#[test]
fn a_lamp_much_smaller_than_a_pixel_is_not_missed() {
    // It covers a hundredth of a pixel, and is all that is to be seen of it.
    let (place, size) = (
        "3, 4, 1\"/>\n        <float name=\"radius\" value=\"0.5",
        "1.2, 1.6, 0\"/>\n        <float name=\"radius\" value=\"0.01",
    );
    let scene = SCENE.replace(place, size).replace("20, 20, 20", "50000, 50000, 50000");
    let folder = Folder::with_scene(&scene);
    let brightest = |goal: &str| {
        folder.good(&format!("render scene.xml -o out.exr --quiet {goal}"));
        let picture = image::open(folder.path("out.exr")).unwrap().to_rgb32f();
        picture.pixels().map(|p| p.0[0]).fold(0.0, f32::max)
    };
    let truth = brightest("--spp 8192");
    assert!(truth > 100.0, "{truth}");
    for seed in 0..4 {
        let found = brightest(&format!("--error 2 --seed {seed}"));
        assert!((0.5..1.5).contains(&(found / truth)), "{found} {truth}");
    }
}

#[test]
fn more_samples_than_fit_sixteen_bits_go_on_converging() {
    let folder = Folder::new();
    let render = |name: &str, seed: u32| {
        let goal = format!("--error 0.005 --max-spp 1000000 --seed {seed}");
        let json = folder.good(&format!("render scene.xml -o {name} --width 6 --json {goal}"));
        let json: Value = serde_json::from_str(&json).unwrap();
        assert!(number(&json["samples_per_pixel"], "max") > 65_536.0, "{json}");
    };
    render("a.exr", 0);
    render("b.exr", 1);
    // The two are as far apart as the errors of both, if they are independent; so few pixels may be a good deal
    // better than what is asked for, since samples are doubled.
    let ratio = (0.5 * relmse(&folder, "a.exr", "b.exr")).sqrt() / 5e-5;
    assert!((0.2..1.3).contains(&ratio), "{ratio}");
}

#[test]
fn any_number_of_threads_and_any_window_of_whole_tiles_gives_the_same_bits() {
    let folder = Folder::new();
    let picture = |arguments: &str| {
        render(&folder, &format!("--width 96 --height 64 --error 2 {arguments}"));
        image::open(folder.path("out.exr")).unwrap().to_rgb32f()
    };
    let whole = picture("--threads 1");
    assert_eq!(picture("--threads 5"), whole);
    let part = picture("--crop 32,32,96,64");
    let inside = |x, y| x >= 32 && y >= 32;
    assert!(part.enumerate_pixels().all(|(x, y, p)| !inside(x, y) || p == whole.get_pixel(x, y)));
}

#[test]
fn what_misses_its_share_is_counted() {
    let folder = Folder::new();
    for adaptive in ["on", "off"] {
        let line = format!("--error 0.5 --max-spp 16 --adaptive {adaptive}");
        let (code, json) = render(&folder, &line);
        assert_eq!(code, Some(1), "{json}");
        assert!((1.0..=24.0 * 16.0).contains(&number(&json, "missed_pixels")), "{json}");
        assert!(json["warnings"][0].as_str().unwrap().contains("did not reach 0.50 % with 16 samples each"));
        assert_eq!(json["samples_per_pixel"]["max"], 16);
        assert!(folder.names().contains(&"out.exr".to_owned()), "the picture is written all the same");
    }
}

#[test]
fn the_time_is_used() {
    let folder = Folder::new();
    for adaptive in ["on", "off"] {
        let start = Instant::now();
        let (code, json) = render(&folder, &format!("--width 480 --time 2 --adaptive {adaptive}"));
        let seconds = start.elapsed().as_secs_f64();
        // On a busy machine the program may be held up; it does not end early.
        assert!((1.9..4.0).contains(&seconds), "{adaptive}: {seconds} s {json}");
        assert_eq!(code, Some(0));
    }
}

#[test]
fn goals_that_contradict_each_other_are_refused() {
    let folder = Folder::new();
    for goals in ["--spp 4 --error 1", "--spp 4 --time 1", "--error 1 --time 1"] {
        assert!(folder.refused(&format!("render scene.xml {goals}")).contains("cannot be used with"));
    }
    for flag in ["--max-spp 4", "--adaptive on"] {
        let message = folder.refused(&format!("render scene.xml {flag}"));
        assert!(message.contains(&flag.replace(" 4", "")), "{message}");
        assert!(message.contains("use it with --error or --time"), "{message}");
    }
    for goal in ["--error 0", "--error -1", "--error nan", "--time 0", "--time x", "--max-spp 0 --error 1"] {
        folder.refused(&format!("render scene.xml {goal}"));
    }
}
