//! What holds for every light.

use super::{Area, Lying, Specimen, Subject};
use crate::histogram::{ConeGrid, directions_follow_density};
use crate::random::{Uniforms, corners};
use crate::statistics::Moments;
use crate::{Verdict, ensure};
use halflight::glam::Vec3;
use halflight::light::{AreaLight, SampledShape, SurfaceView};

/// Samples of each estimate: their standard errors are some tenths of a percent.
const SAMPLES: u64 = 1 << 19;

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
    let grid = {
        let (axis, extent) = subject.cone();
        ConeGrid::new(axis, extent)
    };
    let by_direction = Moments::of((0..SAMPLES).map(|_| {
        let [s, t] = random.two();
        let wi = grid.direction(f64::from(s), f64::from(t));
        let radiance = subject.seen(wi).map_or(0.0, |seen| seen.radiance);
        f64::from(normal.dot(wi).max(0.0) * radiance) * grid.solid_angle()
    }));
    ensure!(by_light.mean() > 0.0, "the light sends nothing");
    by_light.check_same("irradiance by light and by direction", &by_direction, ROUNDING)
}

/// Directions are as frequent as the queried density says.
///
/// # Errors
/// When the histogram is too unlikely, or the density integrates to something else than the share
/// of samples that there are.
pub fn directions_pass_chi_square(subject: &impl Subject) -> Verdict {
    let draw = |random: &mut Uniforms| {
        let (sample, _) = subject.draw(random.two())?;
        clear_pdf(subject, sample.wi).map(|_| sample.wi)
    };
    let (axis, extent) = subject.cone();
    let pdf = |wi| clear_pdf(subject, wi).unwrap_or(0.0);
    directions_follow_density(&ConeGrid::new(axis, extent), SAMPLES, draw, pdf)
}

/// Density of a direction, but not at a round light's rim: there it grows beyond all bounds, and
/// is as noisy as the last bits of the cosine.
fn clear_pdf(subject: &impl Subject, wi: Vec3) -> Option<f64> {
    subject.seen(wi).filter(|seen| seen.cos_light.abs() > 0.02).map(|seen| f64::from(seen.pdf))
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
    let grid = {
        let (axis, extent) = subject.cone();
        ConeGrid::new(axis, extent)
    };
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

/// Directions know the uniforms that they came from, however the light is sampled.
///
/// # Errors
/// When they do not.
pub fn view_inverse_returns_the_uniforms<S: Specimen>(subject: &Area<S>) -> Verdict {
    let mut random = Uniforms::new(17);
    let view = subject.light.view(&subject.from, subject.method);
    let mut compared = 0;
    for _ in 0..20_000 {
        // Off the seams, where 0 and 1 are the same place.
        let u = random.two().map(|u| 0.001 + 0.998 * u);
        let Some(view) = view else { break };
        let Some(sample) = view.sample(u) else { continue };
        if sample.at.normal.dot(sample.wi) >= 0.0 && !subject.two_sided {
            continue;
        }
        compared += 1;
        let Some(v) = view.invert(&sample.at, sample.wi) else {
            return Err(crate::Failure(format!("{u:?} cannot be found again from {sample:?}")));
        };
        // A point is rounded in the light's coordinates, a direction in its own.
        let off = (u[0] - v[0]).abs().max((u[1] - v[1]).abs());
        ensure!(off < 1e-3, "{u:?} became {v:?}");
    }
    ensure!(compared > 200, "{compared} compared");
    Ok(())
}

/// A light whose samples claim `factor` times their density.
#[must_use]
pub fn scaled<T: Subject>(subject: T, factor: f32) -> Lying<T> {
    Lying { subject, sampled: factor, queried: [factor; 2] }
}
