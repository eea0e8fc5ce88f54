//! Where the files of a scene are: on the disk, or in memory.

use core::hint::black_box;
use std::borrow::ToOwned;
use std::collections::{BTreeMap, BTreeSet};
use std::format;
use std::fs::{self, File};
use std::io::{self, BufReader, Cursor, ErrorKind, Read, Seek, SeekFrom};
use std::path::{Component, Path, PathBuf};
use std::sync::{Arc, Mutex};
use std::vec::Vec;

/// Where the files of a scene are.
#[derive(Debug, Clone, Default)]
pub struct Files {
    /// By path; `None` is the disk.
    memory: Option<Arc<BTreeMap<PathBuf, Arc<[u8]>>>>,
    /// Those asked for so far, if they are kept.
    seen: Option<Arc<Mutex<BTreeSet<PathBuf>>>>,
}

impl Files {
    /// Those of the disk.
    #[must_use]
    pub const fn on_disk() -> Self {
        Self { memory: None, seen: None }
    }

    /// The same files; [`Files::seen`] tells which were asked for.
    #[must_use]
    pub fn recorded(self) -> Self {
        Self { seen: Some(Arc::default()), ..self }
    }

    /// The files that were asked for since [`Files::recorded`], missing ones among them, in order of their
    /// paths.
    #[must_use]
    pub fn seen(&self) -> Vec<PathBuf> {
        let seen = self.seen.as_ref().and_then(|seen| seen.lock().ok());
        seen.map(|seen| seen.iter().cloned().collect()).unwrap_or_default()
    }

    /// Keeps that a file was asked for.
    fn record(&self, path: &Path) {
        if let Some(Ok(mut seen)) = self.seen.as_ref().map(|seen| seen.lock())
            && !seen.contains(path)
        {
            seen.insert(path.to_owned());
        }
    }

    /// Some that are in memory, by path, and no others. A file is also found by its name alone, where
    /// only one has it: who was handed a few files need not know their folders.
    #[must_use]
    pub fn in_memory(files: impl IntoIterator<Item = (PathBuf, Vec<u8>)>) -> Self {
        let files = files.into_iter().map(|(path, bytes)| (plain(&path), Arc::from(bytes)));
        Self { memory: Some(Arc::new(files.collect())), seen: None }
    }

    /// Opens a file; with its length in bytes.
    pub(super) fn open(&self, path: &Path) -> io::Result<(BufReader<Opened>, u64)> {
        self.record(path);
        let (file, bytes) = match &self.memory {
            None => {
                let file = File::open(path)?;
                let bytes = file.metadata()?.len();
                room_for(bytes.saturating_mul(MADE_OF_A_BYTE))?;
                (Opened::Disk(file), bytes)
            }
            Some(files) => {
                let bytes = find(files, path).ok_or_else(not_given)?;
                (Opened::Memory(Cursor::new(bytes.clone())), bytes.len() as u64)
            }
        };
        Ok((BufReader::with_capacity(1 << 16, file), bytes))
    }

    /// All bytes of a file.
    pub(super) fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        self.record(path);
        match &self.memory {
            None => fs::read(path),
            Some(files) => find(files, path).map(|bytes| bytes.to_vec()).ok_or_else(not_given),
        }
    }

    /// True when there is such a file.
    pub(super) fn has(&self, path: &Path) -> bool {
        self.record(path);
        match &self.memory {
            None => path.exists(),
            Some(files) => find(files, path).is_some(),
        }
    }

    /// The one path of a file that may have several; `None` when there is no such file.
    pub(super) fn canonical(&self, path: &Path) -> Option<PathBuf> {
        match &self.memory {
            None => path.canonicalize().ok(),
            Some(files) => find(files, path).map(|_| plain(path)),
        }
    }
}

/// Bytes that become of one in a file, or more: meshes of large scenes take twice the room of a binary PLY.
const MADE_OF_A_BYTE: u64 = 2;

/// Asks for memory as a whole, and gives it back: what is not granted now would end the program later.
///
/// # Errors
/// When there is less.
pub(super) fn room_for(bytes: u64) -> io::Result<()> {
    let mut probe = Vec::<u8>::new();
    let granted = usize::try_from(bytes).is_ok_and(|bytes| probe.try_reserve_exact(bytes).is_ok());
    black_box(&probe);
    if granted {
        return Ok(());
    }
    let what = format!("it needs {} MiB of memory, more than there is", bytes >> 20);
    Err(io::Error::new(ErrorKind::OutOfMemory, what))
}

/// A file that is open.
pub(super) enum Opened {
    /// On the disk.
    Disk(File),
    /// In memory.
    Memory(Cursor<Arc<[u8]>>),
}

impl Read for Opened {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::Disk(file) => file.read(into),
            Self::Memory(bytes) => bytes.read(into),
        }
    }
}

impl Seek for Opened {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        match self {
            Self::Disk(file) => file.seek(to),
            Self::Memory(bytes) => bytes.seek(to),
        }
    }
}

fn not_given() -> io::Error {
    io::Error::new(ErrorKind::NotFound, "the file is not among those that were given")
}

/// A path without `.`, `..` and root.
fn plain(path: &Path) -> PathBuf {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::Normal(name) => plain.push(name),
            Component::ParentDir => {
                plain.pop();
            }
            Component::CurDir | Component::RootDir | Component::Prefix(_) => {}
        }
    }
    plain
}

fn find<'f>(files: &'f BTreeMap<PathBuf, Arc<[u8]>>, path: &Path) -> Option<&'f Arc<[u8]>> {
    let path = plain(path);
    files.get(&path).or_else(|| {
        let mut named = files.iter().filter(|(other, _)| other.file_name() == path.file_name());
        let (_, bytes) = named.next()?;
        named.next().is_none().then_some(bytes)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec;

    fn files(names: &[&str]) -> Files {
        Files::in_memory(names.iter().map(|name| (PathBuf::from(name), name.as_bytes().to_vec())))
    }

    #[test]
    fn a_file_is_found_by_its_path_or_by_a_name_that_only_one_has() {
        let files = files(&["a/x.ply", "b/x.ply", "b/y.ply", "top.xml"]);
        let read = |path: &str| files.read(Path::new(path)).ok();
        assert_eq!(read("a/./x.ply"), Some(b"a/x.ply".to_vec()));
        assert_eq!(read("/b/c/../x.ply"), Some(b"b/x.ply".to_vec()));
        assert_eq!(read("elsewhere/y.ply"), Some(b"b/y.ply".to_vec()));
        assert_eq!((read("x.ply"), read("z.ply"), read("")), (None, None, None));
        assert!(files.has(Path::new("../top.xml")) && !files.has(Path::new("Top.xml")));
        assert_eq!(files.canonical(Path::new("a/../top.xml")), Some(PathBuf::from("top.xml")));
    }

    #[test]
    fn memory_that_no_machine_has_is_not_granted() {
        assert!(room_for(1 << 10).is_ok());
        for bytes in [u64::MAX, 1 << 60] {
            assert_eq!(room_for(bytes).unwrap_err().kind(), ErrorKind::OutOfMemory);
        }
    }

    #[test]
    fn what_was_asked_for_is_known() {
        let files = files(&["a/x.ply"]).recorded();
        assert!(files.seen().is_empty());
        let same = files.clone();
        let _ =
            (same.open(Path::new("b.xml")), same.read(Path::new("a/x.ply")), same.read(Path::new("b.xml")));
        assert_eq!(files.seen(), [PathBuf::from("a/x.ply"), PathBuf::from("b.xml")]);
    }

    #[test]
    fn what_is_open_can_be_read_and_sought() {
        let (mut file, bytes) = files(&["name"]).open(Path::new("name")).unwrap();
        assert_eq!(bytes, 4);
        file.seek(SeekFrom::End(-2)).unwrap();
        let mut rest = vec![];
        file.read_to_end(&mut rest).unwrap();
        assert_eq!(rest, b"me");
    }
}
