//! What a render is to reach: samples, an error or a time.

use crate::args::{Adaptive, RenderArgs};
use crate::driver::Goal;
use crate::failure::Failure;
use halflight::build::Description;
use std::time::{Duration, Instant};

/// Samples per pixel where neither the user nor the scene says.
const DEFAULT_SAMPLES: u32 = 64;

/// Most samples per pixel for an error or a time, where the user does not say.
pub(crate) const DEFAULT_CAP: u32 = 65_536;

/// Refuses flags that contradict each other.
///
/// # Errors
/// When a flag has no use with the goal.
pub(crate) fn check(args: &RenderArgs) -> Result<(), Failure> {
    let open = args.error.is_some() || args.time.is_some();
    let useless = [("--max-spp", args.max_spp.is_some()), ("--adaptive on", args.adaptive == Adaptive::On)];
    match useless.iter().find(|(_, given)| *given && !open) {
        Some((flag, _)) => Err(Failure::new(format!("{flag} has no use where the samples are given"))
            .tip(format!("leave {flag} out, or use it with --error or --time"))),
        None => Ok(()),
    }
}

/// The goal; adaptive unless that is turned off, as it is better on every scene it was measured on.
///
/// * `begin` – when the program began: reading and building are part of the time
///
/// # Errors
/// When there would be no samples.
pub(crate) fn make(args: &RenderArgs, description: &Description, begin: Instant) -> Result<Goal, Failure> {
    let (most, adaptive) = (args.max_spp.unwrap_or(DEFAULT_CAP), args.adaptive != Adaptive::Off);
    if let Some(percent) = args.error {
        return Ok(Goal::Error { target: f64::from(percent) / 100.0, most, adaptive });
    }
    if let Some(seconds) = args.time {
        let deadline = begin + Duration::from_secs_f32(seconds.min(MOST_SECONDS));
        return Ok(Goal::Time { deadline, most, adaptive });
    }
    match args.spp.or(description.samples_per_pixel).unwrap_or(DEFAULT_SAMPLES) {
        0 => Err(Failure::new("0 samples per pixel make no picture").tip("choose some with --spp")),
        samples => Ok(Goal::Samples(samples)),
    }
}

/// Ten years: what is longer does not fit a clock.
const MOST_SECONDS: f32 = 3.15e8;

impl Goal {
    /// Samples per pixel for which points are laid out: the most that there can be. Beyond those, points
    /// begin anew. Laid out for 64, √relMSE of the peers' `rect` and `veach` is a seventh larger at 512
    /// samples; what neighbours share instead is worth a tenth at 16, after a blur, and less with more.
    pub(crate) const fn samples(&self) -> u32 {
        match self {
            Self::Samples(samples) | Self::Error { most: samples, .. } | Self::Time { most: samples, .. } => {
                *samples
            }
        }
    }

    /// True when samples go where the error is.
    pub(crate) fn is_adaptive(&self) -> bool {
        matches!(self, Self::Error { adaptive: true, .. } | Self::Time { adaptive: true, .. })
    }
}
