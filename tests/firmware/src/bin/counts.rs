//! Instructions for each light sample, by density, beside the variance that is left: for QEMU with
//! `-icount shift=0`, where an instruction is a nanosecond.
#![no_std]
#![no_main]

use core::hint::black_box;
use cortex_m::peripheral::SYST;
use cortex_m::peripheral::syst::SystClkSource;
use halflight::Rgb;
use halflight::estimate::{ByArea, ByProjected, BySolidAngle, StaticDensity};
use halflight::glam::Vec3;
use halflight::light::{AreaLight, Emitter, Receiver, Sides};
use halflight::num;
use halflight::sequence::{Dimension, Random, Sequence};
use halflight::shape::Rectangle;
use halflight_firmware::machine::{entry, exit, println};

/// Nanoseconds of a tick: the board's clock is 25 MHz.
const TICK: u32 = 40;

const SAMPLES: u32 = 256;

/// Instructions for each sample, and relative standard deviation in thousandths.
fn measure(clock: &mut SYST, mut sample: impl FnMut(u32) -> f32) -> (u32, u32) {
    let (mut sum, mut squares) = (0.0_f32, 0.0_f32);
    clock.clear_current();
    let start = SYST::get_current();
    for index in 0..SAMPLES {
        let value = sample(index);
        sum += value;
        squares += value * value;
    }
    // It counts down.
    let ticks = start.wrapping_sub(SYST::get_current()) & 0x00ff_ffff;
    let (n, mean) = (SAMPLES as f32, sum / SAMPLES as f32);
    let variance = squares / n - mean * mean;
    let deviation = if mean > 0.0 { num::sqrt(variance) / mean } else { 0.0 };
    (ticks * TICK / SAMPLES, (1000.0 * deviation) as u32)
}

/// Irradiance from a panel of 1 × 1 m, `height` (mm) above and as far aside.
fn panel<D: StaticDensity>(clock: &mut SYST, name: &str, height: u32) {
    let h = height as f32 * 0.001;
    let shape = Rectangle::baked(Vec3::new(h, h, 0.0), Vec3::new(0.5, 0.0, 0.0), Vec3::new(0.0, 0.0, 0.5));
    let light = black_box(AreaLight::baked(shape, Rgb::WHITE, Sides::Front));
    let from = black_box(Receiver { point: Vec3::ZERO, normal: Vec3::Y });
    let mut sequence = Random::<rand_pcg::Pcg32>::new(1);
    let mut uniforms = |index| {
        sequence.start(0, index);
        sequence.point(Dimension::Light(0), 0, 1)
    };
    let (overhead, _) = measure(clock, |index| uniforms(index)[0]);
    let (all, deviation) = measure(clock, |index| {
        let u = uniforms(index);
        light.sample(&from, D::SURFACE, u).map_or(0.0, |drawn| {
            drawn.incident.r * from.normal.dot(drawn.wi).max(0.0) * drawn.density.weight()
        })
    });
    println!("{} mm {} {} {}", height, name, all.saturating_sub(overhead), deviation);
}

#[entry]
fn main() -> ! {
    let Some(peripherals) = cortex_m::Peripherals::take() else { exit(false) };
    let mut clock = peripherals.SYST;
    clock.set_clock_source(SystClkSource::Core);
    clock.set_reload(0x00ff_ffff);
    clock.clear_current();
    clock.enable_counter();
    println!("height, density, instructions a sample, relative standard deviation (1e-3)");
    for height in [100, 500, 2000, 10_000] {
        panel::<ByArea>(&mut clock, "area", height);
        panel::<BySolidAngle>(&mut clock, "solid-angle", height);
        panel::<ByProjected>(&mut clock, "projected", height);
    }
    exit(true)
}

halflight_firmware::panics_end!();
