//! `<integrator>`: how many samples its author wants, and how much of the light.

use super::context::Context;
use super::element::Element;
use super::properties::Properties;
use crate::build::{IntegratorDescription, PathDescription};
use crate::load::{LoadError, Problem};
use std::borrow::ToOwned;

/// Sample counts, or how far paths go.
pub(super) fn read(context: &mut Context<'_>, element: &Element) -> Result<IntegratorDescription, LoadError> {
    let kind = element.plugin("integrator", &["direct", "path"])?;
    let mut properties = Properties::new(element)?;
    let hide_emitters = properties.flag("hide_emitters")?;
    let description = if kind == "direct" {
        if hide_emitters {
            context.warn(
                element,
                "hide_emitters=true is not supported here, lights are shown; \
                 the integrator \"path\" with a max_depth of 2 hides them",
            );
        }
        direct(element, &mut properties)?
    } else {
        path(hide_emitters, &mut properties)?
    };
    properties.finish(context)?;
    Ok(description)
}

/// Direct light by the name of `path` is direct light.
fn path(hide_emitters: bool, properties: &mut Properties<'_>) -> Result<IntegratorDescription, LoadError> {
    let default = PathDescription::default();
    let path = PathDescription {
        max_depth: properties.depth("max_depth")?.unwrap_or(default.max_depth),
        rr_depth: properties.depth("rr_depth")?.unwrap_or(default.rr_depth),
        hide_emitters,
    };
    Ok(IntegratorDescription {
        path: Some(path).filter(|p| !p.is_direct()),
        ..IntegratorDescription::default()
    })
}

fn direct(element: &Element, properties: &mut Properties<'_>) -> Result<IntegratorDescription, LoadError> {
    let both = properties.count("shading_samples")?;
    let light_samples = properties.count("emitter_samples")?;
    let bsdf_samples = properties.count("bsdf_samples")?;
    if both.is_some() && (light_samples.is_some() || bsdf_samples.is_some()) {
        let what = "shading_samples together with emitter_samples or bsdf_samples".to_owned();
        return Err(element.error(Problem::NotSupported { what, instead: "give one or the other" }));
    }
    let description = IntegratorDescription {
        light_samples: light_samples.or(both),
        bsdf_samples: bsdf_samples.or(both),
        path: None,
    };
    if description.light_samples == Some(0) && description.bsdf_samples == Some(0) {
        return Err(element.error(Problem::Missing { what: "a number of samples above 0".to_owned() }));
    }
    Ok(description)
}
