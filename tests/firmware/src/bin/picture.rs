//! Renders two scenes as text, measures the light on the floor, and compares the pixels with those of
//! every other machine.
#![no_std]
#![no_main]

use halflight::choose::LightChoice;
use halflight::estimate::Probe;
use halflight::film::Film;
use halflight::glam::Vec3;
use halflight::light::{Emitter, SurfaceDensity};
use halflight::material::Material;
use halflight::scene::BakedError;
use halflight::sequence::Sobol;
use halflight::shape::{Shape, SurfacePoint};
use halflight::{Camera, Rgb, Scene};
use halflight_firmware::machine::{entry, exit, print, println};
use halflight_firmware::picture::{CORNELL, Checksum, SKY, render};
use halflight_firmware::scenes::{cornell, sky};

/// From dark to bright.
const RAMP: &[u8; 10] = b" .:-=+*#%@";

/// Prints a picture, two rows a line, and its checksum.
fn show<S: Shape, L: Emitter, M: Material>(
    scene: Scene<'_, S, L, M>,
    camera: Camera,
    film: Film,
) -> Checksum {
    let (mut sum, mut row) = (Checksum::NEW, [0.0_f32; 64]);
    render(scene, camera, film, |x, y, pixel| {
        sum = sum.with(&pixel.to_words());
        let Some(above) = row.get_mut(x as usize) else { return };
        let value = pixel.mean().luminance();
        if y % 2 == 0 {
            *above = value;
            return;
        }
        let step = ((*above + value) * 10.0) as usize;
        print!("{}", char::from(RAMP.get(step).copied().unwrap_or(b'@')));
        if x + 1 == film.width() {
            println!("");
        }
    });
    sum
}

/// Prints a colour in thousandths.
fn thousandths(what: &str, c: Rgb) {
    let [r, g, b] = (c * 1000.0).to_array().map(|v| v as u32);
    print!("  {} {} {} {}", what, r, g, b);
}

/// Prints what arrives at some points of the floor: with shadows, its standard error, and without.
fn irradiance<S: Shape, L: Emitter, M: Material>(scene: &Scene<'_, S, L, M>) {
    let probe = Probe { samples: 64, surface: SurfaceDensity::Auto, choice: LightChoice::All };
    println!("irradiance on the floor (mW m-2: red green blue)");
    for (x, z) in [(0.28, 0.2), (0.5, 0.3), (0.15, 0.05)] {
        let from = SurfacePoint { point: Vec3::new(x, 1e-4, z), error: Vec3::ZERO, normal: Vec3::Y };
        let seen = probe.irradiance(scene, &from, &mut Sobol::new(7));
        print!("{} mm, {} mm:", (x * 1000.0) as u32, (z * 1000.0) as u32);
        thousandths("mean", seen.mean());
        thousandths("error", seen.standard_error());
        thousandths("unshadowed", seen.unshadowed.unwrap_or(Rgb::BLACK));
        println!("");
    }
}

fn all() -> Result<bool, BakedError> {
    let (lit, open) = (cornell::scene()?, sky::scene()?);
    irradiance(&lit);
    let mut good = true;
    for (name, sum, expected) in [
        ("cornell", show(lit, cornell::CAMERA, cornell::FILM), CORNELL),
        ("sky", show(open, sky::CAMERA, sky::FILM), SKY),
    ] {
        let verdict = if sum.0 == expected { "as everywhere" } else { "NOT as elsewhere" };
        println!("{} {:08x}{:08x} {}", name, (sum.0 >> 32) as u32, sum.0 as u32, verdict);
        good &= sum.0 == expected;
    }
    Ok(good)
}

#[entry]
fn main() -> ! {
    exit(all().unwrap_or(false))
}

halflight_firmware::panics_end!();
