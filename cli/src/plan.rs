//! From the choices on the command line, `auto` among them, to an estimator.

use crate::args::{Choices, Choose, Environment, Heuristic, Lights, Portals, Sequence, Technique};
use crate::failure::Failure;
use halflight::build::{
    BoundScene, Description, FEW_LIGHTS, IntegratorDescription, PathDescription, SceneBuffers,
};
use halflight::choose::LightChoice;
use halflight::estimate::{AnyEstimator, Direct, Heuristic as Weights, Occlusion, Technique as Combine};
use halflight::light::{AnyLight, Emitter, EnvironmentDensity, SurfaceDensity};
use halflight::sequence::{AnySequence, Random, Sobol, ZSobol};
use std::fmt;

/// Which light a sample goes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Choice {
    All,
    Uniform,
    Power,
    Tree,
}

/// Where the uniforms come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Points {
    Random,
    Sobol,
    ZSobol,
}

/// Every choice made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Plan {
    /// Direct light, and indirect light where it is asked for.
    Direct {
        technique: Combine,
        light_samples: u32,
        bsdf_samples: u32,
        surface: SurfaceDensity,
        choice: Choice,
        path: Option<PathDescription>,
        /// Of the environment map that there is.
        environment: Option<EnvironmentDensity>,
        points: Points,
    },
    /// Ambient occlusion.
    Occlusion { reach: f32, points: Points },
}

/// Refuses choices that contradict each other.
///
/// # Errors
/// When a flag has no use with the technique that was asked for.
pub(crate) fn check(choices: &Choices) -> Result<(), Failure> {
    use Technique::{Auto, Bsdf, Control, Light, Mis, Occlusion};
    let uses = [
        ("--heuristic", choices.heuristic.is_some(), &[Auto, Mis, Control][..]),
        ("--light-samples", choices.light_samples.is_some(), &[Auto, Light, Bsdf, Mis, Control]),
        ("--bsdf-samples", choices.bsdf_samples.is_some(), &[Auto, Bsdf, Mis, Control]),
        ("--lights", choices.lights != Lights::Auto, &[Auto, Light, Bsdf, Mis, Control]),
        ("--environment", choices.environment != Environment::Auto, &[Auto, Light, Bsdf, Mis, Control]),
        ("--portals", choices.portals == Portals::Off, &[Auto, Light, Bsdf, Mis, Control]),
        ("--choose", choices.choose != Choose::Auto, &[Auto, Light, Bsdf, Mis, Control]),
        ("--max-depth", choices.max_depth.is_some(), &[Auto, Light, Bsdf, Mis, Control]),
        ("--occlusion-distance", choices.occlusion_distance.is_some(), &[Occlusion]),
    ];
    match uses.iter().find(|(_, given, with)| *given && !with.contains(&choices.technique)) {
        Some((flag, _, with)) => {
            let names: Vec<_> = with.iter().map(|t| technique_name(*t)).collect();
            let (asked, names) = (technique_name(choices.technique), names.join(", "));
            Err(Failure::new(format!("{flag} has no use with --technique {asked}"))
                .tip(format!("leave {flag} out, or use it with --technique {names}")))
        }
        None => Ok(()),
    }
}

/// As it is typed.
const fn technique_name(technique: Technique) -> &'static str {
    match technique {
        Technique::Auto => "auto",
        Technique::Light => "light",
        Technique::Bsdf => "bsdf",
        Technique::Mis => "mis",
        Technique::Control => "control",
        Technique::Occlusion => "occlusion",
    }
}

/// Makes every choice.
///
/// With `auto`, neighbouring pixels share their points. On the peers' `rect` √relMSE is that of points
/// for each pixel alone, and after a blur by one pixel it is 0.71, 0.79, 0.91 and 0.96 of theirs at 1, 4,
/// 16 and 64 samples.
///
/// # Errors
/// When the scene has no light, so that the picture would be black.
pub(crate) fn make(
    choices: &Choices,
    description: &Description,
    bound: &BoundScene<'_>,
) -> Result<Plan, Failure> {
    let points = match choices.sequence {
        Sequence::Random => Points::Random,
        Sequence::Sobol => Points::Sobol,
        Sequence::Zsobol | Sequence::Auto => Points::ZSobol,
    };
    if choices.technique == Technique::Occlusion {
        return Ok(Plan::Occlusion { reach: choices.occlusion_distance.unwrap_or(f32::INFINITY), points });
    }
    let lights = bound.scene().lights();
    check_lights(description, lights)?;
    let author = &description.integrator;
    let surface = match choices.lights {
        Lights::Area => SurfaceDensity::Area,
        Lights::SolidAngle => SurfaceDensity::SolidAngle,
        Lights::Projected => SurfaceDensity::Projected,
        Lights::Auto => SurfaceDensity::Auto,
    };
    let path = path(choices, author);
    Ok(Plan::Direct {
        technique: technique(choices, description),
        light_samples: choices.light_samples.or(author.light_samples).unwrap_or(1).max(1),
        // A path goes on in one direction.
        bsdf_samples: match path {
            Some(_) => 1,
            None => choices.bsdf_samples.or(author.bsdf_samples).unwrap_or(1).max(1),
        },
        surface,
        choice: choice(choices.choose, lights.len()),
        path,
        environment: description.environments.first().map(|e| e.density.resolved()),
        points,
    })
}

/// How far paths go; `None` for direct light.
fn path(choices: &Choices, author: &IntegratorDescription) -> Option<PathDescription> {
    let path = match choices.max_depth {
        Some(max_depth) => Some(PathDescription { max_depth, ..author.path.unwrap_or_default() }),
        None => author.path,
    };
    path.filter(|p| !p.is_direct())
}

/// Which densities are combined.
fn technique(choices: &Choices, description: &Description) -> Combine {
    let weights = match choices.heuristic {
        Some(Heuristic::Balance) => Weights::Balance,
        Some(Heuristic::Power) => Weights::Power,
        None => Weights::default(),
    };
    match choices.technique {
        Technique::Light => Combine::Light,
        Technique::Bsdf => Combine::Bsdf,
        Technique::Mis => Combine::Mis(weights),
        Technique::Control => Combine::Control(weights),
        Technique::Auto | Technique::Occlusion => {
            let IntegratorDescription { light_samples, bsdf_samples, path } = description.integrator;
            let integrator = IntegratorDescription {
                light_samples: choices.light_samples.or(light_samples),
                bsdf_samples: choices.bsdf_samples.or(bsdf_samples),
                path,
            };
            description.required_technique(integrator, weights)
        }
    }
}

/// Which light a sample goes to.
fn choice(asked: Choose, lights: usize) -> Choice {
    match asked {
        Choose::All => Choice::All,
        Choose::Uniform => Choice::Uniform,
        Choose::Power => Choice::Power,
        Choose::Tree => Choice::Tree,
        Choose::Auto if lights <= FEW_LIGHTS => Choice::All,
        Choose::Auto => Choice::Tree,
    }
}

/// A picture that would be black is refused.
fn check_lights(description: &Description, lights: &[AnyLight<'_>]) -> Result<(), Failure> {
    // Any radius will do: it does not decide whether a light is dark.
    if lights.iter().any(|l| l.power(1.0) > 0.0) {
        return Ok(());
    }
    // The builder leaves out surfaces whose emission is 0.
    let meant = !description.lights.is_empty()
        || !description.environments.is_empty()
        || description.objects.iter().any(|o| o.emission.is_some());
    let what = if meant { "every light of the scene is dark" } else { "the scene has no lights" };
    Err(Failure::new(format!("{what}: the picture would be black"))
        .tip("give the scene a light that shines, or use --technique occlusion, which needs no light"))
}

impl Plan {
    /// The estimator, for the scene that the plan was made for.
    pub(crate) fn estimator<'a>(&self, buffers: &'a SceneBuffers) -> AnyEstimator<'a> {
        match *self {
            Self::Direct { technique, light_samples, bsdf_samples, surface, choice, path, .. } => {
                let choice = match (choice, buffers.power_table()) {
                    (Choice::Power, Some(table)) => LightChoice::Power(table),
                    (Choice::Tree, _) => LightChoice::Tree(buffers.light_tree()),
                    (Choice::All, _) => LightChoice::All,
                    _ => LightChoice::Uniform,
                };
                let direct = Direct { technique, light_samples, bsdf_samples, surface, choice };
                path.map_or(AnyEstimator::Direct(direct), |path| AnyEstimator::Path(path.estimator(direct)))
            }
            Self::Occlusion { reach, .. } => AnyEstimator::Occlusion(Occlusion { reach, samples: 1 }),
        }
    }

    /// True when light is followed beyond the first surface.
    pub(crate) fn has_paths(&self) -> bool {
        matches!(self, Self::Direct { path: Some(_), .. })
    }

    /// True when no light is chosen, as all are sampled.
    pub(crate) fn samples_every_light(&self) -> bool {
        matches!(self, Self::Direct { choice: Choice::All, .. })
    }

    /// The sequence for a film of `width` columns whose pixels take `samples` each.
    pub(crate) fn sequence(&self, seed: u32, width: u32, samples: u32) -> AnySequence {
        let (Self::Direct { points, .. } | Self::Occlusion { points, .. }) = *self;
        match points {
            Points::Random => AnySequence::Random(Random::new(seed)),
            Points::Sobol => AnySequence::Sobol(Sobol::new(seed)),
            Points::ZSobol => AnySequence::ZSobol(ZSobol::new(seed, width, samples)),
        }
    }

    /// Its choices by the names of the flags.
    pub(crate) fn flags(&self) -> Vec<(&'static str, String)> {
        let sequence = |points| ("sequence", points_flag(points).to_owned());
        match *self {
            Self::Direct {
                technique,
                light_samples,
                bsdf_samples,
                surface,
                choice,
                path,
                environment,
                points,
            } => {
                let (technique, heuristic) = technique_flags(technique);
                let depth = |p: PathDescription| ("max-depth", depth_flag(p.max_depth));
                let mut flags: Vec<_> = path.map(depth).into_iter().collect();
                flags.push(("technique", technique.to_owned()));
                flags.extend(heuristic.map(|h| ("heuristic", h.to_owned())));
                flags.push(("light-samples", light_samples.to_string()));
                flags.push(("bsdf-samples", bsdf_samples.to_string()));
                flags.push(("lights", surface_flag(surface).to_owned()));
                flags.push(("choose", choice.to_string()));
                flags.extend(environment.map(|e| ("environment", environment_flag(e).to_owned())));
                flags.push(sequence(points));
                flags
            }
            Self::Occlusion { reach, points } => vec![
                ("technique", "occlusion".to_owned()),
                ("occlusion-distance", reach.to_string()),
                sequence(points),
            ],
        }
    }
}

/// As they are typed.
const fn technique_flags(technique: Combine) -> (&'static str, Option<&'static str>) {
    match technique {
        Combine::Light => ("light", None),
        Combine::Bsdf => ("bsdf", None),
        Combine::Mis(weights) => ("mis", Some(weights_flag(weights))),
        Combine::Auto(weights) => ("auto", Some(weights_flag(weights))),
        Combine::Control(weights) => ("control", Some(weights_flag(weights))),
    }
}

/// As it is typed.
fn depth_flag(depth: u32) -> String {
    if depth == u32::MAX { "-1".to_owned() } else { depth.to_string() }
}

/// As it is typed.
const fn weights_flag(weights: Weights) -> &'static str {
    match weights {
        Weights::Balance => "balance",
        Weights::Power => "power",
    }
}

/// As it is typed.
const fn surface_flag(surface: SurfaceDensity) -> &'static str {
    match surface {
        SurfaceDensity::Area => "area",
        SurfaceDensity::SolidAngle => "solid-angle",
        SurfaceDensity::Projected => "projected",
        SurfaceDensity::Auto => "auto",
    }
}

/// As it is typed.
const fn environment_flag(density: EnvironmentDensity) -> &'static str {
    match density {
        EnvironmentDensity::Auto => "auto",
        EnvironmentDensity::Cosine => "cosine",
        EnvironmentDensity::Luminance => "luminance",
        EnvironmentDensity::Compensated => "compensated",
        EnvironmentDensity::Product => "product",
    }
}

/// As it is typed.
const fn points_flag(points: Points) -> &'static str {
    match points {
        Points::Random => "random",
        Points::Sobol => "sobol",
        Points::ZSobol => "zsobol",
    }
}

/// Chooses how directions toward the scene's environment maps are drawn, before its tables are built.
pub(crate) fn choose_environment(choices: &Choices, description: &mut Description) {
    let density = match choices.environment {
        Environment::Auto => description.required_environment(technique(choices, description)),
        Environment::Cosine => EnvironmentDensity::Cosine,
        Environment::Luminance => EnvironmentDensity::Luminance,
        Environment::Compensated => EnvironmentDensity::Compensated,
        Environment::Product => EnvironmentDensity::Product,
    };
    description.environments.iter_mut().for_each(|map| map.density = density);
    if choices.portals == Portals::Off {
        description.portals.clear();
    }
}

impl fmt::Display for Choice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::All => "all",
            Self::Uniform => "uniform",
            Self::Power => "power",
            Self::Tree => "tree",
        })
    }
}
