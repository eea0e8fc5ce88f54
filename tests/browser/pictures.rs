//! What the page renders, and what it says about it.

use crate::driver::Res;
use crate::page::{rendered, with_page};
use halflight::load::builtin::BUILTIN;
use halflight_wasm::Scene;
use serde_json::Value;

#[test]
fn the_page_shows_a_picture_and_gets_to_its_error() -> Res<()> {
    with_page("the first picture", |page| {
        page.open("", 1)?;
        let ms = page.number("halflight.app.timing.picture - halflight.app.timing.arrived")?;
        println!("first picture {ms:.0} ms after the module");
        let foreign = page.run(
            "return performance.getEntriesByType('resource').map((e) => e.name).filter((n) => !n.startsWith(location.origin))",
        )?;
        assert_eq!(foreign.as_array().map(Vec::len), Some(0), "{foreign}");
        page.run("halflight.app.setWidth(240); halflight.app.setTarget(8)")?;
        page.wait("document.body.dataset.state == 'done'")?;
        let error = page.text("error")?;
        let percent: f64 = error.trim_end_matches(" %").parse()?;
        assert!(percent <= 8.0, "{error}");
        // Where nothing can hide, two samples are enough.
        assert!(page.number("document.getElementById('spp').textContent * 1")? >= 2.0);
        Ok(())
    })
}

#[test]
fn the_page_and_the_command_line_have_the_same_bits() -> Res<()> {
    with_page("the bits of the command line", |page| {
        for (scene, workers) in BUILTIN.iter().zip([2, 1, 3].into_iter().cycle()) {
            let scene = scene.name;
            page.open(&format!("?workers={workers}"), 1)?;
            page.select("Scene", scene)?;
            page.wait(&format!("halflight.app.facts.name == '{scene}'"))?;
            page.render(96, 6)?;
            let expected = rendered(page.folder.path(), &format!("{scene} --width 96 --spp 6"))?;
            assert!(page.pixels()? == expected, "{scene}: other bits than the command line's");
        }
        page.select("Scene", "morning")?;
        page.wait("halflight.app.facts.name == 'morning'")?;
        page.select("Technique", "mis")?;
        for sequence in ["random", "sobol"] {
            page.select("Sequence", sequence)?;
            page.render(96, 6)?;
            let line = format!("morning --width 96 --spp 6 --technique mis --sequence {sequence}");
            assert!(page.pixels()? == rendered(page.folder.path(), &line)?, "{line}");
        }
        Ok(())
    })
}

#[test]
fn refined_to_an_error_the_page_and_the_command_line_have_the_same_bits() -> Res<()> {
    with_page("the bits of the command line, refined", |page| {
        for (scene, error, workers) in [("penumbra", 3, 2), ("plates", 5, 3), ("morning", 4, 1)] {
            page.open(&format!("?workers={workers}"), 1)?;
            page.select("Scene", scene)?;
            page.wait(&format!("halflight.app.facts.name == '{scene}'"))?;
            // Wider than a tile, and no multiple of one.
            page.run(&format!(
                "const app = halflight.app; app.setTarget({error}); app.setWidth(200); \
                 app.renderer.restart(...app.size, app.sides)"
            ))?;
            page.wait(
                "document.body.dataset.state == 'done' && halflight.app.renderer.films[0].tiles?.length == 4",
            )?;
            let line = format!("{scene} --width 200 --error {error}");
            assert!(page.pixels()? == rendered(page.folder.path(), &line)?, "{line}");
            // Samples went where the error was.
            let counts = "halflight.app.renderer.films[0].words.filter((_, i) => i % 8 == 6)";
            assert!(page.number(&format!("Math.max(...{counts}) / Math.min(...{counts})"))? >= 4.0);
            assert!(page.number("halflight.app.renderer.films[0].error")? <= 0.01 * f64::from(error));
        }
        Ok(())
    })
}

#[test]
fn another_error_goes_on_from_the_samples_that_are_there() -> Res<()> {
    with_page("another error", |page| {
        page.open("", 1)?;
        page.select("Scene", "penumbra")?;
        page.wait("halflight.app.facts.name == 'penumbra'")?;
        let done =
            "document.body.dataset.state == 'done' && halflight.app.renderer.films[0].tiles?.length == 4";
        let error = || page.number("halflight.app.renderer.films[0].error");
        page.run("halflight.app.setTarget(6); halflight.app.setWidth(200)")?;
        page.wait(done)?;
        assert!(error()? <= 0.06);
        page.run("globalThis.film = halflight.app.renderer.films[0]; halflight.app.setTarget(3)")?;
        page.wait(&format!("halflight.app.renderer.films[0].error <= 0.03 && {done}"))?;
        assert_eq!(page.run("return film === halflight.app.renderer.films[0]")?, true, "it began anew");
        // A looser one throws nothing away.
        let samples = page.number("film.samples")?;
        page.run("halflight.app.setTarget(8)")?;
        page.wait(done)?;
        assert_eq!(page.number("film.samples")?, samples);
        // What was promised holds against a picture with many samples.
        let reference = rendered(page.folder.path(), "penumbra --width 200 --spp 1024 --seed 7")?;
        let (mut sum, pixels) = (0.0, page.pixels()?);
        for (a, b) in pixels.iter().zip(&reference).map(|(a, b)| (f32::from_bits(*a), f32::from_bits(*b))) {
            sum += f64::from((a - b) * (a - b) / (b * b + 0.01));
        }
        let true_error = (sum / pixels.len() as f64).sqrt();
        assert!(true_error < 1.2 * 0.03, "{true_error}");
        // Begun anew it is the command line's, to the last bit.
        page.run("halflight.app.setTarget(3)")?;
        page.run(
            "[...document.querySelectorAll('button')].find((b) => b.textContent == 'Begin anew').click()",
        )?;
        page.wait(&format!("halflight.app.renderer.films[0] !== film && {done}"))?;
        assert!(page.pixels()? == rendered(page.folder.path(), "penumbra --width 200 --error 3")?);
        Ok(())
    })
}

#[test]
fn a_message_does_not_change_the_picture() -> Res<()> {
    with_page("a message", |page| {
        page.open("", 1)?;
        page.run("globalThis.film = halflight.app.renderer.films[0]; halflight.app.say('Three\\nlines\\nof text.', true)")?;
        std::thread::sleep(std::time::Duration::from_millis(300));
        assert_eq!(page.run("return film === halflight.app.renderer.films[0]")?, true, "it began anew");
        page.run("document.getElementById('dismiss').click()")?;
        assert_eq!(page.text("message")?, "");
        Ok(())
    })
}

#[test]
fn a_browser_without_what_the_page_needs_is_told() -> Res<()> {
    with_page("no SIMD", |page| {
        let script = serde_json::json!({ "source": "WebAssembly.validate = () => false" });
        page.cdp("Page.addScriptToEvaluateOnNewDocument", &script)?;
        page.goto(page.url())?;
        page.wait("document.body.dataset.state == 'failed'")?;
        let message = page.text("message")?;
        assert!(message.contains("SIMD") && message.contains("Firefox from 89"), "{message}");
        Ok(())
    })
}

#[test]
fn the_policy_of_the_page_lets_nothing_in_that_is_not_its_own() -> Res<()> {
    with_page("the policy", |page| {
        page.open("", 1)?;
        assert!(page.console()?.is_empty(), "the policy is in the way of the page itself");
        let script = "return (async () => { const refused = []; \
            document.addEventListener('securitypolicyviolation', (e) => refused.push(e.effectiveDirective)); \
            const script = document.createElement('script'); script.textContent = 'globalThis.foreign = 1'; \
            document.body.append(script); \
            await fetch('http://127.0.0.2:9/').catch(() => {}); \
            await new Promise((resolve) => setTimeout(resolve, 100)); \
            return [globalThis.foreign ?? 0, refused.includes('connect-src'), refused.includes('script-src-elem')] })()";
        assert_eq!(page.run(script)?, serde_json::json!([0, true, true]));
        // These are the errors that were asked for.
        assert!(page.console()?.iter().all(|line| line.contains("Security") || line.contains("127.0.0.2")));
        Ok(())
    })
}

#[test]
fn without_workers_the_page_renders_the_same_by_itself() -> Res<()> {
    with_page("no workers", |page| {
        let script = serde_json::json!({ "source": "delete globalThis.Worker" });
        page.cdp("Page.addScriptToEvaluateOnNewDocument", &script)?;
        page.open("", 1)?;
        assert!(page.text("message")?.contains("Workers are not available"));
        page.select("Scene", "cornell")?;
        page.wait("halflight.app.facts.name == 'cornell'")?;
        page.render(48, 4)?;
        assert!(page.pixels()? == rendered(page.folder.path(), "cornell --width 48 --spp 4")?);
        Ok(())
    })
}

#[test]
fn two_ways_are_compared_and_the_chart_grows() -> Res<()> {
    with_page("comparing two ways", |page| {
        page.open("", 1)?;
        page.select("Scene", "penumbra")?;
        page.wait("halflight.app.facts.name == 'penumbra'")?;
        page.run("halflight.app.setWidth(160); document.querySelector('#sampling input').click()")?;
        page.wait("halflight.app.renderer.films.length == 2")?;
        page.samples(4)?;
        let early = page.number("document.querySelectorAll('#chart polyline')[1].points.numberOfItems")?;
        page.samples(16)?;
        page.run("halflight.app.renderer.pause(true)")?;
        assert_eq!(page.text("message")?, "", "a tile was in the middle of a step");
        let late = page.number("document.querySelectorAll('#chart polyline')[1].points.numberOfItems")?;
        assert!(late > early, "{late} points after {early}");
        let words = page.run("return document.querySelector('#chart figcaption').textContent")?;
        let words = words.as_str().unwrap_or_default();
        assert!(words.contains("the right needs about") && words.contains("more samples"), "{words}");
        // Area sampling with random numbers is worse here, and each side shows its own film.
        assert!(
            page.number("halflight.app.renderer.films[1].error / halflight.app.renderer.films[0].error")?
                > 2.0
        );
        page.run("document.getElementById('split').focus()")?;
        page.keys("\u{e012}\u{e012}")?;
        assert!((page.number("halflight.app.state.split")? - 0.46).abs() < 1e-6);
        Ok(())
    })
}

#[test]
fn the_probe_says_what_the_core_says() -> Res<()> {
    with_page("the probe", |page| {
        page.open("", 1)?;
        page.run("halflight.app.setWidth(480)")?;
        page.samples(1)?;
        page.run("return halflight.app.probeAt(0.4, 0.93)")?;
        page.wait("halflight.app.probe?.samples == 4096")?;
        let seen = page.run("return halflight.app.probe")?;
        let mut scene = Scene::builtin("still-life").map_err(|_| "no scene")?;
        scene.resize(480, 320).map_err(|_| "no size")?;
        let here = scene.probe(192, 297, 4096).map_err(|_| "no probe")?.ok_or("no surface")?;
        let numbers = |key: &str| -> Vec<f64> {
            seen[key].as_array().into_iter().flatten().filter_map(Value::as_f64).collect()
        };
        // To the last digits, which are lost on the way through JSON.
        let same = |a: &[f64], b: &[f64]| {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-14 * b.abs())
        };
        assert!(same(&numbers("means"), &here.means), "{seen} {here:?}");
        assert!(same(&numbers("errors"), &here.errors), "{seen} {here:?}");
        let both = |unshadowed, closed: Option<f64>| [unshadowed, closed.unwrap_or(-1.0)];
        let of_page = both(seen["unshadowed"].as_f64().unwrap_or(-1.0), seen["closed_form"].as_f64());
        assert!(same(&of_page, &both(here.unshadowed, here.closed_form)), "{seen} {here:?}");
        // The samples agree with the closed form.
        let exact = here.closed_form.ok_or("no closed form")?;
        assert!((here.unshadowed / exact - 1.0).abs() < 1e-3, "{} {exact}", here.unshadowed);
        assert!(page.text("probe")?.contains("of the light arrives"));
        assert!(page.number("document.querySelectorAll('#overlay .ray').length")? > 10.0);
        Ok(())
    })
}

#[test]
fn the_element_shows_a_scene_in_any_page() -> Res<()> {
    with_page("the element", |page| {
        page.goto(&format!("{}example.html", page.url()))?;
        page.wait("document.querySelector('halflight-view').renderer?.films[0].samples >= 2")
    })
}
