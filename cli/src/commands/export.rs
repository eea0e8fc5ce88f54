//! `halflight export`: a scene as Mitsuba 3 XML.

use crate::args::ExportArgs;
use crate::failure::{Exit, Failure, without_numbers};
use crate::output::Output;
use crate::progress::Step;
use crate::{scene, terminal};
use halflight::load::export_mitsuba;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Reads a scene and writes it as XML, its meshes beside it.
pub(crate) fn run(args: &ExportArgs) -> Result<Exit, Failure> {
    let path = target(args);
    if path.extension().and_then(OsStr::to_str) != Some("xml") {
        return Err(Failure::new(format!("cannot write {}: scenes are written as .xml", path.display()))
            .tip("end the name in .xml"));
    }
    let output = Output::check(&path)?;
    if same_file(&path, &args.scene) {
        return Err(Failure::new(format!("{} is the scene itself", path.display()))
            .tip("choose another file with -o"));
    }
    let found = {
        let _step = Step::begin(format!("reading {}", args.scene.display()), false);
        scene::find(Some(&args.scene), &args.reading)?
    };
    found.print_warnings();
    {
        let _step = Step::begin(format!("writing {}", path.display()), false);
        export_mitsuba(&found.description, output.path())
            .map_err(|e| Failure::new(format!("cannot write {}", without_numbers(&e.to_string()))))?;
    }
    terminal::result(&path.display().to_string())?;
    Ok(Exit::Good)
}

/// True when both lead to one file.
fn same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// Where the scene is written.
fn target(args: &ExportArgs) -> PathBuf {
    args.output.clone().unwrap_or_else(|| {
        let stem = args.scene.file_stem().unwrap_or(OsStr::new("scene"));
        Path::new(stem).with_extension("xml")
    })
}
