//! From SCENE on the command line to a description: a file or a built-in scene.

use crate::args::SceneArgs;
use crate::failure::{Failure, without_numbers};
use crate::terminal;
use halflight::build::Description;
use halflight::load::builtin::{BUILTIN, builtin};
use halflight::load::{CameraPath, LoadError, LoadOptions, Problem, load_from};
use std::path::Path;

/// A scene that was read, and what was remarkable about it.
#[derive(Debug)]
pub(crate) struct Found {
    /// The scene.
    pub(crate) description: Description,
    /// The way of a camera that moves.
    pub(crate) camera_path: Option<CameraPath>,
    /// What was read, but not as written.
    pub(crate) warnings: Vec<String>,
}

/// Reads the scene that is meant, the first built-in one when none is named.
///
/// # Errors
/// When there is no such scene, or it cannot be read.
pub(crate) fn find(scene: Option<&Path>, reading: &SceneArgs) -> Result<Found, Failure> {
    let mut found = match scene {
        None => built_in(BUILTIN.first().map_or("", |b| b.name), reading),
        Some(path) => match path.to_str().filter(|name| BUILTIN.iter().any(|b| b.name == *name)) {
            Some(name) => built_in(name, reading),
            None => from_file(path, reading),
        },
    }?;
    if let Some(sky) = reading.sky {
        sky.surround(&mut found.description).map_err(|e| Failure::new(format!("--sky: {e}")))?;
    }
    Ok(found)
}

impl Found {
    /// Prints the warnings; not while a step is shown, whose line they would tear.
    pub(crate) fn print_warnings(&self) {
        for warning in &self.warnings {
            terminal::warning(warning);
        }
    }
}

/// The name of the scene for messages.
pub(crate) fn shown(scene: Option<&Path>) -> String {
    scene.map_or_else(
        || BUILTIN.first().map_or_else(String::new, |b| b.name.to_owned()),
        |path| path.display().to_string(),
    )
}

/// A built-in scene.
fn built_in(name: &str, reading: &SceneArgs) -> Result<Found, Failure> {
    if let Some((parameter, _)) = reading.define.first() {
        return Err(Failure::new(format!("the built-in scene {name} has no parameter \"{parameter}\""))
            .tip(format!("-D is for scene files; halflight export {name} makes one")));
    }
    let description =
        builtin(name).ok_or_else(|| Failure::new(format!("there is no built-in scene {name}")))?;
    Ok(Found { description, camera_path: None, warnings: Vec::new() })
}

/// A scene file.
fn from_file(path: &Path, reading: &SceneArgs) -> Result<Found, Failure> {
    if !path.exists() {
        return Err(missing(path));
    }
    if path.is_dir() {
        return Err(Failure::new(format!("cannot read {}: it is a folder", path.display()))
            .tip("name the scene file in it"));
    }
    let options = LoadOptions { defines: reading.define.clone(), lenient: reading.lenient };
    let loaded = load_from(&reading.files, path, &options)
        .map_err(|e| Failure::new(without_numbers(&e.to_string())).tip(tip(&e, reading.lenient)))?;
    let warnings = loaded.warnings.iter().map(ToString::to_string).collect();
    Ok(Found { description: loaded.description, camera_path: loaded.camera_path, warnings })
}

/// What to do about a scene that is not read.
const fn tip(error: &LoadError, lenient: bool) -> &'static str {
    match error {
        LoadError::Unreadable { .. } => "put the file where the scene looks for it, and let it be read",
        LoadError::Format { .. } => {
            "export the scene as .glb, as Blender does, or name the scene file itself"
        }
        LoadError::Syntax { .. } | LoadError::Json { .. } => "write, export or copy the file anew",
        LoadError::Empty { .. } => "export at least one mesh with the scene",
        LoadError::Element { problem, .. } | LoadError::Item { problem, .. } if !lenient => match **problem {
            Problem::Unknown { .. } | Problem::NotSupported { .. } => {
                "mend it there, or leave out what is not supported with --lenient"
            }
            _ => "mend it there",
        },
        _ => "mend it there",
    }
}

/// Neither a file nor a built-in scene.
fn missing(path: &Path) -> Failure {
    let name = path.display();
    let failure = Failure::new(format!("there is no scene file and no built-in scene {name}"));
    let near = |known: &&str| strsim::damerau_levenshtein(&path.to_string_lossy(), known);
    match BUILTIN.iter().map(|b| b.name).min_by_key(near).filter(|known| near(known) <= 2) {
        Some(known) => {
            failure.tip(format!("did you mean {known}? halflight scenes lists the built-in scenes"))
        }
        None if path.to_string_lossy().contains("://") => {
            failure.tip("halflight reads files only: download it first, with all that belongs to it")
        }
        None if path.to_string_lossy().contains(['.', '/', '\\']) => {
            let folder = std::env::current_dir().unwrap_or_default();
            let folder = folder.display();
            failure
                .tip(format!("it is looked for from {folder} on; halflight scenes lists the built-in ones"))
        }
        None => failure.tip("halflight scenes lists the built-in scenes"),
    }
}
