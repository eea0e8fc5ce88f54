//! Environment maps pass each check, however directions toward them are drawn.

use halflight::glam::{Mat3, Vec3};
use halflight::light::{Density, Emitter, EnvironmentDensity, Receiver, SurfaceDensity};
use halflight_tests::environments::{DENSITIES, noise, over_a_slope, slope, sun};
use halflight_tests::lights::{self, Lying, scaled};
use halflight_tests::random::{Uniforms, corners};
use halflight_tests::statistics::Moments;
use halflight_tests::{Verdict, ensure};

/// The checks that each map passes, however it is sampled.
macro_rules! conformance {
    ($name:ident, $image:expr) => {
        mod $name {
            conformance!(@drawn by_cosine, Cosine, $image);
            conformance!(@drawn by_luminance, Luminance, $image);
            conformance!(@drawn by_what_is_above_the_mean, Compensated, $image);
            conformance!(@drawn by_product, Product, $image);
        }
    };
    (@drawn $drawn:ident, $density:ident, $image:expr) => {
        mod $drawn {
            use halflight::light::{EnvironmentDensity, EnvironmentMap};
            use halflight_tests::environments::{noise, over_a_slope, sun};
            use halflight_tests::lights::{self, Environment};
            use halflight_tests::Verdict;

            fn subject() -> Environment<EnvironmentMap<'static>> {
                let make: fn() -> halflight::build::Image = $image;
                over_a_slope(make(), EnvironmentDensity::$density)
            }

            #[test]
            fn queried_density_equals_sampled_density() -> Verdict {
                lights::queried_density_equals_sampled_density(&subject())
            }

            #[test]
            fn mean_reciprocal_density_is_the_solid_angle() -> Verdict {
                lights::mean_reciprocal_density_is_the_solid_angle(&subject())
            }

            #[test]
            fn area_and_direction_sampling_agree() -> Verdict {
                lights::area_and_direction_sampling_agree(&subject())
            }

            #[test]
            fn directions_pass_chi_square() -> Verdict {
                lights::directions_pass_chi_square(&subject())
            }

            #[allow(unused_imports)]
            use {noise as _, sun as _};
        }
    };
}

conformance!(envmap_noise_in_a_few_texels, || noise(5, 4));
conformance!(envmap_noise_in_many_texels, || noise(150, 70));
conformance!(envmap_one_row, || noise(7, 1));
conformance!(envmap_one_column, || noise(1, 6));
conformance!(envmap_one_texel, || noise(1, 1));
conformance!(envmap_sky_with_a_sun, || sun(64, 32, [40, 7], 200.0));

/// What a sample says is, to the last bit, what is answered for its direction.
#[test]
fn samples_know_their_density_and_radiance_to_the_last_bit() -> Verdict {
    let mut random = Uniforms::new(31);
    for (image, density) in
        DENSITIES.iter().flat_map(|d| [(noise(37, 20), *d), (sun(512, 256, [9, 80], 1e5), *d)])
    {
        let subject = over_a_slope(image, density);
        for u in corners().chain((0..20_000).map(|_| random.two())) {
            let Some(sample) = subject.light.sample(&subject.from, SurfaceDensity::Auto, u) else { continue };
            let Density::SolidAngle(pdf) = sample.density else { continue };
            ensure!(pdf > 0.0 && pdf.is_finite(), "{density:?}: density {pdf} at {u:?}");
            ensure!((sample.wi.length() - 1.0).abs() < 1e-6, "{density:?}: direction {}", sample.wi);
            let queried = subject.light.pdf_escaping(&subject.from, sample.wi);
            ensure!(queried == pdf, "{density:?}: {queried} when queried, {pdf} when sampled at {u:?}");
            let radiance = subject.light.radiance_escaping(sample.wi);
            ensure!(radiance == sample.incident, "{density:?}: {radiance:?} and {:?}", sample.incident);
        }
    }
    Ok(())
}

mod distant_disk_over_a_slope {
    use super::*;
    use halflight::Rgb;
    use halflight::light::DistantDisk;
    use halflight_tests::lights::Environment;
    use std::f64::consts::TAU;

    /// Above the horizon, cut by it, and as narrow as the sun.
    fn subjects() -> [Environment<DistantDisk>; 3] {
        let disk = |toward, radius| DistantDisk::new(toward, radius, Rgb::WHITE).unwrap();
        [
            (Vec3::new(0.1, -0.7, 0.9), 0.3),
            (Vec3::new(0.8, 0.45, 0.0), 0.2),
            (Vec3::new(0.3, 0.2, 0.9), 0.00465),
        ]
        .map(|(toward, radius)| Environment { light: disk(toward, radius), from: slope() })
    }

    /// Radius (rad) of each.
    const RADII: [f64; 3] = [0.3, 0.2, 0.00465];

    #[test]
    fn queried_density_equals_sampled_density() -> Verdict {
        subjects().iter().try_for_each(lights::queried_density_equals_sampled_density)
    }

    #[test]
    fn mean_reciprocal_density_is_the_solid_angle() -> Verdict {
        for (subject, radius) in subjects().iter().zip(RADII) {
            let solid_angle = TAU * 2.0 * (0.5 * radius).sin().powi(2);
            let pdf = f64::from(subject.light.pdf_escaping(&subject.from, subject.light.axis()));
            ensure!((pdf * solid_angle - 1.0).abs() < 1e-5, "{pdf} over {solid_angle}");
        }
        Ok(())
    }

    /// Samples, and the closed form.
    #[test]
    fn irradiance_agrees_with_the_closed_form() -> Verdict {
        let mut random = Uniforms::new(34);
        for Environment { light, from } in subjects() {
            let cosine = |wi: Vec3| f64::from(from.normal.dot(wi).max(0.0));
            let sample = |u| {
                let s = light.sample(&from, SurfaceDensity::Auto, u)?;
                Some(cosine(s.wi) / f64::from(light.pdf_escaping(&from, s.wi)))
            };
            let moments = Moments::of((0..1 << 18).map(|_| sample(random.two()).unwrap_or(0.0)));
            let closed = light.unshadowed_irradiance(&from).map_or(0.0, |e| f64::from(e.g));
            ensure!(closed > 0.0, "no irradiance");
            moments.check_mean("irradiance", closed, 3e-5)?;
            ensure!(moments.check_mean("irradiance", 1.02 * closed, 3e-5).is_err(), "2 % go unnoticed");
        }
        Ok(())
    }

    #[test]
    fn there_is_a_density_exactly_where_there_is_light() {
        let mut random = Uniforms::new(35);
        for Environment { light, from } in subjects() {
            for _ in 0..100_000 {
                let aside = Vec3::new(random.one() - 0.5, random.one() - 0.5, random.one() - 0.5);
                let wi = (light.axis() + aside * 0.02 * random.one()).normalize();
                let (pdf, radiance) = (light.pdf_escaping(&from, wi), light.radiance_escaping(wi));
                assert!((pdf > 0.0) == (radiance == Rgb::WHITE), "{wi}: {pdf} {radiance:?}");
            }
        }
    }

    #[test]
    fn disks_out_of_range_are_refused() {
        for radius in [0.0, -0.1, 0.8, f32::NAN, 1e-30] {
            assert!(DistantDisk::new(Vec3::Y, radius, Rgb::WHITE).is_err(), "{radius}");
        }
        assert!(DistantDisk::new(Vec3::ZERO, 0.1, Rgb::WHITE).is_err());
        assert!(DistantDisk::new(Vec3::Y, 0.1, Rgb::splat(-1.0)).is_err());
    }
}

mod wrong_densities_are_noticed {
    use super::*;

    #[test]
    fn by_the_query() {
        for density in DENSITIES {
            let subject = over_a_slope(noise(30, 15), density);
            let lying = Lying { subject, sampled: 1.02, queried: [1.0; 2] };
            assert!(lights::queried_density_equals_sampled_density(&lying).is_err());
        }
    }

    #[test]
    fn by_the_mean_of_reciprocals_and_the_histogram() {
        // The sixteenth that is kept below the mean makes reciprocals too uneven to tell.
        for density in DENSITIES.into_iter().filter(|d| *d != EnvironmentDensity::Compensated) {
            let lying = scaled(over_a_slope(noise(30, 15), density), 1.02);
            assert!(lights::mean_reciprocal_density_is_the_solid_angle(&lying).is_err(), "{density:?}");
            let subject = over_a_slope(noise(30, 15), density);
            let lying = Lying { subject, sampled: 1.0, queried: [1.02; 2] };
            assert!(lights::directions_pass_chi_square(&lying).is_err(), "{density:?}");
        }
    }
}

#[test]
fn a_table_of_another_map_is_refused() {
    use halflight::build::EnvironmentTables;
    use halflight::light::{EnvironmentMap, LightError};
    let (small, large) = (noise(6, 3), noise(12, 6));
    let tables = EnvironmentTables::new(&small, EnvironmentDensity::Product);
    let light = EnvironmentMap::new(&large.texels, 12, 6, Mat3::IDENTITY).unwrap();
    let refused = light.with_table(tables.table().unwrap());
    assert_eq!(refused, Err(LightError::Table { width: 12, height: 6 }));
    let stretched = EnvironmentMap::new(&small.texels, 6, 3, Mat3::from_diagonal(Vec3::new(1.0, 2.0, 1.0)));
    assert_eq!(stretched, Err(LightError::NotARotation));
    assert!(slope().normal.is_normalized());
}

#[test]
fn a_map_that_is_turned_and_scaled_keeps_its_table() {
    use halflight::build::EnvironmentTables;
    use halflight::light::{EnvironmentMap, LightError};
    let image = noise(12, 6);
    let tables = EnvironmentTables::new(&image, EnvironmentDensity::Product);
    let map = EnvironmentMap::new(&image.texels, 12, 6, Mat3::IDENTITY)
        .and_then(|map| map.with_table(tables.table().unwrap()))
        .unwrap();
    let turn = Mat3::from_rotation_y(2.0);
    let turned = map.turned(turn).and_then(|map| map.scaled(4.0)).unwrap();
    let from = slope();
    let before = Receiver { normal: turn.transpose() * from.normal, ..from };
    for aside in [Vec3::ZERO, Vec3::new(0.4, 0.2, 0.0), Vec3::new(-0.3, 0.1, 0.5)] {
        let wi = (before.normal + aside).normalize();
        let (as_it_was, new) = (map.radiance_escaping(wi) * 4.0, turned.radiance_escaping(turn * wi));
        assert!((as_it_was.luminance() / new.luminance() - 1.0).abs() < 1e-4, "{as_it_was:?} {new:?}");
        let (as_it_was, new) = (map.pdf_escaping(&before, wi), turned.pdf_escaping(&from, turn * wi));
        assert!((as_it_was / new - 1.0).abs() < 1e-4, "{as_it_was} {new}");
    }
    assert!((turned.power(2.0) / map.power(2.0) - 4.0).abs() < 1e-5);
    assert!(matches!(map.scaled(-1.0), Err(LightError::NegativeEmission { .. })));
    assert!(matches!(map.scaled(f32::NAN), Err(LightError::NotFinite { .. })));
    assert!(matches!(map.scaled(f32::MAX), Err(LightError::Texel { .. })));
    assert!(map.turned(Mat3::ZERO).is_err() && map.scaled(0.0).is_ok());
}
