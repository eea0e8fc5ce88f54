//! Output files: checked before the work, written whole or not at all.

use crate::failure::{Failure, io_reason};
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// A place for a file, of which all that can be known beforehand has been checked.
#[derive(Debug, Clone)]
pub(crate) struct Output {
    /// As the user wrote it, for messages.
    shown: PathBuf,
    /// Where the bytes go: the file behind a link.
    target: PathBuf,
}

impl Output {
    /// Checks that a file can be put at `path`.
    ///
    /// # Errors
    /// When its folder is missing or closed to us, or when something else is there.
    pub(crate) fn check(path: &Path) -> Result<Self, Failure> {
        let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
        let output = Self { shown: path.to_owned(), target };
        output.check_what_is_there()?;
        output.check_folder()?;
        // Only trying tells whether a file may be made here. It is gone when it leaves this scope.
        output.temporary()?;
        Ok(output)
    }

    /// Where the bytes go: the file behind a link.
    pub(crate) fn target(&self) -> &Path {
        &self.target
    }

    /// As the user wrote it.
    pub(crate) fn path(&self) -> &Path {
        &self.shown
    }

    /// Writes the file: under a temporary name in the same folder, then renamed.
    ///
    /// # Errors
    /// When the system refuses, for example as the disk is full. What was there before stays.
    pub(crate) fn write(&self, bytes: &[u8]) -> Result<(), Failure> {
        let mut file = self.temporary()?;
        file.write_all(bytes).and_then(|()| file.as_file().sync_all()).map_err(|e| {
            self.failure(&io_reason(&e)).tip("nothing was written; make room or choose another place with -o")
        })?;
        file.persist(&self.target).map_err(|e| self.failure(&io_reason(&e.error)))?;
        Ok(())
    }

    /// Whatever is at the target must be a file that may be replaced.
    fn check_what_is_there(&self) -> Result<(), Failure> {
        let Ok(metadata) = fs::metadata(&self.target) else { return Ok(()) };
        if metadata.is_dir() {
            return Err(self.failure("it is a folder").tip("give the name of a file"));
        }
        if !metadata.is_file() {
            return Err(self.failure("it is not a regular file").tip("give the name of a file"));
        }
        if metadata.permissions().readonly() {
            return Err(self.failure("it is write-protected").tip("choose another name with -o"));
        }
        Ok(())
    }

    /// The folder must exist.
    fn check_folder(&self) -> Result<(), Failure> {
        let folder = self.folder();
        match fs::metadata(folder) {
            Ok(metadata) if metadata.is_dir() => Ok(()),
            Ok(_) => Err(self.failure(&format!("{} is not a folder", folder.display()))),
            Err(e) if e.kind() == std::io::ErrorKind::NotFound => Err(self
                .failure(&format!("the folder {} does not exist", folder.display()))
                .tip("make the folder first, or choose another place with -o")),
            Err(e) => Err(self.failure(&io_reason(&e))),
        }
    }

    /// The folder that holds the file.
    fn folder(&self) -> &Path {
        match self.target.parent() {
            Some(folder) if folder != Path::new("") => folder,
            _ => Path::new("."),
        }
    }

    /// A file beside the target that vanishes unless it is renamed.
    fn temporary(&self) -> Result<NamedTempFile, Failure> {
        let mut builder = Builder::new();
        builder.prefix(".halflight-").suffix(".partial");
        // As open(2) would: the default of a temporary file is for its owner's eyes only.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
        builder.tempfile_in(self.folder()).map_err(|e| {
            let reason = e.get_ref().map_or_else(|| io_reason(&e), |_| io_reason(&e.kind().into()));
            self.failure(&reason).tip("choose another place with -o")
        })
    }

    /// A failure to write this file.
    fn failure(&self, reason: &str) -> Failure {
        Failure::new(format!("cannot write {}: {reason}", self.shown.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Names in a folder.
    fn names(folder: &Path) -> Vec<String> {
        fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect()
    }

    #[test]
    fn a_check_leaves_nothing_behind() {
        let folder = tempfile::tempdir().unwrap();
        Output::check(&folder.path().join("a.png")).unwrap();
        assert_eq!(names(folder.path()), Vec::<String>::new());
    }

    #[test]
    fn a_file_is_replaced_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        fs::write(&path, "a longer text than the new one").unwrap();
        Output::check(&path).unwrap().write(b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(folder.path()), ["a.png"]);
    }

    #[test]
    fn places_for_which_there_is_no_file_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        assert!(Output::check(folder.path()).is_err());
        assert!(Output::check(&folder.path().join("missing/a.png")).is_err());
        fs::write(folder.path().join("file"), "").unwrap();
        assert!(Output::check(&folder.path().join("file/a.png")).is_err());
    }

    #[cfg(unix)]
    #[test]
    fn a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file.png"), folder.path().join("link.png"));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        Output::check(&link).unwrap().write(b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
    }
}
