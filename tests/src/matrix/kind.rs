//! Which density a light was sampled with, judged by its values.

use super::examine::Drawn;
use super::truth::Truth;
use crate::oracle::{Amounts, Patch};
use halflight::light::{Receiver, SurfaceDensity};

/// What a density turned out to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// Uniform over the surface.
    Area,
    /// Uniform over solid angle.
    SolidAngle,
    /// Uniform over projected solid angle.
    Projected,
    /// None of these, but one of its own.
    Own,
}

impl Kind {
    /// One letter, for the table.
    #[must_use]
    pub const fn letter(self) -> char {
        match self {
            Self::Area => 'A',
            Self::SolidAngle => 'S',
            Self::Projected => 'P',
            Self::Own => 'o',
        }
    }

    /// True where a density close to the one that was asked for will do: where none is known in
    /// closed form.
    pub(super) fn may_be_own(patch: Patch, method: SurfaceDensity) -> bool {
        let polygon = matches!(patch, Patch::Parallelogram(..) | Patch::Triangle(..));
        match method {
            SurfaceDensity::Area => false,
            SurfaceDensity::SolidAngle => !polygon && !matches!(patch, Patch::Sphere(..)),
            SurfaceDensity::Projected | SurfaceDensity::Auto => true,
        }
    }

    /// What each kind is to a method, the best first.
    const fn order(method: SurfaceDensity) -> &'static [Self] {
        match method {
            SurfaceDensity::Area => &[Self::Area],
            SurfaceDensity::SolidAngle => &[Self::SolidAngle, Self::Area],
            _ => &[Self::Projected, Self::SolidAngle, Self::Area],
        }
    }

    /// The kind that all samples fit best, and how far the others are from fitting.
    pub(super) fn recognise(
        method: SurfaceDensity,
        truth: &Truth,
        from: &Receiver,
        drawn: &[([f32; 2], Drawn)],
    ) -> (Self, String) {
        let (mut best, mut misfits) = ((f64::INFINITY, Self::Own), String::new());
        for &kind in Self::order(method) {
            if drawn.is_empty() {
                // Only a density over the whole surface, most of it unseen, may miss what is seen.
                best.1 = kind;
            }
            let (mut worst, mut fits) = (0.0_f64, !drawn.is_empty());
            for (_, drawn) in drawn {
                let (exact, tolerance) = kind.exact(truth, from, drawn);
                let off = (f64::from(drawn.pdf) / exact - 1.0).abs();
                worst = worst.max(off);
                fits &= off <= tolerance;
            }
            if fits && worst < best.0 {
                best = (worst, kind);
            } else if !fits {
                misfits += &format!("{kind:?} is off by up to {worst:.1e}; ");
            }
        }
        (best.1, misfits)
    }

    /// The density of a sample (sr⁻¹), and how far single precision may be off, relatively.
    fn exact(self, truth: &Truth, from: &Receiver, drawn: &Drawn) -> (f64, f64) {
        let eps = 4.0 * f64::from(f32::EPSILON);
        let (total, slack) = (&truth.total, &truth.total_slack);
        match self {
            Self::SolidAngle => (1.0 / total.solid_angle, 2e-5 + slack.solid_angle / total.solid_angle),
            Self::Projected => {
                let cos = from.normal.as_dvec3().dot(drawn.sample.wi.as_dvec3());
                (cos / total.irradiance, truth.rounding() / total.irradiance + 1e-5 + eps / cos.max(1e-30))
            }
            _ => {
                let cos = f64::from(drawn.cos_light());
                let pdf = f64::from(drawn.sample.distance).powi(2) / (truth.outlook.whole_area() * cos);
                let loose = slack.solid_angle / total.solid_angle + slack.area / total.area;
                (pdf, 2e-5 + eps / cos + loose)
            }
        }
    }

    /// The share of samples that are in a cell, of all that are drawn; none for a density of its own.
    pub(super) fn share(self, part: &Amounts, truth: &Truth) -> Option<f64> {
        match self {
            Self::Area => Some(part.area / truth.outlook.whole_area()),
            Self::SolidAngle => Some(part.solid_angle / truth.total.solid_angle),
            Self::Projected => Some(part.irradiance / truth.total.irradiance),
            Self::Own => None,
        }
    }

    /// Variance of one sample of the irradiance; none for a density of its own.
    pub(super) fn variance(self, truth: &Truth) -> Option<f64> {
        let total = &truth.total;
        let second = match self {
            Self::Area => truth.outlook.whole_area() * total.geometry_squared,
            Self::SolidAngle => total.solid_angle * total.cos_squared,
            Self::Projected => total.irradiance.powi(2),
            Self::Own => return None,
        };
        Some((second - total.irradiance.powi(2)).max(0.0))
    }
}
