//! What holds for every light.

use super::{Area, Lying, Specimen, Subject};
use crate::random::{Uniforms, corners};
use crate::statistics::{Moments, chi_square};
use crate::{Verdict, ensure};
use halflight::glam::{DVec3, Vec3};
use halflight::light::{AreaLight, SampledShape};
use std::f64::consts::TAU;

/// Samples of each estimate: its standard error is a fifth of a percent or less.
const SAMPLES: u64 = 1 << 20;

/// What single precision and the quadrature of the truth may add to a mean.
const ROUNDING: f64 = 5e-4;

/// The density of a sample is the density that is answered for its direction.
///
/// # Errors
/// When they differ.
pub fn queried_density_equals_sampled_density(subject: &impl Subject) -> Verdict {
    let mut random = Uniforms::new(11);
    let (mut compared, mut missed) = (0, 0);
    for _ in 0..20_000 {
        let Some((sample, pdf)) = subject.draw(random.two()) else { continue };
        let Some(seen) = subject.seen(sample.wi) else {
            // The direction is rounded and may pass beside the edge.
            missed += 1;
            continue;
        };
        compared += 1;
        // A rounded direction meets the surface a little aside: by its distance over the cosine,
        // and on a curved surface the normal turns with it.
        let reach = if sample.distance.is_finite() { sample.distance / subject.size() } else { 0.0 };
        let tolerance = 1e-5 + 1e-6 * (1.0 + reach) / seen.cos_light.powi(2);
        ensure!(
            (seen.pdf / pdf - 1.0).abs() <= tolerance,
            "toward {} the density is {} when queried, {pdf} when sampled (cosine {})",
            sample.wi,
            seen.pdf,
            seen.cos_light
        );
    }
    ensure!(compared > 200 && missed * 100 < compared, "{compared} compared, {missed} beside the light");
    Ok(())
}

/// `E[1 / p]` is the solid angle, or `E[weight / p]` its weighted measure.
///
/// # Errors
/// When it is not.
pub fn mean_reciprocal_density_is_the_solid_angle(subject: &impl Subject) -> Verdict {
    let mut random = Uniforms::new(12);
    let reciprocal =
        |(sample, pdf): (halflight::light::LightSample, f32)| subject.weight(sample.wi) / f64::from(pdf);
    let moments = Moments::of((0..SAMPLES).map(|_| subject.draw(random.two()).map_or(0.0, reciprocal)));
    moments.check_mean("mean of 1/p", subject.measure(), ROUNDING)
}

/// Irradiance from sampling the light is irradiance from uniform directions that happen to meet it.
///
/// # Errors
/// When they differ.
pub fn area_and_direction_sampling_agree(subject: &impl Subject) -> Verdict {
    let mut random = Uniforms::new(13);
    let normal = subject.from().normal;
    let by_light = Moments::of((0..SAMPLES).map(|_| {
        subject.draw(random.two()).map_or(0.0, |(sample, pdf)| {
            f64::from(normal.dot(sample.wi).max(0.0) * sample.incident.g) / f64::from(pdf)
        })
    }));
    let grid = ConeGrid::new(subject);
    let by_direction = Moments::of((0..SAMPLES).map(|_| {
        let [s, t] = random.two();
        let wi = grid.direction(f64::from(s), f64::from(t));
        let radiance = subject.seen(wi).map_or(0.0, |seen| seen.radiance);
        f64::from(normal.dot(wi).max(0.0) * radiance) * grid.solid_angle()
    }));
    ensure!(by_light.mean() > 0.0, "the light sends nothing");
    by_light.check_same("irradiance by light and by direction", &by_direction, ROUNDING)
}

/// Cells of the histogram: from the axis outward, and around it.
const CELLS: [usize; 2] = [16, 32];

/// Points in each cell along each axis for the integral of the density.
const POINTS: usize = 64;

/// Directions are as frequent as the queried density says.
///
/// # Errors
/// When the histogram is too unlikely, or the density integrates to something else than the share
/// of samples that there are.
pub fn directions_pass_chi_square(subject: &impl Subject) -> Verdict {
    let mut random = Uniforms::new(14);
    let grid = ConeGrid::new(subject);
    let n = SAMPLES as f64;
    let mut expected = vec![0.0; CELLS[0] * CELLS[1]];
    let points = POINTS as f64;
    for (cell, sum) in expected.iter_mut().enumerate() {
        let (i, j) = ((cell / CELLS[1]) as f64, (cell % CELLS[1]) as f64);
        for k in 0..POINTS * POINTS {
            let [a, b] = random.two().map(f64::from);
            let s = (i + ((k / POINTS) as f64 + a) / points) / CELLS[0] as f64;
            let t = (j + ((k % POINTS) as f64 + b) / points) / CELLS[1] as f64;
            *sum += clear_pdf(subject, grid.direction(s, t)).unwrap_or(0.0);
        }
        *sum *= n * grid.solid_angle() / (CELLS[0] * CELLS[1] * POINTS * POINTS) as f64;
    }
    let mut observed = vec![0; CELLS[0] * CELLS[1]];
    for _ in 0..SAMPLES {
        let Some((sample, _)) = subject.draw(random.two()) else { continue };
        if clear_pdf(subject, sample.wi).is_none() {
            continue;
        }
        let [s, t] = grid.coordinates(sample.wi);
        ensure!(s < 1.0, "{} is beyond the light's cone", sample.wi);
        observed[(s * CELLS[0] as f64) as usize * CELLS[1] + (t * CELLS[1] as f64) as usize] += 1;
    }
    let drawn = observed.iter().sum::<u64>() as f64;
    let held = expected.iter().sum::<f64>();
    let spread = 5.0 * (drawn * (1.0 - drawn / n)).sqrt() + 3e-3 * n;
    ensure!(
        (drawn - held).abs() <= spread,
        "{} of the samples exist, the density holds {}",
        drawn / n,
        held / n
    );
    chi_square("directions", &observed, &expected, 0.01)
}

/// Density of a direction, but not at a round light's rim: there it grows beyond all bounds, and
/// is as noisy as the last bits of the cosine.
fn clear_pdf(subject: &impl Subject, wi: Vec3) -> Option<f64> {
    subject.seen(wi).filter(|seen| seen.cos_light.abs() > 0.02).map(|seen| f64::from(seen.pdf))
}

/// Equal-area coordinates of a cone of directions.
struct ConeGrid {
    axes: [DVec3; 3],
    extent: f64,
}

impl ConeGrid {
    fn new(subject: &impl Subject) -> Self {
        let (axis, extent) = subject.cone();
        let n = axis.as_dvec3().normalize();
        let s = n.any_orthonormal_vector();
        Self { axes: [s, n.cross(s), n], extent }
    }

    fn solid_angle(&self) -> f64 {
        TAU * self.extent
    }

    fn direction(&self, s: f64, t: f64) -> Vec3 {
        let x = s * self.extent;
        let across = (x * (2.0 - x)).max(0.0).sqrt();
        let (sin, cos) = (TAU * t).sin_cos();
        let [a, b, n] = self.axes;
        (a * (across * cos) + b * (across * sin) + n * (1.0 - x)).as_vec3()
    }

    fn coordinates(&self, wi: Vec3) -> [f64; 2] {
        let [a, b, n] = self.axes.map(|axis| axis.dot(wi.as_dvec3().normalize()));
        let sin2 = a * a + b * b;
        let x = if n > 0.0 { sin2 / (1.0 + (1.0 - sin2).max(0.0).sqrt()) } else { 1.0 - n };
        [x / self.extent, (b.atan2(a) / TAU).rem_euclid(1.0).min(1.0 - 1e-12)]
    }
}

/// The back of a one-sided light is dark, whether it is sampled or met; both sides of a two-sided
/// one are the same.
///
/// # Errors
/// When something arrives from behind, or two sides differ.
pub fn nothing_arrives_from_behind<S: Specimen>(subject: &Area<S>) -> Verdict {
    let two_sided = subject.two_sided;
    let turned = Area { light: relight(subject.light.shape().turned(), two_sided), ..*subject };
    let mut random = Uniforms::new(15);
    let grid = ConeGrid::new(subject);
    for u in corners().chain((0..50_000).map(|_| random.two())) {
        let wi = grid.direction(f64::from(u[0]), f64::from(u[1]));
        for one in [subject, &turned] {
            let Some(seen) = one.seen(wi) else { continue };
            let lit = two_sided || seen.cos_light > 0.0;
            ensure!((seen.radiance > 0.0) == lit, "radiance {} at cosine {}", seen.radiance, seen.cos_light);
            ensure!(lit || seen.pdf == 0.0, "density {} from behind", seen.pdf);
        }
        let (front, back) = (subject.draw(u), turned.draw(u));
        if two_sided {
            ensure!(front.is_some() == back.is_some(), "the two sides differ at {u:?}");
        } else if S::FLAT {
            ensure!(back.is_none(), "{back:?} arrives from behind at {u:?}");
        } else if let Some((sample, _)) = back {
            // What faces the receiver is behind what does not, except at the rim, where both meet,
            // and through the open end of a tube.
            let seen = turned.seen(sample.wi);
            ensure!(seen.is_none_or(|s| s.cos_light > -0.01), "{sample:?} arrives from behind");
        }
    }
    Ok(())
}

fn relight<S: Specimen>(shape: S, two_sided: bool) -> AreaLight<S> {
    let light = AreaLight::new(shape, halflight::Rgb::WHITE).expect("a proper radiance");
    if two_sided { light.two_sided() } else { light }
}

/// Points of the surface know the uniforms that they came from.
///
/// # Errors
/// When they do not.
pub fn inverse_returns_the_uniforms(shape: &impl SampledShape) -> Verdict {
    let mut random = Uniforms::new(16);
    for _ in 0..100_000 {
        // Off the seams, where 0 and 1 are the same place.
        let u = random.two().map(|u| 0.001 + 0.998 * u);
        let v = shape.sample_area_inverse(shape.sample_area(u).point);
        let off = (u[0] - v[0]).abs().max((u[1] - v[1]).abs());
        ensure!(off < 1e-3, "{u:?} became {v:?}");
        // Near a pole or the centre a turn is not well known; its share of the area is.
        let polar = u[0].min(1.0 - u[0]).min((u[0] - 0.5).abs().max((u[1] - 0.5).abs()));
        ensure!(off < 2e-5 || polar < 0.02, "{u:?} became {v:?}");
    }
    Ok(())
}

/// A light whose samples claim `factor` times their density.
#[must_use]
pub fn scaled<T: Subject>(subject: T, factor: f32) -> Lying<T> {
    Lying { subject, sampled: factor, queried: [factor; 2] }
}
