//! What holds for every BSDF.

use crate::histogram::{ConeGrid, directions_follow_density};
use crate::random::{Uniforms, corners};
use crate::statistics::Moments;
use crate::{Verdict, ensure};
use halflight::bsdf::{Bsdf, BsdfSample};
use halflight::glam::Vec3;
use std::f64::consts::TAU;

/// Samples of each estimate.
const SAMPLES: u64 = 1 << 19;

/// Cosines of the outgoing direction: facing, aside, grazing.
pub const COSINES: [f32; 5] = [1.0, 0.8, 0.4, 0.1, 1e-3];

/// The outgoing direction of a cosine, in no coordinate plane.
#[must_use]
pub fn outgoing(cosine: f32) -> Vec3 {
    let sine = ((1.0 - cosine) * (1.0 + cosine)).sqrt();
    Vec3::new(0.6 * sine, -0.8 * sine, cosine)
}

fn draw(bsdf: &impl Bsdf, wo: Vec3, random: &mut Uniforms) -> Option<BsdfSample> {
    let u = random.two();
    bsdf.sample(wo, u, random.one())
}

/// The density of a sample is the density that is answered for its direction, to the last bit.
///
/// # Errors
/// When they differ.
pub fn queried_density_equals_sampled_density(bsdf: &impl Bsdf) -> Verdict {
    let mut random = Uniforms::new(51);
    let mut compared = 0;
    for cosine in COSINES {
        let wo = outgoing(cosine);
        for _ in 0..20_000 {
            let Some(sample) = draw(bsdf, wo, &mut random) else { continue };
            let queried = bsdf.pdf_solid_angle(wo, sample.wi);
            ensure!(queried == sample.pdf_solid_angle, "{sample:?} has the density {queried} when queried");
            compared += 1;
        }
    }
    ensure!(compared > 10_000, "only {compared} samples");
    Ok(())
}

/// `f_r` is the same both ways.
///
/// # Errors
/// When it is not.
pub fn light_may_run_backward(bsdf: &impl Bsdf) -> Verdict {
    let mut random = Uniforms::new(52);
    for _ in 0..100_000 {
        let [a, b] = [0; 2].map(|_| {
            let d = random.direction();
            Vec3::new(d.x, d.y, d.z.abs())
        });
        let (there, back) = (bsdf.eval(a, b).g, bsdf.eval(b, a).g);
        ensure!((there - back).abs() <= 1e-5 * there.max(back), "{a} {b}: {there} and {back}");
    }
    Ok(())
}

/// What is reflected of light from everywhere, from samples of the BSDF itself.
#[must_use]
pub fn furnace(bsdf: &impl Bsdf, wo: Vec3) -> Moments {
    let mut random = Uniforms::new(53);
    Moments::of((0..SAMPLES).map(|_| {
        draw(bsdf, wo, &mut random).map_or(0.0, |sample| {
            f64::from(bsdf.eval(wo, sample.wi).g * sample.wi.z) / f64::from(sample.pdf_solid_angle)
        })
    }))
}

/// No more is reflected than arrives, from samples of the BSDF and from uniform directions alike.
///
/// * `uniform` – false for lobes that uniform directions do not find
///
/// # Errors
/// When more is reflected, or the two differ.
pub fn reflects_at_most_what_arrives(bsdf: &impl Bsdf, uniform: bool) -> Verdict {
    for cosine in COSINES {
        let wo = outgoing(cosine);
        let own = furnace(bsdf, wo);
        let bound = 1.0 + 5.0 * own.standard_error() + 1e-5;
        ensure!(own.mean() <= bound, "{} is reflected at cosine {cosine}", own.mean());
        if uniform {
            let mut random = Uniforms::new(54);
            let grid = ConeGrid::new(Vec3::Z, 1.0);
            let other = Moments::of((0..SAMPLES).map(|_| {
                let [s, t] = random.two().map(f64::from);
                let wi = grid.direction(s, t);
                f64::from(bsdf.eval(wo, wi).g * wi.z) * TAU
            }));
            own.check_same(&format!("albedo at cosine {cosine}"), &other, 1e-4)?;
        }
    }
    Ok(())
}

/// Directions are as frequent as their density says, in a cone around the mirror direction.
///
/// * `extent` – `1 − cos` of the cone's half-angle; 2 for all directions
///
/// # Errors
/// When they are not.
pub fn directions_pass_chi_square(bsdf: &impl Bsdf, extent: f64) -> Verdict {
    // At grazing angles a narrow lobe is a needle that no grid of cells resolves.
    for cosine in COSINES.into_iter().filter(|c| extent == 2.0 || *c >= 0.1) {
        let wo = outgoing(cosine);
        let grid = ConeGrid::new(Vec3::new(-wo.x, -wo.y, wo.z), extent);
        directions_follow_density(
            &grid,
            SAMPLES,
            |random| draw(bsdf, wo, random).map(|sample| sample.wi),
            |wi| f64::from(bsdf.pdf_solid_angle(wo, wi)),
        )
        .map_err(|e| crate::Failure(format!("at cosine {cosine}: {e:?}")))?;
    }
    Ok(())
}

/// Whatever the direction and the uniforms: numbers, and none negative.
///
/// # Errors
/// When something else comes out.
pub fn extremes_stay_finite(bsdf: &impl Bsdf) -> Verdict {
    let mut random = Uniforms::new(55);
    for cosine in [1.0, 0.5, 1e-3, 1e-7, 1e-30, 0.0, -1e-7, -1.0_f32] {
        let wo = outgoing(cosine);
        for u in corners().chain((0..2000).map(|_| random.two())).collect::<Vec<_>>() {
            for lobe in [0.0, random.one(), 1.0 - 0.5 * f32::EPSILON] {
                let Some(BsdfSample { wi, pdf_solid_angle }) = bsdf.sample(wo, u, lobe) else { continue };
                ensure!((wi.length() - 1.0).abs() < 2e-6, "{wo}: direction {wi}");
                let pdf = pdf_solid_angle;
                ensure!(pdf > 0.0 && pdf.is_finite(), "{wo}: density {pdf} of {wi}");
                let share = bsdf.eval(wo, wi) * (wi.z.abs() / pdf);
                ensure!(share.is_valid(), "{wo} {wi}: {share:?} is reflected");
            }
            let wi = ConeGrid::new(Vec3::Z, 2.0).direction(f64::from(u[0]), f64::from(u[1]));
            let (f, pdf) = (bsdf.eval(wo, wi), bsdf.pdf_solid_angle(wo, wi));
            ensure!(f.is_valid() && pdf >= 0.0 && !pdf.is_nan(), "{wo} {wi}: {f:?} with density {pdf}");
            let below = wo.z <= 0.0 || wi.z <= 0.0;
            ensure!(!below || (f.is_black() && pdf == 0.0), "{wo} {wi}: {f:?} through the surface");
        }
    }
    Ok(())
}

/// A BSDF that lies about its density: what the checks must notice.
#[derive(Debug, Clone, Copy)]
pub struct Lying<B> {
    /// The honest one.
    pub bsdf: B,
    /// Factor on the density of samples.
    pub sampled: f32,
    /// Factor on queried densities.
    pub queried: f32,
}

impl<B: Bsdf> Bsdf for Lying<B> {
    fn eval(&self, wo: Vec3, wi: Vec3) -> halflight::Rgb {
        self.bsdf.eval(wo, wi)
    }

    fn sample(&self, wo: Vec3, u: [f32; 2], u_lobe: f32) -> Option<BsdfSample> {
        let sample = self.bsdf.sample(wo, u, u_lobe)?;
        Some(BsdfSample { pdf_solid_angle: sample.pdf_solid_angle * self.sampled, ..sample })
    }

    fn pdf_solid_angle(&self, wo: Vec3, wi: Vec3) -> f32 {
        self.bsdf.pdf_solid_angle(wo, wi) * self.queried
    }

    fn albedo(&self) -> halflight::Rgb {
        self.bsdf.albedo()
    }
}
