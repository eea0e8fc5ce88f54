//! `<integrator>`: how many samples its author wants.

use super::context::Context;
use super::element::Element;
use super::properties::Properties;
use crate::build::IntegratorDescription;
use crate::load::{LoadError, Problem};
use std::borrow::ToOwned;

/// Sample counts; everything is rendered as direct light.
pub(super) fn read(context: &mut Context<'_>, element: &Element) -> Result<IntegratorDescription, LoadError> {
    let kind = element.plugin("integrator", &["direct", "path"])?;
    let mut properties = Properties::new(element)?;
    if properties.flag("hide_emitters")? {
        context.warn(element, "hide_emitters=true is not supported; lights are shown");
    }
    let description = if kind == "direct" {
        direct(element, &mut properties)?
    } else {
        // Two segments, camera to surface to light, are all of the direct light.
        if properties.count("max_depth").ok().flatten() != Some(2) {
            context.warn(element, "only direct light is rendered");
        }
        properties.ignore(&["max_depth", "rr_depth"]);
        IntegratorDescription::default()
    };
    properties.finish(context)?;
    Ok(description)
}

fn direct(element: &Element, properties: &mut Properties<'_>) -> Result<IntegratorDescription, LoadError> {
    let both = properties.count("shading_samples")?;
    let light_samples = properties.count("emitter_samples")?;
    let bsdf_samples = properties.count("bsdf_samples")?;
    if both.is_some() && (light_samples.is_some() || bsdf_samples.is_some()) {
        let what = "shading_samples together with emitter_samples or bsdf_samples".to_owned();
        return Err(element.error(Problem::NotSupported { what, instead: "give one or the other" }));
    }
    let description =
        IntegratorDescription { light_samples: light_samples.or(both), bsdf_samples: bsdf_samples.or(both) };
    if description.light_samples == Some(0) && description.bsdf_samples == Some(0) {
        return Err(element.error(Problem::Missing { what: "a number of samples above 0".to_owned() }));
    }
    Ok(description)
}
