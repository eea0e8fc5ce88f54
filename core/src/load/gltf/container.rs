//! The outside of a glTF file: GLB chunks, JSON, version, extensions.

use super::document::{Document, Versioned};
use crate::load::{LoadError, Problem};
use std::borrow::ToOwned;
use std::format;
use std::path::Path;
use std::string::{String, ToString};
use std::vec::Vec;

/// What is read of extensions.
const EXTENSIONS: [&str; 5] = [
    "EXT_lights_image_based",
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

/// A file's JSON, and the binary data behind it.
#[derive(Debug)]
pub(super) struct Container {
    pub(super) document: Document,
    pub(super) binary: Option<Vec<u8>>,
    /// Extensions that are used but not read.
    pub(super) unread: Vec<String>,
}

/// Takes a file apart.
///
/// * `lenient` – takes extensions that the file says are required, but are not read, for others
pub(super) fn open(path: &Path, bytes: &[u8], lenient: bool) -> Result<Container, LoadError> {
    let (json, binary) = if bytes.starts_with(b"glTF") {
        chunks(bytes).map_err(|what| item(path, "the GLB container", malformed(what)))?
    } else {
        (bytes, None)
    };
    let refused = |source: &serde_json::Error| LoadError::Json {
        path: path.to_owned(),
        line: source.line(),
        column: source.column(),
        what: if source.is_eof() { "it ends here".to_owned() } else { without_place(source) },
    };
    let versioned: Versioned = serde_json::from_slice(json).map_err(|e| refused(&e))?;
    let version = versioned.asset.min_version.unwrap_or(versioned.asset.version);
    if version != "2.0" {
        let what = format!("version {version} of glTF");
        return Err(item(path, "asset", Problem::NotSupported { what, instead: "export as glTF 2.0" }));
    }
    let document: Document = serde_json::from_slice(json).map_err(|e| refused(&e))?;
    let known = |name: &String| EXTENSIONS.contains(&name.as_str());
    if let Some(name) = document.extensions_required.iter().find(|name| !known(name) && !lenient) {
        let problem = Problem::NotSupported { what: format!("the extension {name}"), instead: instead(name) };
        return Err(item(path, "extensionsRequired", problem));
    }
    let unread = document.extensions_used.iter().filter(|name| !known(name)).cloned().collect();
    Ok(Container { document, binary: binary.map(<[u8]>::to_vec), unread })
}

/// What to do about an extension.
fn instead(name: &str) -> &'static str {
    match name {
        "KHR_draco_mesh_compression" | "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
            "export without compression of meshes"
        }
        "KHR_texture_basisu" | "EXT_texture_webp" | "EXT_texture_avif" => "export textures as PNG or JPEG",
        _ => "export without it, or leave it out with --lenient",
    }
}

/// A part of the file and what is wrong with it.
pub(super) fn item(path: &Path, item: &str, problem: Problem) -> LoadError {
    LoadError::Item { path: path.to_owned(), item: item.to_owned(), problem: problem.into() }
}

/// Something that breaks the rules of the format.
pub(super) fn malformed(what: impl Into<String>) -> Problem {
    Problem::Malformed { what: what.into() }
}

/// The message, whose end repeats line and column.
fn without_place(error: &serde_json::Error) -> String {
    let text = error.to_string();
    text.rsplit_once(" at line ").map_or(text.clone(), |(what, _)| what.to_owned())
}

/// The JSON chunk of a GLB file and the binary one.
///
/// Source: glTF 2.0 Specification, section 4.4.
fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), String> {
    let word = |at: usize| -> Option<u32> {
        let word = bytes.get(at..at.checked_add(4)?)?;
        Some(u32::from_le_bytes(word.try_into().ok()?))
    };
    let ended = || format!("the file ends after {} bytes, within a header", bytes.len());
    let version = word(4).ok_or_else(ended)?;
    if version != 2 {
        return Err(format!("its version is {version}; only 2 is read"));
    }
    let promised = word(8).ok_or_else(ended)? as usize;
    if promised > bytes.len() {
        return Err(format!("it promises {promised} bytes, but the file has {}", bytes.len()));
    }
    let (mut at, mut json, mut binary) = (12, None, None);
    while at < promised && (json.is_none() || binary.is_none()) {
        let (length, kind) = (word(at).ok_or_else(ended)? as usize, word(at + 4).ok_or_else(ended)?);
        let end = (at + 8).checked_add(length).filter(|end| *end <= promised);
        let end = end.ok_or_else(|| format!("a chunk of {length} bytes reaches beyond its end"))?;
        match &kind.to_le_bytes() {
            b"JSON" if json.is_none() => json = Some(&bytes[at + 8..end]),
            b"BIN\0" if binary.is_none() => binary = Some(&bytes[at + 8..end]),
            _ => {}
        }
        at = end;
    }
    json.map(|json| (json, binary)).ok_or_else(|| "it has no JSON chunk".to_owned())
}
