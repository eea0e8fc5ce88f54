//! Scenes as files: what is read, what is refused and how, and what is written.
#![cfg(feature = "load")]

mod camera_paths;
mod environments;
mod errors;
mod export;
mod files;
mod geometry;
mod gltf;
mod gltf_environment;
mod gltf_hostile;
mod portals;
mod scenes;
mod textures;

use halflight::build::Description;
use halflight::load::{LoadError, LoadOptions, Loaded, load};
use std::fs;
use std::path::PathBuf;

/// Where a test has its files: tests run at the same time.
fn place(name: &str) -> PathBuf {
    let test = std::thread::current().name().unwrap_or("main").replace(':', "-");
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("load").join(test).join(name)
}

/// An empty folder for one test.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = place(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("the folder for tests can be made");
    folder
}

/// Writes files into an empty folder and reads the first of them.
pub(crate) fn load_files(
    name: &str,
    files: &[(&str, &str)],
    options: &LoadOptions,
) -> Result<Loaded, LoadError> {
    let folder = folder(name);
    for (file, text) in files {
        let path = folder.join(file);
        fs::create_dir_all(path.parent().expect("files are in a folder")).expect("folders can be made");
        fs::write(path, text).expect("files can be written");
    }
    load(&folder.join(files[0].0), options)
}

/// Reads a scene from the elements in it; they start on line 2.
pub(crate) fn load_body(name: &str, body: &str) -> Result<Loaded, LoadError> {
    let text = format!("<scene version=\"3.0.0\">\n{body}\n</scene>\n");
    load_files(name, &[("scene.xml", &text)], &LoadOptions::default())
}

/// The scene of some elements that are well.
pub(crate) fn scene(name: &str, body: &str) -> Description {
    match load_body(name, body) {
        Ok(loaded) => loaded.description,
        Err(error) => panic!("{error}"),
    }
}

/// The message for some elements that are not, without the folder.
pub(crate) fn refusal(name: &str, body: &str) -> String {
    match load_body(name, body) {
        Ok(loaded) => panic!("this must be refused: {body}\n{:#?}", loaded.description),
        Err(error) => message(name, &error),
    }
}

/// An error's text, without the folder.
pub(crate) fn message(name: &str, error: &LoadError) -> String {
    error.to_string().replace(&format!("{}/", place(name).display()), "")
}
