//! Openings for the light from all around.

use crate::{folder, refusal, scene};
use halflight::build::SceneBuffers;
use halflight::glam::Vec3;
use halflight::light::AnyLight;
use halflight::load::{LoadOptions, export_mitsuba, load};

const SKY: &str = "<emitter type=\"constant\"/>";

/// A rectangle turned to face `−z`, lifted, with something inside.
fn opening(inside: &str) -> String {
    format!(
        "<shape type=\"rectangle\"><transform name=\"to_world\"><scale x=\"2\"/>\
         <rotate y=\"1\" angle=\"180\"/><translate z=\"3\"/></transform>{inside}</shape>"
    )
}

#[test]
fn a_portal_is_an_opening_and_no_surface() {
    let body = format!("<shape type=\"sphere\"/>{SKY}{}", opening("<emitter type=\"portal\"/>"));
    let description = scene("portal", &body);
    assert_eq!(description.objects.len(), 1);
    let [portal] = description.portals[..] else { panic!("{:?}", description.portals) };
    let shape = portal.shape();
    assert!((shape.normal() - Vec3::NEG_Z).length() < 1e-6, "{}", shape.normal());
    assert!((shape.centre() - Vec3::Z * 3.0).length() < 1e-6, "{}", shape.centre());
    assert!((shape.half_u().length() - 2.0).abs() < 1e-6 && (shape.half_v().length() - 1.0).abs() < 1e-6);
    let buffers = SceneBuffers::new(&description).expect("a scene");
    let bound = buffers.bind();
    assert!(matches!(bound.scene().lights(), [AnyLight::ConstantPortals(l)] if l.portals() == [portal]));
}

#[test]
fn an_exported_portal_is_the_same_portal() {
    let description = scene("portal-out", &format!("{SKY}{}", opening("<emitter type=\"portal\"/>")));
    let path = folder("portal-exported").join("out.xml");
    export_mitsuba(&description, &path).expect("a scene can be written");
    let again = load(&path, &LoadOptions::default()).expect("what was written can be read");
    assert_eq!(again.description.portals, description.portals);
    assert!(again.description.objects.is_empty());
}

#[test]
fn what_is_no_portal_is_refused() {
    let round =
        refusal("portal-round", &format!("{SKY}<shape type=\"disk\"><emitter type=\"portal\"/></shape>"));
    assert!(
        round.contains("<emitter type=\"portal\">") && round.contains("use <shape type=\"rectangle\">"),
        "{round}"
    );
    let coloured = refusal(
        "portal-coloured",
        &format!(
            "{SKY}{}",
            opening("<emitter type=\"portal\"><rgb name=\"radiance\" value=\"1\"/></emitter>")
        ),
    );
    assert!(coloured.contains("\"radiance\""), "{coloured}");
    let solid = refusal(
        "portal-solid",
        &format!("{SKY}{}", opening("<bsdf type=\"diffuse\"/><emitter type=\"portal\"/>")),
    );
    assert!(solid.contains("<bsdf"), "{solid}");
    let free = refusal("portal-free", &format!("{SKY}<emitter type=\"portal\"/>"));
    assert!(free.contains("portal"), "{free}");
}
