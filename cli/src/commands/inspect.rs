//! `halflight inspect`: what a scene holds, needs and costs, and what is therefore left out.

use crate::args::{Choices, InspectArgs};
use crate::failure::{Exit, Failure};
use crate::number::{bytes, counted, grouped};
use crate::plan::{self, Plan};
use crate::progress::Step;
use crate::{scene, terminal};
use halflight::bsdf::AnyBsdf;
use halflight::build::{
    CameraDescription, Description, EnvironmentDescription, ProjectionDescription, SceneBuffers, SceneStats,
};
use halflight::bvh::STACK;
use halflight::estimate::PixelStats;
use halflight::film::Filter;
use halflight::light::AnyLight;
use halflight::material::AnyMaterial;
use halflight::scene::AnyScene;
use halflight::shape::AnyShape;
use serde_json::{Map, Value, json};
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// How many there are of each kind that there is.
type Kinds = Vec<(&'static str, usize)>;

/// Between the lines of one row of the table.
const BREAK: &str = "\n            ";

/// What a scene holds.
struct Contents {
    shapes: Kinds,
    lights: Kinds,
    materials: Kinds,
}

/// Everything that is told.
struct Inspected<'a> {
    description: &'a Description,
    stats: SceneStats,
    contents: Contents,
    plan: Option<Plan>,
    left_out: Vec<&'static str>,
}

/// Describes a scene.
pub(crate) fn run(args: &InspectArgs) -> Result<Exit, Failure> {
    let name = scene::shown(args.scene.as_deref());
    let (found, buffers) = {
        let _step = Step::begin(format!("reading {name}"), args.json);
        let mut found = scene::find(args.scene.as_deref(), &args.reading)?;
        plan::choose_environment(&Choices::default(), &mut found.description);
        let buffers =
            SceneBuffers::new(&found.description).map_err(|e| Failure::new(format!("{name}: {e}")))?;
        (found, buffers)
    };
    found.print_warnings();
    let bound = buffers.bind();
    let scene = bound.scene();
    let contents = contents(scene);
    // A scene without lights can still be inspected.
    let plan = plan::make(&Choices::default(), &found.description, &bound).ok();
    let left_out = left_out(scene, plan.as_ref());
    let inspected =
        Inspected { description: &found.description, stats: buffers.stats(), contents, plan, left_out };
    if args.json {
        terminal::json(&object(&inspected))?;
    } else {
        terminal::result(&table(&inspected))?;
    }
    Ok(Exit::Good)
}

/// Counts shapes, lights and BSDFs by kind.
fn contents(scene: AnyScene<'_>) -> Contents {
    let shape = |shape: &AnyShape| match shape {
        AnyShape::Triangle(_) => "triangle",
        AnyShape::Rectangle(_) => "rectangle",
        AnyShape::Disk(_) => "disk",
        AnyShape::Sphere(_) => "sphere",
        AnyShape::Cylinder(_) => "cylinder",
    };
    Contents {
        shapes: kinds(scene.surfaces().iter().map(|s| shape(&s.shape))),
        lights: kinds(scene.lights().iter().map(AnyLight::name)),
        materials: kinds(scene.materials().iter().map(bsdf_kind)),
    }
}

/// The kind of a material, by its front.
fn bsdf_kind(material: &AnyMaterial<'_>) -> &'static str {
    match material.base().front {
        AnyBsdf::Lambert(_) => "diffuse",
        AnyBsdf::Phong(_) => "phong",
        AnyBsdf::GgxConductor(_) => "roughconductor",
        AnyBsdf::RoughPlastic(_) => "roughplastic",
        AnyBsdf::MetallicRoughness(_) => "metallic-roughness",
    }
}

/// Counts words; the most frequent comes first.
fn kinds(words: impl Iterator<Item = &'static str>) -> Kinds {
    let mut counts = BTreeMap::new();
    for word in words {
        *counts.entry(word).or_insert(0) += 1;
    }
    let mut kinds: Kinds = counts.into_iter().collect();
    kinds.sort_by_key(|(_, n)| Reverse(*n));
    kinds
}

/// "3 spheres, 1 disk", or "none".
fn listed(kinds: &Kinds) -> String {
    let counts: Vec<_> = kinds.iter().map(|(kind, n)| counted(*n as u64, kind)).collect();
    if counts.is_empty() { "none".to_owned() } else { counts.join(", ") }
}

/// "2 diffuse, 1 phong", or "none": kinds that have no plural.
fn listed_materials(kinds: &Kinds) -> String {
    let counts: Vec<_> = kinds.iter().map(|(kind, n)| format!("{} {kind}", grouped(*n as u64))).collect();
    if counts.is_empty() { "none".to_owned() } else { counts.join(", ") }
}

/// Bytes that the film takes while rendering.
fn film_bytes(description: &Description) -> u64 {
    u64::from(description.width) * u64::from(description.height) * size_of::<PixelStats>() as u64
}

/// The description for people.
fn table(inspected: &Inspected<'_>) -> String {
    let Inspected { description, stats, contents, plan, left_out } = inspected;
    let samples = description.samples_per_pixel.map_or_else(
        || "not said by the scene".to_owned(),
        |n| format!("{} per pixel, says the scene", grouped(u64::from(n))),
    );
    let rows = [
        ("scene", description.name.clone()),
        (
            "film",
            format!("{}×{} pixels, {}", description.width, description.height, filter(description.filter)),
        ),
        ("camera", camera(&description.camera)),
        ("samples", samples),
        ("surfaces", listed(&contents.shapes)),
        ("materials", listed_materials(&contents.materials)),
        ("lights", lights(&contents.lights, description)),
        ("tree", format!("{}, stack {} of {STACK}", counted(stats.nodes as u64, "node"), stats.stack)),
        ("memory", format!("{} scene, {} film", bytes(stats.bytes as u64), bytes(film_bytes(description)))),
        ("auto takes", plan.as_ref().map_or_else(|| "nothing: there is no light".to_owned(), choices)),
        ("left out", if left_out.is_empty() { "nothing".to_owned() } else { left_out.join(BREAK) }),
    ];
    rows.iter().map(|(name, value)| format!("{name:10}  {value}")).collect::<Vec<_>>().join("\n")
}

/// The lights, how large the maps among them are, and how many portals there are.
fn lights(kinds: &Kinds, description: &Description) -> String {
    let map = |m: &EnvironmentDescription| format!(" ({}×{} texels)", m.image.width, m.image.height);
    let maps: String = description.environments.iter().map(map).collect();
    let portals = match description.portals.len() as u64 {
        0 => String::new(),
        n => format!(" ({})", counted(n, "portal")),
    };
    listed(kinds) + &maps + &portals
}

/// The description for scripts.
fn object(inspected: &Inspected<'_>) -> Value {
    let Inspected { description, stats, contents, plan, left_out } = inspected;
    let counts =
        |kinds: &Kinds| kinds.iter().map(|(k, n)| ((*k).to_owned(), json!(n))).collect::<Map<_, _>>();
    let choices = plan
        .as_ref()
        .map(|p| p.flags().into_iter().map(|(k, v)| (k.to_owned(), json!(v))).collect::<Map<_, _>>());
    json!({
        "scene": description.name,
        "film": {
            "width": description.width,
            "height": description.height,
            "filter": filter(description.filter),
            "bytes": film_bytes(description),
        },
        "camera": camera(&description.camera),
        "samples_per_pixel": description.samples_per_pixel,
        "surfaces": counts(&contents.shapes),
        "degenerate_triangles": stats.degenerate,
        "materials": counts(&contents.materials),
        "lights": counts(&contents.lights),
        "environment_maps": description.environments.iter()
            .map(|m| json!({ "width": m.image.width, "height": m.image.height })).collect::<Vec<_>>(),
        "portals": description.portals.len(),
        "tree": { "nodes": stats.nodes, "stack": stats.stack, "stack_limit": STACK },
        "bytes": stats.bytes,
        "auto": choices,
        "left_out": left_out,
    })
}

/// The camera in words.
fn camera(camera: &CameraDescription) -> String {
    match camera.projection {
        ProjectionDescription::Perspective { fov, axis } => {
            let axis = format!("{axis:?}").to_lowercase();
            format!("perspective, {fov}° along {axis}")
        }
        ProjectionDescription::Orthographic { half_width } => {
            format!("orthographic, {} m wide", 2.0 * half_width)
        }
    }
}

/// The filter in words.
fn filter(filter: Filter) -> String {
    match filter {
        Filter::Box { radius } => format!("box filter of radius {radius}"),
        Filter::Tent { radius } => format!("tent filter of radius {radius}"),
        Filter::Gaussian { stddev } => format!("Gaussian filter of deviation {stddev}"),
    }
}

/// The flags that say the same as `auto`.
fn choices(plan: &Plan) -> String {
    let flags: Vec<_> = plan.flags().iter().map(|(flag, value)| format!("--{flag} {value}")).collect();
    flags.join(BREAK)
}

/// What this scene spares the renderer.
fn left_out(scene: AnyScene<'_>, plan: Option<&Plan>) -> Vec<&'static str> {
    let mut left_out = Vec::new();
    if scene.lights().is_empty() {
        left_out.push("direct light (no light)");
    } else if scene.lights().len() == 1 {
        left_out.push("choosing a light (there is one)");
    } else if plan.is_some_and(Plan::samples_every_light) {
        left_out.push("choosing a light (each is sampled)");
    }
    if scene.environments().next().is_none() {
        left_out.push("environment (no light surrounds the scene)");
    }
    if !plan.is_some_and(Plan::has_paths) {
        if !scene.lights().is_empty() {
            left_out.push("indirect light (the scene asks for direct light)");
        }
        if !scene.has_light_to_meet() {
            left_out.push("BSDF samples (no ray can meet a light)");
        } else if scene.materials().iter().all(|b| bsdf_kind(b) == "diffuse") {
            left_out.push("BSDF samples (every material is diffuse)");
        }
    }
    if scene.materials().iter().all(|m| matches!(m, AnyMaterial::Plain(_))) {
        left_out.push("textures (no material has one)");
    }
    if scene.surfaces().is_empty() {
        left_out.push("tree (no surface)");
    }
    left_out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_most_frequent_kind_comes_first() {
        let kinds = kinds(["sphere", "disk", "disk"].into_iter());
        assert_eq!(kinds, [("disk", 2), ("sphere", 1)]);
        assert_eq!(listed(&kinds), "2 disks, 1 sphere");
        assert_eq!(listed(&Vec::new()), "none");
    }
}
