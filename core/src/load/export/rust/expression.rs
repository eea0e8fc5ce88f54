//! Values as Rust expressions that a compiler can evaluate.

use crate::Rgb;
use crate::build::{CameraDescription, ProjectionDescription};
use crate::bvh::{Child, Node, WIDTH};
use crate::camera::{Camera, View};
use crate::film::{Film, Filter};
use crate::scene::{CornerNormals, CornerUvs, NONE, Surface};
use crate::shape::AnyShape;
use crate::texture::ObjectSpace;
use glam::Vec3;
use std::format;
use std::string::{String, ToString};

/// A number, with as many digits as tell it from its neighbours.
pub(super) fn number(v: f32) -> String {
    if v == f32::INFINITY { "f32::INFINITY".to_string() } else { format!("{v:?}") }
}

/// Numbers, separated by commas.
pub(super) fn list(numbers: &[f32]) -> String {
    let parts: std::vec::Vec<String> = numbers.iter().map(|&n| number(n)).collect();
    parts.join(", ")
}

pub(super) fn vector(v: Vec3) -> String {
    format!("Vec3::new({})", list(&v.to_array()))
}

pub(super) fn rgb(c: Rgb) -> String {
    format!("Rgb::new({})", list(&c.to_array()))
}

/// A shape, of its own type.
pub(super) fn shape(shape: &AnyShape) -> String {
    match shape {
        AnyShape::Triangle(t) => format!("Triangle::baked([{}])", t.corners().map(vector).join(", ")),
        AnyShape::Rectangle(r) => planar("Rectangle", [r.centre(), r.half_u(), r.half_v()]),
        AnyShape::Disk(d) => planar("Disk", [d.centre(), d.axis_u(), d.axis_v()]),
        AnyShape::Sphere(s) => {
            let flip = if s.is_inward() { ".flipped()" } else { "" };
            format!("Sphere::baked({}, {}){flip}", vector(s.centre()), number(s.radius()))
        }
        AnyShape::Cylinder(c) => {
            let flip = if c.is_inward() { ".flipped()" } else { "" };
            let (base, axis) = (vector(c.base()), vector(c.axis()));
            format!("Cylinder::baked({base}, {axis}, {}){flip}", number(c.radius()))
        }
    }
}

fn planar(kind: &str, vectors: [Vec3; 3]) -> String {
    format!("{kind}::baked({})", vectors.map(vector).join(", "))
}

/// The name of a shape's type.
pub(super) fn shape_name(shape: &AnyShape) -> &'static str {
    match shape {
        AnyShape::Triangle(_) => "Triangle",
        AnyShape::Rectangle(_) => "Rectangle",
        AnyShape::Disk(_) => "Disk",
        AnyShape::Sphere(_) => "Sphere",
        AnyShape::Cylinder(_) => "Cylinder",
    }
}

/// A surface whose shape is the given expression.
pub(super) fn surface(surface: &Surface<AnyShape>, shape: &str) -> String {
    let index = |i: u32| if i == NONE { "NONE".to_string() } else { i.to_string() };
    let Surface { material, light, normals, uvs, .. } = *surface;
    format!(
        "Surface {{ shape: {shape}, material: {material}, light: {}, normals: {}, uvs: {} }}",
        index(light),
        index(normals),
        index(uvs)
    )
}

/// A node from its children.
pub(super) fn node(node: &Node) -> String {
    let mut text = "Node::EMPTY".to_string();
    for slot in 0..WIDTH {
        let child = match node.child(slot) {
            Child::Empty => continue,
            Child::Node(index) => format!("Child::Node({index})"),
            Child::Leaf { first, count } => format!("Child::Leaf {{ first: {first}, count: {count} }}"),
        };
        let bounds = node.child_bounds(slot);
        let (min, max) = (vector(bounds.min), vector(bounds.max));
        text += &format!("\n        .with_child({slot}, {child}, Aabb {{ min: {min}, max: {max} }})");
    }
    text
}

pub(super) fn corner_normals(normals: &CornerNormals) -> String {
    format!("CornerNormals([{}])", normals.0.map(vector).join(", "))
}

pub(super) fn corner_uvs(uvs: &CornerUvs) -> String {
    let corners = uvs.0.map(|uv| format!("Vec2::new({})", list(&uv.to_array())));
    format!("CornerUvs([{}])", corners.join(", "))
}

pub(super) fn object_space(space: &ObjectSpace) -> String {
    let columns = [space.to_object.x_axis, space.to_object.y_axis, space.to_object.z_axis].map(vector);
    format!(
        "ObjectSpace {{ origin: {}, to_object: Mat3::from_cols({}) }}",
        vector(space.origin),
        columns.join(", ")
    )
}

/// A constant that a compiler refuses when its constructor does.
fn constant(out: &mut String, about: &str, name: &str, kind: &str, made: &str, what: &str) {
    *out += &format!(
        "\n/// {about}\npub const {name}: {kind} = match {made} {{\n    Ok({what}) => {what},\n    \
         Err(_) => panic!(\"not a {what}\"),\n}};\n"
    );
}

/// The camera, of which the description is another view.
pub(super) fn camera(out: &mut String, description: &CameraDescription, camera: &Camera) {
    let View { origin, right, up, forward } = description.view;
    let [origin, right, up, forward] = [origin, right, up, forward].map(vector);
    let view = format!("View {{ origin: {origin}, right: {right}, up: {up}, forward: {forward} }}");
    let kind = match description.projection {
        ProjectionDescription::Perspective { .. } => "perspective",
        ProjectionDescription::Orthographic { .. } => "orthographic",
    };
    let (width, height) = camera.half_extents();
    let (near, far) = (number(description.near), number(description.far));
    *out += &format!("\nconst VIEW: View = {view};\n");
    let unclipped = format!("Camera::{kind}(VIEW, {}, {})", number(width), number(height));
    constant(out, "The camera before anything is clipped away.", "UNCLIPPED", "Camera", &unclipped, "camera");
    let clipped = format!("UNCLIPPED.with_clip({near}, {far})");
    constant(out, "What looks at the scene.", "CAMERA", "Camera", &clipped, "camera");
}

pub(super) fn film(out: &mut String, film: &Film) {
    let filter = match film.filter() {
        Filter::Box { radius } => format!("Filter::Box {{ radius: {} }}", number(radius)),
        Filter::Tent { radius } => format!("Filter::Tent {{ radius: {} }}", number(radius)),
        Filter::Gaussian { stddev } => format!("Filter::Gaussian {{ stddev: {} }}", number(stddev)),
    };
    let made = format!("Film::new({}, {}, {filter})", film.width(), film.height());
    constant(out, "The picture's raster.", "FILM", "Film", &made, "film");
}
