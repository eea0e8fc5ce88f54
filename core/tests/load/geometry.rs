//! Where shapes, lights and cameras end up. The numbers are those of Mitsuba 3.9.1.

use crate::scene;
use halflight::Rgb;
use halflight::build::{Description, Geometry};
use halflight::glam::Vec3;
use halflight::light::AnyLight;
use halflight::shape::{AnyShape, Shape};

fn placed(kind: &str, inside: &str, steps: &str) -> Geometry {
    let body =
        format!("<shape type=\"{kind}\">{inside}<transform name=\"to_world\">{steps}</transform></shape>");
    scene("geometry", &body).objects.remove(0).geometry
}

fn shape(kind: &str, inside: &str, steps: &str) -> AnyShape {
    match placed(kind, inside, steps) {
        Geometry::Shape(shape) => shape,
        Geometry::Mesh(_) => panic!("{kind} became a mesh"),
    }
}

fn near(a: Vec3, b: Vec3) -> bool {
    (a - b).abs().max_element() < 2e-6
}

#[test]
fn steps_of_a_transform_act_one_after_the_other() {
    let steps = "<scale x=\"2\"/><rotate y=\"1\" angle=\"90\"/><translate z=\"1\"/>";
    let AnyShape::Rectangle(r) = shape("rectangle", "", steps) else { panic!("no rectangle") };
    assert!(near(r.centre(), Vec3::Z) && near(r.half_u(), Vec3::NEG_Z * 2.0) && near(r.half_v(), Vec3::Y));
    assert!(near(r.normal(), Vec3::X));
    let same = "<rotate value=\"0, 1, 0\" angle=\"90\"/><translate value=\"0 0 1\"/>";
    let AnyShape::Rectangle(r) = shape("rectangle", "", same) else { panic!("no rectangle") };
    assert!(near(r.centre(), Vec3::Z) && near(r.half_u(), Vec3::NEG_Z));
}

#[test]
fn matrices_are_row_by_row_and_may_lack_the_translation() {
    let steps = "<matrix value=\"0 0 2 5  1 0 0 6  0 3 0 7  0 0 0 1\"/>";
    let AnyShape::Rectangle(r) = shape("rectangle", "", steps) else { panic!("no rectangle") };
    assert_eq!((r.centre(), r.half_u()), (Vec3::new(5.0, 6.0, 7.0), Vec3::Y));
    assert_eq!(r.half_v(), Vec3::Z * 3.0);
    let AnyShape::Disk(d) = shape("disk", "", "<matrix value=\"2 0 0 0 1 0 0 0 1\"/>") else {
        panic!("no disk")
    };
    assert_eq!((d.axis_u(), d.axis_v()), (Vec3::X * 2.0, Vec3::Y));
}

#[test]
fn lookat_points_z_at_the_target() {
    let steps = "<lookat origin=\"0, 0, 5\" target=\"0, 0, 0\" up=\"0, 1, 0\"/>";
    let AnyShape::Disk(d) = shape("disk", "", steps) else { panic!("no disk") };
    assert!(near(d.centre(), Vec3::Z * 5.0) && near(d.normal(), Vec3::NEG_Z));
    // x is to the left.
    assert!(near(d.axis_u(), Vec3::NEG_X) && near(d.axis_v(), Vec3::Y));
}

#[test]
fn spheres_take_place_and_size_from_both_sources() {
    let own = "<point name=\"center\" value=\"1, 0, 0\"/><float name=\"radius\" value=\"2\"/>";
    let AnyShape::Sphere(s) = shape("sphere", own, "<scale value=\"3\"/>") else { panic!("no sphere") };
    assert_eq!((s.centre(), s.radius(), s.is_inward()), (Vec3::X * 3.0, 6.0, false));
    let flip = "<boolean name=\"flip_normals\" value=\"true\"/>";
    let AnyShape::Sphere(s) = shape("sphere", flip, "<scale x=\"-1\"/>") else { panic!("no sphere") };
    assert!(!s.is_inward(), "mirrored and flipped");
}

#[test]
fn cylinders_keep_their_ends() {
    let own = "<point name=\"p0\" value=\"0 1 0\"/><point name=\"p1\" value=\"0 3 0\"/><float name=\"radius\" value=\"0.5\"/>";
    let AnyShape::Cylinder(c) = shape("cylinder", own, "<rotate x=\"1\" angle=\"90\"/>") else {
        panic!("no cylinder")
    };
    assert!(near(c.base(), Vec3::Z) && near(c.axis(), Vec3::Z * 2.0) && (c.radius() - 0.5).abs() < 1e-6);
}

#[test]
fn cubes_face_outward_also_when_mirrored() {
    for (steps, inside, outward) in [
        ("<scale value=\"2\"/>", "", true),
        ("<scale x=\"-1\"/>", "", true),
        ("<scale x=\"-1\"/>", "<boolean name=\"flip_normals\" value=\"true\"/>", false),
    ] {
        let Geometry::Mesh(cube) = placed("cube", inside, steps) else { panic!("no mesh") };
        assert_eq!(cube.triangles.len(), 12);
        for t in cube.triangles.iter().map(|t| t.map(|i| cube.positions[i as usize])) {
            let n = (t[1] - t[0]).cross(t[2] - t[0]);
            assert_eq!(n.dot(t[0]) > 0.0, outward, "{steps}");
        }
    }
}

#[test]
fn a_sheared_rectangle_becomes_two_triangles() {
    let Geometry::Mesh(mesh) = placed("rectangle", "", "<matrix value=\"1 .5 0 0 1 0 0 0 1\"/>") else {
        panic!("no mesh")
    };
    assert_eq!(mesh.triangles.len(), 2);
    assert!(mesh.positions.contains(&Vec3::new(1.5, 1.0, 0.0)));
}

fn lights(body: &str) -> Vec<AnyLight<'static>> {
    let description: Description = scene("lights", &format!("<shape type=\"disk\"/>{body}"));
    description.lights
}

#[test]
fn lights_without_a_surface_are_placed_and_have_mitsubas_defaults() {
    let body = "<emitter type=\"point\"><point name=\"position\" value=\"1 2 3\"/></emitter>\
        <emitter type=\"point\"><transform name=\"to_world\"><translate y=\"4\"/></transform></emitter>\
        <emitter type=\"spot\"><float name=\"cutoff_angle\" value=\"40\"/><transform name=\"to_world\">\
        <lookat origin=\"0 5 0\" target=\"0 0 0\" up=\"1 0 0\"/></transform></emitter>\
        <emitter type=\"directional\"><vector name=\"direction\" value=\"0 -2 0\"/>\
        <rgb name=\"irradiance\" value=\"1 2 3\"/></emitter>";
    let lights = lights(body);
    let [AnyLight::Point(p), AnyLight::Point(q), AnyLight::Spot(s), AnyLight::Directional(d)] = lights[..]
    else {
        panic!("{lights:?}")
    };
    assert_eq!((p.position(), p.intensity()), (Vec3::new(1.0, 2.0, 3.0), Rgb::WHITE));
    assert_eq!(q.position(), Vec3::Y * 4.0);
    assert!(near(s.axis(), Vec3::NEG_Y) && s.position() == Vec3::Y * 5.0);
    let (beam, cutoff) = s.angles();
    assert!((beam.to_degrees() - 30.0).abs() < 1e-5 && (cutoff.to_degrees() - 40.0).abs() < 1e-5);
    assert_eq!((d.direction(), d.irradiance()), (Vec3::NEG_Y, Rgb::new(1.0, 2.0, 3.0)));
}

#[test]
fn colours_have_three_spellings() {
    let intensity = |property: &str| match lights(&format!("<emitter type=\"point\">{property}</emitter>"))[..]
    {
        [AnyLight::Point(p)] => p.intensity(),
        ref other => panic!("{other:?}"),
    };
    assert_eq!(intensity("<rgb name=\"intensity\" value=\"1, 2,3\"/>"), Rgb::new(1.0, 2.0, 3.0));
    assert_eq!(intensity("<rgb name=\"intensity\" value=\"0.5\"/>"), Rgb::splat(0.5));
    assert_eq!(intensity("<float name=\"intensity\" value=\"0.5\"/>"), Rgb::splat(0.5));
    // The same power at every wavelength is not the white of sRGB; Mitsuba has these numbers.
    let flat = intensity("<spectrum name=\"intensity\" value=\"10\"/>");
    for (a, b) in flat.to_array().into_iter().zip([12.0479, 9.48291, 9.08916]) {
        assert!((a - b).abs() < 1e-4, "{flat:?}");
    }
}

#[test]
fn bounds_follow_rotation() {
    let steps = "<scale x=\"2\"/><rotate z=\"1\" angle=\"45\"/><translate value=\"1 1 1\"/>";
    let bounds = shape("disk", "", steps).bounds();
    // Half-extent √((2² + 1²)/2) along x and y.
    let half = 2.5_f32.sqrt();
    assert!(near(bounds.max, Vec3::new(1.0 + half, 1.0 + half, 1.0)), "{bounds:?}");
}
