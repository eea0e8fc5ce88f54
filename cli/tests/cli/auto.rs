//! `auto` against the other choices on every built-in scene, without a clock: relMSE at equal samples times
//! what a sample costs, as it was measured once and is kept in `costs.txt`.

use crate::support::Folder;
use serde_json::Value;
use std::fmt::Write;

/// How much better than `auto` a choice may be.
pub(crate) const FACTOR: f64 = 1.5;

/// For each scene and choice, the CPU time of a sample over that with `auto`; without the choices that are
/// hopeless.
const COSTS: &str = include_str!("costs.txt");

/// Less efficient than this is hopeless.
const HOPELESS: f64 = 0.3;

/// Samples per pixel, of the reference and of what it judges.
const REFERENCE: u32 = 512;
const SAMPLES: u32 = 16;

/// Seeds of what is judged.
const SEEDS: [u32; 2] = [0, 1];

/// Share of the pixels that are left out, those with the largest errors: at the edges of lamps one sample
/// decides, and the seed tells more than the choice.
const OUTLIERS: f64 = 0.01;

/// A choice of `costs.txt`.
struct Choice {
    flags: String,
    cost: f64,
}

/// The choices that are kept for a scene.
fn choices(scene: &str) -> Vec<Choice> {
    let lines = COSTS.lines().filter(|line| !line.starts_with('#'));
    let words = lines.map(|line| line.split_whitespace().collect::<Vec<_>>());
    let of_scene = words.filter(|words| words[0] == scene);
    let choice = |words: Vec<&str>| {
        let [_, flag, value, cost] = words[..] else { panic!("costs.txt: {words:?}") };
        Choice { flags: format!("--{flag} {value}"), cost: cost.parse().unwrap() }
    };
    of_scene.map(choice).collect()
}

/// The channels of a rendered picture.
fn rendered(folder: &Folder, scene: &str, samples: u32, seed: u32, flags: &str) -> Vec<f64> {
    let goal = format!("--width 48 --spp {samples} --seed {seed}");
    folder.good(&format!("render {scene} {goal} {flags} --threads 1 --quiet -o out.pfm"));
    let bytes = folder.bytes("out.pfm");
    let (values, _) = bytes[bytes.len() - 48 * 12 * rows(&bytes)..].as_chunks::<4>();
    values.iter().map(|v| f64::from(f32::from_le_bytes(*v))).collect()
}

/// Rows of a PFM file, by its second line.
fn rows(bytes: &[u8]) -> usize {
    let size = bytes.split(|b| *b == b'\n').nth(1).unwrap();
    std::str::from_utf8(size).unwrap().split(' ').nth(1).unwrap().parse().unwrap()
}

/// relMSE of a picture without the outliers.
fn relmse(picture: &[f64], reference: &[f64]) -> f64 {
    let square = |(p, r): (&f64, &f64)| (p - r).powi(2) / (r * r + 0.01);
    let squares: Vec<_> = picture.iter().zip(reference).map(square).collect();
    let mut pixels: Vec<f64> = squares.chunks(3).map(|c| c.iter().sum::<f64>() / 3.0).collect();
    pixels.sort_by(f64::total_cmp);
    pixels.truncate((pixels.len() as f64 * (1.0 - OUTLIERS)) as usize);
    pixels.iter().sum::<f64>() / pixels.len() as f64
}

/// Every choice is at most [`FACTOR`] times as efficient as `auto`.
fn check(scene: &str) {
    let folder = Folder::new();
    let reference = rendered(&folder, scene, REFERENCE, 99, "--sequence sobol");
    let error = |flags: &str| -> f64 {
        SEEDS.iter().map(|s| relmse(&rendered(&folder, scene, SAMPLES, *s, flags), &reference)).sum()
    };
    let auto = error("");
    for Choice { flags, cost } in choices(scene) {
        let gain = auto / (error(&flags) * cost);
        eprintln!("{scene}: {flags} {gain:.2}");
        assert!(gain < FACTOR, "{scene}: {flags} is {gain:.2} times as efficient as auto");
    }
}

/// A test for each scene.
macro_rules! each_scene {
    ($($test:ident: $scene:literal,)*) => {
        const SCENES: &[&str] = &[$($scene),*];
        $(
            #[test]
            fn $test() {
                check($scene);
            }
        )*
    };
}

each_scene! {
    auto_is_nearly_the_best_in_still_life: "still-life",
    auto_is_nearly_the_best_in_penumbra: "penumbra",
    auto_is_nearly_the_best_in_colours: "colours",
    auto_is_nearly_the_best_in_sky: "sky",
    auto_is_nearly_the_best_in_morning: "morning",
    auto_is_nearly_the_best_in_gallery: "gallery",
    auto_is_nearly_the_best_in_lanterns: "lanterns",
    auto_is_nearly_the_best_in_contact: "contact",
    auto_is_nearly_the_best_in_plates: "plates",
    auto_is_nearly_the_best_in_cornell: "cornell",
}

#[test]
fn no_built_in_scene_is_left_out() {
    let scenes: Value = serde_json::from_str(&Folder::new().good("scenes --json")).unwrap();
    let names: Vec<_> = scenes.as_array().unwrap().iter().map(|s| s["name"].as_str().unwrap()).collect();
    assert_eq!(names, SCENES);
    assert!(SCENES.iter().all(|scene| choices(scene).len() > 3));
}

/// The lines of `costs.txt` for what `tradeoff` has measured in a scene.
pub(crate) fn lines_of_costs(scene: &str, measured: &Value) -> String {
    let choices = measured["choices"].as_array().unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    let seconds = |choice: &Value| {
        let last = choice["rungs"].as_array().unwrap().last().unwrap();
        number(&last["cpu_seconds"]) / number(&last["samples_per_pixel"])
    };
    let (auto, others) = choices.split_first().unwrap();
    let is_uniform = |choice: &&Value| choice["choice"] != "adaptive on";
    let hopeful = |choice: &&Value| number(&choice["efficiency"]) > HOPELESS;
    let mut lines = String::new();
    for choice in others.iter().filter(is_uniform).filter(hopeful) {
        let (name, cost) = (choice["choice"].as_str().unwrap(), seconds(choice) / seconds(auto));
        writeln!(lines, "{scene} {name} {cost:.2}").unwrap();
    }
    lines
}
