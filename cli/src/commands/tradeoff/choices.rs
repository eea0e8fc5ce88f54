//! The choices that a scene makes possible: what `auto` takes, and that with one thing changed.

use crate::args::{Choices, Choose, Environment, Heuristic, Lights, Portals, Sequence, Technique};
use crate::failure::Failure;
use crate::plan::{self, Plan};
use clap::ValueEnum;
use halflight::bsdf::Bsdf;
use halflight::build::{Description, SceneBuffers};
use halflight::estimate::Technique as Combine;
use halflight::glam::Vec3;
use halflight::light::{AnyLight, Emitter, EnvironmentDensity, Receiver};
use halflight::scene::AnyScene;

/// The choice that all others are compared with.
pub(super) const AUTO: &str = "auto";

/// The flag that puts samples where the error is.
pub(super) const ADAPTIVE: &str = "adaptive";

/// One way of rendering the scene.
#[derive(Debug)]
pub(super) struct Candidate {
    /// What differs from `auto`, for example `lights area`.
    pub(super) name: String,
    /// The flag that says so.
    pub(super) flag: &'static str,
    pub(super) plan: Plan,
    /// True when samples go where the error is.
    pub(super) adaptive: bool,
    /// Which of the field's buffers it renders.
    pub(super) tables: usize,
}

/// All ways of rendering the scene, and the scenes built for them: how directions toward a sky are drawn
/// is in their tables.
#[derive(Debug, Default)]
pub(super) struct Field {
    pub(super) candidates: Vec<Candidate>,
    pub(super) buffers: Vec<SceneBuffers>,
    /// What decides that: the density of the map, and how many portals there are.
    skies: Vec<(Option<EnvironmentDensity>, usize)>,
}

/// What decides which choices make a difference.
struct Facts {
    has_surface_light: bool,
    has_light_to_meet: bool,
    has_closed_form: bool,
    has_map: bool,
    has_portals: bool,
    all_diffuse: bool,
    lights: usize,
    /// `auto` combines light and BSDF sampling everywhere.
    combines: bool,
}

impl Field {
    /// Finds out what is possible, and builds what is needed for it.
    ///
    /// # Errors
    /// When the scene cannot be built or has no light.
    pub(super) fn of(description: &mut Description) -> Result<Self, Failure> {
        let mut field = Self::default();
        field.enter(AUTO.to_owned(), "", &Choices::default(), description)?;
        let facts = field.facts(description);
        for (flag, value, choices) in alternatives(&facts) {
            field.enter(format!("{flag} {value}"), flag, &choices, description)?;
        }
        let plan = field.candidates[0].plan;
        let name = format!("{ADAPTIVE} on");
        field.candidates.push(Candidate { name, flag: ADAPTIVE, plan, adaptive: true, tables: 0 });
        Ok(field)
    }

    /// Takes a choice in unless there is one that comes to the same.
    fn enter(
        &mut self,
        name: String,
        flag: &'static str,
        choices: &Choices,
        description: &mut Description,
    ) -> Result<(), Failure> {
        plan::choose_environment(choices, description);
        let density = description.environments.first().map(|e| e.density.resolved());
        let sky = (density, description.portals.len());
        let tables = match self.skies.iter().position(|s| *s == sky) {
            Some(tables) => tables,
            None => {
                self.buffers.push(SceneBuffers::new(description).map_err(Failure::new)?);
                self.skies.push(sky);
                self.buffers.len() - 1
            }
        };
        let plan = plan::make(choices, description, &self.buffers[tables].bind())?;
        if self.candidates.iter().all(|c| (c.plan, c.tables) != (plan, tables)) {
            self.candidates.push(Candidate { name, flag, plan, adaptive: false, tables });
        }
        Ok(())
    }

    /// Looks at the scene as `auto` renders it.
    fn facts(&self, description: &Description) -> Facts {
        let bound = self.buffers[0].bind();
        let scene: AnyScene<'_> = bound.scene();
        let lights = scene.lights();
        let anywhere = Receiver { point: Vec3::ZERO, normal: Vec3::Y };
        Facts {
            has_surface_light: lights.iter().any(has_surface),
            has_light_to_meet: scene.has_light_to_meet(),
            has_closed_form: lights.iter().any(|l| l.unshadowed_irradiance(&anywhere).is_some()),
            has_map: !description.environments.is_empty(),
            has_portals: !description.portals.is_empty(),
            all_diffuse: scene.materials().iter().all(|m| m.base().is_diffuse()),
            lights: lights.len(),
            combines: matches!(self.candidates[0].plan, Plan::Direct { technique: Combine::Mis(_), .. }),
        }
    }
}

/// True for a light that can be sampled in several ways.
const fn has_surface(light: &AnyLight<'_>) -> bool {
    use AnyLight::{Cylinder, Disk, Painted, Rectangle, Sphere, Triangle};
    matches!(light, Rectangle(_) | Disk(_) | Sphere(_) | Triangle(_) | Cylinder(_) | Painted(_))
}

/// Every change of one flag that may make a difference: flag, value, choices.
fn alternatives(facts: &Facts) -> Vec<(&'static str, String, Choices)> {
    let none = Choices::default();
    let mut all = Vec::new();
    let lights = [Lights::Area, Lights::SolidAngle, Lights::Projected];
    let lights = lights.into_iter().filter(|_| facts.has_surface_light);
    all.extend(lights.map(|lights| ("lights", word(&lights), Choices { lights, ..none })));
    let technique = [Technique::Light, Technique::Bsdf, Technique::Mis, Technique::Control];
    let technique = technique.into_iter().filter(|t| differs(*t, facts));
    all.extend(technique.map(|technique| ("technique", word(&technique), Choices { technique, ..none })));
    if facts.has_light_to_meet && (facts.combines || !facts.all_diffuse) {
        let heuristic = Some(Heuristic::Balance);
        all.push(("heuristic", "balance".to_owned(), Choices { heuristic, ..none }));
    }
    let choose = [Choose::All, Choose::Uniform, Choose::Power, Choose::Tree];
    let choose = choose.into_iter().filter(|_| facts.lights > 1);
    all.extend(choose.map(|choose| ("choose", word(&choose), Choices { choose, ..none })));
    let environment =
        [Environment::Cosine, Environment::Luminance, Environment::Compensated, Environment::Product];
    let environment = environment.into_iter().filter(|_| facts.has_map);
    all.extend(environment.map(|e| ("environment", word(&e), Choices { environment: e, ..none })));
    let sequence = [Sequence::Random, Sequence::Sobol, Sequence::Zsobol];
    all.extend(sequence.map(|sequence| ("sequence", word(&sequence), Choices { sequence, ..none })));
    // The last one, as what it leaves out of the description is gone.
    if facts.has_portals {
        all.push(("portals", "off".to_owned(), Choices { portals: Portals::Off, ..none }));
    }
    all
}

/// True where a technique takes other samples than `auto`.
const fn differs(technique: Technique, facts: &Facts) -> bool {
    match technique {
        Technique::Light => facts.combines || !facts.all_diffuse,
        Technique::Bsdf | Technique::Mis => facts.has_light_to_meet,
        Technique::Control => facts.has_closed_form,
        Technique::Auto | Technique::Occlusion => false,
    }
}

/// As it is typed.
fn word(value: &impl ValueEnum) -> String {
    value.to_possible_value().map_or_else(String::new, |v| v.get_name().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;
    use halflight::load::builtin::builtin;

    fn names(scene: &str) -> Vec<String> {
        let field = Field::of(&mut builtin(scene).unwrap()).unwrap();
        field.candidates.into_iter().map(|c| c.name).collect()
    }

    #[test]
    fn a_scene_offers_what_makes_a_difference() {
        let cornell = names("cornell");
        assert_eq!(cornell[0], AUTO);
        for there in ["lights area", "technique control", "sequence random", "adaptive on"] {
            assert!(cornell.iter().any(|n| n == there), "{there}: {cornell:?}");
        }
        // All is diffuse: auto samples by light. There is no map.
        for not in ["technique light", "heuristic balance", "environment product"] {
            assert!(cornell.iter().all(|n| n != not), "{not}: {cornell:?}");
        }
        let sky = names("sky");
        assert!(sky.iter().all(|n| !n.starts_with("lights") && !n.starts_with("choose")), "{sky:?}");
        assert!(names("lanterns").iter().any(|n| n == "choose power"));
    }

    #[test]
    fn nothing_is_measured_twice() {
        let field = Field::of(&mut builtin("plates").unwrap()).unwrap();
        for (i, a) in field.candidates.iter().enumerate() {
            assert!(
                field.candidates[..i]
                    .iter()
                    .all(|b| (a.plan, a.tables, a.adaptive) != (b.plan, b.tables, b.adaptive)),
                "{}",
                a.name
            );
        }
    }
}
