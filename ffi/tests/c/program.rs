//! A program in C gets the numbers that the core has.

use crate::{Buffer, cornell, stored};
use halflight::choose::LightChoice;
use halflight::estimate::{Direct, Job, PixelStats, Probe};
use halflight::film::PixelRect;
use halflight::geom::Ray;
use halflight::glam::Vec3;
use halflight::light::SurfaceDensity;
use halflight::sequence::Sobol;
use halflight::shape::SurfacePoint;
use halflight::stored::{NO_LIGHT, NO_MATERIAL, StoredScene};
use halflight::{Film, Rgb};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::Command;

const SYSTEM: [&str; 4] = ["-lpthread", "-ldl", "-lm", "-lgcc_s"];

/// The library, which cargo puts beside the tests or one folder above.
fn library() -> PathBuf {
    let here = std::env::current_exe().expect("a path");
    let folders = here.ancestors().skip(1).take(2);
    let files = folders.map(|folder| folder.join("libhalflight_ffi.a"));
    files.into_iter().find(|file| file.exists()).expect("the static library")
}

/// What the program prints of a scene; `None` where there is no C compiler.
fn printed(bytes: &[u8]) -> Option<String> {
    let folder = tempfile::tempdir().expect("a folder");
    let (scene, program) = (folder.path().join("scene.bin"), folder.path().join("embed"));
    std::fs::write(&scene, bytes).expect("a file");
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let compiler = std::env::var_os("CC").unwrap_or("cc".into());
    let compiled = Command::new(compiler)
        .args(["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-O1", "-I"])
        .arg(crate_folder.join("include"))
        .arg(crate_folder.join("tests/c/embed.c"))
        .arg(library())
        .args(SYSTEM)
        .arg("-o")
        .arg(&program)
        .output()
        .ok()?;
    assert!(compiled.status.success(), "{}", String::from_utf8_lossy(&compiled.stderr));
    let run = Command::new(&program).arg(&scene).output().expect("the program");
    let message = String::from_utf8_lossy(&run.stderr);
    assert!(run.status.success(), "{:?}: {message}", run.status);
    String::from_utf8(run.stdout).ok()
}

/// A line of three numbers, in so many digits that they come back.
fn line(text: &mut String, name: &str, rgb: Rgb) {
    let [r, g, b] = rgb.to_array();
    writeln!(text, "{name} {r} {g} {b}").expect("a line");
}

/// The same from the core.
fn expected() -> String {
    let buffer = Buffer::new(&stored());
    let stored = StoredScene::new(buffer.bytes()).expect("a scene");
    let (mut lights, mut materials) = (vec![NO_LIGHT; stored.room().0], vec![NO_MATERIAL; stored.room().1]);
    let scene = stored.scene(&mut lights, &mut materials).expect("a scene");
    let mut text = String::new();
    let counts = (scene.lights().len(), scene.surfaces().len());
    writeln!(text, "facts {} {} {} {}", cornell().width, cornell().height, counts.0, counts.1)
        .expect("a line");
    let from = SurfacePoint { point: Vec3::new(0.1, 0.001, 0.2), error: Vec3::ZERO, normal: Vec3::Y };
    let probe = Probe { samples: 256, surface: SurfaceDensity::Auto, choice: LightChoice::All };
    let light = probe.irradiance(&scene, &from, &mut Sobol::new(7));
    line(&mut text, "irradiance", light.mean());
    line(&mut text, "error", light.standard_error());
    line(&mut text, "unshadowed", light.unshadowed.expect("a closed form"));
    let seen = probe.visibility(&scene, &from, 0, &mut Sobol::new(7)).expect("a light");
    writeln!(text, "closed 1\nvisibility {seen}").expect("a line");
    let toward = Vec3::new(0.0, -0.1, 1.0).try_normalize().expect("a direction");
    let ray = Ray::new(Vec3::new(0.278, 0.273, -0.8), toward);
    let probe = Probe { samples: 64, ..probe };
    let seen = probe.radiance(&scene, &Direct::default(), (&ray, f32::INFINITY), &mut Sobol::new(7));
    line(&mut text, "ray", seen.mean());
    let (camera, film): (_, Film) = (stored.camera().expect("a camera"), stored.film().expect("a film"));
    let job = Job { scene, camera, film, estimator: Direct::default(), sequence: Sobol::new(7) };
    let mut pixel = [PixelStats::NEW];
    job.render(PixelRect { x0: 3, y0: 5, x1: 4, y1: 6 }, 0..16, &mut pixel);
    line(&mut text, "pixel", pixel[0].mean());
    text
}

#[test]
fn a_program_gets_the_numbers_of_the_core() {
    let Some(printed) = printed(&stored()) else {
        eprintln!("not run: a program in C: there is no C compiler");
        return;
    };
    let expected = expected();
    assert_eq!(printed.lines().count(), expected.lines().count(), "{printed}");
    for (printed, expected) in printed.lines().zip(expected.lines()) {
        let (mut a, mut b) = (printed.split(' '), expected.split(' '));
        assert_eq!(a.next(), b.next());
        let bits = |text: &str| text.parse::<f32>().expect("a number").to_bits();
        assert!(a.map(bits).eq(b.map(bits)), "{printed} instead of {expected}");
    }
}
