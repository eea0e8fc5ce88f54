use super::*;
use crate::light::{Density, Emitter, EnvironmentMap, Receiver, SurfaceDensity};
use crate::num::{hash2, unit_f32};
use glam::{Mat3, Vec3};

fn picture(width: u32, height: u32, texel: impl Fn(u32) -> f32) -> Image {
    Image { width, height, texels: (0..width * height).map(|i| Rgb::splat(texel(i))).collect() }
}

/// Neighbours that differ by up to a factor of ten.
fn noise(width: u32, height: u32) -> Image {
    picture(width, height, |i| crate::num::pow(10.0, unit_f32(hash2(i, 1))))
}

/// A sky of radiance 1 with one bright texel.
fn sun(width: u32, height: u32, at: u32) -> Image {
    picture(width, height, |i| if i == at { 1e4 } else { 1.0 })
}

/// Share of samples that come from below the horizon or not at all, and the relative variance of one
/// sample of the irradiance.
fn waste_and_variance(image: &Image, density: EnvironmentDensity, normal: Vec3) -> (f64, f64) {
    let tables = EnvironmentTables::new(image, density);
    let map = EnvironmentMap::new(&image.texels, image.width, image.height, Mat3::IDENTITY).unwrap();
    let map = tables.table().map_or(map, |table| map.with_table(table).unwrap());
    let from = Receiver { point: Vec3::ZERO, normal };
    let count = 1 << 16;
    let (mut wasted, mut sum, mut squares) = (0.0, 0.0, 0.0);
    for i in 0..count {
        let u = [2, 3].map(|k| unit_f32(hash2(i, k)));
        let value = map.sample(&from, SurfaceDensity::Auto, u).map_or(0.0, |s| match s.density {
            Density::SolidAngle(pdf) => f64::from(s.incident.g * normal.dot(s.wi).max(0.0) / pdf),
            Density::Delta => 0.0,
        });
        wasted += f64::from(u8::from(value == 0.0));
        sum += value;
        squares += value * value;
    }
    let n = f64::from(count);
    (wasted / n, squares * n / (sum * sum) - 1.0)
}

const NORMALS: [Vec3; 4] = [Vec3::Y, Vec3::NEG_X, Vec3::new(0.6, 0.48, -0.64), Vec3::new(0.28, -0.96, 0.0)];

#[test]
fn the_product_wastes_little_below_the_horizon() {
    for (image, name) in [(noise(512, 256), "noise"), (sun(512, 256, 512 * 200 + 9), "sun")] {
        for normal in NORMALS {
            let (wasted, _) = waste_and_variance(&image, EnvironmentDensity::Product, normal);
            assert!(wasted < 0.1, "{name} {normal}: {wasted}");
        }
    }
}

/// What `auto` relies on; maps of a few texels have blocks too wide for it.
#[test]
fn without_other_samples_the_product_has_the_least_variance() {
    for (image, name) in [(noise(128, 64), "noise"), (sun(256, 128, 256 * 30 + 30), "sun")] {
        for normal in NORMALS {
            let variance = |density| waste_and_variance(&image, density, normal).1;
            let product = variance(EnvironmentDensity::Product);
            for density in [EnvironmentDensity::Cosine, EnvironmentDensity::Luminance] {
                let other = variance(density);
                // Where the sun does not shine the map is even, and the cosine alone is exact.
                assert!(product < other + 0.06, "{name} {normal} {density:?}: {other}, product {product}");
            }
        }
    }
}
