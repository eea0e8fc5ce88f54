//! Choices by the names that the command line gives them.

use crate::estimator::Shown;
use halflight::build::{Description, FEW_LIGHTS, SceneBuffers};
use halflight::choose::LightChoice;
use halflight::estimate::{Arrival, Direct, Heuristic, Occlusion, Technique};
use halflight::light::{EnvironmentDensity, SurfaceDensity};
use halflight::sequence::{AnySequence, Random, Sobol, ZSobol};
use std::fmt;

/// What a picture shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Show {
    /// Radiance.
    Radiance,
    /// How much of the light arrives.
    Visibility,
    /// How much of the sky is open.
    Occlusion,
}

/// Everything that can be chosen; `None` is `auto`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Choices {
    show: Show,
    technique: Option<Technique>,
    heuristic: Heuristic,
    surface: SurfaceDensity,
    choose: Option<Choose>,
    environment: Option<EnvironmentDensity>,
    sequence: Draws,
    light_samples: Option<u32>,
    bsdf_samples: Option<u32>,
    seed: u32,
    /// How many samples a pixel is meant to get at most: neighbours share a sequence by that.
    samples: u32,
}

/// Which light a sample goes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Choose {
    All,
    Uniform,
    Power,
    Tree,
}

/// Where the uniforms come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Draws {
    Random,
    Sobol,
    ZSobol,
}

/// A choice that there is not.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct UnknownChoice {
    name: String,
    value: String,
}

impl fmt::Display for UnknownChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "there is no choice {} = {}; the names are those of halflight render",
            self.name, self.value
        )
    }
}

impl std::error::Error for UnknownChoice {}

impl Default for Choices {
    fn default() -> Self {
        Self {
            show: Show::Radiance,
            technique: None,
            heuristic: Heuristic::default(),
            surface: SurfaceDensity::Auto,
            choose: None,
            environment: None,
            sequence: Draws::ZSobol,
            light_samples: None,
            bsdf_samples: None,
            seed: 0,
            samples: 1 << 16,
        }
    }
}

impl Choices {
    /// Makes one choice.
    ///
    /// # Errors
    /// When there is none of that name or value.
    pub(crate) fn set(&mut self, name: &str, value: &str) -> Result<(), UnknownChoice> {
        let unknown = || UnknownChoice { name: name.to_owned(), value: value.to_owned() };
        let known = match name {
            "show" => show(value).map(|v| self.show = v),
            "technique" => technique(value, self.heuristic).map(|v| self.technique = v),
            "heuristic" => heuristic(value).map(|v| self.weigh_by(v)),
            "lights" => surface(value).map(|v| self.surface = v),
            "choose" => choose(value).map(|v| self.choose = v),
            "environment" => environment(value).map(|v| self.environment = v),
            "sequence" => sequence(value).map(|v| self.sequence = v),
            "light-samples" => count(value).map(|v| self.light_samples = v),
            "bsdf-samples" => count(value).map(|v| self.bsdf_samples = v),
            "samples" => value.parse().ok().filter(|n| *n > 0).map(|v| self.samples = v),
            "seed" => value.parse().ok().map(|v| self.seed = v),
            _ => None,
        };
        known.ok_or_else(unknown)
    }

    fn weigh_by(&mut self, heuristic: Heuristic) {
        self.heuristic = heuristic;
        self.technique = self.technique.map(|technique| match technique {
            Technique::Mis(_) => Technique::Mis(heuristic),
            Technique::Control(_) => Technique::Control(heuristic),
            other => other,
        });
    }

    /// The technique for a scene.
    fn technique(&self, description: &Description) -> Technique {
        let mut integrator = description.integrator;
        integrator.light_samples = self.light_samples.or(integrator.light_samples);
        integrator.bsdf_samples = self.bsdf_samples.or(integrator.bsdf_samples);
        self.technique.unwrap_or_else(|| description.required_technique(integrator, self.heuristic))
    }

    /// How directions toward the environment maps of a scene are drawn: part of its tables.
    pub(crate) fn environment(&self, description: &Description) -> EnvironmentDensity {
        self.environment.unwrap_or_else(|| description.required_environment(self.technique(description)))
    }

    /// The estimator for a scene of `lights` lights.
    pub(crate) fn estimator<'a>(
        &self,
        description: &Description,
        buffers: &'a SceneBuffers,
        lights: usize,
    ) -> Shown<'a> {
        let choice = self.light_choice(buffers, lights);
        let author = description.integrator;
        let samples = |own: Option<u32>, author: Option<u32>| own.or(author).unwrap_or(1).max(1);
        let light_samples = samples(self.light_samples, author.light_samples);
        match self.show {
            Show::Occlusion => Shown::Occlusion(Occlusion::default()),
            Show::Visibility => Shown::Visibility(Arrival { light_samples, surface: self.surface, choice }),
            Show::Radiance => Shown::Radiance(Direct {
                technique: self.technique(description),
                light_samples,
                bsdf_samples: samples(self.bsdf_samples, author.bsdf_samples),
                surface: self.surface,
                choice,
            }),
        }
    }

    /// One sample of each light that gets one.
    pub(crate) fn arrival<'a>(&self, buffers: &'a SceneBuffers, lights: usize) -> Arrival<'a> {
        Arrival { light_samples: 1, surface: self.surface, choice: self.light_choice(buffers, lights) }
    }

    fn light_choice<'a>(&self, buffers: &'a SceneBuffers, lights: usize) -> LightChoice<'a> {
        let auto = if lights <= FEW_LIGHTS { Choose::All } else { Choose::Tree };
        match (self.choose.unwrap_or(auto), buffers.power_table()) {
            (Choose::All, _) => LightChoice::All,
            (Choose::Tree, _) => LightChoice::Tree(buffers.light_tree()),
            (Choose::Power, Some(table)) => LightChoice::Power(table),
            (Choose::Uniform | Choose::Power, _) => LightChoice::Uniform,
        }
    }

    /// Where the uniforms come from.
    ///
    /// * `width` – of the picture (pixels)
    pub(crate) fn sequence(&self, width: u32) -> AnySequence {
        match self.sequence {
            Draws::Random => AnySequence::Random(Random::new(self.seed)),
            Draws::Sobol => AnySequence::Sobol(Sobol::new(self.seed)),
            Draws::ZSobol => AnySequence::ZSobol(ZSobol::new(self.seed, width, self.samples)),
        }
    }
}

fn show(value: &str) -> Option<Show> {
    Some(match value {
        "radiance" => Show::Radiance,
        "visibility" => Show::Visibility,
        "occlusion" => Show::Occlusion,
        _ => return None,
    })
}

fn technique(value: &str, heuristic: Heuristic) -> Option<Option<Technique>> {
    Some(match value {
        "auto" => None,
        "light" => Some(Technique::Light),
        "bsdf" => Some(Technique::Bsdf),
        "mis" => Some(Technique::Mis(heuristic)),
        "control" => Some(Technique::Control(heuristic)),
        _ => return None,
    })
}

fn heuristic(value: &str) -> Option<Heuristic> {
    Some(match value {
        "balance" => Heuristic::Balance,
        "power" => Heuristic::Power,
        _ => return None,
    })
}

fn surface(value: &str) -> Option<SurfaceDensity> {
    Some(match value {
        "auto" => SurfaceDensity::Auto,
        "area" => SurfaceDensity::Area,
        "solid-angle" => SurfaceDensity::SolidAngle,
        "projected" => SurfaceDensity::Projected,
        _ => return None,
    })
}

fn choose(value: &str) -> Option<Option<Choose>> {
    Some(match value {
        "auto" => None,
        "all" => Some(Choose::All),
        "uniform" => Some(Choose::Uniform),
        "power" => Some(Choose::Power),
        "tree" => Some(Choose::Tree),
        _ => return None,
    })
}

fn environment(value: &str) -> Option<Option<EnvironmentDensity>> {
    Some(match value {
        "auto" => None,
        "cosine" => Some(EnvironmentDensity::Cosine),
        "luminance" => Some(EnvironmentDensity::Luminance),
        "compensated" => Some(EnvironmentDensity::Compensated),
        "product" => Some(EnvironmentDensity::Product),
        _ => return None,
    })
}

fn sequence(value: &str) -> Option<Draws> {
    Some(match value {
        "sobol" => Draws::Sobol,
        "auto" | "zsobol" => Draws::ZSobol,
        "random" => Draws::Random,
        _ => return None,
    })
}

/// Samples for each camera sample: from 1 on, as the command line has it.
fn count(value: &str) -> Option<Option<u32>> {
    match value {
        "auto" => Some(None),
        number => number.parse().ok().filter(|n| (1..=65_536).contains(n)).map(Some),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_the_command_line_and_others_are_refused() {
        let mut choices = Choices::default();
        for (name, value) in [
            ("show", "visibility"),
            ("technique", "mis"),
            ("heuristic", "balance"),
            ("lights", "solid-angle"),
            ("choose", "tree"),
            ("environment", "product"),
            ("sequence", "random"),
            ("light-samples", "4"),
            ("bsdf-samples", "auto"),
            ("samples", "64"),
            ("seed", "7"),
        ] {
            assert_eq!(choices.set(name, value), Ok(()), "{name}");
            assert!(choices.set(name, "purple").is_err(), "{name}");
        }
        assert!(choices.set("colour", "auto").is_err());
        assert!(choices.set("light-samples", "0").is_err());
        // The heuristic holds, whichever of the two is said first.
        assert_eq!(choices.technique, Some(Technique::Mis(Heuristic::Balance)));
    }
}
