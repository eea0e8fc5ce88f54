//! A folder to work in, and the program run in it.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};
use tempfile::TempDir;

/// A small scene: a floor, a ball, and a ball of light.
pub(crate) const SCENE: &str = r#"<scene version="3.0.0">
    <default name="spp" value="4"/>
    <integrator type="direct"/>
    <sensor type="perspective">
        <float name="fov" value="40"/>
        <transform name="to_world">
            <lookat origin="0, 2, 6" target="0, 0.8, 0" up="0, 1, 0"/>
        </transform>
        <film type="hdrfilm">
            <integer name="width" value="24"/>
            <integer name="height" value="16"/>
            <rfilter type="box"/>
        </film>
        <sampler type="independent">
            <integer name="sample_count" value="$spp"/>
        </sampler>
    </sensor>
    <shape type="rectangle">
        <transform name="to_world">
            <scale value="10"/>
            <rotate x="1" angle="-90"/>
        </transform>
        <bsdf type="diffuse"/>
    </shape>
    <shape type="sphere">
        <point name="center" value="0, 1, 0"/>
        <float name="radius" value="1"/>
        <bsdf type="diffuse"/>
    </shape>
    <shape type="sphere">
        <point name="center" value="3, 4, 1"/>
        <float name="radius" value="0.5"/>
        <emitter type="area">
            <rgb name="radiance" value="20, 20, 20"/>
        </emitter>
    </shape>
</scene>
"#;

/// The emitter of [`SCENE`].
pub(crate) const EMITTER: &str = r#"<emitter type="area">
            <rgb name="radiance" value="20, 20, 20"/>
        </emitter>"#;

/// A folder with `scene.xml` in it, gone at the end of the test.
#[derive(Debug)]
pub(crate) struct Folder(TempDir);

/// How a run ended.
#[derive(Debug)]
pub(crate) struct Run {
    /// Exit code; `None` after a signal.
    pub(crate) code: Option<i32>,
    /// Results.
    pub(crate) stdout: String,
    /// Everything else.
    pub(crate) stderr: String,
}

impl Folder {
    /// With [`SCENE`].
    pub(crate) fn new() -> Self {
        Self::with_scene(SCENE)
    }

    /// With that scene.
    pub(crate) fn with_scene(xml: &str) -> Self {
        let folder = Self(tempfile::tempdir().unwrap());
        fs::write(folder.path("scene.xml"), xml).unwrap();
        folder
    }

    /// With [`SCENE`] in which `from`, which must be there, is `to`.
    pub(crate) fn with_change(from: &str, to: &str) -> Self {
        assert!(SCENE.contains(from), "{from} is not in the scene");
        Self::with_scene(&SCENE.replacen(from, to, 1))
    }

    /// A path in it.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Bytes of a file in it.
    pub(crate) fn bytes(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Names in it, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(self.0.path())
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    /// The program, to be run in the folder: no terminal, no colours, a fixed width.
    pub(crate) fn command(&self, line: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_halflight"));
        command
            .args(line.split_whitespace())
            .current_dir(self.0.path())
            .env("COLUMNS", "100")
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        command
    }

    /// Runs the program with the arguments in `line`.
    pub(crate) fn run(&self, line: &str) -> Run {
        self.command(line).output().unwrap().into()
    }

    /// Runs it, expecting success; returns what it printed on stdout.
    pub(crate) fn good(&self, line: &str) -> String {
        let run = self.run(line);
        assert_eq!(run.code, Some(0), "halflight {line}: {run:?}");
        run.stdout
    }

    /// Runs it, expecting that it refuses: code 2, one message on stderr, no panic, nothing on stdout,
    /// and a folder in which nothing has changed. Returns the message.
    pub(crate) fn refused(&self, line: &str) -> String {
        let before = (self.names(), self.contents());
        let run = self.run(line);
        run.assert_refusal(line);
        assert_eq!(before, (self.names(), self.contents()), "halflight {line} has changed the folder");
        run.stderr
    }

    /// Bytes of every file that can be read.
    fn contents(&self) -> Vec<Option<Vec<u8>>> {
        let is_file = |name: &String| fs::metadata(self.path(name)).is_ok_and(|m| m.is_file() && m.len() > 0);
        self.names().iter().filter(|n| is_file(n)).map(|n| fs::read(self.path(n)).ok()).collect()
    }
}

impl Run {
    /// Code 2, one message on stderr, no panic, nothing on stdout.
    pub(crate) fn assert_refusal(&self, line: &str) {
        assert_eq!(self.code, Some(2), "halflight {line}: {self:?}");
        assert_eq!(self.stdout, "", "halflight {line}");
        assert!(self.stderr.starts_with("error: "), "halflight {line}: {self:?}");
        assert_eq!(self.stderr.matches("error: ").count(), 1, "halflight {line}: {self:?}");
        assert!(!self.stderr.contains("panicked"), "halflight {line}: {self:?}");
    }
}

impl From<Output> for Run {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).unwrap(),
            stderr: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

/// Says that a test could not be run here, and why: silence would look like success.
pub(crate) fn not_run(test: &str, why: &str) {
    eprintln!("not run: {test}: {why}");
}
