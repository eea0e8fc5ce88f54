//! What the choices are judged by, and how well that is known itself.

use super::choices::Candidate;
use super::ladder::{Errors, Stage};
use super::region::Region;
use halflight::Rgb;
use halflight::estimate::PixelStats;
use rayon::prelude::*;

/// Seeds of the reference; those of the ladders are far away.
const SEEDS: [u32; 2] = [0x7265_6665, 0x7265_6e63];

/// A picture that is nearly converged.
#[derive(Debug)]
pub(super) struct Reference {
    pixels: Vec<Rgb>,
    regions: Vec<Region>,
    /// Its own relMSE.
    pub(super) noise: Errors,
    /// Samples per pixel; `None` for a picture that was given.
    pub(super) samples: Option<u32>,
    /// CPU time that it took (s).
    pub(super) seconds: f64,
}

impl Reference {
    /// Renders `samples` samples per pixel as two independent halves: half their difference is the error of
    /// their mean. `None` when interrupted.
    pub(super) fn render(
        stage: &Stage<'_>,
        candidate: &Candidate,
        samples: u32,
        regions: Vec<Region>,
    ) -> Option<Self> {
        let half = (samples / 2).max(1);
        let (a, a_seconds) = stage.picture(candidate, SEEDS[0], half)?;
        let (b, b_seconds) = stage.picture(candidate, SEEDS[1], half)?;
        let pixels: Vec<_> = a.iter().zip(&b).map(|(&a, &b)| (a + b) * 0.5).collect();
        let square = |i: usize, channel: usize| {
            let (a, b) = (a[i].to_array()[channel], b[i].to_array()[channel]);
            0.25 * f64::from(a - b).powi(2)
        };
        let noise = mean_over(&pixels, &regions, square);
        let samples = Some(2 * half);
        Some(Self { noise, pixels, regions, samples, seconds: a_seconds + b_seconds })
    }

    /// Takes a picture that was given, whose noise is what two independent renders find amiss with it
    /// alike. `None` when interrupted.
    pub(super) fn given(
        stage: &Stage<'_>,
        candidate: &Candidate,
        samples: u32,
        regions: Vec<Region>,
        pixels: Vec<Rgb>,
    ) -> Option<Self> {
        let (a, a_seconds) = stage.picture(candidate, SEEDS[0], samples)?;
        let (b, b_seconds) = stage.picture(candidate, SEEDS[1], samples)?;
        let product = |i: usize, channel: usize| {
            let [a, b, r] = [a[i], b[i], pixels[i]].map(|p| f64::from(p.to_array()[channel]));
            (a - r) * (b - r)
        };
        let noise = mean_over(&pixels, &regions, product);
        let noise = noise.zip(noise, |x, _| x.max(0.0));
        Some(Self { noise, pixels, regions, samples: None, seconds: a_seconds + b_seconds })
    }

    /// relMSE of a picture, the noise of the reference included.
    pub(super) fn relmse(&self, pixels: &[PixelStats]) -> Errors {
        mean_over(&self.pixels, &self.regions, |i, channel| {
            let (p, r) = (pixels[i].mean().to_array()[channel], self.pixels[i].to_array()[channel]);
            f64::from(p - r).powi(2)
        })
    }

    /// Fraction of the pixels in a region.
    pub(super) fn share(&self, region: Region) -> f64 {
        self.regions.iter().filter(|r| **r == region).count() as f64 / self.regions.len() as f64
    }
}

/// Mean of `square(pixel, channel) / (R² + 0.01)` over pixels and channels, for each part of the picture.
fn mean_over(reference: &[Rgb], regions: &[Region], square: impl Fn(usize, usize) -> f64 + Sync) -> Errors {
    let pixel = |i: usize| {
        let r = reference[i].to_array();
        (0..3).map(|c| square(i, c) / (f64::from(r[c]).powi(2) + 0.01)).sum::<f64>() / 3.0
    };
    // Collected first: a sum in parallel would depend on the threads.
    let values: Vec<f64> = (0..reference.len()).into_par_iter().map(pixel).collect();
    let mean = |part: &dyn Fn(Region) -> bool| {
        let part = values.iter().zip(regions).filter(|(_, r)| part(**r));
        let (sum, count) = part.fold((0.0, 0), |(sum, count), (v, _)| (sum + v, count + 1));
        if count > 0 { sum / f64::from(count) } else { f64::NAN }
    };
    Errors {
        all: mean(&|_| true),
        open: mean(&|r| r == Region::Open),
        penumbra: mean(&|r| r == Region::Penumbra),
    }
}
