use super::*;
use crate::build::{EnvironmentTables, Image};
use crate::light::{Density, EnvironmentDensity};
use crate::num::{hash2, unit_f32};
use glam::{DVec3, Mat3};

const NORMALS: [Vec3; 3] = [Vec3::Y, Vec3::NEG_X, Vec3::new(0.6, -0.48, -0.64)];

/// Neighbours that differ by up to a factor of ten, and a sun.
fn sky(width: u32, height: u32) -> Image {
    let texel = |i| if i == width * (height / 5) + 3 { 1e4 } else { num::pow(10.0, unit_f32(hash2(i, 1))) };
    let colour = |i| Rgb::new(texel(i), 0.5 * texel(i), unit_f32(hash2(i, 2)));
    Image { width, height, texels: (0..width * height).map(colour).collect() }
}

fn tables(image: &Image) -> EnvironmentTables {
    EnvironmentTables::new(image, EnvironmentDensity::Compensated)
}

fn map<'a>(image: &'a Image, tables: &'a EnvironmentTables, to_world: Mat3) -> EnvironmentMap<'a> {
    let map = EnvironmentMap::new(&image.texels, image.width, image.height, to_world).unwrap();
    map.with_table(tables.table().unwrap()).unwrap()
}

/// Irradiance by the directions that are let in, by the midpoints of many small patches of each cell.
fn integral(map: &EnvironmentMap<'_>, normal: Vec3, lets_in: impl Fn(Vec3) -> bool) -> [f64; 3] {
    let [width, height] = map.size();
    let (across, down) = (2048 / width * width, 1024 / (height - 1) * (height - 1));
    let step = core::f64::consts::PI / f64::from(down);
    let turn = core::f64::consts::TAU / f64::from(across);
    let mut sum = [0.0; 3];
    for (x, y) in (0..down).flat_map(|y| (0..across).map(move |x| (x, y))) {
        let ((sin, cos), (sin_phi, cos_phi)) =
            (libm::sincos(step * (f64::from(y) + 0.5)), libm::sincos(turn * (f64::from(x) + 0.5)));
        let d = DVec3::new(sin * sin_phi, cos, -sin * cos_phi);
        let world = map.to_local.transpose() * d.as_vec3();
        let cosine = (map.to_local * normal).as_dvec3().dot(d);
        if cosine > 0.0 && lets_in(world) {
            let Rgb { r, g, b } = map.lookup(&map.grid.place(d.as_vec3()));
            let weight = cosine * 2.0 * libm::sin(0.5 * step) * sin * turn;
            sum = [
                sum[0] + weight * f64::from(r),
                sum[1] + weight * f64::from(g),
                sum[2] + weight * f64::from(b),
            ];
        }
    }
    sum
}

/// Irradiance by the rest of a view, by samples that are let in; and how much the samples differ.
fn rest(map: &EnvironmentMap<'_>, view: &SkyView, normal: Vec3, lets_in: impl Fn(Vec3) -> bool) -> [f64; 2] {
    let (count, mut sum, mut squares) = (1 << 18, 0.0, 0.0);
    for i in 0..count {
        let Some(sample) = map.sample_rest(view, [3, 4].map(|k| unit_f32(hash2(i, k)))) else { continue };
        let Density::SolidAngle(pdf) = sample.density else { panic!("a sky is no delta light") };
        let value = f64::from(sample.incident.g * normal.dot(sample.wi).max(0.0) / pdf);
        let value = if lets_in(sample.wi) { value } else { 0.0 };
        sum += value;
        squares += value * value;
    }
    let n = f64::from(count);
    [sum / n, libm::sqrt(squares / (n * n))]
}

/// What is hidden: a cone.
const HIDDEN: (Vec3, f32) = (Vec3::new(0.48, 0.6, 0.64), 0.6);

/// How far the open part and the samples of the rest, of a density `lie` times as large as is said, are from the
/// exact irradiance; in standard errors of the samples and a thousandth.
fn deviation(map: &EnvironmentMap<'_>, normal: Vec3, hides: impl Fn(Vec3) -> bool, lie: f64) -> f64 {
    let clear = map.clear(normal, |part| {
        let angle = libm::asinf(part.sin_radius) + libm::acosf(HIDDEN.1);
        part.axis.dot(HIDDEN.0) > libm::cosf(angle)
    });
    let view = map.view(normal, &clear.unwrap()).unwrap();
    let exact = integral(map, normal, |d| !hides(d))[1];
    let [sum, error] = rest(map, &view, normal, |d| !hides(d));
    assert!(sum < 0.9 * exact, "{normal}: {sum} {exact}");
    (f64::from(view.irradiance().g) + sum / lie - exact).abs() / (error + 1e-4 * exact)
}

#[test]
fn what_is_open_and_the_rest_are_the_whole_sky() {
    let turned = Mat3::from_rotation_z(0.4) * Mat3::from_rotation_y(1.0);
    for (size, to_world) in [((128, 65), Mat3::IDENTITY), ((128, 65), turned), ((32, 17), turned)] {
        let image = sky(size.0, size.1);
        let tables = tables(&image);
        let map = map(&image, &tables, to_world).scaled(1.5).unwrap();
        let mut lies = 0;
        for normal in NORMALS {
            let hides = |d: Vec3| d.dot(HIDDEN.0) > HIDDEN.1;
            for seen in [deviation(&map, normal, hides, 1.0), deviation(&map, normal, |_| false, 1.0)] {
                assert!(seen < 5.0, "{size:?} {normal}: {seen}");
            }
            lies += u32::from(deviation(&map, normal, |_| false, 1.02) > 5.0);
        }
        assert!(lies > 0, "{size:?}: a density that is wrong is not found");
    }
}

/// Radiance is integrated exactly, so that without anything in the way only the ring at the horizon is left.
#[test]
fn an_open_sky_is_a_closed_form() {
    let image = sky(64, 33);
    let tables = tables(&image);
    let map = map(&image, &tables, Mat3::from_rotation_z(0.4));
    for normal in NORMALS {
        let view = map.view(normal, &map.clear(normal, |_| false).unwrap()).unwrap();
        let (exact, ring) = (integral(&map, normal, |_| true), rest(&map, &view, normal, |_| true));
        let seen = f64::from(view.irradiance().g) + ring[0];
        assert!((seen - exact[1]).abs() < 5.0 * ring[1] + 5e-5 * exact[1], "{normal}: {seen} {exact:?}");
        assert!(ring[0] < 0.2 * exact[1], "{normal}: {ring:?} {exact:?}");
    }
}

/// The closed form of radiances of any size is right, or there is none.
#[test]
fn the_closed_form_is_right_or_there_is_none() {
    let irradiance = |size: f32| {
        let mut image = sky(64, 33);
        image.texels.iter_mut().for_each(|texel| *texel *= size * 1e-4);
        let tables = tables(&image);
        let map = map(&image, &tables, Mat3::IDENTITY);
        let clear = map.clear(Vec3::Y, |part| part.axis.y < 0.5).unwrap();
        map.view(Vec3::Y, &clear).map(|view| view.irradiance() / size)
    };
    let usual = irradiance(1.0).unwrap();
    for size in [1e-40, 1e-37, 1e-30, 1e-20, 1e20, 1e30, 1e37, 1e38] {
        let Some(seen) = irradiance(size) else {
            assert!(!(1e-36..1e36).contains(&size), "{size}");
            continue;
        };
        assert!((seen.g / usual.g - 1.0).abs() < 1e-3, "{size}: {seen:?} {usual:?}");
    }
}
