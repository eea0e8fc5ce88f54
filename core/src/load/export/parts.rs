//! The parts of a scene in Mitsuba's words.

use super::textures::Pictures;
use super::xml::Xml;
use super::{ExportError, digits};
use crate::build::{
    CameraDescription, Description, Emission, EnvironmentDescription, FovAxis, Geometry,
    IntegratorDescription, PathDescription, ProjectionDescription,
};
use crate::camera::View;
use crate::film::Filter;
use crate::geom::Frame;
use crate::light::{AnyLight, Emitter, Portal, Spot};
use crate::shape::AnyShape;
use crate::texture::ObjectSpace;
use glam::{DMat3, DVec3, Vec3};
use std::borrow::ToOwned;
use std::format;

/// Mitsuba refuses a near distance of 0.
const NEAREST: f32 = 1e-6;
/// Stands for an infinite far distance, which Mitsuba cannot read.
const FARTHEST: f32 = 1e30;

pub(super) fn integrator(xml: &mut Xml, description: &Description) {
    let samples = description.integrator;
    if samples == IntegratorDescription::default() {
        return xml.empty("integrator", &[("type", "direct")]);
    }
    if let Some(path) = samples.path {
        return path_integrator(xml, path);
    }
    xml.open_plugin("integrator", "direct", None);
    for (name, count) in [("emitter_samples", samples.light_samples), ("bsdf_samples", samples.bsdf_samples)]
    {
        if let Some(count) = count {
            xml.integer(name, count);
        }
    }
    xml.close("integrator");
}

fn path_integrator(xml: &mut Xml, path: PathDescription) {
    xml.open_plugin("integrator", "path", None);
    let depth = |depth| if depth == u32::MAX { "-1".to_owned() } else { format!("{depth}") };
    xml.property("integer", "max_depth", &depth(path.max_depth));
    xml.property("integer", "rr_depth", &depth(path.rr_depth));
    if path.hide_emitters {
        xml.property("boolean", "hide_emitters", "true");
    }
    xml.close("integrator");
}

pub(super) fn sensor(xml: &mut Xml, description: &Description) {
    let camera = &description.camera;
    match camera.projection {
        ProjectionDescription::Perspective { fov, axis } => {
            xml.open_plugin("sensor", "perspective", None);
            xml.float("fov", fov);
            xml.property("string", "fov_axis", axis_name(axis));
            place_camera(xml, camera, 1.0);
        }
        ProjectionDescription::Orthographic { half_width } => {
            xml.open_plugin("sensor", "orthographic", None);
            place_camera(xml, camera, half_width);
        }
    }
    xml.float("near_clip", camera.near.max(NEAREST));
    xml.float("far_clip", camera.far.min(FARTHEST));
    film(xml, description);
    if let Some(count) = description.samples_per_pixel {
        xml.open_plugin("sampler", "independent", None);
        xml.integer("sample_count", count);
        xml.close("sampler");
    }
    xml.close("sensor");
}

fn axis_name(axis: FovAxis) -> &'static str {
    match axis {
        FovAxis::X => "x",
        FovAxis::Y => "y",
        FovAxis::Diagonal => "diagonal",
        FovAxis::Smaller => "smaller",
        FovAxis::Larger => "larger",
    }
}

/// Mitsuba's camera has x to the left; the window of an orthographic one is `[−1, 1]` wide.
fn place_camera(xml: &mut Xml, camera: &CameraDescription, scale: f32) {
    let View { origin, right, up, forward } = camera.view;
    let (right, up, scale) = (right.as_dvec3(), up.as_dvec3(), f64::from(scale));
    matrix(xml, [right * -scale, up * scale, forward.as_dvec3(), origin.as_dvec3()]);
}

/// A transform from its columns: the images of the axes and of the origin.
fn matrix(xml: &mut Xml, [x, y, z, origin]: [DVec3; 4]) {
    let row = |i: usize| [x, y, z, origin].map(|column| digits(column[i])).join(" ");
    let value = format!("{}  {}  {}  0 0 0 1", row(0), row(1), row(2));
    xml.open("transform", &[("name", "to_world")]);
    xml.empty("matrix", &[("value", &value)]);
    xml.close("transform");
}

fn film(xml: &mut Xml, description: &Description) {
    xml.open_plugin("film", "hdrfilm", None);
    xml.integer("width", description.width);
    xml.integer("height", description.height);
    let (kind, name, extent) = match description.filter {
        Filter::Box { radius } => ("box", "radius", radius),
        Filter::Tent { radius } => ("tent", "radius", radius),
        Filter::Gaussian { stddev } => ("gaussian", "stddev", stddev),
    };
    if description.filter == Filter::PIXEL {
        xml.empty("rfilter", &[("type", kind)]);
    } else {
        if kind == "box" {
            xml.remark("Mitsuba's box has no other radius than 0.5");
        }
        xml.open_plugin("rfilter", kind, None);
        xml.float(name, extent);
        xml.close("rfilter");
    }
    xml.close("film");
}

pub(super) fn shape_kind(geometry: &Geometry) -> &'static str {
    match geometry {
        Geometry::Mesh(_) | Geometry::Shape(AnyShape::Triangle(_)) => "ply",
        Geometry::Shape(AnyShape::Rectangle(_)) => "rectangle",
        Geometry::Shape(AnyShape::Disk(_)) => "disk",
        Geometry::Shape(AnyShape::Sphere(_)) => "sphere",
        Geometry::Shape(AnyShape::Cylinder(_)) => "cylinder",
    }
}

/// The properties of a shape that is not written as a mesh.
pub(super) fn analytic(xml: &mut Xml, shape: &AnyShape) {
    let inward = match shape {
        AnyShape::Triangle(_) => false,
        AnyShape::Rectangle(s) => {
            matrix(xml, [s.half_u(), s.half_v(), s.normal(), s.centre()].map(|v| v.as_dvec3()));
            false
        }
        AnyShape::Disk(s) => {
            matrix(xml, [s.axis_u(), s.axis_v(), s.normal(), s.centre()].map(|v| v.as_dvec3()));
            false
        }
        AnyShape::Sphere(s) => {
            coordinates(xml, "point", "center", s.centre().as_dvec3());
            xml.float("radius", s.radius());
            s.is_inward()
        }
        AnyShape::Cylinder(s) => {
            let base = s.base().as_dvec3();
            coordinates(xml, "point", "p0", base);
            // In double precision, so that the difference gives the axis back.
            coordinates(xml, "point", "p1", base + s.axis().as_dvec3());
            xml.float("radius", s.radius());
            s.is_inward()
        }
    };
    if inward {
        xml.property("boolean", "flip_normals", "true");
    }
}

fn coordinates(xml: &mut Xml, tag: &str, name: &str, v: DVec3) {
    xml.empty(tag, &[("name", name), ("x", &digits(v.x)), ("y", &digits(v.y)), ("z", &digits(v.z))]);
}

/// The same as the image of the unit shape, whose turn textures show.
pub(super) fn in_object_space(xml: &mut Xml, shape: &AnyShape, space: &ObjectSpace) {
    let to_world = space.to_object.as_dmat3().inverse();
    let DMat3 { x_axis, y_axis, z_axis } = to_world;
    matrix(xml, [x_axis, y_axis, z_axis, space.origin.as_dvec3()]);
    let upward =
        |normal: Vec3| to_world.inverse().transpose().mul_vec3(DVec3::Z).dot(normal.as_dvec3()) > 0.0;
    let flipped = match shape {
        AnyShape::Triangle(_) => false,
        AnyShape::Rectangle(s) => !upward(s.normal()),
        AnyShape::Disk(s) => !upward(s.normal()),
        // A mirrored sphere is seen from inside, a mirrored cylinder is not.
        AnyShape::Sphere(s) => s.is_inward() != (to_world.determinant() < 0.0),
        AnyShape::Cylinder(s) => s.is_inward(),
    };
    if flipped {
        xml.property("boolean", "flip_normals", "true");
    }
}

pub(super) fn emission(
    xml: &mut Xml,
    pictures: &mut Pictures<'_>,
    emission: &Emission,
) -> Result<(), ExportError> {
    if emission.two_sided {
        xml.remark("two_sided is not known to Mitsuba");
    }
    xml.open_plugin("emitter", "area", None);
    let texture = emission.texture.as_ref().map(|t| (t, emission.radiance));
    pictures.colour(xml, "radiance", emission.radiance, texture)?;
    if emission.two_sided {
        xml.property("boolean", "two_sided", "true");
    }
    xml.close("emitter");
    Ok(())
}

/// An opening for the light from all around.
pub(super) fn portal(xml: &mut Xml, portal: &Portal, index: usize) {
    if index == 0 {
        xml.remark("Mitsuba has no portals: leave these rectangles out there");
    }
    xml.open_plugin("shape", "rectangle", None);
    analytic(xml, &AnyShape::Rectangle(*portal.shape()));
    xml.open_plugin("emitter", "portal", None);
    xml.close("emitter");
    xml.close("shape");
}

/// An environment map whose picture is in a file.
pub(super) fn environment(xml: &mut Xml, map: &EnvironmentDescription, file: &str) {
    let [x, y, z] = [map.to_world.x_axis, map.to_world.y_axis, map.to_world.z_axis].map(|v| v.as_dvec3());
    xml.open_plugin("emitter", "envmap", None);
    xml.property("string", "filename", file);
    if map.scale != 1.0 {
        xml.float("scale", map.scale);
    }
    matrix(xml, [x, y, z, DVec3::ZERO]);
    xml.close("emitter");
}

/// A light without a surface.
pub(super) fn light(xml: &mut Xml, light: &AnyLight) -> Result<(), ExportError> {
    match light {
        AnyLight::Rectangle(_)
        | AnyLight::Disk(_)
        | AnyLight::Sphere(_)
        | AnyLight::Triangle(_)
        | AnyLight::Cylinder(_)
        | AnyLight::Painted(_)
        | AnyLight::EnvironmentMap(_)
        | AnyLight::EnvironmentPortals(_) => return Err(ExportError::SurfaceLight { kind: light.name() }),
        AnyLight::Point(l) => {
            xml.open_plugin("emitter", "point", None);
            coordinates(xml, "point", "position", l.position().as_dvec3());
            xml.rgb("intensity", l.intensity());
        }
        AnyLight::Spot(l) => spot(xml, l),
        AnyLight::Directional(l) => {
            xml.open_plugin("emitter", "directional", None);
            coordinates(xml, "vector", "direction", l.direction().as_dvec3());
            xml.rgb("irradiance", l.irradiance());
        }
        AnyLight::DistantDisk(l) => {
            xml.remark("a sun of some width, which Mitsuba has only within its own sky: as parallel light");
            xml.open_plugin("emitter", "directional", None);
            coordinates(xml, "vector", "direction", -l.axis().as_dvec3());
            xml.rgb("irradiance", l.irradiance());
        }
        AnyLight::Constant(_) | AnyLight::ConstantPortals(_) => {
            xml.open_plugin("emitter", "constant", None);
            xml.rgb("radiance", light.radiance_escaping(Vec3::Z));
        }
    }
    xml.close("emitter");
    Ok(())
}

fn spot(xml: &mut Xml, light: &Spot) {
    xml.open_plugin("emitter", "spot", None);
    let frame = Frame::from_normal(light.axis());
    matrix(xml, [frame.s, frame.t, frame.n, light.position()].map(|v| v.as_dvec3()));
    let (beam, cutoff) = light.angles();
    xml.property("float", "cutoff_angle", &format!("{:?}", f64::from(cutoff).to_degrees()));
    xml.property("float", "beam_width", &format!("{:?}", f64::from(beam).to_degrees()));
    xml.rgb("intensity", light.intensity());
}
