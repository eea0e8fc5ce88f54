//! `<sensor>`: camera, film and sample count.

use super::context::Context;
use super::element::Element;
use super::properties::Properties;
use super::value;
use crate::build::{CameraDescription, FovAxis, ProjectionDescription};
use crate::camera::View;
use crate::film::{Film, Filter};
use crate::load::framing::FILM;
use crate::load::{LoadError, Problem};
use glam::{DMat4, DVec3};
use std::borrow::ToOwned;

const SAMPLERS: [&str; 5] = ["independent", "stratified", "multijitter", "orthogonal", "ldsampler"];
const AXES: [(&str, FovAxis); 5] = [
    ("x", FovAxis::X),
    ("y", FovAxis::Y),
    ("diagonal", FovAxis::Diagonal),
    ("smaller", FovAxis::Smaller),
    ("larger", FovAxis::Larger),
];
/// How far a camera's axes may be from unit length and right angles: a matrix written with few digits.
const RIGID: f64 = 1e-3;

/// What a `<sensor>` says.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sensor {
    pub(super) camera: CameraDescription,
    pub(super) film: Film,
    pub(super) samples_per_pixel: Option<u32>,
}

/// Reads a sensor.
pub(super) fn read(context: &mut Context<'_>, element: &Element) -> Result<Sensor, LoadError> {
    let kind = element.plugin("sensor", &["perspective", "orthographic"])?;
    let mut properties = Properties::new(element)?;
    let (at, m) = properties.transform("to_world")?.unwrap_or((element, DMat4::IDENTITY));
    let axes = Axes::new(at, &m)?;
    let (mut near, mut far) =
        (properties.float_or("near_clip", 1e-2)?, properties.float_or("far_clip", 1e4)?);
    let projection = if kind == "perspective" {
        axes.check_rigid(at)?;
        perspective(element, &mut properties)?
    } else {
        // As Mitsuba: a scale moves the near end, but leaves the length between the ends.
        let length = far - near;
        near *= axes.lengths.z;
        far = near + length;
        axes.orthographic(at)?
    };
    let film = match properties.single(&["film"])? {
        Some(film) => read_film(context, film)?,
        None => FILM,
    };
    let samples_per_pixel = match properties.single(&["sampler"])? {
        Some(sampler) => read_sampler(context, sampler)?,
        None => None,
    };
    properties.finish(context)?;
    let view = axes.view(&m);
    let camera = CameraDescription { view, projection, near: near as f32, far: far as f32 };
    camera.camera(film.width(), film.height()).map_err(|e| element.error(e))?;
    Ok(Sensor { camera, film, samples_per_pixel })
}

/// The directions of a camera and how they are scaled. Mitsuba's camera looks along z with y up and
/// x to the left.
struct Axes {
    lengths: DVec3,
    units: [DVec3; 3],
}

impl Axes {
    fn new(at: &Element, m: &DMat4) -> Result<Self, LoadError> {
        let columns = [m.x_axis, m.y_axis, m.z_axis].map(|c| c.truncate());
        // Axes of unit length in single precision stay as they are, to the last bit.
        let length = |v: DVec3| if (v.length() - 1.0).abs() < 1e-6 { 1.0 } else { v.length() };
        let lengths = DVec3::from_array(columns.map(length));
        let units = columns.map(|v| if length(v) == 1.0 { v } else { v.normalize_or_zero() });
        let skew = [(0, 1), (0, 2), (1, 2)].map(|(i, j)| units[i].dot(units[j]).abs());
        if lengths.min_element() > 0.0 && skew.iter().all(|s| *s < RIGID) {
            return Ok(Self { lengths, units });
        }
        Err(at.error(Problem::Transform { must: "keep the camera's axes at right angles" }))
    }

    fn check_rigid(&self, at: &Element) -> Result<(), LoadError> {
        if (self.lengths - 1.0).abs().max_element() < RIGID {
            return Ok(());
        }
        Err(at.error(Problem::Transform { must: "not scale a perspective camera" }))
    }

    fn orthographic(&self, at: &Element) -> Result<ProjectionDescription, LoadError> {
        if (self.lengths.y / self.lengths.x - 1.0).abs() < RIGID {
            return Ok(ProjectionDescription::Orthographic { half_width: self.lengths.x as f32 });
        }
        Err(at.error(Problem::Transform { must: "scale x and y of an orthographic camera alike" }))
    }

    fn view(&self, m: &DMat4) -> View {
        let [left, up, forward] = self.units.map(|v| v.as_vec3());
        View { origin: m.w_axis.truncate().as_vec3(), right: -left, up, forward }
    }
}

fn perspective(
    element: &Element,
    properties: &mut Properties<'_>,
) -> Result<ProjectionDescription, LoadError> {
    for name in ["principal_point_offset_x", "principal_point_offset_y"] {
        if properties.float_or(name, 0.0)? != 0.0 {
            let what = "an offset of the principal point".to_owned();
            return Err(element.error(Problem::NotSupported { what, instead: "set it to 0" }));
        }
    }
    let fov = properties.float("fov")?;
    let axis = properties.text("fov_axis")?;
    match (fov, properties.text("focal_length")?) {
        (Some(_), Some((at, _))) => {
            let what = "focal_length together with fov".to_owned();
            Err(at.error(Problem::NotSupported { what, instead: "give one of the two" }))
        }
        (Some(fov), None) => {
            Ok(ProjectionDescription::Perspective { fov: fov as f32, axis: fov_axis(axis)? })
        }
        // Millimetres on film for 35 mm cameras, 36 × 24, along its diagonal.
        (None, length) => {
            let length = length.map_or(Ok(50.0), |(at, text)| focal_length(at, text))?;
            let fov = 2.0 * libm::atan(libm::sqrt(36.0 * 36.0 + 24.0 * 24.0) / (2.0 * length)).to_degrees();
            Ok(ProjectionDescription::Perspective { fov: fov as f32, axis: FovAxis::Diagonal })
        }
    }
}

fn fov_axis(axis: Option<(&Element, &str)>) -> Result<FovAxis, LoadError> {
    let Some((at, name)) = axis else { return Ok(FovAxis::X) };
    AXES.iter()
        .find(|(n, _)| *n == name)
        .map(|(_, axis)| *axis)
        .ok_or_else(|| at.error(Problem::unknown("axis of the field of view", name, &AXES.map(|(n, _)| n))))
}

fn focal_length(at: &Element, text: &str) -> Result<f64, LoadError> {
    let digits = text.strip_suffix("mm").unwrap_or(text).trim();
    let length = digits.parse().ok().filter(|l: &f64| *l > 0.0 && l.is_finite());
    length.ok_or_else(|| value::bad(at, "value", "a length above 0, such as 50mm"))
}

fn read_film(context: &mut Context<'_>, element: &Element) -> Result<Film, LoadError> {
    element.plugin("film", &["hdrfilm"])?;
    let mut properties = Properties::new(element)?;
    let width = properties.count("width")?.unwrap_or(FILM.width());
    let height = properties.count("height")?.unwrap_or(FILM.height());
    for name in ["crop_offset_x", "crop_offset_y", "crop_width", "crop_height"] {
        if properties.count(name)?.is_some() {
            let what = "a crop window in the file".to_owned();
            return Err(element.error(Problem::NotSupported { what, instead: "use --crop" }));
        }
    }
    let ignored = ["pixel_format", "file_format", "component_format", "sample_border", "compensate"];
    properties.ignore(&ignored);
    let filter = match properties.single(&["rfilter"])? {
        Some(filter) => read_filter(context, filter)?,
        None => FILM.filter(),
    };
    properties.finish(context)?;
    Film::new(width, height, filter).map_err(|e| element.error(e))
}

fn read_filter(context: &mut Context<'_>, element: &Element) -> Result<Filter, LoadError> {
    let kind = element.plugin("reconstruction filter", &["box", "tent", "gaussian"])?;
    let mut properties = Properties::new(element)?;
    let filter = match kind {
        "box" => Filter::Box { radius: properties.float_or("radius", 0.5)? as f32 },
        "tent" => Filter::Tent { radius: properties.float_or("radius", 1.0)? as f32 },
        _ => Filter::Gaussian { stddev: properties.float_or("stddev", 0.5)? as f32 },
    };
    properties.finish(context)?;
    Ok(filter)
}

fn read_sampler(context: &mut Context<'_>, element: &Element) -> Result<Option<u32>, LoadError> {
    element.plugin("sampler", &SAMPLERS)?;
    let mut properties = Properties::new(element)?;
    let count = properties.count("sample_count")?;
    properties.ignore(&["seed", "jitter"]);
    properties.finish(context)?;
    match count {
        Some(0) => Err(element.error(Problem::Missing { what: "a sample_count above 0".to_owned() })),
        count => Ok(count),
    }
}
