//! `<scene>`: puts the parts together.

use super::context::Context;
use super::element::Element;
use super::emitter::Free;
use super::material::Materials;
use super::properties::Properties;
use super::sensor::Sensor;
use super::shape::{self, Form};
use super::{emitter, integrator, sensor};
use crate::build::{
    CameraDescription, Description, Emission, EnvironmentDescription, IntegratorDescription, Object,
};
use crate::light::{AnyLight, Emitter, Portal};
use crate::load::framing::{FILM, framing_camera};
use crate::load::{CameraPath, LoadError, Problem};
use std::borrow::ToOwned;
use std::path::Path;
use std::vec::Vec;

/// What stands in a scene.
const TAGS: [&str; 10] =
    ["integrator", "sensor", "shape", "emitter", "bsdf", "texture", "default", "include", "alias", "path"];

/// The parts gathered so far.
#[derive(Debug, Default)]
struct Parts<'e> {
    integrator: Option<(&'e Element, IntegratorDescription)>,
    sensor: Option<Sensor>,
    /// The sensors after the first; `None` for those that cannot be read.
    others: Vec<(&'e Element, Option<CameraDescription>)>,
    environment: Option<&'e Element>,
    materials: Materials,
    objects: Vec<Object>,
    lights: Vec<AnyLight<'static>>,
    environments: Vec<EnvironmentDescription>,
    portals: Vec<Portal>,
}

/// The scene of a document, and the way through its sensors.
pub(super) fn read(
    context: &mut Context<'_>,
    path: &Path,
) -> Result<(Description, Option<CameraPath>), LoadError> {
    let root = &context.document.root;
    let mut parts = Parts::default();
    // Named materials first, in the order of the file; then the others, as they are met.
    for element in root.children.iter().filter(|e| e.tag == "bsdf") {
        let index = parts.materials.index(context, element);
        context.tolerate(index)?;
    }
    for element in root.children.iter().filter(|e| e.tag != "bsdf") {
        let part = parts.take(context, element);
        context.tolerate(part)?;
    }
    if parts.objects.is_empty() && parts.environment.is_none() {
        return Err(LoadError::Empty { path: path.to_owned() });
    }
    let camera_path = parts.camera_path(context);
    Ok((parts.finish(context, root, path)?, camera_path))
}

impl<'e> Parts<'e> {
    fn take(&mut self, context: &mut Context<'_>, element: &'e Element) -> Result<(), LoadError> {
        match element.tag.as_str() {
            "integrator" => self.integrator(context, element),
            "sensor" => self.sensor(context, element),
            "shape" => self.shape(context, element),
            "emitter" => self.light(context, element),
            // Read where it is referred to.
            "texture" => Ok(()),
            tag => Err(element.error(Problem::unknown("element", tag, &TAGS))),
        }
    }

    fn integrator(&mut self, context: &mut Context<'_>, element: &'e Element) -> Result<(), LoadError> {
        if let Some((first, _)) = self.integrator {
            let what = "there is another integrator".to_owned();
            return Err(element.error(Problem::Conflict { what, first: first.at.clone() }));
        }
        self.integrator = Some((element, integrator::read(context, element)?));
        Ok(())
    }

    fn sensor(&mut self, context: &mut Context<'_>, element: &'e Element) -> Result<(), LoadError> {
        if self.sensor.is_some() {
            let read = sensor::read(context, element);
            self.others.push((element, read.ok().map(|sensor| sensor.camera)));
            return Ok(());
        }
        self.sensor = Some(sensor::read(context, element)?);
        Ok(())
    }

    fn light(&mut self, context: &mut Context<'_>, element: &'e Element) -> Result<(), LoadError> {
        let light = emitter::free(context, element)?;
        if matches!(&light, Free::Environment(_)) || matches!(&light, Free::Light(l) if l.is_environment()) {
            if let Some(first) = self.environment {
                let what = "there is another light around the scene".to_owned();
                return Err(element.error(Problem::Conflict { what, first: first.at.clone() }));
            }
            self.environment = Some(element);
        }
        match light {
            Free::Light(light) => self.lights.push(light),
            Free::Environment(map) => self.environments.push(map),
        }
        Ok(())
    }

    fn shape(&mut self, context: &mut Context<'_>, element: &'e Element) -> Result<(), LoadError> {
        let mut properties = Properties::new(element)?;
        let Form { mut geometry, mut object_space } = shape::read(context, element, &mut properties)?;
        let emitter = properties.single(&["emitter"])?;
        if let Some(portal) = emitter.filter(|e| e.attribute("type") == Some(emitter::PORTAL)) {
            self.portals.push(emitter::portal(context, portal, &geometry)?);
            return properties.finish(context);
        }
        let material = match properties.single(&["bsdf", "ref"])? {
            Some(bsdf) => {
                let index = self.materials.index(context, bsdf);
                context.tolerate(index)?
            }
            None => None,
        };
        let emission = match emitter {
            Some(emitter) => {
                let emission = emitter::surface(context, emitter);
                context.tolerate(emission)?
            }
            None => None,
        };
        properties.finish(context)?;
        let material = material.map_or_else(|| self.materials.default(element, emission.is_some()), Ok)?;
        let has_texture = |e: &Emission| e.texture.is_some();
        if !self.materials.list[material].needs_uvs() && !emission.as_ref().is_some_and(has_texture) {
            geometry.forget_uvs();
            object_space = None;
        }
        let name = element.title().to_owned();
        self.objects.push(Object { name, geometry, material, emission, object_space });
        Ok(())
    }

    /// From sensor to sensor, where there are several between which a camera can move.
    fn camera_path(&self, context: &mut Context<'_>) -> Option<CameraPath> {
        let (second, _) = self.others.first()?;
        let first = self.sensor.map(|sensor| sensor.camera);
        let keys: Option<Vec<_>> =
            core::iter::once(first).chain(self.others.iter().map(|(_, other)| *other)).collect();
        let path = keys.and_then(CameraPath::through);
        if path.is_none() {
            context.warn(second, "only the first sensor is used");
        }
        path
    }

    fn finish(
        self,
        context: &mut Context<'_>,
        root: &Element,
        path: &Path,
    ) -> Result<Description, LoadError> {
        let Sensor { camera, film, samples_per_pixel } = match self.sensor {
            Some(sensor) => sensor,
            None => {
                context.warn(root, "there is no sensor; a camera that sees the whole scene is used");
                default_sensor(&self.objects, root)?
            }
        };
        Ok(Description {
            name: path.file_stem().unwrap_or_default().to_string_lossy().into_owned(),
            camera,
            width: film.width(),
            height: film.height(),
            filter: film.filter(),
            integrator: self.integrator.map(|(_, i)| i).unwrap_or_default(),
            samples_per_pixel,
            materials: self.materials.list,
            objects: self.objects,
            lights: self.lights,
            environments: self.environments,
            portals: self.portals,
        })
    }
}

/// One that sees the whole scene.
fn default_sensor(objects: &[Object], root: &Element) -> Result<Sensor, LoadError> {
    let camera = framing_camera(objects).map_err(|e| root.error(e))?;
    camera.camera(FILM.width(), FILM.height()).map_err(|e| root.error(e))?;
    Ok(Sensor { camera, film: FILM, samples_per_pixel: None })
}
