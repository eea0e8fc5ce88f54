//! What stands outside of the JSON: buffers and pictures, in files, in URIs, or behind the JSON.

use super::container::malformed;
use super::document::Document;
use crate::load::{Files, Problem};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::borrow::ToOwned;
use std::format;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::string::String;
use std::vec::Vec;

/// Most bytes of all buffers together: 4 GiB.
const MAX_BYTES: u64 = 1 << 32;

/// A file that was taken apart, with its buffers.
#[derive(Debug)]
pub(super) struct Source<'f> {
    pub(super) files: &'f Files,
    /// Of the file itself.
    pub(super) path: &'f Path,
    pub(super) document: Document,
    /// `None` for one that has no data of its own, which only unread extensions make sense of.
    buffers: Vec<Option<Vec<u8>>>,
}

/// An entry of a table.
pub(super) fn entry<'t, T>(table: &'t [T], name: &str, index: usize) -> Result<&'t T, Problem> {
    let missing = || malformed(format!("{name}[{index}] does not exist; there are {}", table.len()));
    table.get(index).ok_or_else(missing)
}

impl<'f> Source<'f> {
    /// Reads the buffers.
    ///
    /// # Errors
    /// The index of the buffer that cannot be read, and why.
    pub(super) fn new(
        files: &'f Files,
        path: &'f Path,
        document: Document,
        mut binary: Option<Vec<u8>>,
    ) -> Result<Self, (usize, Problem)> {
        let mut source = Self { files, path, document, buffers: Vec::new() };
        let (mut total, mut buffers) = (0_u64, Vec::new());
        for (index, buffer) in source.document.buffers.iter().enumerate() {
            total = total.saturating_add(buffer.byte_length);
            if total > MAX_BYTES {
                return Err((
                    index,
                    Problem::TooLarge { what: "bytes of buffers", limit: MAX_BYTES as usize },
                ));
            }
            let bytes = match &buffer.uri {
                Some(uri) => Some(source.resource(uri, buffer.byte_length).map_err(|p| (index, p))?),
                None if index == 0 => binary.take(),
                None => None,
            };
            if let Some(bytes) = &bytes
                && (bytes.len() as u64) < buffer.byte_length
            {
                return Err((index, too_short(buffer.byte_length, bytes.len() as u64)));
            }
            buffers.push(bytes);
        }
        source.buffers = buffers;
        Ok(source)
    }

    /// The bytes that a URI means; of a file the first `length`, which it must have.
    pub(super) fn resource(&self, uri: &str, length: u64) -> Result<Vec<u8>, Problem> {
        if let Some(data) = uri.strip_prefix("data:") {
            let (_, base64) =
                data.split_once(";base64,").ok_or_else(|| malformed("its data URI is not in base64"))?;
            return STANDARD.decode(base64).map_err(|e| malformed(format!("its data URI is damaged: {e}")));
        }
        let path = self.file(uri)?;
        let failed = |source| Problem::File { path: path.clone(), source };
        let (reader, has) = self.files.open(&path).map_err(failed)?;
        if has < length {
            return Err(too_short(length, has));
        }
        let mut bytes = Vec::new();
        reader.take(length).read_to_end(&mut bytes).map_err(failed)?;
        Ok(bytes)
    }

    /// The file that a URI names.
    pub(super) fn file(&self, uri: &str) -> Result<PathBuf, Problem> {
        if uri.contains("://") {
            let what = format!("data from {uri}");
            return Err(Problem::NotSupported { what, instead: "put the file beside the scene" });
        }
        let name = percent_decoded(uri).ok_or_else(|| malformed(format!("{uri:?} is not a URI")))?;
        Ok(self.path.with_file_name(name))
    }

    /// The file of a picture, and where that is: bytes within the scene are a file of their own.
    pub(super) fn picture(&self, index: usize) -> Result<(Files, PathBuf), Problem> {
        let image = entry(&self.document.images, "images", index)?;
        let embedded = |bytes| {
            let path = PathBuf::from(format!("images[{index}]"));
            (Files::in_memory([(path.clone(), bytes)]), path)
        };
        match (&image.uri, image.buffer_view) {
            (Some(uri), _) if uri.starts_with("data:") => self.resource(uri, 0).map(embedded),
            (Some(uri), _) => Ok((self.files.clone(), self.file(uri)?)),
            (None, Some(view)) => Ok(embedded(self.view(view)?.0.to_vec())),
            (None, None) => Err(malformed(format!("images[{index}] has neither a uri nor a bufferView"))),
        }
    }

    /// The bytes of a view, and how far apart its elements are.
    pub(super) fn view(&self, index: usize) -> Result<(&[u8], Option<u64>), Problem> {
        let view = entry(&self.document.buffer_views, "bufferViews", index)?;
        entry(&self.document.buffers, "buffers", view.buffer)?;
        let buffer = self
            .buffers
            .get(view.buffer)
            .and_then(Option::as_deref)
            .ok_or_else(|| Problem::Missing { what: format!("the data of buffers[{}]", view.buffer) })?;
        let bytes = slice(buffer, view.byte_offset, view.byte_length);
        let bytes = bytes.map_err(|what| malformed(format!("bufferViews[{index}]: {what}")))?;
        Ok((bytes, view.byte_stride))
    }
}

fn too_short(promised: u64, has: u64) -> Problem {
    malformed(format!("it promises {promised} bytes, but has {has}"))
}

/// A part of some bytes, or what is wrong with it.
pub(super) fn slice(bytes: &[u8], offset: u64, length: u64) -> Result<&[u8], String> {
    let range = || {
        let (start, end) =
            (usize::try_from(offset).ok()?, usize::try_from(offset.checked_add(length)?).ok()?);
        bytes.get(start..end)
    };
    range().ok_or_else(|| {
        format!("{length} bytes from byte {offset} on are more than the {} that there are", bytes.len())
    })
}

/// A URI with its percent signs resolved; `None` when they cannot be.
fn percent_decoded(uri: &str) -> Option<String> {
    if !uri.contains('%') {
        return Some(uri.to_owned());
    }
    let (mut bytes, mut rest) = (Vec::with_capacity(uri.len()), uri.as_bytes());
    while let Some((&first, after)) = rest.split_first() {
        if first == b'%' {
            let code = core::str::from_utf8(after.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(code, 16).ok()?);
            rest = &after[2..];
        } else {
            bytes.push(first);
            rest = after;
        }
    }
    String::from_utf8(bytes).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percent_signs_are_resolved_or_refused() {
        assert_eq!(percent_decoded("a%20b%C3%A9.bin").as_deref(), Some("a bé.bin"));
        for bad in ["%", "%2", "%zz", "%ff"] {
            assert_eq!(percent_decoded(bad), None, "{bad}");
        }
    }

    #[test]
    fn a_part_lies_within_the_whole() {
        assert_eq!(slice(b"abcd", 1, 2), Ok(&b"bc"[..]));
        assert_eq!(slice(b"abcd", 4, 0), Ok(&b""[..]));
        for (offset, length) in [(3, 2), (5, 0), (u64::MAX, 1), (1, u64::MAX), (u64::MAX, u64::MAX)] {
            assert!(slice(b"abcd", offset, length).is_err(), "{offset} {length}");
        }
    }
}
