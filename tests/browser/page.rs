//! The page, served by `halflight serve` and open in a browser.

use crate::driver::{Browser, Res};
use halflight::Rgb;
use halflight::load::{Encoding, read_image};
use serde_json::Value;
use std::env::var;
use std::io::{BufRead, BufReader};
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};

/// A browser with the page.
pub(crate) struct Page {
    browser: Browser,
    server: Child,
    url: String,
}

impl Deref for Page {
    type Target = Browser;

    fn deref(&self) -> &Browser {
        &self.browser
    }
}

impl Drop for Page {
    fn drop(&mut self) {
        let _ = self.server.kill();
        let _ = self.server.wait();
    }
}

/// The page's folder and the program, as `.ci/run` names them; `None`, with a word about it, when this
/// is a run of the tests without the page.
fn given(test: &str) -> Option<(PathBuf, PathBuf)> {
    match (var("HALFLIGHT_WWW"), var("HALFLIGHT_CLI")) {
        (Ok(www), Ok(cli)) => Some((www.into(), cli.into())),
        _ => {
            eprintln!("not run: {test}: HALFLIGHT_WWW and HALFLIGHT_CLI say where page and program are");
            None
        }
    }
}

/// Runs a test with the page open in a browser of its own.
pub(crate) fn with_page(test: &str, run: impl FnOnce(&Page) -> Res<()>) -> Res<()> {
    let Some((www, cli)) = given(test) else { return Ok(()) };
    let mut server =
        Command::new(cli).args(["serve", "--port", "0"]).arg(www).stdout(Stdio::piped()).spawn()?;
    let mut url = String::new();
    BufReader::new(server.stdout.take().ok_or("no output")?).read_line(&mut url)?;
    let page = Page { browser: Browser::start()?, server, url: url.trim().to_owned() };
    page.resize(1280, 800)?;
    run(&page)?;
    let bad: Vec<_> = page.console()?.into_iter().filter(|line| !line.contains("INFO")).collect();
    assert!(bad.is_empty(), "{test}: {bad:?}");
    Ok(())
}

/// The linear picture of the command line: bits of red, green and blue.
pub(crate) fn rendered(folder: &Path, line: &str) -> Res<Vec<u32>> {
    let out = folder.join("cli.exr");
    let words = line.split_whitespace();
    let run = Command::new(var("HALFLIGHT_CLI")?)
        .arg("render")
        .args(words)
        .args(["--quiet", "-o"])
        .arg(&out)
        .output()?;
    assert!(run.status.success(), "{line}: {run:?}");
    let image = read_image(&out, Encoding::Linear)?;
    Ok(bits(&image.texels))
}

pub(crate) fn bits(texels: &[Rgb]) -> Vec<u32> {
    texels.iter().flat_map(|t| t.to_array().map(f32::to_bits)).collect()
}

impl Page {
    /// Where it is served.
    pub(crate) fn url(&self) -> &str {
        &self.url
    }

    /// Opens the page with a query and a state, and waits for a number of samples.
    pub(crate) fn open(&self, query: &str, samples: u32) -> Res<()> {
        self.goto("about:blank")?;
        self.goto(&format!("{}{query}", self.url))?;
        self.samples(samples)
    }

    /// Waits until each pixel has so many samples.
    pub(crate) fn samples(&self, samples: u32) -> Res<()> {
        self.wait(&format!(
            "globalThis.halflight?.app.renderer.films.length && halflight.app.renderer.films.every(f => f.samples >= {samples})"
        ))
    }

    /// A picture of so many columns with exactly so many samples.
    pub(crate) fn render(&self, columns: u32, samples: u32) -> Res<()> {
        let script = format!(
            "halflight.app.renderer.budget = {samples}; halflight.app.setWidth({columns}); \
             halflight.app.renderer.restart(...halflight.app.size, halflight.app.sides)"
        );
        self.run(&script)?;
        self.samples(samples)
    }

    /// The linear pixels of the page: bits of red, green and blue.
    pub(crate) fn pixels(&self) -> Res<Vec<u32>> {
        let bits =
            self.run("return [...new Uint32Array(halflight.app.renderer.films[0].linear().buffer)]")?;
        Ok(serde_json::from_value(bits)?)
    }

    pub(crate) fn text(&self, id: &str) -> Res<String> {
        let text = self.run(&format!("return document.getElementById('{id}').textContent"))?;
        Ok(text.as_str().unwrap_or_default().to_owned())
    }

    /// The middle of an element in the window.
    pub(crate) fn middle(&self, selector: &str) -> Res<[i64; 2]> {
        let at = self.run(&format!(
            "const r = document.querySelector('{selector}').getBoundingClientRect(); \
             return [Math.round(r.x + r.width / 2), Math.round(r.y + r.height / 2)]"
        ))?;
        Ok(serde_json::from_value(at)?)
    }

    /// Chooses a value of a control, as a user does.
    pub(crate) fn select(&self, label: &str, value: &str) -> Res<()> {
        let script = format!(
            "const all = [...document.querySelectorAll('select')]; \
             const of = (s) => s.getAttribute('aria-label') ?? s.labels[0]?.textContent; \
             const control = all.find((s) => of(s) === '{label}'); \
             control.value = '{value}'; control.dispatchEvent(new Event('change')); return control.value"
        );
        let chosen = self.run(&script)?;
        assert_eq!(chosen, value, "{label}");
        Ok(())
    }

    pub(crate) fn number(&self, expression: &str) -> Res<f64> {
        let value = self.run(&format!("return {expression}"))?;
        Value::as_f64(&value).ok_or_else(|| format!("{expression} is {value}").into())
    }
}
