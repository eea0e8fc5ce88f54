//! How fast the page is; `scripts/page-speed.sh` runs it.

use crate::driver::Res;
use crate::page::{Page, with_page};
use serde_json::Value;
use std::process::Command;

/// Runs of each measurement, of which the best counts: the machine has other things to do.
const RUNS: usize = 3;

/// Samples of each pixel for comparing with the command line.
const SAMPLES: u32 = 16;

/// Width of the picture for that (pixels).
const WIDTH: u32 = 320;

fn best(of: impl Fn() -> Res<f64>, better: fn(f64, f64) -> f64) -> Res<f64> {
    let runs: Vec<_> = (0..RUNS).map(|_| of()).collect::<Res<_>>()?;
    runs.into_iter().reduce(better).ok_or("no runs".into())
}

/// From the module's arrival to the first picture (ms).
fn first_picture(page: &Page) -> Res<f64> {
    page.open("", 1)?;
    page.number("halflight.app.timing.picture - halflight.app.timing.arrived")
}

/// Frames a second while the light moves at each frame of the screen, and their pixels in the mean.
fn frames(page: &Page) -> Res<[f64; 2]> {
    let measured = page.run(
        "return (async () => { const app = halflight.app; let [frames, pixels] = [0, 0]; let moving = true; \
         const count = ({ detail: { films: [film] } }) => { frames += 1; pixels += film.width * film.height; }; app.renderer.addEventListener('frame', count); \
         const [x, y, z] = app.lights[0].position; const start = performance.now(); \
         const move = (now) => { if (!moving) return; \
             const t = (now - start) / 500; app.moveLight([x + 0.1 * Math.sin(t), y, z + 0.1 * Math.cos(t)]); \
             requestAnimationFrame(move); }; \
         requestAnimationFrame(move); await new Promise((resolve) => setTimeout(resolve, 1500)); \
         [frames, pixels] = [0, 0]; const from = performance.now(); await new Promise((resolve) => setTimeout(resolve, 3000)); \
         moving = false; const rate = 1000 * frames / (performance.now() - from); \
         app.renderer.removeEventListener('frame', count); app.released(); \
         return [rate, pixels / frames]; })()",
    )?;
    Ok(serde_json::from_value(measured)?)
}

/// Until the picture as it is at first, 914×609 pixels, is known to 1 % (s).
fn to_one_percent(page: &Page, scene: &str) -> Res<f64> {
    page.open(&format!("#{}", state(&format!("{{\"scene\":\"{scene}\"}}"))), 1)?;
    page.wait("document.body.dataset.state == 'done'")?;
    page.number("halflight.app.renderer.elapsed / 1000")
}

/// A state as a link has it.
fn state(json: &str) -> String {
    const DIGITS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    let mut text = String::new();
    for bytes in json.as_bytes().chunks(3) {
        let word = bytes.iter().fold(0, |word, b| word << 8 | usize::from(*b)) << (8 * (3 - bytes.len()));
        text.extend((0..=bytes.len()).map(|i| char::from(DIGITS[word >> (18 - 6 * i) & 63])));
    }
    text
}

/// Samples a second of one worker, and of the command line with one thread.
fn against_native(page: &Page, scene: &str) -> Res<[f64; 2]> {
    page.open("?workers=1", 1)?;
    page.select("Scene", scene)?;
    page.wait(&format!("halflight.app.facts.name == '{scene}'"))?;
    let samples = "halflight.app.size[0] * halflight.app.size[1]";
    let in_wasm = || -> Res<f64> {
        page.render(WIDTH, SAMPLES)?;
        page.run("halflight.app.renderer.restart(...halflight.app.size, 1)")?;
        page.samples(SAMPLES)?;
        page.number(&format!("{SAMPLES} * {samples} / (halflight.app.renderer.films[0].busy / 1000)"))
    };
    let native = || -> Res<f64> {
        let out = page.folder.path().join("native.exr");
        let run = Command::new(std::env::var("HALFLIGHT_CLI")?)
            .args(["render", scene, "--threads", "1", "--json", "-o"])
            .arg(out)
            .args(["--width", &WIDTH.to_string(), "--spp", &SAMPLES.to_string()])
            .output()?;
        let report: Value = serde_json::from_slice(&run.stdout)?;
        let [all, seconds] = [&report["samples"], &report["seconds"]["render"]].map(Value::as_f64);
        Ok(all.ok_or("no samples")? / seconds.ok_or("no time")?)
    };
    Ok([best(in_wasm, f64::max)?, best(native, f64::max)?])
}

#[test]
#[ignore = "takes minutes and proves nothing; scripts/page-speed.sh"]
fn speed() -> Res<()> {
    with_page("speed", |page| {
        println!("first picture after the module: {:.0} ms", best(|| first_picture(page), f64::min)?);
        page.open("", 1)?;
        for _ in 0..RUNS {
            let [rate, pixels] = frames(page)?;
            println!("while the light is dragged: {rate:.0} frames/s of {pixels:.0} pixels");
        }
        for scene in ["still-life", "penumbra", "morning"] {
            let seconds = best(|| to_one_percent(page, scene), f64::min)?;
            println!("{scene} to 1 %: {seconds:.1} s");
        }
        for scene in ["still-life", "cornell", "plates", "lanterns", "morning"] {
            let [wasm, native] = against_native(page, scene)?;
            let mega = |rate: f64| rate / 1e6;
            let share = wasm / native;
            println!("{scene}: {:.2} M samples/s, native {:.2}, {share:.2}×", mega(wasm), mega(native));
        }
        Ok(())
    })
}
