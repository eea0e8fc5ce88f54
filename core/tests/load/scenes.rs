//! Whole scenes: parameters, includes, materials, camera, film.

use crate::{load_body, load_files, scene};
use halflight::Rgb;
use halflight::bsdf::{AnyBsdf, Bsdf};
use halflight::build::{FovAxis, Geometry, PathDescription, ProjectionDescription};
use halflight::film::Filter;
use halflight::glam::Vec3;
use halflight::load::LoadOptions;
use halflight::shape::AnyShape;

fn near(a: Vec3, b: Vec3) -> bool {
    (a - b).abs().max_element() < 2e-6
}

fn radius(geometry: &Geometry) -> f32 {
    match geometry {
        Geometry::Shape(AnyShape::Sphere(s)) => s.radius(),
        other => panic!("no sphere: {other:?}"),
    }
}

#[test]
fn parameters_are_put_in_and_can_be_overridden() {
    let text = "<scene version=\"3.0.0\"><default name=\"r\" value=\"2\"/><default name=\"rr\" value=\"$r.5\"/>\
                <shape type=\"sphere\" id=\"a$r\"><float name=\"radius\" value=\"$rr\"/></shape></scene>";
    let radius_with = |defines: &[(&str, &str)]| {
        let defines = defines.iter().map(|(n, v)| ((*n).into(), (*v).into())).collect();
        let options = LoadOptions { defines, lenient: false };
        let object =
            load_files("parameters", &[("s.xml", text)], &options).unwrap().description.objects.remove(0);
        (object.name, radius(&object.geometry))
    };
    assert_eq!(radius_with(&[]), ("a2".to_owned(), 2.5));
    assert_eq!(radius_with(&[("r", "3")]), ("a3".to_owned(), 3.5));
    assert_eq!(radius_with(&[("rr", "7")]), ("a2".to_owned(), 7.0));
}

#[test]
fn includes_are_found_beside_their_file_and_on_the_search_path() {
    let files = [
        (
            "s.xml",
            "<scene version=\"3.0.0\"><path value=\"shared\"/><default name=\"r\" value=\"2\"/>\
             <include filename=\"sub/t.xml\"/><include filename=\"u.xml\"/></scene>",
        ),
        ("sub/t.xml", "<scene version=\"3.0.0\"><include filename=\"v.xml\"/></scene>"),
        ("sub/v.xml", "<shape type=\"sphere\"><float name=\"radius\" value=\"$r\"/></shape>"),
        (
            "shared/u.xml",
            "<scene version=\"3.0.0\"><shape type=\"disk\"/>\
             <shape type=\"obj\"><string name=\"filename\" value=\"m.obj\"/></shape></scene>",
        ),
        ("shared/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    ];
    let description = load_files("includes", &files, &LoadOptions::default()).unwrap().description;
    assert_eq!(description.objects.len(), 3);
    assert_eq!(radius(&description.objects[0].geometry), 2.0);
    assert_eq!(description.triangle_count(), 1);
    assert_eq!(description.name, "s");
}

#[test]
fn materials_are_shared_by_id_alias_and_default() {
    let body = "<shape type=\"disk\"><ref id=\"late\"/></shape><shape type=\"disk\"><ref name=\"bsdf\" id=\"other\"/></shape>\
                <shape type=\"disk\"/><shape type=\"disk\"><bsdf type=\"diffuse\"/></shape>\
                <alias id=\"late\" as=\"other\"/>\
                <bsdf type=\"diffuse\" id=\"late\"><rgb name=\"reflectance\" value=\".1 .2 .3\"/></bsdf>";
    let description = scene("materials", body);
    let used: Vec<usize> = description.objects.iter().map(|o| o.material).collect();
    assert_eq!(used, [0, 0, 1, 1]);
    assert_eq!(description.materials[0].name, "late");
    assert_eq!(description.materials[0].bsdf.front.albedo(), Rgb::new(0.1, 0.2, 0.3));
    assert_eq!(description.materials[1].bsdf.front.albedo(), Rgb::splat(0.5));
    assert!(description.materials[1].bsdf.back.is_none(), "black from behind, as in Mitsuba");
}

#[test]
fn every_material_is_read() {
    let body = "<shape type=\"disk\"/><bsdf type=\"twosided\" id=\"a\"><bsdf type=\"roughconductor\">\
         <string name=\"material\" value=\"none\"/><string name=\"distribution\" value=\"ggx\"/>\
         <float name=\"alpha\" value=\"0.25\"/><boolean name=\"sample_visible\" value=\"true\"/>\
         <rgb name=\"specular_reflectance\" value=\"0.5\"/></bsdf></bsdf>\
         <bsdf type=\"twosided\" id=\"b\"><ref id=\"c\"/><bsdf type=\"diffuse\"/></bsdf>\
         <bsdf type=\"phong\" id=\"c\"><rgb name=\"diffuse_reflectance\" value=\".3\"/></bsdf>";
    let materials = scene("kinds", body).materials;
    assert!(matches!(materials[0].bsdf.front, AnyBsdf::GgxConductor(b) if b.alpha() == [0.25; 2]));
    assert_eq!(materials[0].bsdf.back, Some(materials[0].bsdf.front));
    assert!(matches!(materials[1].bsdf.front, AnyBsdf::Phong(b) if b.diffuse() == Rgb::splat(0.3)));
    assert!(matches!(materials[1].bsdf.back, Some(AnyBsdf::Lambert(_))));
    assert!(
        matches!(materials[2].bsdf.front, AnyBsdf::Phong(b) if b.exponent() == 30.0 && b.specular() == Rgb::splat(0.2))
    );
}

#[test]
fn stretched_metals_and_plastics_are_read() {
    let body = "<shape type=\"disk\"/><bsdf type=\"roughconductor\" id=\"a\">\
         <string name=\"distribution\" value=\"ggx\"/><float name=\"alpha_u\" value=\"0.1\"/>\
         <float name=\"alpha_v\" value=\"0.3\"/><rgb name=\"eta\" value=\".2 .9 1.1\"/>\
         <rgb name=\"k\" value=\"3.9 2.4 2.2\"/></bsdf>\
         <bsdf type=\"roughplastic\" id=\"b\"><string name=\"distribution\" value=\"ggx\"/></bsdf>\
         <bsdf type=\"roughplastic\" id=\"c\"><string name=\"distribution\" value=\"ggx\"/>\
         <string name=\"int_ior\" value=\"BK7\"/><float name=\"ext_ior\" value=\"1.25\"/>\
         <float name=\"alpha\" value=\"0.2\"/><rgb name=\"diffuse_reflectance\" value=\".1 .2 .3\"/>\
         <rgb name=\"specular_reflectance\" value=\".9\"/><boolean name=\"nonlinear\" value=\"true\"/></bsdf>";
    let materials = scene("stretched", body).materials;
    let AnyBsdf::GgxConductor(metal) = materials[0].bsdf.front else { panic!("no metal") };
    assert_eq!(metal.alpha(), [0.1, 0.3]);
    assert_eq!(metal.index(), Some((Rgb::new(0.2, 0.9, 1.1), Rgb::new(3.9, 2.4, 2.2))));
    let AnyBsdf::RoughPlastic(plain) = materials[1].bsdf.front else { panic!("no plastic") };
    assert!((plain.eta() - 1.49 / 1.000_277).abs() < 1e-6 && plain.alpha() == 0.1);
    assert!(plain.diffuse() == Rgb::splat(0.5) && plain.specular() == Rgb::WHITE && !plain.is_nonlinear());
    let AnyBsdf::RoughPlastic(full) = materials[2].bsdf.front else { panic!("no plastic") };
    assert!((full.eta() - 1.5046 / 1.25).abs() < 1e-6 && full.alpha() == 0.2 && full.is_nonlinear());
    assert_eq!((full.diffuse(), full.specular()), (Rgb::new(0.1, 0.2, 0.3), Rgb::splat(0.9)));
}

#[test]
fn materials_beyond_what_is_possible_are_moderated_with_a_warning() {
    let body = "<shape type=\"disk\"/><bsdf type=\"phong\" id=\"p\"><rgb name=\"diffuse_reflectance\" value=\".9\"/>\
        <rgb name=\"specular_reflectance\" value=\".9\"/></bsdf>\
        <bsdf type=\"roughconductor\" id=\"m\"><string name=\"distribution\" value=\"ggx\"/>\
        <float name=\"alpha\" value=\"0.00001\"/></bsdf>";
    let loaded = load_body("moderated", body).unwrap();
    let AnyBsdf::Phong(p) = loaded.description.materials[0].bsdf.front else { panic!("no phong") };
    assert!((p.diffuse().r - 0.495).abs() < 1e-6 && p.diffuse() == p.specular());
    let AnyBsdf::GgxConductor(m) = loaded.description.materials[1].bsdf.front else { panic!("no metal") };
    assert_eq!(m.alpha(), [1e-4; 2]);
    assert_eq!(loaded.warnings.len(), 3, "both, and the missing sensor");
}

#[test]
fn emission_goes_with_the_shape_and_its_material() {
    let body = "<shape type=\"disk\" id=\"lamp\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"1 2 3\"/>\
                <boolean name=\"two_sided\" value=\"true\"/></emitter><bsdf type=\"diffuse\" id=\"glass\"/></shape>\
                <shape type=\"sphere\"><emitter type=\"area\"/></shape>";
    let description = scene("emission", body);
    let lamp = &description.objects[0];
    assert_eq!(
        lamp.emission.as_ref().map(|e| (e.radiance, e.two_sided)),
        Some((Rgb::new(1.0, 2.0, 3.0), true))
    );
    assert_eq!(description.materials[lamp.material].name, "glass");
    assert_eq!(
        description.objects[1].emission.as_ref().map(|e| (e.radiance, e.two_sided)),
        Some((Rgb::WHITE, false))
    );
    let sphere = &description.objects[1];
    assert_eq!(sphere.name, "sphere");
    assert!(
        description.materials[sphere.material].bsdf.front.is_black(),
        "a light without a material, as in Mitsuba"
    );
}

#[test]
fn a_perspective_camera_is_mitsubas() {
    let body = "<shape type=\"disk\"/><sensor type=\"perspective\"><float name=\"fov\" value=\"60\"/>\
        <transform name=\"to_world\"><lookat origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/></transform>\
        <film type=\"hdrfilm\"><integer name=\"width\" value=\"200\"/><integer name=\"height\" value=\"100\"/></film>\
        <sampler type=\"multijitter\"><integer name=\"sample_count\" value=\"16\"/></sampler></sensor>";
    let description = scene("perspective", body);
    assert_eq!(description.samples_per_pixel, Some(16));
    assert_eq!(description.filter, Filter::Gaussian { stddev: 0.5 });
    let camera = description.camera.camera(description.width, description.height).unwrap();
    // Origin, direction and reach that Mitsuba gives the upper left corner.
    let (ray, reach) = camera.ray(-1.0, 1.0);
    assert!((ray.direction - Vec3::new(-0.48507, 0.24254, -0.84017)).length() < 1e-5, "{ray:?}");
    assert!((ray.origin - Vec3::new(-5.77e-3, 2.89e-3, 4.99)).length() < 1e-4, "{ray:?}");
    assert!((reach - 11902.368).abs() < 0.01, "{reach}");
}

#[test]
fn the_default_camera_of_a_sensor_has_fifty_millimetres() {
    let film = "<film type=\"hdrfilm\"><integer name=\"width\" value=\"200\"/><integer name=\"height\" value=\"100\"/></film>";
    for lens in
        ["", "<string name=\"focal_length\" value=\"50mm\"/>", "<string name=\"focal_length\" value=\"50\"/>"]
    {
        let body = format!("<shape type=\"disk\"/><sensor type=\"perspective\">{lens}{film}</sensor>");
        let description = scene("lens", &body);
        let camera = description.camera.camera(200, 100).unwrap();
        let (ray, _) = camera.ray(-1.0, 1.0);
        assert!((ray.direction - Vec3::new(0.35517, 0.17758, 0.91778)).length() < 1e-5, "{ray:?}");
    }
    let both = "<sensor type=\"perspective\"><float name=\"fov\" value=\"9\"/><string name=\"focal_length\" value=\"9\"/></sensor>";
    assert!(crate::refusal("lens", both).contains("give one of the two"));
}

#[test]
fn a_mirrored_camera_is_mirrored() {
    let body = "<shape type=\"disk\"/><sensor type=\"perspective\"><float name=\"fov\" value=\"60\"/>\
                <string name=\"fov_axis\" value=\"smaller\"/>\
                <transform name=\"to_world\"><scale x=\"-1\"/></transform></sensor>";
    let camera = scene("mirrored", body).camera;
    assert!(near(camera.view.right, Vec3::X) && near(camera.view.forward, Vec3::Z));
    assert_eq!(camera.projection, ProjectionDescription::Perspective { fov: 60.0, axis: FovAxis::Smaller });
}

#[test]
fn an_orthographic_camera_is_mitsubas() {
    let body = "<shape type=\"disk\"/><sensor type=\"orthographic\">\
                <transform name=\"to_world\"><scale value=\"3\"/></transform>\
                <film type=\"hdrfilm\"><rfilter type=\"tent\"/></film></sensor>";
    let description = scene("orthographic", body);
    let (ray, reach) = description.camera.camera(200, 100).unwrap().ray(-1.0, 1.0);
    assert!(near(ray.origin, Vec3::new(3.0, 1.5, 0.03)) && ray.direction == Vec3::Z, "{ray:?}");
    assert!((reach - 9999.99).abs() < 1e-2, "Mitsuba does not scale the reach: {reach}");
    assert_eq!(description.filter, Filter::Tent { radius: 1.0 });
}

#[test]
fn only_the_first_sensor_counts_and_without_one_all_is_seen() {
    let two = load_body(
        "sensors",
        "<shape type=\"disk\"/><sensor type=\"perspective\"/>\n<sensor type=\"orthographic\"/>",
    )
    .unwrap();
    assert_eq!(two.warnings.len(), 1);
    assert_eq!(two.warnings[0].at.as_ref().map(|at| at.line), Some(3));
    let none =
        load_body("sensors", "<shape type=\"sphere\"><point name=\"center\" value=\"9 9 9\"/></shape>")
            .unwrap();
    assert!(none.warnings[0].text.contains("no sensor"));
    let view = none.description.camera.view;
    let to_centre = (Vec3::splat(9.0) - view.origin).normalize();
    assert!(to_centre.dot(view.forward) > 0.999_999);
}

#[test]
fn integrators_give_sample_counts_and_how_far_paths_go() {
    let counts = |integrator: &str| {
        let loaded = load_body(
            "integrators",
            &format!("<shape type=\"disk\"/><sensor type=\"perspective\"/>{integrator}"),
        )
        .unwrap();
        let i = loaded.description.integrator;
        assert_eq!(i.path, None, "{integrator}");
        (i.light_samples, i.bsdf_samples, loaded.warnings.len())
    };
    let direct = |inside: &str| counts(&format!("<integrator type=\"direct\">{inside}</integrator>"));
    assert_eq!(direct(""), (None, None, 0));
    assert_eq!(direct("<integer name=\"shading_samples\" value=\"3\"/>"), (Some(3), Some(3), 0));
    assert_eq!(direct("<integer name=\"emitter_samples\" value=\"2\"/>"), (Some(2), None, 0));
    assert_eq!(direct("<boolean name=\"hide_emitters\" value=\"true\"/>"), (None, None, 1));
    let one_bounce = "<integrator type=\"path\"><integer name=\"max_depth\" value=\"2\"/></integrator>";
    assert_eq!(counts(one_bounce), (None, None, 0), "that is the direct light");
    let path = |inside: &str| {
        let integrator = format!("<integrator type=\"path\">{inside}</integrator>");
        let scene = format!("<shape type=\"disk\"/><sensor type=\"perspective\"/>{integrator}");
        load_body("integrators", &scene).map(|loaded| loaded.description.integrator.path)
    };
    let depth = |name: &str, value: &str| format!("<integer name=\"{name}\" value=\"{value}\"/>");
    let all = PathDescription { max_depth: u32::MAX, rr_depth: 5, hide_emitters: false };
    assert_eq!(path("").unwrap(), Some(all));
    assert_eq!(path(&depth("max_depth", "-1")).unwrap(), Some(all));
    assert_eq!(path(&depth("max_depth", "8")).unwrap(), Some(PathDescription { max_depth: 8, ..all }));
    assert_eq!(path(&depth("rr_depth", "3")).unwrap(), Some(PathDescription { rr_depth: 3, ..all }));
    let hidden = depth("max_depth", "2") + "<boolean name=\"hide_emitters\" value=\"true\"/>";
    let expected = PathDescription { max_depth: 2, hide_emitters: true, ..all };
    assert_eq!(path(&hidden).unwrap(), Some(expected));
    for value in ["0", "-2", "many", "1.5"] {
        let error = path(&depth("max_depth", value)).unwrap_err().to_string();
        assert!(error.contains("-1 for paths without end"), "{error}");
    }
}
