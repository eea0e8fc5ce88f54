//! `halflight export`: a scene as Mitsuba 3 XML, as Rust source or as bytes.

use crate::args::{ExportArgs, SceneFormat};
use crate::failure::{Exit, Failure, without_numbers};
use crate::output::Output;
use crate::progress::Step;
use crate::{scene, terminal};
use halflight::load::{export_bytes, export_mitsuba, export_rust};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// Reads a scene and writes it: as XML with its meshes beside it, or as one file.
pub(crate) fn run(args: &ExportArgs) -> Result<Exit, Failure> {
    let (path, format) = target(args)?;
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
        let export = match format {
            SceneFormat::Xml => export_mitsuba,
            SceneFormat::Rust => export_rust,
            SceneFormat::Bytes => export_bytes,
        };
        export(&found.description, output.path())
            .map_err(|e| Failure::new(format!("cannot write {}", without_numbers(&e.to_string()))))?;
    }
    terminal::result(&path.display().to_string())?;
    Ok(Exit::Good)
}

/// True when both lead to one file.
fn same_file(a: &Path, b: &Path) -> bool {
    matches!((a.canonicalize(), b.canonicalize()), (Ok(a), Ok(b)) if a == b)
}

/// Where the scene is written, and how: as is asked for, as the file's name says, or as XML.
fn target(args: &ExportArgs) -> Result<(PathBuf, SceneFormat), Failure> {
    let named = args.output.as_deref().and_then(Path::extension);
    let by_name = SceneFormat::ALL.into_iter().find(|f| named == Some(f.extension().as_ref()));
    let format = args.format.or(by_name);
    let Some(path) = &args.output else {
        let format = format.unwrap_or(SceneFormat::Xml);
        let stem = args.scene.file_stem().unwrap_or(OsStr::new("scene"));
        return Ok((Path::new(stem).with_extension(format.extension()), format));
    };
    match (format, by_name) {
        (Some(format), Some(ending)) if format == ending => Ok((path.clone(), format)),
        _ => Err(Failure::new(format!(
            "cannot write {}: scenes are written as .xml, .rs or .scene",
            path.display()
        ))
        .tip(format!("end the name in .{}", format.unwrap_or(SceneFormat::Xml).extension()))),
    }
}
