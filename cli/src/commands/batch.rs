//! `halflight render` of several scenes, or of a camera's way: a file for each picture.

use super::shots::{Shot, shoot};
use crate::args::{Frames, RenderArgs};
use crate::failure::{Exit, Failure};
use crate::number::counted;
use crate::picture::read;
use crate::scene;
use crate::terminal;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

/// Frames of a second, where the user does not say.
pub(super) const RATE: f64 = 24.0;

/// True when there are several pictures to render.
pub(crate) fn is_asked(args: &RenderArgs) -> bool {
    !args.more.is_empty() || args.frames.is_some()
}

/// Renders them in turn, but for those that exist whole.
pub(crate) fn run(args: &RenderArgs) -> Result<Exit, Failure> {
    check(args)?;
    let scenes = args.scene.iter().chain(&args.more).map(|scene| Some(scene.as_path()));
    let scenes: Vec<_> = if args.scene.is_some() { scenes.collect() } else { vec![None] };
    let shots: Vec<Vec<Shot>> = scenes.iter().map(|scene| shots_of(args, *scene)).collect();
    check_apart(&scenes, &shots)?;
    let mut exit = Exit::Good;
    for (scene, shots) in scenes.into_iter().zip(shots) {
        let all = shots.len();
        let missing: Vec<_> =
            shots.into_iter().filter(|shot| args.overwrite || !is_whole(&shot.output)).collect();
        if missing.len() < all && !args.quiet {
            let (kept, name) = (counted((all - missing.len()) as u64, "picture"), scene::shown(scene));
            terminal::remark(format!("{name}: kept {kept} that exist whole; --overwrite renders all anew"));
        }
        if missing.is_empty() {
            continue;
        }
        let args = RenderArgs { scene: scene.map(Path::to_owned), more: Vec::new(), ..args.clone() };
        match shoot(&args, &missing)? {
            Exit::Good => {}
            Exit::Interrupted => return Ok(Exit::Interrupted),
            failed @ Exit::CheckFailed => exit = failed,
        }
    }
    Ok(exit)
}

/// Refuses what names one file for several pictures.
fn check(args: &RenderArgs) -> Result<(), Failure> {
    let beside = [("--samples-image", &args.samples_image), ("--visibility-image", &args.visibility_image)];
    if let Some((flag, _)) = beside.iter().find(|(_, file)| file.is_some()) {
        return Err(Failure::new(format!("{flag} names one file, and there are several pictures"))
            .tip(format!("leave {flag} out; --layers keeps both in .exr files")));
    }
    let output = args.output.to_string_lossy();
    if !args.more.is_empty() && !output.contains(NAME) && !is_folder(&args.output) {
        let scenes = args.more.len() + 1;
        return Err(Failure::new(format!(
            "{scenes} scenes make {scenes} pictures, and -o {output} names one"
        ))
        .tip("-o out/ writes out/NAME.png for each; -o 'out/{name}.exr' says how they are named"));
    }
    Ok(())
}

/// The pictures of a scene.
fn shots_of(args: &RenderArgs, scene: Option<&Path>) -> Vec<Shot> {
    let shown = scene::shown(scene);
    let name =
        Path::new(&shown).file_stem().map_or_else(|| shown.clone(), |n| n.to_string_lossy().into_owned());
    match args.frames {
        None => vec![Shot { time: None, output: place(&args.output, &name, None) }],
        Some(Frames { first, last }) => (first..=last)
            .map(|frame| Shot {
                time: Some(f64::from(frame) / args.fps.map_or(RATE, f64::from)),
                output: place(&args.output, &name, Some(frame)),
            })
            .collect(),
    }
}

/// Refuses two pictures of one name.
fn check_apart(scenes: &[Option<&Path>], shots: &[Vec<Shot>]) -> Result<(), Failure> {
    let mut seen = HashMap::new();
    for (scene, shots) in scenes.iter().zip(shots) {
        for Shot { output, .. } in shots {
            if let Some(other) = seen.insert(output, scene) {
                let (one, two) = (scene::shown(*other), scene::shown(*scene));
                let message = format!("{one} and {two} would both be written to {}", output.display());
                return Err(
                    Failure::new(message).tip("render them into different folders, one after the other")
                );
            }
        }
    }
    Ok(())
}

/// Stands for the scene's name in the name of a file.
const NAME: &str = "{name}";

/// True for a path that is a folder, or looks like one.
fn is_folder(path: &Path) -> bool {
    path.to_string_lossy().ends_with(['/', std::path::MAIN_SEPARATOR]) || path.is_dir()
}

/// Where a picture goes.
fn place(output: &Path, name: &str, frame: Option<u32>) -> PathBuf {
    let output = if is_folder(output) { output.join("{name}.png") } else { output.to_owned() };
    let path = PathBuf::from(output.to_string_lossy().replace(NAME, name));
    match frame {
        Some(frame) => path.with_file_name(numbered(&path, frame)),
        None => path,
    }
}

/// The name of a file with the number of a frame in it: in place of `####` or `%04d`, or else before the
/// extension, with four digits.
fn numbered(path: &Path, frame: u32) -> String {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    if let Some(start) = name.find('#') {
        let digits = name[start..].bytes().take_while(|b| *b == b'#').count();
        return format!("{}{frame:0digits$}{}", &name[..start], &name[start + digits..]);
    }
    if let Some((before, rest)) = name.split_once('%')
        && let Some((digits, after)) = rest.split_once('d')
        && digits.bytes().all(|b| b.is_ascii_digit())
    {
        let digits = digits.parse().unwrap_or(1).min(20);
        return format!("{before}{frame:0digits$}{after}");
    }
    match name.rsplit_once('.') {
        Some((stem, extension)) => format!("{stem}.{frame:04}.{extension}"),
        None => format!("{name}.{frame:04}"),
    }
}

/// True for a picture that is there and can be read: not one that a copy cut off, or an empty file that holds
/// its place.
fn is_whole(path: &Path) -> bool {
    path.is_file() && read(path).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frame_has_its_number_in_its_name() {
        let name = |path: &str| numbered(Path::new(path), 7);
        assert_eq!(name("out.exr"), "out.0007.exr");
        assert_eq!(name("a/out.##.exr"), "out.07.exr");
        assert_eq!(name("out-%03d.exr"), "out-007.exr");
        assert_eq!(name("out%d.exr"), "out7.exr");
        assert_eq!(name("100%dark.exr"), "1007ark.exr");
        assert_eq!(name("50%off.png"), "50%off.0007.png");
        assert_eq!(numbered(Path::new("#.png"), 12_345), "12345.png");
    }

    #[test]
    fn a_scene_has_its_name_in_that_of_its_file() {
        let place = |output: &str, frame| place(Path::new(output), "box", frame);
        assert_eq!(place("out/", None), Path::new("out/box.png"));
        assert_eq!(place("x/{name}.exr", None), Path::new("x/box.exr"));
        assert_eq!(place("x/{name}.exr", Some(3)), Path::new("x/box.0003.exr"));
        assert_eq!(place("a.png", None), Path::new("a.png"));
    }
}
