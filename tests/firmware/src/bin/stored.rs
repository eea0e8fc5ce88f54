//! Renders a scene that it borrows from bytes, as a program reads them from storage, and compares the pixels
//! with those of every other machine.
#![no_std]
#![no_main]

use halflight::stored::{Aligned, NO_LIGHT, NO_MATERIAL, StoredError, StoredScene};
use halflight_firmware::machine::{entry, exit, println};
use halflight_firmware::picture::{CORNELL, Checksum, render};

/// What `halflight export --as bytes` wrote.
static BYTES: Aligned<[u8; include_bytes!("../../scenes/cornell.scene").len()]> =
    Aligned(*include_bytes!("../../scenes/cornell.scene"));

fn sum() -> Result<Checksum, StoredError> {
    let (mut lights, mut materials) = ([NO_LIGHT; 1], [NO_MATERIAL; 4]);
    let stored = StoredScene::new(&BYTES.0)?;
    let scene = stored.scene(&mut lights, &mut materials)?;
    let mut sum = Checksum::NEW;
    render(scene, stored.camera()?, stored.film()?, |_, _, pixel| sum = sum.with(&pixel.to_words()));
    Ok(sum)
}

#[entry]
fn main() -> ! {
    let good = sum().is_ok_and(|sum| sum.0 == CORNELL);
    println!(
        "cornell from {} bytes: {}",
        BYTES.0.len(),
        if good { "as everywhere" } else { "NOT as elsewhere" }
    );
    exit(good)
}

halflight_firmware::panics_end!();
