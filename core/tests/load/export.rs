//! What is written is what was there.

use crate::folder;
use halflight::build::{CameraDescription, Description, Geometry, Mesh, Object, PathDescription};
use halflight::film::Filter;
use halflight::glam::Vec3;
use halflight::light::AnyLight;
use halflight::load::builtin::{BUILTIN, builtin};
use halflight::load::{ExportError, LoadOptions, export_mitsuba, load};
use halflight::shape::{AnyShape, Triangle};
use std::fs;
use std::path::Path;

/// One of everything, with numbers that need all their digits.
const EVERYTHING: &str = "\
<sensor type=\"perspective\"><float name=\"fov\" value=\"37.3\"/><string name=\"fov_axis\" value=\"larger\"/>\
<float name=\"near_clip\" value=\"0.1\"/><float name=\"far_clip\" value=\"123.4\"/>\
<transform name=\"to_world\"><lookat origin=\"1.1, 3.2, 7.7\" target=\"0.1, 0.6, 0\" up=\"0.1, 1, 0\"/></transform>\
<film type=\"hdrfilm\"><integer name=\"width\" value=\"321\"/><rfilter type=\"tent\"/></film>\
<sampler type=\"independent\"><integer name=\"sample_count\" value=\"7\"/></sampler></sensor>\
<integrator type=\"direct\"><integer name=\"emitter_samples\" value=\"2\"/></integrator>\
<bsdf type=\"twosided\" id=\"a &amp; &quot;b&quot; &lt;c&gt;\"><bsdf type=\"diffuse\"><rgb name=\"reflectance\" value=\".1 .2 .3\"/></bsdf>\
<bsdf type=\"phong\"/></bsdf>\
<bsdf type=\"roughconductor\" id=\"metal\"><string name=\"distribution\" value=\"ggx\"/></bsdf>\
<bsdf type=\"roughconductor\" id=\"brushed\"><string name=\"distribution\" value=\"ggx\"/><float name=\"alpha_u\" value=\".3\"/>\
<float name=\"alpha_v\" value=\".07\"/><rgb name=\"eta\" value=\".2 .9 1.1\"/><rgb name=\"k\" value=\"3.9 2.4 2.2\"/></bsdf>\
<bsdf type=\"roughplastic\" id=\"plastic\"><string name=\"distribution\" value=\"ggx\"/><string name=\"int_ior\" value=\"bk7\"/>\
<rgb name=\"diffuse_reflectance\" value=\".1 .2 .3\"/><boolean name=\"nonlinear\" value=\"true\"/></bsdf>\
<bsdf type=\"principled\" id=\"shop\"><rgb name=\"base_color\" value=\".1 .7 .3\"/><float name=\"metallic\" value=\".3\"/>\
<float name=\"roughness\" value=\".4\"/></bsdf>\
<shape type=\"rectangle\" id=\"floor\"><ref id=\"metal\"/><transform name=\"to_world\"><rotate x=\".8\" y=\".6\" angle=\"-77\"/>\
<scale value=\"12.1\"/><translate x=\".3\"/></transform></shape>\
<shape type=\"rectangle\"><boolean name=\"flip_normals\" value=\"true\"/><bsdf type=\"twosided\"><bsdf type=\"diffuse\"/></bsdf></shape>\
<shape type=\"disk\" id=\"lamp\"><emitter type=\"area\"><rgb name=\"radiance\" value=\"1.1 2.2 1e-7\"/></emitter>\
<transform name=\"to_world\"><matrix value=\"1 .5 0 .2 1 .3 0 .1 1\"/></transform></shape>\
<shape type=\"sphere\"><point name=\"center\" value=\".1 .2 .3\"/><float name=\"radius\" value=\".7\"/>\
<boolean name=\"flip_normals\" value=\"true\"/></shape>\
<shape type=\"cylinder\"><point name=\"p0\" value=\".1 .2 .3\"/><point name=\"p1\" value=\"1.7 -.9 1e-3\"/><float name=\"radius\" value=\".3\"/></shape>\
<shape type=\"cube\" id=\"box\"><transform name=\"to_world\"><rotate y=\"1\" angle=\"30\"/></transform></shape>\
<shape type=\"ply\" id=\"../../box\"><string name=\"filename\" value=\"m.ply\"/></shape>\
<emitter type=\"point\"><point name=\"position\" value=\".1 .2 .3\"/></emitter>\
<emitter type=\"spot\"><float name=\"cutoff_angle\" value=\"33.3\"/></emitter>\
<emitter type=\"directional\"><vector name=\"direction\" value=\"0 0 -1\"/></emitter>\
<emitter type=\"constant\"><rgb name=\"radiance\" value=\".1\"/></emitter>";

const MESH: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
element face 2\nproperty list uchar int vertex_indices\nend_header\n-1 -1 0\n1 -1 0\n1 1 0.5\n-1 1 0\n3 0 1 2\n3 0 2 3\n";

fn read(path: &Path) -> Description {
    load(path, &LoadOptions::default()).unwrap_or_else(|e| panic!("{e}")).description
}

fn everything(name: &str) -> Description {
    let folder = folder(name);
    fs::write(folder.join("m.ply"), MESH).unwrap();
    let path = folder.join("in.xml");
    fs::write(&path, format!("<scene version=\"3.0.0\">{EVERYTHING}</scene>")).unwrap();
    read(&path)
}

/// Equality of all parts but the name, which is that of the file.
fn assert_same(a: &Description, b: &Description) {
    assert_same_camera(&a.camera, &b.camera);
    assert_eq!((a.width, a.height, a.filter), (b.width, b.height, b.filter));
    assert_eq!((a.integrator, a.samples_per_pixel), (b.integrator, b.samples_per_pixel));
    assert_eq!(a.materials, b.materials);
    assert_eq!(a.objects.len(), b.objects.len());
    a.objects.iter().zip(&b.objects).for_each(|(a, b)| assert_eq!(a, b));
    assert_eq!(a.lights, b.lights);
}

#[test]
fn everything_comes_back_to_the_last_bit() {
    let description = everything("roundtrip");
    let path = folder("roundtrip-out").join("out.xml");
    export_mitsuba(&description, &path).unwrap();
    assert_same(&read(&path), &description);
}

#[test]
fn paths_come_back() {
    let mut description = builtin("cornell").unwrap();
    for path in [
        PathDescription::default(),
        PathDescription { max_depth: 9, rr_depth: 2, hide_emitters: true },
        PathDescription { max_depth: 1, ..PathDescription::default() },
    ] {
        description.integrator.path = Some(path);
        let file = folder("paths").join("out.xml");
        export_mitsuba(&description, &file).unwrap();
        assert_eq!(read(&file).integrator, description.integrator);
    }
}

/// The axes are made unit vectors again on reading, so they may differ by a rounding.
#[track_caller]
fn assert_same_camera(a: &CameraDescription, b: &CameraDescription) {
    for (a, b) in [(a.view.right, b.view.right), (a.view.up, b.view.up), (a.view.forward, b.view.forward)] {
        assert!((a - b).abs().max_element() <= f32::EPSILON, "{a} {b}");
    }
    assert_eq!(CameraDescription { view: b.view, ..*a }, *b);
    assert_eq!(a.view.origin, b.view.origin);
}

/// A sun is written as parallel light: Mitsuba has none of some width outside of its own sky.
#[track_caller]
fn assert_same_light(again: &AnyLight<'_>, light: &AnyLight<'_>) {
    match (again, light) {
        (AnyLight::Directional(again), AnyLight::DistantDisk(sun)) => {
            assert!((again.direction() + sun.axis()).length() < 1e-6);
            assert_eq!(again.irradiance(), sun.irradiance());
        }
        _ => assert_eq!(again, light),
    }
}

#[test]
fn every_built_in_scene_comes_back() {
    for name in BUILTIN.map(|b| b.name) {
        let description = builtin(name).unwrap();
        let path = folder(name).join("out.xml");
        export_mitsuba(&description, &path).unwrap();
        let again = read(&path);
        assert_same_camera(&again.camera, &description.camera);
        assert_eq!(
            (again.width, again.height, again.filter),
            (description.width, description.height, description.filter)
        );
        assert_eq!(again.lights.len(), description.lights.len(), "{name}");
        for (again, light) in again.lights.iter().zip(&description.lights) {
            assert_same_light(again, light);
        }
        assert_eq!(again.objects.len(), description.objects.len());
        for (a, b) in again.objects.iter().zip(&description.objects) {
            assert_eq!(
                again.materials[a.material].bsdf, description.materials[b.material].bsdf,
                "{name}: {}",
                b.name
            );
            assert_eq!(a.emission, b.emission, "{name}: {}", b.name);
            assert!(a.geometry == b.geometry, "{name}: {}", b.name);
        }
    }
}

#[test]
fn nothing_is_written_but_the_scene_and_its_meshes() {
    let description = everything("files");
    let folder = folder("files-out");
    export_mitsuba(&description, &folder.join("out.xml")).unwrap();
    // Over an earlier one too.
    export_mitsuba(&description, &folder.join("out.xml")).unwrap();
    let mut names: Vec<String> =
        fs::read_dir(&folder).unwrap().map(|f| f.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["out-______box.ply", "out-box.ply", "out.xml"]);
}

#[test]
fn equal_names_become_different_ids_and_files() {
    let mut description = everything("names");
    let object = description.objects.iter().find(|o| o.name == "box").cloned().unwrap();
    description.objects = vec![object.clone(), Object { name: "Box".into(), ..object.clone() }, object];
    let folder = folder("names-out");
    export_mitsuba(&description, &folder.join("out.xml")).unwrap();
    let again = read(&folder.join("out.xml"));
    let names: Vec<&str> = again.objects.iter().map(|o| o.name.as_str()).collect();
    assert_eq!(names, ["box", "Box-2", "box-3"]);
    assert_eq!(again.objects[2].geometry, description.objects[2].geometry);
}

#[test]
fn triangles_are_written_as_meshes() {
    let mut description = everything("triangle");
    let triangle = Triangle::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap();
    description.objects[0].geometry = Geometry::Shape(AnyShape::Triangle(triangle));
    let path = folder("triangle-out").join("out.xml");
    export_mitsuba(&description, &path).unwrap();
    let expected =
        Mesh { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]], ..Mesh::default() };
    assert_eq!(read(&path).objects[0].geometry, Geometry::Mesh(expected));
}

#[test]
fn a_camera_without_clipping_is_written_with_wide_clipping() {
    let mut description = everything("clip");
    (description.camera.near, description.camera.far) = (0.0, f32::INFINITY);
    let path = folder("clip-out").join("out.xml");
    export_mitsuba(&description, &path).unwrap();
    let camera = read(&path).camera;
    assert_eq!((camera.near, camera.far), (1e-6, 1e30));
}

#[test]
fn the_pixel_as_filter_is_written_in_mitsubas_words() {
    let mut description = everything("filter");
    let path = folder("filter-out").join("out.xml");
    for (filter, text) in [
        (Filter::PIXEL, "<rfilter type=\"box\"/>"),
        (Filter::Box { radius: 1.5 }, "<float name=\"radius\" value=\"1.5\"/>"),
        (Filter::Gaussian { stddev: 0.7 }, "<float name=\"stddev\" value=\"0.7\"/>"),
    ] {
        description.filter = filter;
        export_mitsuba(&description, &path).unwrap();
        assert!(fs::read_to_string(&path).unwrap().contains(text));
        assert_eq!(read(&path).filter, filter);
    }
}

#[test]
fn what_cannot_be_written_is_refused() {
    let mut description = everything("refused");
    let missing = folder("refused-out").join("none/out.xml");
    assert!(matches!(export_mitsuba(&description, &missing), Err(ExportError::Unwritable { .. })));
    assert!(matches!(export_mitsuba(&description, Path::new("/")), Err(ExportError::Path { .. })));
    description.objects[0].material = 99;
    let path = folder("refused-out").join("out.xml");
    assert!(matches!(export_mitsuba(&description, &path), Err(ExportError::Material { object: 0 })));
    assert!(!path.exists(), "a scene is written whole or not at all");
}
