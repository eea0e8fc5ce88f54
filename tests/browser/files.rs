//! What goes into the page, and what comes out of it.

use crate::driver::Res;
use crate::page::{bits, rendered, with_page};
use halflight::load::{Encoding, read_image, write_exr};
use halflight::{Rgb, build::Image};
use std::fs;
use std::process::Command;

#[test]
fn a_scene_with_its_files_is_shown_and_a_broken_one_is_explained() -> Res<()> {
    with_page("opening files", |page| {
        page.open("", 1)?;
        let folder = page.folder.path().join("scene");
        fs::create_dir(&folder)?;
        let exported = Command::new(std::env::var("HALFLIGHT_CLI")?)
            .args(["export", "contact", "-o"])
            .arg(folder.join("mine.xml"))
            .output()?;
        assert!(exported.status.success(), "{exported:?}");
        let files: Vec<_> = fs::read_dir(&folder)?.map(|e| e.map(|e| e.path())).collect::<Result<_, _>>()?;
        page.choose_files("#files", &files)?;
        page.wait("halflight.app.facts.name == 'mine'")?;
        page.render(60, 4)?;
        let line = format!("{} --width 60 --spp 4", folder.join("mine.xml").display());
        assert!(page.pixels()? == rendered(page.folder.path(), &line)?);

        let broken = page.folder.path().join("broken.xml");
        fs::write(&broken, "<scene version=\"3.0.0\">\n  <shape type=\"spere\"/>\n</scene>")?;
        page.choose_files("#files", &[broken])?;
        page.wait("document.getElementById('message').classList.contains('bad')")?;
        let message = page.text("message")?;
        assert!(message.contains("broken.xml:2: ") && message.contains("sphere"), "{message}");
        // The scene before is still there.
        page.render(60, 4)?;
        let text = page.folder.path().join("notes.txt");
        fs::write(&text, "no scene")?;
        page.choose_files("#files", &[text])?;
        page.wait("document.getElementById('message').textContent.includes('notes.txt')")
    })
}

#[test]
fn files_can_be_dropped_on_the_page() -> Res<()> {
    with_page("dropping files", |page| {
        page.open("", 1)?;
        let folder = page.folder.path();
        let (good, broken) = (folder.join("lamp.xml"), folder.join("broken.xml"));
        fs::write(
            &good,
            "<scene version=\"3.0.0\"><shape type=\"sphere\"/>\
             <emitter type=\"point\"><point name=\"position\" x=\"0\" y=\"3\" z=\"4\"/></emitter></scene>",
        )?;
        fs::write(&broken, "<scene version=\"3.0.0\">\n<shape></scene>")?;
        page.drop_file(&good)?;
        page.wait("halflight.app.facts.name == 'lamp'")?;
        page.render(48, 2)?;
        page.drop_file(&broken)?;
        page.wait("document.getElementById('message').classList.contains('bad')")?;
        assert!(page.text("message")?.contains("broken.xml:2:8: "), "{}", page.text("message")?);
        assert_eq!(page.run("return document.getElementById('drop').hidden")?, true);
        // What was there before is still shown.
        page.render(48, 3)
    })
}

#[test]
fn a_sky_lights_the_scene() -> Res<()> {
    with_page("opening a sky", |page| {
        page.open("", 1)?;
        page.select("Scene", "sky")?;
        page.wait("halflight.app.facts.name == 'sky'")?;
        let sky = page.folder.path().join("red.exr");
        let texels = vec![Rgb::new(2.0, 0.1, 0.1); 32 * 16];
        write_exr(&Image { width: 32, height: 16, texels }, fs::File::create(&sky)?)?;
        page.choose_files("#files", &[sky])?;
        page.wait("halflight.app.facts.environments == 1")?;
        page.render(48, 4)?;
        let sums =
            "halflight.app.renderer.films[0].linear().reduce((s, v, i) => (s[i % 3] += v, s), [0, 0, 0])";
        assert!(page.number(&format!("{sums}[0]"))? > 8.0 * page.number(&format!("{sums}[2]"))?);
        Ok(())
    })
}

#[test]
fn pictures_are_saved_as_they_are() -> Res<()> {
    with_page("saving", |page| {
        page.open("", 1)?;
        page.render(96, 4)?;
        page.run("document.getElementById('exr').click()")?;
        let saved = read_image(&page.download("still-life.exr")?, Encoding::Linear)?;
        assert_eq!((saved.width, saved.height), (96, 64));
        assert!(bits(&saved.texels) == page.pixels()?);
        page.run("document.getElementById('png').click()")?;
        let saved = read_image(&page.download("still-life.png")?, Encoding::Srgb)?;
        assert_eq!((saved.width, saved.height), (96, 64));
        Ok(())
    })
}
