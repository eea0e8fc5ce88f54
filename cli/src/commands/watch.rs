//! `halflight render --watch`: the picture anew whenever the scene changes.
//!
//! The times of the files are looked at a few times a second. They are few, and unlike the system's own notices
//! that works over networks, where editors put a new file in the place of the old one, and for files that are
//! missing so far; and it needs no other crate.

use super::render;
use crate::args::RenderArgs;
use crate::failure::{Exit, Failure};
use crate::interrupt::on_interrupt;
use crate::number::counted;
use crate::scene;
use crate::terminal;
use halflight::load::Files;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{scope, sleep};
use std::time::{Duration, SystemTime};

/// Between two looks at the files.
const PAUSE: Duration = Duration::from_millis(150);

/// When a file was last changed, and its bytes; `None` while it is missing.
type Stamp = Option<(SystemTime, u64)>;

/// Files, as they were when they were first looked at.
#[derive(Debug, Default)]
struct Watched(BTreeMap<PathBuf, Stamp>);

/// Renders until interrupted. An error in the scene is printed, and mending it is waited for.
pub(crate) fn run(args: &RenderArgs) -> Result<Exit, Failure> {
    let stop = on_interrupt()?;
    let scene = match &args.scene {
        Some(path) if path.is_file() => path,
        other => return Err(nothing_to_watch(other.as_deref())),
    };
    let mut watched = Watched::default();
    loop {
        let mut args = args.clone();
        args.reading.files = Files::on_disk().recorded();
        watched.add(vec![scene.clone()]);
        let (result, has_changed) = render_watched(&args, &mut watched, &stop);
        if !has_changed {
            match result {
                Ok(Exit::Interrupted) => return Ok(Exit::Interrupted),
                Ok(_) => {}
                Err(failure) => _ = failure.report(),
            }
            if !args.quiet {
                let files = counted(watched.0.len() as u64, "file");
                terminal::remark(format!("watching {files}; Ctrl-C ends it"));
            }
            while !watched.has_changed() {
                if stop.load(Ordering::Relaxed) {
                    return Ok(Exit::Interrupted);
                }
                sleep(PAUSE);
            }
        }
        watched.settle();
        stop.store(false, Ordering::Relaxed);
    }
}

/// Renders once, but not to the end when a file changes meanwhile; says whether one has.
fn render_watched(
    args: &RenderArgs,
    watched: &mut Watched,
    stop: &AtomicBool,
) -> (Result<Exit, Failure>, bool) {
    let (done, has_changed) = (AtomicBool::new(false), AtomicBool::new(false));
    let result = scope(|scope| {
        scope.spawn(|| {
            while !done.load(Ordering::Relaxed) {
                watched.add(args.reading.files.seen());
                if watched.has_changed() && !stop.load(Ordering::Relaxed) {
                    has_changed.store(true, Ordering::Relaxed);
                    stop.store(true, Ordering::Relaxed);
                    return;
                }
                sleep(PAUSE);
            }
        });
        let result = render::run_whole(args);
        done.store(true, Ordering::Relaxed);
        result
    });
    watched.add(args.reading.files.seen());
    (result, has_changed.into_inner())
}

impl Watched {
    /// Watches more files.
    fn add(&mut self, paths: Vec<PathBuf>) {
        for path in paths {
            let now = stamp(&path);
            self.0.entry(path).or_insert(now);
        }
    }

    /// True when one is not as it was.
    fn has_changed(&self) -> bool {
        self.0.iter().any(|(path, then)| stamp(path) != *then)
    }

    /// Waits until no file changes any more: one that is being written is half a file.
    fn settle(&mut self) {
        while self.has_changed() {
            self.0.iter_mut().for_each(|(path, then)| *then = stamp(path));
            sleep(PAUSE);
        }
    }
}

/// As a file is now.
fn stamp(path: &Path) -> Stamp {
    let metadata = fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

/// What cannot change.
fn nothing_to_watch(scene: Option<&Path>) -> Failure {
    let name = scene::shown(scene);
    Failure::new(format!("--watch has nothing to watch: {name} is no file"))
        .tip("halflight export NAME makes a file of a built-in scene")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_that_changes_comes_or_goes_is_noticed() {
        let folder = tempfile::tempdir().unwrap();
        let (here, missing) = (folder.path().join("here"), folder.path().join("missing"));
        fs::write(&here, "a").unwrap();
        let mut watched = Watched::default();
        watched.add(vec![here.clone(), missing.clone()]);
        assert!(!watched.has_changed());
        fs::write(&missing, "").unwrap();
        assert!(watched.has_changed());
        watched.settle();
        assert!(!watched.has_changed());
        fs::write(&here, "ab").unwrap();
        assert!(watched.has_changed());
        watched.settle();
        fs::remove_file(&here).unwrap();
        assert!(watched.has_changed());
    }
}
