//! Environment maps with receivers.

use crate::lights::{Environment, receiver};
use crate::quadrature::integrate;
use crate::random::Uniforms;
use halflight::Rgb;
use halflight::build::{EnvironmentTables, Image};
use halflight::glam::{Mat3, Vec3};
use halflight::light::{EnvironmentDensity, EnvironmentMap, Receiver};

/// Every way of drawing directions toward a map.
pub const DENSITIES: [EnvironmentDensity; 4] = [
    EnvironmentDensity::Cosine,
    EnvironmentDensity::Luminance,
    EnvironmentDensity::Compensated,
    EnvironmentDensity::Product,
];

/// A picture from a function of column and row.
#[must_use]
pub fn picture(width: u32, height: u32, texel: impl Fn(u32, u32) -> f32) -> Image {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    Image { width, height, texels: texels.map(|(x, y)| Rgb::splat(texel(x, y))).collect() }
}

/// Neighbours that differ by up to a factor of ten.
#[must_use]
pub fn noise(width: u32, height: u32) -> Image {
    let mut random = Uniforms::new(u64::from(width * height));
    let values: Vec<f32> = (0..width * height).map(|_| 10.0_f32.powf(random.one())).collect();
    picture(width, height, |x, y| values[(y * width + x) as usize])
}

/// A sky of radiance 1 with one bright texel.
#[must_use]
pub fn sun(width: u32, height: u32, [sun_x, sun_y]: [u32; 2], radiance: f32) -> Image {
    picture(width, height, |x, y| if [x, y] == [sun_x, sun_y] { radiance } else { 1.0 })
}

/// A map of a picture, drawn by a density. It lives as long as the tests do.
///
/// # Panics
/// When the picture is no map.
#[must_use]
pub fn map(image: Image, to_world: Mat3, density: EnvironmentDensity) -> EnvironmentMap<'static> {
    let tables: &'static EnvironmentTables = Box::leak(Box::new(EnvironmentTables::new(&image, density)));
    let image: &'static Image = Box::leak(Box::new(image));
    let map = EnvironmentMap::new(&image.texels, image.width, image.height, to_world).expect("a map");
    tables.table().map_or(map, |table| map.with_table(table).expect("a table of this map"))
}

/// A turned map over a slope.
#[must_use]
pub fn over_a_slope(image: Image, density: EnvironmentDensity) -> Environment<EnvironmentMap<'static>> {
    let to_world = Mat3::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), 1.1);
    Environment { light: map(image, to_world, density), from: slope() }
}

/// A receiver that faces no axis.
#[must_use]
pub fn slope() -> Receiver {
    receiver(Vec3::ONE, Vec3::new(0.3, -0.5, 0.8))
}

/// Irradiance on a surface that looks up from below a map whose rows are each of one radiance, by
/// quadrature over the latitude.
#[must_use]
pub fn irradiance_of_rows(rows: &[f64]) -> f64 {
    use std::f64::consts::{FRAC_PI_2, PI, TAU};
    let intervals = rows.len() - 1;
    let radiance = |theta: f64| {
        let down = theta / PI * intervals as f64;
        let y = (down as usize).min(intervals - 1);
        let t = down - y as f64;
        rows[y] * (1.0 - t) + rows[y + 1] * t
    };
    let step = PI / intervals as f64;
    let at = |y: usize| (y as f64 * step).min(FRAC_PI_2);
    let row = |y: usize| integrate(at(y), at(y + 1), 4, |theta| radiance(theta) * theta.sin() * theta.cos());
    TAU * (0..intervals).map(row).sum::<f64>()
}
