//! Memory, asked for as a whole before it is needed piece by piece.
//!
//! Rust ends a process, without a word of this program's, when an allocation fails. So what is large is asked
//! for first, and given back: when it is not granted, there is a message, and nothing has been begun.

use crate::failure::Failure;
use crate::number::{bytes, counted};
use halflight::film::Film;
use std::hint::black_box;

/// Most bytes that a pixel takes while a picture is encoded (30 to 37 where this was measured), and those of
/// layers beside it (another 90).
const ENCODED: u64 = 40;
const LAYERS: u64 = 90;

/// Bytes that a triangle takes while the tree and the tables are built (115 where this was measured), and those
/// that it takes beside them where it is among the many that are built at once.
const BUILT: u64 = 130;
const AT_ONCE: u64 = 60;
const MANY: u64 = 1 << 18;

/// Bytes for all else: tiles that are worked on, tables, buffers of files.
const SLACK: u64 = 16 << 20;

/// Asks for the pixels of a film, and for the picture that is made of them.
///
/// * `parts` – how many share the pixels
/// * `pixel` – bytes of one while it is rendered
/// * `has_layers` – whether layers are written
///
/// # Errors
/// When there is less.
pub(crate) fn check_film(film: &Film, parts: u32, pixel: usize, has_layers: bool) -> Result<(), Failure> {
    let pixels = (film.crop().area() as u64).div_ceil(u64::from(parts));
    let each = pixel as u64 + ENCODED + if has_layers { LAYERS } else { 0 };
    let (width, height) = (film.crop().width(), film.crop().height());
    let what = match parts {
        1 => format!("{width}×{height} pixels need"),
        _ => format!("a part of {width}×{height} pixels needs"),
    };
    ask(pixels.saturating_mul(each).saturating_add(SLACK), &what)
        .map_err(|failure| failure.tip("choose a smaller --width and --height, or a part with --crop"))
}

/// Asks for the pixels of parts, and for the picture that is made of them.
///
/// * `pixel` – bytes of one while it is held
/// * `has_layers` – whether layers are written
///
/// # Errors
/// When there is less.
pub(crate) fn check_merge(pixels: u64, pixel: usize, has_layers: bool) -> Result<(), Failure> {
    let each = pixel as u64 + ENCODED + if has_layers { LAYERS } else { 0 };
    ask(pixels.saturating_mul(each).saturating_add(SLACK), &format!("{} need", counted(pixels, "pixel")))
        .map_err(|failure| failure.tip("merge them where there is more, or render fewer pixels"))
}

/// Asks for the tree over triangles.
///
/// # Errors
/// When there is less.
pub(crate) fn check_tree(triangles: u64) -> Result<(), Failure> {
    ask(
        triangles.saturating_mul(BUILT).saturating_add(triangles.min(MANY) * AT_ONCE),
        &format!("the tree over {} needs", counted(triangles, "triangle")),
    )
    .map_err(|failure| failure.tip("give the program more, or simplify the meshes"))
}

/// Asks for so many bytes at once.
fn ask(needed: u64, what: &str) -> Result<(), Failure> {
    let mut probe = Vec::<u8>::new();
    let granted = usize::try_from(needed).is_ok_and(|needed| probe.try_reserve_exact(needed).is_ok());
    black_box(&probe);
    if granted {
        return Ok(());
    }
    Err(Failure::new(format!("{what} about {} of memory, more than there is", bytes(needed))))
}

#[cfg(test)]
mod tests {
    use super::*;
    use halflight::film::Filter;

    #[test]
    fn what_no_machine_has_is_refused_and_a_part_of_it_is_less() {
        check_tree(1000).unwrap();
        for triangles in [u64::MAX, 1 << 55] {
            assert!(check_tree(triangles).is_err(), "{triangles}");
        }
        assert!(check_merge(1 << 56, 32, true).is_err());
        let film = Film::new(64, 64, Filter::Box { radius: 0.5 }).unwrap();
        check_film(&film, 1, 32, true).unwrap();
        assert!(check_film(&film, 1, usize::MAX / 2, false).is_err());
    }
}
