//! How large frames are while something moves, on machines that are made up.

use crate::driver::Res;
use crate::page::with_page;

/// A machine: milliseconds of any frame, pixels in one more, and every how manyth frame takes twice as long.
struct Machine {
    fixed: f64,
    pixels_per_ms: f64,
    hiccup: u32,
}

/// What became of 600 frames of a picture of 914×609: frames a second and changes of size after the first 120,
/// the size it ended with, and the smallest and largest of the last 200.
struct Held {
    rate: f64,
    changes: f64,
    pixels: f64,
    range: [f64; 2],
}

const FRAMES: &str = "const pace = new Pace(); pace.begin(16000); const times = []; const sizes = []; \
    for (let i = 0; i < 600; i++) { const [w, h] = pace.size(914, 609); \
        const ms = (fixed + w * h / perMs) * (i % hiccup == 0 ? 2 : 1); \
        times.push(ms); sizes.push(w * h); pace.took(ms, w * h); } \
    const late = times.slice(120); const last = sizes.slice(400); \
    return [1000 * late.length / late.reduce((a, b) => a + b), \
        sizes.slice(120).filter((size, i) => size != sizes[119 + i]).length, sizes.at(-1), \
        Math.min(...last), Math.max(...last)]";

#[test]
fn frames_are_as_large_as_keep_up_their_rate_on_any_machine() -> Res<()> {
    with_page("the pace of frames", |page| {
        let held = |machine: Machine| -> Res<Held> {
            let Machine { fixed, pixels_per_ms, hiccup } = machine;
            let script = format!(
                "return (async () => {{ const {{ Pace }} = await import('./engine/pace.js'); \
                 const [fixed, perMs, hiccup] = [{fixed}, {pixels_per_ms}, {hiccup}]; {FRAMES}; }})()"
            );
            let numbers: Vec<f64> = serde_json::from_value(page.run(&script)?)?;
            let &[rate, changes, pixels, least, most] = numbers.as_slice() else { return Err("?".into()) };
            Ok(Held { rate, changes, pixels, range: [least, most] })
        };
        page.goto(page.url())?;
        // From a desktop to a slow phone, each pixel 250 times as dear; a frame in 40 takes twice as long.
        for pixels_per_ms in [30_000.0, 5000.0, 1200.0, 400.0, 120.0] {
            let held = held(Machine { fixed: 8.0, pixels_per_ms, hiccup: 40 })?;
            assert!(held.rate >= 30.0, "{} frames a second at {pixels_per_ms} pixels/ms", held.rate);
            // No less is shown than there is time for, and the size does not flicker.
            let full = held.pixels > 0.99 * 914.0 * 609.0;
            assert!(full || held.rate < 45.0, "{} frames a second, {} pixels", held.rate, held.pixels);
            assert!(held.changes <= 8.0, "{} changes at {pixels_per_ms} pixels/ms", held.changes);
            assert!(held.range[1] / held.range[0] < 1.5, "{:?}", held.range);
        }
        // What cannot be fast enough is at least as fast as it can be.
        let hopeless = held(Machine { fixed: 60.0, pixels_per_ms: 100.0, hiccup: 1000 })?;
        assert!(hopeless.pixels < 1600.0 && hopeless.changes < 1.0, "{}", hopeless.pixels);
        Ok(())
    })
}

#[test]
fn frames_follow_a_machine_that_gets_slower_and_faster() -> Res<()> {
    with_page("a machine that changes", |page| {
        page.goto(page.url())?;
        let script = "return (async () => { const { Pace } = await import('./engine/pace.js'); \
            const pace = new Pace(); pace.begin(16000); \
            const run = (frames, perMs) => { let late = 0; for (let i = 0; i < frames; i++) { \
                const ms = 8 + pace.pixels / perMs; if (ms > 100 / 3) late += 1; pace.took(ms); } \
                return [pace.pixels, late]; }; \
            return [run(200, 2000), run(60, 250), run(200, 2000)]; })()";
        let [fast, slow, again]: [[f64; 2]; 3] = serde_json::from_value(page.run(script)?)?;
        assert!(fast[0] > 25_000.0 && slow[0] < 6500.0, "{fast:?} {slow:?}");
        // Eight times slower, it is back in time after a third of a second.
        assert!(slow[1] <= 10.0, "{} late frames", slow[1]);
        assert!(again[0] > 0.7 * fast[0], "{again:?} after {fast:?}");
        assert!(again[1] <= 8.0, "{} late frames", again[1]);
        Ok(())
    })
}
