//! A scene that lives in a page: shown, changed, rendered.

use crate::camera::{look, zoomed};
use crate::choices::Choices;
use crate::light::{Light, Wanted};
use crate::lights::{Place, places};
use crate::rigid::{Home, Turn};
use crate::{BuiltinScene, Facts, Probe, View, probe};
use halflight::Film;
use halflight::Rgb;
use halflight::build::{Description, SceneBuffers};
use halflight::film::PixelRect;
use halflight::glam::Vec3;
use halflight::load::builtin::{BUILTIN, builtin};
use std::collections::BTreeMap;
use std::error::Error;
use wasm_bindgen::prelude::*;

/// What a call comes to before JavaScript hears of it.
pub(crate) type Res<T> = Result<T, Box<dyn Error>>;

/// For JavaScript.
pub(crate) fn thrown(error: Box<dyn Error>) -> JsError {
    JsError::new(&error.to_string())
}

/// A scene with its camera, its lights, and how it is to be sampled.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Scene {
    pub(crate) description: Description,
    pub(crate) buffers: SceneBuffers,
    pub(crate) places: Vec<Place>,
    /// Lights that have kept their form and moved, by their index.
    pub(crate) homes: BTreeMap<usize, Home>,
    pub(crate) turns: Vec<Turn>,
    pub(crate) choices: Choices,
    warnings: Vec<String>,
    /// False when the tree has the form of lights that were elsewhere.
    pub(crate) settled: bool,
}

#[wasm_bindgen]
impl Scene {
    /// The built-in scenes; the first is the one to begin with.
    #[must_use]
    pub fn builtins() -> Vec<BuiltinScene> {
        let scene = |b: &halflight::load::builtin::Builtin| BuiltinScene {
            name: b.name.to_owned(),
            about: b.about.to_owned(),
        };
        BUILTIN.iter().map(scene).collect()
    }

    /// A built-in scene.
    ///
    /// # Errors
    /// When there is none of that name.
    pub fn builtin(name: &str) -> Result<Scene, JsError> {
        let description = builtin(name).ok_or_else(|| JsError::new(&format!("there is no scene {name}")))?;
        Self::new(description, Vec::new()).map_err(thrown)
    }

    /// What it holds.
    #[must_use]
    pub fn facts(&self) -> Facts {
        let stats = self.buffers.stats();
        let bound = self.buffers.bind();
        let bounds = bound.scene().bvh().bounds();
        Facts {
            name: self.description.name.clone(),
            width: self.description.width,
            height: self.description.height,
            triangles: stats.triangles as u32,
            analytic: stats.analytic as u32,
            lights: stats.lights as u32,
            environments: self.description.environments.len() as u32,
            bytes: stats.bytes as u32,
            radius: 0.5 * bounds.diagonal(),
            warnings: self.warnings.clone(),
        }
    }

    /// Sets the size of the picture (pixels).
    ///
    /// # Errors
    /// When a film cannot have it.
    pub fn resize(&mut self, width: u32, height: u32) -> Result<(), JsError> {
        Film::new(width, height, self.description.filter)?;
        (self.description.width, self.description.height) = (width, height);
        Ok(())
    }

    /// Where it is looked at from.
    #[must_use]
    pub fn view(&self) -> View {
        View::new(&self.description.camera, self.description.width, self.description.height)
    }

    /// Looks from `origin` toward `target` (m each), with `up` roughly upward.
    ///
    /// * `half_width` – of the picture at distance 1, or of the window (m) of parallel rays
    ///
    /// # Errors
    /// When that is no direction.
    pub fn look(
        &mut self,
        origin: &[f32],
        target: &[f32],
        up: &[f32],
        half_width: f32,
    ) -> Result<(), JsError> {
        let camera = look(&self.description.camera, vec3(origin)?, vec3(target)?, vec3(up)?)?;
        self.description.camera = zoomed(&camera, half_width);
        Ok(())
    }

    /// Its lights, environment maps last.
    #[must_use]
    pub fn lights(&self) -> Vec<Light> {
        self.places.iter().enumerate().map(|(index, place)| self.light(index, *place)).collect()
    }

    /// Changes the light with an index of [`Scene::lights`], or adds one after the last; the indices stay.
    ///
    /// * `kind` – one of those that [`Light`] has: `none` takes the light away, and of a light that is not
    ///   `editable` the kind stays
    /// * `position`, `direction` (m, any length), `size`, `strength` – as [`Light`] has them
    ///
    /// # Errors
    /// When there is no such light, or it cannot be.
    pub fn set_light(
        &mut self,
        index: usize,
        kind: &str,
        position: &[f32],
        direction: &[f32],
        size: &[f32],
        strength: &[f32],
    ) -> Result<(), JsError> {
        let &[width, height] = size else { return Err(JsError::new("the size has two numbers")) };
        let wanted = Wanted {
            kind,
            position: vec3(position)?,
            direction: vec3(direction)?,
            size: [width, height],
            strength: Rgb::from(vec3(strength)?.to_array()),
        };
        self.change_light(index, &wanted).map_err(thrown)
    }

    /// Builds anew what [`Scene::set_light`] has only adapted: to the very tables, and so the very bits,
    /// that the command line has.
    ///
    /// # Errors
    /// When the scene contradicts itself.
    pub fn settle(&mut self) -> Result<(), JsError> {
        if self.settled { Ok(()) } else { self.build().map_err(thrown) }
    }

    /// Makes a choice of `halflight render` by its name: `technique`, `heuristic`, `lights`, `choose`,
    /// `environment`, `sequence`, `light-samples`, `bsdf-samples`, `seed`. And `show`: `radiance`,
    /// `visibility` (arriving luminance of the irradiance in red, without shadows in green), `occlusion`;
    /// and `samples`: how many a pixel is meant to get, which the sequence is laid out for. The command line
    /// says its `--spp`, or with `--error` 65536, which is what it is at first.
    ///
    /// # Errors
    /// When there is no such choice.
    pub fn choose(&mut self, name: &str, value: &str) -> Result<(), JsError> {
        self.choices.set(name, value)?;
        self.draw_environment().map_err(thrown)
    }

    /// Adds samples `first..last` to the pixels of a tile; returns the sum of weighted squared differences
    /// and their number, for [`crate::Progress`].
    ///
    /// * `pixels` – eight words each, 0 before the first sample: mean and sum of squared deviations of
    ///   red, green and blue as floats, samples, rejected samples
    ///
    /// # Errors
    /// When the tile is not in the picture, or has another number of pixels.
    #[expect(clippy::too_many_arguments, reason = "plain numbers, for JavaScript")]
    pub fn render(
        &self,
        x0: u32,
        y0: u32,
        x1: u32,
        y1: u32,
        first: u32,
        last: u32,
        pixels: &mut [u32],
    ) -> Result<Vec<f64>, JsError> {
        let tile = PixelRect { x0, y0, x1, y1 };
        let sums = self.add_samples(tile, first..last, pixels).map_err(thrown)?;
        let (sum, values) = sums.to_parts();
        Ok(vec![sum, values as f64])
    }

    /// Looks at the middle of a pixel with some samples; `undefined` where there is no surface.
    ///
    /// # Errors
    /// When the camera cannot be.
    pub fn probe(&self, x: u32, y: u32, samples: u32) -> Result<Option<Probe>, JsError> {
        self.look_at_pixel(x, y, samples).map_err(thrown)
    }
}

/// Three numbers.
fn vec3(numbers: &[f32]) -> Result<Vec3, JsError> {
    match numbers {
        &[x, y, z] => Ok(Vec3::new(x, y, z)),
        _ => Err(JsError::new("a vector has three numbers")),
    }
}

impl Scene {
    pub(crate) fn new(mut description: Description, warnings: Vec<String>) -> Res<Self> {
        let choices = Choices::default();
        let density = choices.environment(&description);
        description.environments.iter_mut().for_each(|map| map.density = density);
        let buffers = SceneBuffers::new(&description)?;
        let places = places(&description);
        let turns = description.environments.iter().map(Turn::none).collect();
        let homes = BTreeMap::new();
        Ok(Self { description, buffers, places, homes, turns, choices, warnings, settled: true })
    }

    pub(crate) fn build(&mut self) -> Res<()> {
        self.buffers = SceneBuffers::new(&self.description)?;
        self.settled = true;
        Ok(())
    }

    /// Rebuilds when directions toward environment maps are to be drawn in another way.
    fn draw_environment(&mut self) -> Res<()> {
        let density = self.choices.environment(&self.description);
        if self.description.environments.iter().all(|map| map.density == density) {
            return Ok(());
        }
        self.description.environments.iter_mut().for_each(|map| map.density = density);
        self.build()
    }

    pub(crate) fn film(&self) -> Res<Film> {
        Ok(Film::new(self.description.width, self.description.height, self.description.filter)?)
    }

    pub(crate) fn camera(&self) -> Res<halflight::Camera> {
        Ok(self.description.camera.camera(self.description.width, self.description.height)?)
    }

    pub(crate) fn look_at_pixel(&self, x: u32, y: u32, samples: u32) -> Res<Option<Probe>> {
        let bound = self.buffers.bind();
        let of = (&bound.scene(), &self.buffers);
        Ok(probe::probe(of, (&self.camera()?, &self.film()?), &self.choices, (x, y), samples))
    }
}
