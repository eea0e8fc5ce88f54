//! What a visitor can move, choose and type.

use crate::driver::Res;
use crate::page::{Page, with_page};

/// The shadow, as numbers: how much of the light arrives at each pixel.
fn visibility(page: &Page) -> Res<Vec<f64>> {
    let script = "return [...halflight.app.renderer.films[0].linear()].filter((_, i) => i % 3 == 0)";
    Ok(serde_json::from_value(page.run(script)?)?)
}

#[test]
fn dragging_the_light_moves_the_shadow() -> Res<()> {
    with_page("dragging the light", |page| {
        page.open("", 1)?;
        page.select("Show", "visibility")?;
        page.render(96, 4)?;
        let before = visibility(page)?;
        page.run("window.frames_seen = 0; halflight.app.renderer.addEventListener('frame', () => window.frames_seen++)")?;
        let place = page.number("halflight.app.lights[0].position[0]")?;
        let [x, y] = page.middle("#handle")?;
        page.drag([x, y], [x + 300, y + 40])?;
        page.samples(4)?;
        assert!(page.number("window.frames_seen")? > 2.0);
        assert!(page.number("halflight.app.lights[0].position[0]")? > place + 0.1);
        let after = visibility(page)?;
        let changed = before.iter().zip(&after).filter(|(a, b)| (*a - *b).abs() > 0.3).count();
        assert!(changed > before.len() / 50, "{changed} of {} pixels", before.len());
        Ok(())
    })
}

#[test]
fn every_kind_of_light_can_be_chosen_and_lights_the_scene() -> Res<()> {
    with_page("kinds of light", |page| {
        page.open("", 1)?;
        for kind in
            ["disk", "sphere", "cylinder", "point", "spot", "directional", "distant", "constant", "rectangle"]
        {
            page.select("Kind", kind)?;
            page.wait(&format!(
                "halflight.app.lights[0].kind == '{kind}' && !halflight.app.renderer.moving"
            ))?;
            page.render(48, 2)?;
            let mean = page
                .number("halflight.app.renderer.films[0].linear().reduce((a, b) => a + b) / (48 * 32 * 3)")?;
            assert!(mean > 0.01 && mean < 100.0, "{kind}: {mean}");
        }
        Ok(())
    })
}

#[test]
fn lights_are_added_and_taken_away() -> Res<()> {
    with_page("adding lights", |page| {
        page.open("", 1)?;
        let light = |samples: u32| -> Res<f64> {
            page.render(48, samples)?;
            page.number("halflight.app.renderer.films[0].linear().reduce((a, b) => a + b)")
        };
        let one = light(4)?;
        page.run("document.querySelector('#light .add').click()")?;
        page.wait("halflight.app.lights.length == 2 && !halflight.app.renderer.moving")?;
        let two = light(4)?;
        assert!(two > 1.02 * one, "{two} with two lights, {one} with one");
        let hash = page.run("return halflight.app.link().split('#')[1]")?;
        page.open(&format!("#{}", hash.as_str().unwrap_or_default()), 1)?;
        assert_eq!(light(4)?, two, "a link restores a light that was added");
        page.select("Kind", "none")?;
        page.wait("halflight.app.lights[1].kind == 'none' && !halflight.app.renderer.moving")?;
        assert!((light(4)? / one - 1.0).abs() < 1e-3);
        page.select("Which", "0")?;
        page.select("Kind", "none")?;
        page.wait("halflight.app.lights[0].kind == 'none' && !halflight.app.renderer.moving")?;
        assert_eq!(light(4)?, 0.0, "without a light it is dark");
        Ok(())
    })
}

#[test]
fn mouse_wheel_and_fingers_move_the_camera() -> Res<()> {
    with_page("moving the camera", |page| {
        page.open("", 1)?;
        page.run("halflight.app.setWidth(160)")?;
        let origin = || -> Res<Vec<f64>> {
            Ok(serde_json::from_value(page.run("return halflight.app.orbit.origin")?)?)
        };
        let target = "JSON.stringify(halflight.app.orbit.target)";
        let distance = || page.number("halflight.app.orbit.distance");
        let [x, y] = page.middle("#canvas")?;
        let (start, at, from) = (origin()?, page.run(&format!("return {target}"))?, distance()?);
        page.drag([x, y], [x + 120, y])?;
        assert!(origin()? != start, "the mouse turns");
        assert_eq!(page.run(&format!("return {target}"))?, at, "around what is looked at");
        page.wheel([x, y], -100)?;
        page.wait(&format!("halflight.app.orbit.distance < {} ", 0.95 * from))?;
        let before = (distance()?, page.run(&format!("return {target}"))?);
        page.touch(&[[x - 40, y], [x + 40, y]], &[[x - 90, y + 30], [x + 90, y + 30]])?;
        page.wait(&format!("halflight.app.orbit.distance < {}", 0.7 * before.0))?;
        assert!(page.run(&format!("return {target}"))? != before.1, "two fingers move sideways too");
        let (turned, near) = (origin()?, distance()?);
        page.touch(&[[x, y]], &[[x + 60, y + 20]])?;
        assert!(origin()? != turned && (distance()? / near - 1.0).abs() < 1e-9, "one finger turns");
        Ok(())
    })
}

#[test]
fn what_is_shown_and_how_bright_is_chosen() -> Res<()> {
    with_page("what is shown", |page| {
        page.open("", 1)?;
        page.render(96, 4)?;
        // From a copy, so that the page's own canvas is not one that is read often.
        let mean = "(() => { const copy = new OffscreenCanvas(96, 64).getContext('2d', { willReadFrequently: true }); \
            copy.drawImage(halflight.app.canvas, 0, 0); return [...copy.getImageData(0, 0, 96, 64).data] \
            .filter((_, i) => i % 4 != 3).reduce((a, b) => a + b) / (96 * 64 * 3) })()";
        let plain = page.number(mean)?;
        page.run("halflight.app.setExposure(2)")?;
        assert!(page.number(mean)? > plain + 10.0);
        page.run("halflight.app.setExposure(0)")?;
        for show in ["visibility", "occlusion", "error", "samples"] {
            page.select("Show", show)?;
            page.samples(4)?;
            assert!((page.number(mean)? - plain).abs() > 1.0, "{show} looks like radiance");
            assert_eq!(page.run("return document.getElementById('legend').hidden")?, false);
        }
        page.select("Columns", "240")?;
        page.wait("document.getElementById('size').textContent == '240 × 160'")?;
        Ok(())
    })
}

#[test]
fn a_link_restores_scene_camera_light_and_settings() -> Res<()> {
    with_page("the link", |page| {
        page.open("", 1)?;
        page.select("Scene", "colours")?;
        page.wait("halflight.app.facts.name == 'colours'")?;
        page.run(
            "const app = halflight.app; app.orbit.turn(0.3, 0.1); app.cameraMoved(); app.chooseLight(1); \
             app.moveLight([0.5, 3, 1]); app.setChoice(0, 'lights', 'projected')",
        )?;
        page.wait("!halflight.app.renderer.moving")?;
        page.render(72, 3)?;
        let (pixels, link) = (page.pixels()?, page.run("return halflight.app.link()")?);
        let hash = link.as_str().and_then(|l| l.split_once('#')).ok_or("no state in the link")?.1.to_owned();
        page.open(&format!("#{hash}"), 1)?;
        page.render(72, 3)?;
        assert_eq!(page.run("return halflight.app.facts.name")?, "colours");
        assert!(page.pixels()? == pixels, "another picture than the one of the link");
        page.open("#nonsense", 1)?;
        assert_eq!(page.run("return halflight.app.facts.name")?, "still-life");
        Ok(())
    })
}

#[test]
fn keys_alone_turn_pause_probe_and_move_the_light() -> Res<()> {
    with_page("keys", |page| {
        page.open("", 1)?;
        page.run("halflight.app.setWidth(160); document.getElementById('canvas').focus()")?;
        page.keys("\u{e014}\u{e014}")?;
        page.wait("halflight.app.state.camera")?;
        page.wait("!halflight.app.renderer.moving")?;
        page.keys("\u{e007}")?;
        page.wait("!document.getElementById('probe').hidden")?;
        page.keys("\u{e00c}")?;
        page.wait("document.getElementById('probe').hidden")?;
        page.keys(" ")?;
        assert_eq!(page.run("return document.getElementById('pause').ariaPressed")?, "true");
        page.keys(" ")?;
        let x = page.number("halflight.app.lights[0].position[0]")?;
        page.run("document.getElementById('handle').focus()")?;
        page.keys("\u{e014}")?;
        page.wait(&format!("Math.abs(halflight.app.lights[0].position[0] - {x}) > 1e-3"))?;
        // The controls of two ways take the place of those of one; the focus stays where it was.
        page.run("document.querySelector('#sampling input').focus()")?;
        page.keys(" ")?;
        page.wait("halflight.app.renderer.films.length == 2")?;
        assert_eq!(
            page.run("return document.activeElement.labels[0].textContent")?,
            "Compare two, side by side"
        );
        page.keys(" ")?;
        page.wait("halflight.app.renderer.films.length == 1")?;
        // Every control can be reached, and has a name.
        let nameless = page.run(
            "return [...document.querySelectorAll('button, select, input:not([hidden]), canvas, [role=slider]')] \
             .filter((e) => !e.hidden && !(e.ariaLabel || e.labels?.length || e.textContent.trim() || e.title)) \
             .map((e) => e.outerHTML)",
        )?;
        assert_eq!(nameless.as_array().map(Vec::len), Some(0), "{nameless}");
        Ok(())
    })
}

#[test]
fn a_phone_of_360_pixels_scrolls_one_way_only() -> Res<()> {
    with_page("360 pixels", |page| {
        page.resize(360, 740)?;
        page.open("", 1)?;
        for compare in ["false", "true"] {
            page.run(&format!("halflight.app.compare({compare})"))?;
            assert_eq!(page.number("document.documentElement.scrollWidth")?, 360.0);
        }
        Ok(())
    })
}

#[test]
fn out_of_sight_the_page_rests_and_goes_on_when_back() -> Res<()> {
    with_page("out of sight", |page| {
        page.open("", 1)?;
        page.run(
            "halflight.app.setWidth(160); halflight.app.setTarget(0.05); \
             Object.defineProperty(document, 'hidden', { get: () => globalThis.out, configurable: true }); \
             globalThis.out = true; document.dispatchEvent(new Event('visibilitychange'))",
        )?;
        page.wait("(globalThis.last ?? -1) == (globalThis.last = halflight.app.renderer.elapsed)")?;
        std::thread::sleep(std::time::Duration::from_secs(2));
        let rested = page.number("halflight.app.renderer.elapsed")?;
        std::thread::sleep(std::time::Duration::from_secs(1));
        assert_eq!(page.number("halflight.app.renderer.elapsed")?, rested);
        page.run("globalThis.out = false; document.dispatchEvent(new Event('visibilitychange'))")?;
        page.wait(&format!("halflight.app.renderer.elapsed > {rested}"))
    })
}

#[test]
fn two_hundred_changes_of_scene_take_no_more_memory_than_twenty() -> Res<()> {
    with_page("memory", |page| {
        page.open("?workers=1", 1)?;
        page.run("halflight.app.setWidth(48)")?;
        let bytes = |changes: u32| -> Res<f64> {
            page.run(&format!(
                "return (async () => {{ for (let i = 0; i < {changes}; i++) {{ \
                 await halflight.app.load({{ builtin: i % 2 ? 'cornell' : 'contact' }}); }} }})()"
            ))?;
            page.run("return halflight.app.pool.all({ type: 'memory' })")?["bytes"].as_f64().ok_or("?".into())
        };
        let (some, many) = (bytes(20)?, bytes(180)?);
        assert!(many <= some, "{some} bytes after 20 changes, {many} after 200");
        Ok(())
    })
}
