//! Lights that keep their form: turned, moved, made brighter.

use crate::driver::Res;
use crate::page::{Page, with_page};
use std::fs;

/// The sum of the picture's linear values.
const LIGHT: &str = "halflight.app.renderer.films[0].linear().reduce((a, b) => a + b)";

/// Moves a slider of the controls to a value, as a user does.
fn slide(page: &Page, label: &str, value: f64) -> Res<()> {
    let found = page.run(&format!(
        "const all = [...document.querySelectorAll('input[type=range]')]; \
         const control = all.find((c) => c.labels[0]?.textContent == '{label}'); \
         control.value = {value}; control.dispatchEvent(new Event('input')); \
         halflight.app.released(); return true"
    ))?;
    assert_eq!(found, true);
    page.wait("!halflight.app.renderer.moving")
}

#[test]
fn a_sky_is_turned_and_made_brighter_and_a_link_restores_it() -> Res<()> {
    with_page("turning the sky", |page| {
        page.open("", 1)?;
        page.select("Scene", "morning")?;
        page.wait("document.getElementById('light').textContent.includes('environment map')")?;
        let index = page.number("halflight.app.lights.findIndex((light) => light.kind == 'map')")?;
        page.select("Which", &index.to_string())?;
        page.render(72, 4)?;
        let (before, light) = (page.pixels()?, page.number(LIGHT)?);
        slide(page, "Turn", 100.0)?;
        page.render(72, 4)?;
        assert!(page.pixels()? != before, "the sky has not turned");
        slide(page, "Intensity", 1.1)?;
        page.render(72, 4)?;
        assert!(page.number(LIGHT)? > 1.5 * light, "three times the sky is not much brighter");
        let (turned, link) = (page.pixels()?, page.run("return halflight.app.link()")?);
        let hash = link.as_str().and_then(|l| l.split_once('#')).ok_or("no state in the link")?.1.to_owned();
        page.open(&format!("#{hash}"), 1)?;
        page.render(72, 4)?;
        assert!(page.pixels()? == turned, "another picture than the one of the link");
        // In the picture: by key, and by dragging with Alt held.
        let turn = "halflight.app.currentLight().size[0]";
        page.run("document.getElementById('canvas').focus()")?;
        page.keys("]")?;
        let keyed = page.number(turn)?;
        assert!((keyed - 96.56).abs() < 0.1, "{keyed}");
        let camera = page.run("return halflight.app.orbit.origin")?;
        page.run(
            "const canvas = document.getElementById('canvas'); \
             canvas.setPointerCapture = () => {}; \
             const at = (type, x) => canvas.dispatchEvent(new PointerEvent(type, \
                 { pointerId: 1, clientX: x, clientY: 300, altKey: true, button: 0 })); \
             at('pointerdown', 300); at('pointermove', 340); at('pointermove', 400); at('pointerup', 400)",
        )?;
        assert!((page.number(turn)? - keyed).abs() > 10.0);
        assert_eq!(page.run("return halflight.app.orbit.origin")?, camera, "the camera stays");
        Ok(())
    })
}

#[test]
fn a_sky_of_the_visitors_own_turns_without_being_read_again() -> Res<()> {
    with_page("a sky of one's own", |page| {
        page.open("", 1)?;
        let texels: Vec<_> =
            (0..32 * 16).map(|i| halflight::Rgb::splat(if i % 32 < 8 { 4.0 } else { 0.1 })).collect();
        let sky = page.folder.path().join("aside.exr");
        let image = halflight::build::Image { width: 32, height: 16, texels };
        halflight::load::write_exr(&image, fs::File::create(&sky)?)?;
        page.choose_files("#files", &[sky])?;
        page.wait("halflight.app.facts.environments == 1")?;
        page.wait("document.getElementById('message').textContent.startsWith('Shown from files')")?;
        let index = page.number("halflight.app.lights.findIndex((light) => light.kind == 'map')")?;
        page.select("Which", &index.to_string())?;
        page.render(48, 4)?;
        let before = page.pixels()?;
        slide(page, "Turn", -90.0)?;
        page.render(48, 4)?;
        assert!(page.pixels()? != before);
        slide(page, "Turn", 0.0)?;
        page.render(48, 4)?;
        assert!(page.pixels()? == before, "turned back it is what it was");
        Ok(())
    })
}

#[test]
fn lights_made_of_triangles_and_painted_ones_are_dragged() -> Res<()> {
    with_page("dragging a mesh", |page| {
        page.open("", 1)?;
        let scene = |lamp: &str| {
            format!(
                "<scene version=\"3.0.0\">\
                 <sensor type=\"perspective\"><transform name=\"to_world\">\
                 <lookat origin=\"0, 3, 9\" target=\"0, 1, 0\" up=\"0, 1, 0\"/></transform></sensor>\
                 <shape type=\"sphere\"><float name=\"radius\" value=\"0.6\"/>\
                 <point name=\"center\" x=\"0\" y=\"0.6\" z=\"0\"/></shape>\
                 <shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"-90\"/>\
                 <scale value=\"5\"/></transform></shape>{lamp}</scene>"
            )
        };
        let place =
            "<transform name=\"to_world\"><scale value=\"0.4\"/><translate x=\"-1\" y=\"3\"/></transform>";
        let mesh = format!(
            "<shape type=\"cube\">{place}<emitter type=\"area\"><rgb name=\"radiance\" value=\"9\"/></emitter></shape>"
        );
        let painted = format!(
            "<shape type=\"rectangle\">{place}<emitter type=\"area\"><texture name=\"radiance\" type=\"checkerboard\"/>\
             </emitter></shape>"
        );
        for (kind, lamp) in [("mesh", mesh), ("painted", painted)] {
            let file = page.folder.path().join(format!("{kind}.xml"));
            fs::write(&file, scene(&lamp))?;
            page.choose_files("#files", &[file])?;
            page.wait(&format!("halflight.app.facts.name == '{kind}'"))?;
            assert_eq!(page.run("return halflight.app.lights[0].kind")?, kind);
            page.render(48, 4)?;
            let before = page.pixels()?;
            let [x, y] = page.middle("#handle")?;
            page.drag([x, y], [x + 150, y + 10])?;
            page.wait("!halflight.app.renderer.moving")?;
            assert!(page.number("halflight.app.lights[0].position[0]")? > -0.6, "{kind}");
            page.render(48, 4)?;
            assert!(page.pixels()? != before, "{kind}");
            assert!(page.text("light")?.contains("keeps its form"));
        }
        Ok(())
    })
}
