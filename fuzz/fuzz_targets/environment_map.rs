//! Environment maps of any size and content, turned and drawn in any way, seen from anywhere.
#![no_main]

use halflight::build::{EnvironmentTables, Image};
use halflight::glam::{Mat3, Vec3};
use halflight::light::{EnvironmentDensity, EnvironmentMap};
use halflight_fuzz::{Numbers, emitter};
use libfuzzer_sys::fuzz_target;

const DENSITIES: [EnvironmentDensity; 4] = [
    EnvironmentDensity::Cosine,
    EnvironmentDensity::Luminance,
    EnvironmentDensity::Compensated,
    EnvironmentDensity::Product,
];

fuzz_target!(|data: &[u8]| {
    let mut n = Numbers::new(data);
    let (width, height) = (u32::from(n.byte() % 20), u32::from(n.byte() % 20));
    let density = DENSITIES[usize::from(n.byte() % 4)];
    let to_world = Mat3::from_axis_angle(Vec3::new(0.6, 0.8, 0.0), f32::from(n.byte()));
    let texels = (0..width * height).map(|_| n.colour()).collect();
    let image = Image { width, height, texels };
    let Ok(map) = EnvironmentMap::new(&image.texels, width, height, to_world) else { return };
    let tables = EnvironmentTables::new(&image, density);
    let map = tables.table().map_or(map, |table| map.with_table(table).expect("a table of this map"));
    emitter(&map, &n.receiver(), n.uniforms());
});
