//! Near and far, tiny and huge, facing and edge-on.

use super::{Area, Specimen, Subject};
use crate::random::{Uniforms, corners};
use crate::{Verdict, ensure};
use halflight::Rgb;
use halflight::glam::Vec3;
use halflight::light::{AreaLight, Density, Emitter, Receiver, SurfaceDensity, SurfaceView};

/// Sizes of the light (m).
const SIZES: [f32; 3] = [1e-6, 1.0, 1e6];

/// Distances, in sizes of the light.
const DISTANCES: [f32; 7] = [0.0, 1e-6, 1e-3, 0.1, 1.0, 1e3, 1e6];

/// Angles from the light's normal: facing, aside, 1 mrad above its plane, in it, behind (rad).
const ANGLES: [f32; 6] = [
    0.0,
    std::f32::consts::FRAC_PI_3,
    std::f32::consts::FRAC_PI_2 - 1e-3,
    std::f32::consts::FRAC_PI_2,
    2.5,
    std::f32::consts::PI,
];

/// Whatever the distance, the size and the angle: a unit direction with a positive finite density
/// that is the queried one to the last bit, or nothing.
///
/// # Errors
/// When something else comes out.
pub fn extreme_distances_stay_finite<S: Specimen>(subject: &Area<S>) -> Verdict {
    for size in SIZES {
        let shape = subject.light.shape().scaled(size / subject.size());
        for distance in DISTANCES {
            for angle in ANGLES {
                for from in around(&shape, distance * size, angle) {
                    let what = format!("{shape:?} {distance} sizes away at {angle} rad");
                    let (method, two_sided) = (subject.method, subject.two_sided);
                    stays_finite(&what, shape, &from, method, two_sided)?;
                    stays_finite(&what, shape.turned(), &from, method, two_sided)?;
                }
            }
        }
    }
    Ok(())
}

/// Receivers that face the light's foot, and that see it at 85°.
fn around<S: Specimen>(shape: &S, distance: f32, angle: f32) -> [Receiver; 2] {
    let (foot, normal) = shape.foot();
    let aside = normal.any_orthonormal_vector();
    let out = normal * angle.cos() + aside * angle.sin();
    let point = foot + out * distance;
    let across = out.cross(aside).normalize_or(normal.cross(aside));
    let (sin, cos) = 85.0_f32.to_radians().sin_cos();
    [Receiver { point, normal: -out }, Receiver { point, normal: (across * sin - out * cos).normalize() }]
}

fn stays_finite<S: Specimen>(
    what: &str,
    shape: S,
    from: &Receiver,
    method: SurfaceDensity,
    two_sided: bool,
) -> Verdict {
    let light = AreaLight::new(shape, Rgb::WHITE).expect("a proper radiance");
    let light = if two_sided { light.two_sided() } else { light };
    let mut random = Uniforms::new(21);
    for u in corners().chain((0..64).map(|_| random.two())) {
        let Some(sample) = light.sample(from, method, u) else { continue };
        let Density::SolidAngle(pdf) = sample.density else {
            return Err(crate::Failure(format!("{what}: an area light has no density")));
        };
        let distance = sample.distance;
        ensure!((sample.wi.length() - 1.0).abs() < 1e-6, "{what}: direction {}", sample.wi);
        ensure!(distance > 0.0 && distance.is_finite(), "{what}: distance {distance} at {u:?}");
        ensure!(pdf > 0.0 && pdf.is_finite(), "{what}: density {pdf} at {u:?}");
        ensure!(sample.incident == Rgb::WHITE, "{what}: radiance {:?}", sample.incident);
        let share = from.normal.dot(sample.wi).max(0.0) / pdf;
        ensure!(share.is_finite(), "{what}: {share} arrives with density {pdf}");
        let Some(drawn) = light.view(from, method).and_then(|v| v.sample(u)) else {
            return Err(crate::Failure(format!("{what}: a direction without a point at {u:?}")));
        };
        let queried = light.pdf_solid_angle(from, method, sample.wi, &drawn.at);
        ensure!(queried == pdf, "{what}: density {queried} when queried, {pdf} when sampled");
        on_the_light(what, &shape, from, drawn.at.point, sample.wi * distance)?;
    }
    Ok(())
}

/// The sampled point is where the direction and the distance say.
fn on_the_light<S: Specimen>(what: &str, shape: &S, from: &Receiver, point: Vec3, way: Vec3) -> Verdict {
    let reach = from.point.abs().max_element().max(shape.bounding_sphere().1).max(way.abs().max_element());
    let off = (from.point + way - point).length();
    ensure!(off <= 2e-6 * reach, "{what}: the way ends {off} beside {point}, a reach of {reach}");
    Ok(())
}
