//! Environment maps.

use halflight::Rgb;
use halflight::build::{EnvironmentTables, Image};
use halflight::choose::PowerTable;
use halflight::glam::{Mat3, Vec3};
use halflight::light::{
    AnyLight, Constant, Density, Emitter, EnvironmentDensity, EnvironmentMap, LightError, Receiver,
    SurfaceDensity,
};
use halflight_tests::environments::{DENSITIES, irradiance_of_rows, map, noise, over_a_slope, picture, sun};
use halflight_tests::lights::{directions_pass_chi_square, mean_reciprocal_density_is_the_solid_angle};
use halflight_tests::random::Uniforms;
use halflight_tests::statistics::{Moments, chi_square};
use halflight_tests::{Verdict, ensure};
use std::f64::consts::PI;

/// A receiver that looks up.
const UP: Receiver = Receiver { point: Vec3::ZERO, normal: Vec3::Y };

const SAMPLES: usize = 1 << 17;

/// Irradiance from independent samples, none of which may be anything but a finite positive number.
fn irradiance(light: &impl Emitter, from: &Receiver, samples: usize) -> Moments {
    let mut random = Uniforms::new(129);
    Moments::of((0..samples).map(|_| {
        let Some(sample) = light.sample(from, SurfaceDensity::Auto, random.two()) else { return 0.0 };
        let Density::SolidAngle(pdf) = sample.density else { panic!("an environment without density") };
        assert!(pdf > 0.0 && pdf.is_finite(), "density {pdf}");
        f64::from(sample.incident.g) * f64::from(from.normal.dot(sample.wi).max(0.0)) / f64::from(pdf)
    }))
}

/// The sum of the table is 0: 0/0, and in one system every light went dark.
#[test]
fn row_29_a_black_map_sends_nothing_and_takes_nothing_from_others() {
    let black = picture(8, 4, |_, _| 0.0);
    for density in DENSITIES {
        assert!(EnvironmentTables::new(&black, density).table().is_none());
        let light = map(black.clone(), Mat3::IDENTITY, density);
        assert_eq!(irradiance(&light, &UP, 1000).mean(), 0.0);
        let other = AnyLight::Constant(Constant::new(Rgb::WHITE).unwrap());
        let lights = [other, AnyLight::EnvironmentMap(light)];
        let mut cumulative = [0.0; 2];
        assert!(PowerTable::fill(&mut cumulative, |i| lights[i].power(1.0)));
        assert_eq!(cumulative, [1.0, 1.0]);
    }
}

/// Nothing is above the mean of a constant map: a density of 0 everywhere.
#[test]
fn row_30_a_constant_map_has_something_above_its_mean() -> Verdict {
    for (what, image) in [
        ("constant", picture(16, 8, |_, _| 3.0)),
        ("nearly", picture(16, 8, |x, _| if x % 2 == 0 { 3.0 } else { 3.000_01 })),
    ] {
        let light = map(image, Mat3::IDENTITY, EnvironmentDensity::Compensated);
        irradiance(&light, &UP, SAMPLES).check_mean(what, 3.0 * PI, 1e-4)?;
    }
    Ok(())
}

/// One less than one texel: a division by 0.
#[test]
fn row_31_maps_of_one_row_one_column_or_one_texel_are_maps() -> Verdict {
    let rows = [4.0, 1.0, 2.0, 0.5, 1.5];
    let column = picture(1, 5, |_, y| rows[y as usize] as f32);
    let row = picture(5, 1, |x, _| rows[x as usize] as f32);
    let mean = rows.iter().sum::<f64>() / 5.0;
    for density in DENSITIES {
        let one = map(picture(1, 1, |_, _| 2.0), Mat3::IDENTITY, density);
        irradiance(&one, &UP, SAMPLES).check_mean("one texel", 2.0 * PI, 1e-4)?;
        let light = map(column.clone(), Mat3::IDENTITY, density);
        irradiance(&light, &UP, SAMPLES).check_mean("one column", irradiance_of_rows(&rows), 1e-4)?;
        let light = map(row.clone(), Mat3::IDENTITY, density);
        irradiance(&light, &UP, SAMPLES).check_mean("one row", mean * PI, 1e-4)?;
    }
    Ok(())
}

/// Rows weighted by the sine of their latitude: nothing is drawn at the pole, or with infinite density.
#[test]
fn row_32_the_texels_at_a_pole_are_drawn_as_often_as_they_count() -> Verdict {
    let mut rows = vec![0.0; 257];
    rows[0] = 1.0;
    let image = picture(512, 257, |_, y| rows[y as usize] as f32);
    for density in DENSITIES {
        let light = map(image.clone(), Mat3::IDENTITY, density);
        let at_pole = light.pdf_escaping(&UP, Vec3::Y);
        ensure!(at_pole.is_finite() && at_pole > 0.0, "{density:?}: density {at_pole} at the pole");
        // Cosine sampling finds the pole once in 10^4.
        let samples = if density == EnvironmentDensity::Cosine { 1 << 22 } else { SAMPLES };
        irradiance(&light, &UP, samples).check_mean("a pole", irradiance_of_rows(&rows), 1e-4)?;
    }
    Ok(())
}

/// The neighbour of the last column is the first: a line at the seam.
#[test]
fn row_33_turning_the_map_by_texels_turns_the_picture() {
    let (image, mut random) = (noise(24, 12), Uniforms::new(33));
    let still = map(image.clone(), Mat3::IDENTITY, EnvironmentDensity::Product);
    for shift in [1, 5, 12, 23] {
        let shifted = picture(24, 12, |x, y| image.texels[(y * 24 + (x + shift) % 24) as usize].g);
        let turned = map(shifted, Mat3::IDENTITY, EnvironmentDensity::Product);
        // Columns run the way that the angle about y falls.
        let turn = Mat3::from_rotation_y(std::f32::consts::TAU * shift as f32 / 24.0);
        for _ in 0..20_000 {
            let [x, y] = random.two();
            let wi = halflight::warp::uniform_sphere([x, y]);
            let (a, b) = (turned.radiance_escaping(turn * wi).g, still.radiance_escaping(wi).g);
            assert!((a - b).abs() < 1e-4 * b.max(1.0), "{shift} texels at {wi}: {a} and {b}");
        }
    }
}

/// What a map with one texel that differs says about it.
fn refusal(texel: Rgb) -> Option<LightError> {
    let mut image = noise(7, 3);
    image.texels[7 + 4] = texel;
    EnvironmentMap::new(&image.texels, 7, 3, Mat3::IDENTITY).err()
}

/// One such texel makes every sum, and with it every pixel, not a number.
#[test]
fn row_34_a_texel_that_is_not_finite_is_refused_by_its_place() {
    for value in [f32::NAN, f32::INFINITY] {
        let refused = refusal(Rgb::new(1.0, value, 0.0));
        assert!(matches!(refused, Some(LightError::Texel { x: 4, y: 1, .. })), "{refused:?}");
        let message = refused.map(|e| e.to_string()).unwrap_or_default();
        assert!(message.contains("column 4, row 1"), "{message}");
    }
}

/// A sum that falls: a choice that finds no texel.
#[test]
fn row_35_a_negative_texel_is_refused_by_its_place() {
    let refused = refusal(Rgb::new(1.0, 0.0, -1e-9));
    assert!(matches!(refused, Some(LightError::Texel { x: 4, y: 1, .. })), "{refused:?}");
}

/// Sums in single precision lose most of the texels beside a sun, and the cosine alone never finds it.
#[test]
fn row_36_a_sun_of_a_hundred_thousand_has_little_noise() -> Verdict {
    let image = sun(1024, 512, [700, 100], 1e5);
    // A texel is a tent over four cells; the sky is what it is without.
    let texel = picture(1024, 512, |x, y| if [x, y] == [700, 100] { 1e5 - 1.0 } else { 0.0 });
    let alone = map(texel, Mat3::IDENTITY, EnvironmentDensity::Luminance);
    let truth = PI + irradiance(&alone, &UP, 1 << 20).mean();
    for density in [EnvironmentDensity::Luminance, EnvironmentDensity::Product] {
        let moments = irradiance(&map(image.clone(), Mat3::IDENTITY, density), &UP, 1 << 20);
        moments.check_mean("a sun", truth, 1e-3)?;
        let error = moments.standard_error() / truth;
        ensure!(error < 2e-3, "{density:?}: standard error {error} after 2^20 samples");
    }
    Ok(())
}

/// The sampler and the evaluator disagree about what is inside of the sun: fireflies at its edge.
#[test]
fn row_37_there_is_a_density_exactly_where_there_is_light() {
    let image = picture(256, 128, |x, y| f32::from(u8::from([x / 2, y / 2] == [60, 20])) * 1e5);
    let mut random = Uniforms::new(37);
    for density in
        [EnvironmentDensity::Luminance, EnvironmentDensity::Compensated, EnvironmentDensity::Product]
    {
        let light = map(image.clone(), Mat3::IDENTITY, density);
        for _ in 0..100_000 {
            let [s, t] = random.two();
            let (phi, theta) = (
                (118.0 + 6.0 * s) / 256.0 * std::f32::consts::TAU,
                (38.0 + 6.0 * t) / 127.0 * std::f32::consts::PI,
            );
            let wi = Vec3::new(theta.sin() * phi.sin(), theta.cos(), -theta.sin() * phi.cos());
            let (pdf, radiance) = (light.pdf_escaping(&UP, wi), light.radiance_escaping(wi).g);
            assert!(
                (pdf > 0.0) == (radiance > 0.0),
                "{density:?} at {wi}: density {pdf}, radiance {radiance}"
            );
        }
    }
}

/// A density that is interpolated, with samples that are not: weights that do not add up to 1.
#[test]
fn row_38_samples_are_interpolated_as_their_density_is() -> Verdict {
    let image = || picture(8, 5, |x, y| if (x + y) % 2 == 0 { 100.0 } else { 1.0 });
    for density in DENSITIES {
        directions_pass_chi_square(&over_a_slope(image(), density))?;
        mean_reciprocal_density_is_the_solid_angle(&over_a_slope(image(), density))?;
    }
    Ok(())
}

/// One uniform for both decisions: three bits are left for the second one.
#[test]
fn row_39_every_column_of_millions_of_texels_is_drawn() -> Verdict {
    let (width, bits) = (8192, 256);
    let light = map(picture(width, 300, |_, _| 1.0), Mat3::IDENTITY, EnvironmentDensity::Luminance);
    let mut random = Uniforms::new(39);
    let (mut low, mut fractions) = (vec![0_u64; bits], vec![0_u64; 64]);
    let draws = 1 << 20;
    for _ in 0..draws {
        let Some(sample) = light.sample(&UP, SurfaceDensity::Auto, random.two()) else { continue };
        let turns = f64::from(sample.wi.x).atan2(f64::from(-sample.wi.z)) / (2.0 * PI);
        let column = turns.rem_euclid(1.0) * f64::from(width) - 0.5;
        low[column.rem_euclid(bits as f64) as usize] += 1;
        fractions[(column.rem_euclid(1.0) * 64.0) as usize] += 1;
    }
    let even = |cells: usize| vec![f64::from(draws) / cells as f64; cells];
    chi_square("the last eight bits of the column", &low, &even(bits), 0.0)?;
    chi_square("the place within the column", &fractions, &even(64), 0.01)
}

/// A map with a colour in each texel is the sum of its channels.
#[test]
fn colours_are_kept() {
    let image = Image { width: 2, height: 2, texels: vec![Rgb::new(1.0, 2.0, 3.0); 4] };
    let light = map(image, Mat3::IDENTITY, EnvironmentDensity::Product);
    assert_eq!(light.radiance_escaping(Vec3::X), Rgb::new(1.0, 2.0, 3.0));
}
