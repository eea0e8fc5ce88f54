//! Several pictures of one scene, which is read and built once.

use super::keeping::Destination;
use super::render::{Prepared, check, pool, prepare};
use crate::args::RenderArgs;
use crate::failure::{Exit, Failure};
use crate::goal;
use crate::scene;
use crate::terminal;
use std::path::PathBuf;
use std::time::Instant;

/// A picture of a scene.
#[derive(Debug, Clone)]
pub(super) struct Shot {
    /// Where the camera is on its way (s); `None` for the scene's camera as it is.
    pub(super) time: Option<f64>,
    /// Its file.
    pub(super) output: PathBuf,
}

/// Renders pictures of a scene. What is interrupted is not written.
///
/// # Errors
/// When one cannot be rendered or written; those before it are there.
pub(super) fn shoot(args: &RenderArgs, shots: &[Shot]) -> Result<Exit, Failure> {
    let begin = Instant::now();
    check(args)?;
    let of = |shot: &Shot| RenderArgs { output: shot.output.clone(), ..args.clone() };
    let files: Vec<_> = shots.iter().map(|shot| Destination::check(&of(shot))).collect::<Result<_, _>>()?;
    let pool = pool(args.threads)?;
    let mut prepared = prepare(args, begin)?;
    if let Some(files) = files.first() {
        prepared.warn_of(args, files)?;
    }
    let known = prepared.found.warnings.len();
    let mut exit = Exit::Good;
    for (i, (shot, files)) in shots.iter().zip(&files).enumerate() {
        if i > 0 {
            prepared.goal = goal::make(args, &prepared.found.description, Instant::now())?;
            prepared.found.warnings.truncate(known);
        }
        if let Some(time) = shot.time {
            aim(&mut prepared, args, time)?;
        }
        match prepared.picture(&of(shot), files, &pool, false)? {
            Exit::Good => {}
            Exit::Interrupted => {
                let file = shot.output.display();
                terminal::remark(format!("interrupted: the same command goes on with {file}"));
                return Ok(Exit::Interrupted);
            }
            failed @ Exit::CheckFailed => exit = failed,
        }
    }
    Ok(exit)
}

/// Takes the camera to where it is at a time (s).
fn aim(prepared: &mut Prepared, args: &RenderArgs, time: f64) -> Result<(), Failure> {
    let name = scene::shown(args.scene.as_deref());
    let Some(path) = &prepared.found.camera_path else {
        return Err(Failure::new(format!("the camera of {name} does not move: it has no frames"))
            .tip("animate the camera of a glTF scene, or put several <sensor>s into a Mitsuba scene"));
    };
    let camera = path.at(time).ok_or_else(|| {
        Failure::new(format!("{name}: the camera has no direction at {time} s"))
            .tip("mend the animation there, or leave the frame out")
    })?;
    prepared.camera = camera.camera(prepared.film.width(), prepared.film.height()).map_err(Failure::new)?;
    Ok(())
}
