//! What outlives a process: parts of a picture, and checkpoints.

use crate::driver::Goal;
use crate::failure::{Failure, io_reason, without_numbers};
use crate::output::Output;
use crate::terminal;
use crate::tiles::{self, Aim, Header, Part, Reader, State, Stored, Tile, TilesError};
use halflight::film::PixelRect;
use std::fs::{self, File};
use std::io::{BufReader, BufWriter, ErrorKind};
use std::path::{Path, PathBuf};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

/// Keeps what a render has come to. The default keeps nothing.
#[derive(Debug, Default)]
pub(crate) struct Keeper {
    /// Of what is written; `None` when nothing is.
    header: Option<Header>,
    file: Option<Output>,
    checkpoint: Option<Checkpoint>,
}

/// Where a render goes on after it was killed.
#[derive(Debug)]
struct Checkpoint {
    path: PathBuf,
    every: Duration,
    is_there: bool,
}

/// What a tile is rendered to.
///
/// # Errors
/// For a time: what comes of that depends on the machine.
pub(crate) fn aim(goal: Goal) -> Result<Aim, Failure> {
    match goal {
        Goal::Samples(samples) => Ok(Aim::Samples(samples)),
        Goal::Error { target, most, adaptive } => Ok(Aim::Error { target, most, adaptive }),
        Goal::Time { .. } => {
            Err(Failure::new("--time has no use with --part or --checkpoint: its bits depend on the clock")
                .tip("say --spp or --error instead"))
        }
    }
}

/// Reads the header of a file of tiles.
///
/// # Errors
/// When it cannot be read, or is no such file.
pub(crate) fn open(path: &Path) -> Result<Reader<BufReader<File>>, Failure> {
    let unreadable =
        |e: std::io::Error| Failure::new(format!("cannot read {}: {}", path.display(), io_reason(&e)));
    let file = File::open(path).map_err(unreadable)?;
    let metadata = file.metadata().map_err(unreadable)?;
    if !metadata.is_file() {
        return Err(Failure::new(format!("cannot read {}: it is not a regular file", path.display())));
    }
    Reader::new(BufReader::new(file), metadata.len()).map_err(|e| refused(path, &e))
}

/// A file that is not as it should be.
pub(crate) fn refused(path: &Path, error: &TilesError) -> Failure {
    Failure::new(format!("{} {}", path.display(), without_numbers(&error.to_string())))
        .tip("remove it and render it again; it is not used")
}

/// What is behind a lock, whatever has happened to other holders.
pub(crate) fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Keeper {
    /// Keeps a part in a file.
    ///
    /// * `file` – of the part; `None` when there is none, and only checkpoints are kept
    pub(crate) fn new(header: Header, file: Option<Output>) -> Self {
        Self { header: Some(header), file, checkpoint: None }
    }

    /// Keeps a checkpoint beside the file `beside`, too.
    ///
    /// # Errors
    /// When a checkpoint is there that cannot be used, or none can be written.
    pub(crate) fn with_checkpoint(mut self, beside: &Path, every: Duration) -> Result<Self, Failure> {
        let path = suffixed(beside, ".checkpoint");
        Output::check(&path)?;
        let is_there = path.exists();
        if let (true, Some(header)) = (is_there, &self.header) {
            let reader = open(&path)?;
            let difference = reader.header().difference(header);
            let other_part =
                (reader.header().part != header.part).then(|| "it is of another part".to_owned());
            if let Some(difference) = difference.or(other_part) {
                return Err(Failure::new(format!("{} is of another render: {difference}", path.display()))
                    .tip("remove it, or choose another name with -o"));
            }
        }
        self.checkpoint = Some(Checkpoint { path, every, is_there });
        Ok(self)
    }

    /// The part that is rendered.
    pub(crate) fn part(&self) -> Part {
        self.header.as_ref().map_or(Part::WHOLE, |header| header.part)
    }

    /// True when a killed render can go on.
    pub(crate) const fn has_checkpoint(&self) -> bool {
        self.checkpoint.is_some()
    }

    /// The checkpoint that the render goes on from, when there is one.
    pub(crate) fn resumes(&self) -> Option<&Path> {
        self.checkpoint.as_ref().filter(|c| c.is_there).map(|c| c.path.as_path())
    }

    /// The tiles to begin with: those of the checkpoint, else those of the part, of which nothing is known.
    ///
    /// # Errors
    /// When the checkpoint is damaged.
    pub(crate) fn begin<P: Stored, S: State>(
        &self,
        crop: PixelRect,
        side: u32,
    ) -> Result<Vec<Mutex<Tile<P, S>>>, Failure> {
        let fresh = |(index, rect): (u32, PixelRect)| Tile {
            index,
            rect,
            pixels: vec![P::default(); rect.area()],
            state: S::new(rect),
        };
        let tiles = match self.resumes() {
            Some(path) => open(path)?.tiles().map_err(|e| refused(path, &e))?,
            None => tiles::places(crop, side, self.part()).map(fresh).collect(),
        };
        Ok(tiles.into_iter().map(Mutex::new).collect())
    }

    /// Does something while a checkpoint is written every so often.
    pub(crate) fn while_saving<P: Stored, S: State, R>(
        &self,
        tiles: &[Mutex<Tile<P, S>>],
        work: impl FnOnce() -> R,
    ) -> R {
        let Some(Checkpoint { path, every, .. }) = &self.checkpoint else { return work() };
        thread::scope(|scope| {
            let (done, wait) = channel::<()>();
            scope.spawn(move || {
                while wait.recv_timeout(*every) == Err(RecvTimeoutError::Timeout) {
                    if let Err(failure) = self.save(path, path, tiles, false) {
                        // The render itself is well: it goes on.
                        failure.warn();
                    }
                }
            });
            let result = work();
            drop(done);
            result
        })
    }

    /// Ends: with a part's file, or a last checkpoint when the user has interrupted it.
    ///
    /// # Errors
    /// When the file cannot be written.
    pub(crate) fn end<P: Stored, S: State>(
        &self,
        tiles: &[Mutex<Tile<P, S>>],
        interrupted: bool,
    ) -> Result<(), Failure> {
        match (&self.file, &self.checkpoint) {
            (Some(file), _) if !interrupted => self.save(file.target(), file.path(), tiles, true),
            (_, Some(checkpoint)) if interrupted => {
                self.save(&checkpoint.path, &checkpoint.path, tiles, false)
            }
            _ => Ok(()),
        }
    }

    /// Removes the checkpoint: all is done, and written.
    pub(crate) fn forget(&self) {
        if let Some(Checkpoint { path, .. }) = &self.checkpoint {
            for path in [path, &suffixed(path, UNFINISHED)] {
                match fs::remove_file(path) {
                    Err(e) if e.kind() != ErrorKind::NotFound => {
                        let (path, reason) = (path.display(), io_reason(&e));
                        terminal::warning(&format!(
                            "cannot remove {path}: {reason}; it is not needed any more"
                        ));
                    }
                    _ => {}
                }
            }
        }
    }

    /// Writes a file of the tiles: under another name first, so that at any time the file is whole.
    ///
    /// * `shown` – its name as the user knows it
    fn save<P: Stored, S: State>(
        &self,
        path: &Path,
        shown: &Path,
        tiles: &[Mutex<Tile<P, S>>],
        complete: bool,
    ) -> Result<(), Failure> {
        let Some(header) = &self.header else { return Ok(()) };
        let header = Header { complete, ..header.clone() };
        let unfinished = suffixed(path, UNFINISHED);
        let write = || {
            let mut file = BufWriter::new(File::create(&unfinished)?);
            tiles::write(&mut file, &header, tiles.iter().map(lock))?;
            file.into_inner()?.sync_all()?;
            fs::rename(&unfinished, path)?;
            sync_folder(path)
        };
        write().map_err(|e| {
            // What is there of it is of no use; the failure is told in any case.
            let _ = fs::remove_file(&unfinished);
            Failure::new(format!("cannot write {}: {}", shown.display(), io_reason(&e)))
                .tip("make room, or choose another place with -o")
        })
    }
}

/// What the name of a file ends in while it is written. It is the same every time, so that kills leave one at
/// most.
const UNFINISHED: &str = ".unfinished";

/// Makes the new name last: renaming changes the folder.
#[cfg(unix)]
fn sync_folder(path: &Path) -> std::io::Result<()> {
    match path.parent() {
        Some(folder) if folder != Path::new("") => File::open(folder)?.sync_all(),
        _ => File::open(".")?.sync_all(),
    }
}

/// Elsewhere folders cannot be opened.
#[cfg(not(unix))]
fn sync_folder(_: &Path) -> std::io::Result<()> {
    Ok(())
}

/// A file's name with something behind it.
fn suffixed(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    name.into()
}
