//! Textures: where they are looked up, what is read, what is refused. The numbers are those of
//! Mitsuba 3.9.1.

use crate::{folder, load_body, message, scene};
use halflight::Rgb;
use halflight::bsdf::{AnyBsdf, Bsdf, TwoSided};
use halflight::build::{Description, Image, SceneBuffers, TexelBuffer};
use halflight::geom::Ray;
use halflight::glam::{Vec2, Vec3};
use halflight::light::{AnyLight, Emitter, PaintedLight};
use halflight::load::{LoadOptions, Loaded, load, write_exr};
use halflight::material::Material;
use std::fs::{self, File};

const CHECKERS: &str = "<bsdf type=\"diffuse\"><texture type=\"checkerboard\" name=\"reflectance\"/></bsdf>";

/// Texture coordinates of what a ray meets.
fn uv_in(description: &Description, origin: [f32; 3], direction: [f32; 3]) -> Vec2 {
    let buffers = SceneBuffers::new(description).unwrap();
    let bound = buffers.bind();
    let ray = Ray::new(origin.into(), Vec3::from(direction).normalize());
    let hit = bound.scene().closest_hit(&ray, f32::INFINITY).expect("the ray meets the shape");
    bound.scene().uv(&hit)
}

#[track_caller]
fn check(shape: &str, inside: &str, origin: [f32; 3], direction: [f32; 3], expected: [f32; 2]) {
    let body = format!("<shape type=\"{shape}\">{inside}{CHECKERS}</shape>");
    let found = uv_in(&scene("uv", &body), origin, direction);
    assert!(
        (found - Vec2::from(expected)).abs().max_element() < 2e-5,
        "{shape} {inside}: {found} {expected:?}"
    );
}

fn placed(steps: &str) -> String {
    format!("<transform name=\"to_world\">{steps}</transform>")
}

const FLIP: &str = "<boolean name=\"flip_normals\" value=\"true\"/>";
const DOWN: [f32; 3] = [0.0, 0.0, -1.0];

#[test]
fn flat_shapes_have_mitsubas_coordinates_also_flipped_and_mirrored() {
    let (above, mirror) = ([0.5, -0.2, 5.0], placed("<scale x=\"-1\"/>"));
    check("rectangle", "", above, DOWN, [0.75, 0.4]);
    check("rectangle", FLIP, above, DOWN, [0.75, 0.4]);
    check("rectangle", &mirror, above, DOWN, [0.25, 0.4]);
    check("disk", "", above, DOWN, [0.53852, 0.93944]);
    check("disk", FLIP, above, DOWN, [0.53852, 0.93944]);
    check("disk", &mirror, above, DOWN, [0.53852, 0.56056]);
    check("disk", &placed("<scale x=\"2\"/>"), above, DOWN, [0.32016, 0.89261]);
}

#[test]
fn round_shapes_have_mitsubas_coordinates_also_turned() {
    let (aside, inward) = ([3.0, 0.3, 0.2], [-3.0, -0.3, -0.2]);
    check("sphere", "", aside, inward, [0.01586, 0.47892]);
    check("sphere", FLIP, aside, inward, [0.01586, 0.47892]);
    check("sphere", &placed("<rotate x=\"1\" angle=\"90\"/>"), aside, inward, [0.01059, 0.53166]);
    check("sphere", &placed("<scale x=\"-1\"/>"), aside, inward, [0.48414, 0.47892]);
    let left = [-1.0, 0.0, 0.0];
    check("cylinder", "", aside, left, [0.04849, 0.2]);
    check("cylinder", FLIP, aside, left, [0.04849, 0.2]);
    check("cylinder", &placed("<scale x=\"-1\"/>"), aside, left, [0.45151, 0.2]);
    let ends = |a: &str, b: &str| {
        format!(
            "<point name=\"p0\" value=\"{a}\"/><point name=\"p1\" value=\"{b}\"/><float name=\"radius\" value=\".8\"/>"
        )
    };
    check("cylinder", &ends("0 -1 0", "0 1 0"), aside, left, [0.95978, 0.65]);
    check("cylinder", &ends("0 0 1", "0 0 -1"), aside, left, [0.93882, 0.4]);
    check("cylinder", &ends("-1 0 .2", "1 .1 0"), [0.1, 3.0, 0.2], [0.0, -1.0, 0.0], [0.76468, 0.56415]);
}

#[test]
fn the_sides_of_a_cube_have_mitsubas_coordinates() {
    for (origin, direction, uv) in [
        ([0.5, -0.2, 5.0], [0.0, 0.0, -1.0], [0.4, 0.75]),
        ([0.5, -0.2, -5.0], [0.0, 0.0, 1.0], [0.6, 0.75]),
        ([5.0, -0.2, 0.5], [-1.0, 0.0, 0.0], [0.4, 0.25]),
        ([-5.0, -0.2, 0.5], [1.0, 0.0, 0.0], [0.4, 0.75]),
        ([0.5, 5.0, -0.2], [0.0, -1.0, 0.0], [0.25, 0.6]),
        ([0.5, -5.0, -0.2], [0.0, 1.0, 0.0], [0.4, 0.75]),
    ] {
        check("cube", "", origin, direction, uv);
    }
}

const SQUARE_OBJ: &str =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
const SQUARE_PLY: &str = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
    property float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n\
    0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n3 0 1 2\n3 0 2 3\n";

#[test]
fn meshes_have_the_coordinates_of_their_corners_and_obj_counts_from_the_bottom() {
    for (kind, text) in [("obj", SQUARE_OBJ), ("ply", SQUARE_PLY)] {
        for (flip, up) in [("", kind == "obj"), ("true", true), ("false", false)] {
            let flag = if flip.is_empty() {
                String::new()
            } else {
                format!("<boolean name=\"flip_tex_coords\" value=\"{flip}\"/>")
            };
            let folder = folder("meshes");
            fs::write(folder.join("m"), text).unwrap();
            let body = format!(
                "<scene version=\"3.0.0\"><shape type=\"{kind}\"><string name=\"filename\" value=\"m\"/>{flag}{CHECKERS}</shape></scene>"
            );
            fs::write(folder.join("scene.xml"), body).unwrap();
            let loaded = load(&folder.join("scene.xml"), &LoadOptions::default()).unwrap();
            let found = uv_in(&loaded.description, [0.7, 0.2, 3.0], DOWN);
            let expected = Vec2::new(0.7, if up { 0.8 } else { 0.2 });
            assert!((found - expected).length() < 1e-5, "{kind} {flip}: {found}");
        }
    }
}

/// Loads elements beside a picture of 2 × 2 texels, `t.exr`.
fn with_picture(name: &str, texels: [Rgb; 4], body: &str) -> Result<Loaded, String> {
    let folder = folder(name);
    let image = Image { width: 2, height: 2, texels: texels.to_vec() };
    write_exr(&image, File::create(folder.join("t.exr")).unwrap()).unwrap();
    let text = format!("<scene version=\"3.0.0\">\n{body}\n</scene>\n");
    fs::write(folder.join("scene.xml"), text).unwrap();
    load(&folder.join("scene.xml"), &LoadOptions::default()).map_err(|e| message(name, &e))
}

const BITMAP: &str = "<string name=\"filename\" value=\"t.exr\"/><boolean name=\"raw\" value=\"true\"/>";

fn texels() -> [Rgb; 4] {
    [Rgb::new(0.1, 0.2, 0.3), Rgb::splat(0.5), Rgb::splat(0.7), Rgb::new(0.9, 0.8, 0.6)]
}

/// The BSDF of the first material at a place.
fn bsdf_at(loaded: &Loaded, uv: [f32; 2]) -> TwoSided<AnyBsdf> {
    let buffers = SceneBuffers::new(&loaded.description).unwrap();
    let bound = buffers.bind();
    bound.scene().materials()[0].at(|| uv.into())
}

#[test]
fn every_parameter_can_come_from_a_picture_on_either_side() {
    let texture = |name: &str| format!("<texture type=\"bitmap\" name=\"{name}\">{BITMAP}</texture>");
    let shape = |bsdf: &str| format!("<shape type=\"sphere\">{bsdf}</shape>");
    let near = |a: Rgb, b: Rgb| (a - b).to_array().iter().all(|c| c.abs() < 1e-6);
    let body = shape(&format!("<bsdf type=\"diffuse\">{}</bsdf>", texture("reflectance")));
    let loaded = with_picture("diffuse", texels(), &body).unwrap();
    let found = bsdf_at(&loaded, [0.25, 0.25]);
    assert!(near(found.albedo(), texels()[0]) && found.back.is_none() && found.is_diffuse());
    assert!(near(bsdf_at(&loaded, [0.75, 0.75]).albedo(), texels()[3]));
    let body = shape(&format!(
        "<bsdf type=\"twosided\"><bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"ggx\"/>\
         <string name=\"material\" value=\"none\"/>{}{}</bsdf></bsdf>",
        texture("alpha"),
        texture("specular_reflectance")
    ));
    let loaded = with_picture("metal", texels(), &body).unwrap();
    let found = bsdf_at(&loaded, [0.75, 0.25]);
    assert!(near(found.albedo(), Rgb::splat(0.5)) && found.back == Some(found.front));
    let AnyBsdf::GgxConductor(metal) = found.front else { panic!("{found:?}") };
    assert!(metal.alpha().iter().all(|a| (a - 0.5).abs() < 1e-6));
    // Both reflectances exceed 1 together, and are scaled down to 0.99.
    let body = shape(&format!("<bsdf type=\"phong\">{}</bsdf>", texture("diffuse_reflectance")));
    let loaded = with_picture("phong", texels(), &body).unwrap();
    assert!(loaded.warnings.iter().any(|w| w.text.contains("scaled down")));
    let AnyBsdf::Phong(phong) = bsdf_at(&loaded, [0.75, 0.75]).front else { panic!("no phong") };
    assert!(near(phong.diffuse(), texels()[3] * (0.9 / 1.0)), "{phong:?}");
    assert!(near(phong.diffuse() + phong.specular(), Rgb::new(0.99, 0.9, 0.72)), "{phong:?}");
}

#[test]
fn a_picture_is_read_once_and_values_above_one_are_clamped_with_a_warning() {
    let texture = format!("<texture type=\"bitmap\" id=\"t\">{BITMAP}</texture>");
    let matte = "<bsdf type=\"diffuse\"><ref id=\"t\" name=\"reflectance\"/></bsdf>";
    let body = format!("{texture}<shape type=\"sphere\">{matte}</shape><shape type=\"disk\">{matte}</shape>");
    let loaded = with_picture("once", texels(), &body).unwrap();
    assert_eq!(loaded.description.materials.len(), 1, "equal materials are one");
    let bright = [Rgb::splat(2.0), Rgb::BLACK, Rgb::WHITE, Rgb::new(0.5, 1.5, 0.1)];
    let loaded = with_picture("clamped", bright, &body).unwrap();
    assert!(loaded.warnings.iter().any(|w| w.to_string().contains("values above 1 are taken for 1")));
    let texture = loaded.description.materials[0].textures[0].diffuse.clone().unwrap();
    let Some(TexelBuffer::Float(values)) = texture.texels.as_deref() else { panic!("no numbers") };
    assert_eq!(values[3], Rgb::new(0.5, 1.0, 0.1));
}

/// A matte sphere with something in its reflectance, on line 3.
fn matte(texture: &str) -> String {
    format!("<shape type=\"sphere\"><bsdf type=\"diffuse\">\n{texture}</bsdf></shape>")
}

/// The same with a bitmap.
fn bitmap(inside: &str) -> String {
    matte(&format!("<texture type=\"bitmap\" name=\"reflectance\">{inside}</texture>"))
}

/// Textures that are wrong, and a part of what is said of each.
fn bad_textures() -> [(String, &'static str); 12] {
    [
        (bitmap(""), "the property \"filename\" is missing"),
        (bitmap("<string name=\"filename\" value=\"none.png\"/>"), "none.png: "),
        (bitmap("<string name=\"filename\" value=\"scene.xml\"/>"), "scene.xml: "),
        (
            bitmap(&format!("{BITMAP}<string name=\"filter_type\" value=\"cubic\"/>")),
            "unknown filter_type \"cubic\"",
        ),
        (
            bitmap(&format!("{BITMAP}<string name=\"wrap_mode\" value=\"miror\"/>")),
            "did you mean \"mirror\"?",
        ),
        (bitmap(&format!("{BITMAP}<float name=\"gama\" value=\"1\"/>")), "unknown property \"gama\""),
        (bitmap(&format!("{BITMAP}<transform name=\"to_uv\"><rotate angle=\"5\"/></transform>")), "the axis"),
        (matte("<texture type=\"volume\" name=\"reflectance\"/>"), "supported: bitmap, checkerboard"),
        (matte("<ref id=\"nothing\" name=\"reflectance\"/>"), "unknown id \"nothing\""),
        (
            matte(
                "<rgb name=\"reflectance\" value=\"1\"/><texture type=\"checkerboard\" name=\"reflectance\"/>",
            ),
            "property \"reflectance\" is given twice",
        ),
        (
            matte(
                "<texture type=\"checkerboard\" name=\"reflectance\"><rgb name=\"color0\" value=\"1.5\"/></texture>",
            ),
            "a reflectance goes up to (1.5, 1.5, 1.5); it must not exceed 1",
        ),
        (
            matte(
                "<texture type=\"checkerboard\" name=\"reflectance\"><rgb name=\"color1\" value=\"-1\"/></texture>",
            ),
            "a colour of the texture is (-1, -1, -1)",
        ),
    ]
}

#[test]
fn bad_textures_are_refused_with_their_line_and_what_would_do() {
    for (body, part) in bad_textures() {
        let message = with_picture("bad", texels(), &body).unwrap_err();
        assert!(message.starts_with("scene.xml:3: <") && message.contains(part), "{body}\n{message}");
    }
    for bad in [f32::NAN, f32::INFINITY, -0.5] {
        let texels = [Rgb::WHITE, Rgb::WHITE, Rgb::WHITE, Rgb::new(0.0, bad, 0.0)];
        let message = with_picture("texel", texels, &bitmap(BITMAP)).unwrap_err();
        assert!(message.contains("the texel in column 1, row 1 is (0, "), "{message}");
    }
}

#[test]
fn lights_take_pictures_and_rectangles_are_sampled_by_them() {
    let emitter = |to_uv: &str| {
        format!(
            "<emitter type=\"area\"><texture type=\"bitmap\" name=\"radiance\">{BITMAP}{to_uv}</texture></emitter>"
        )
    };
    let light = |body: &str| -> Loaded { with_picture("light", texels(), body).unwrap() };
    let examine = |loaded: &Loaded, see: &dyn Fn(&AnyLight<'_>)| {
        let buffers = SceneBuffers::new(&loaded.description).unwrap();
        let bound = buffers.bind();
        bound.scene().lights().iter().for_each(see);
        assert!(!bound.scene().lights().is_empty());
    };
    let mean = texels().iter().map(|t| t.average()).sum::<f32>() / 4.0;
    let along = [
        "",
        "<transform name=\"to_uv\"><scale y=\"-1\"/></transform>",
        "<transform name=\"to_uv\"><scale x=\"3\"/><translate y=\"2\"/></transform>",
    ];
    for to_uv in along {
        examine(&light(&format!("<shape type=\"rectangle\">{}</shape>", emitter(to_uv))), &|l| {
            assert!(matches!(l, AnyLight::Painted(PaintedLight::Bright(_))), "{to_uv}: {l:?}");
            assert!((l.power(1.0) / (4.0 * std::f32::consts::PI * mean) - 1.0).abs() < 1e-5);
        });
    }
    let aslant = emitter("<transform name=\"to_uv\"><rotate z=\"1\" angle=\"30\"/></transform>");
    examine(&light(&format!("<shape type=\"rectangle\">{aslant}</shape>")), &|l| {
        assert!(matches!(l, AnyLight::Painted(PaintedLight::Rectangle(_))), "{l:?}");
    });
    examine(&light(&format!("<shape type=\"cube\">{}</shape>", emitter(""))), &|l| {
        assert!(matches!(l, AnyLight::Painted(PaintedLight::Triangle(_))) && l.power(1.0) > 0.0, "{l:?}");
    });
}

#[test]
fn a_black_picture_is_no_light() {
    let body = format!(
        "<shape type=\"rectangle\"><emitter type=\"area\"><texture type=\"bitmap\" name=\"radiance\">{BITMAP}</texture></emitter></shape>"
    );
    let loaded = with_picture("black", [Rgb::BLACK; 4], &body).unwrap();
    assert!(SceneBuffers::new(&loaded.description).unwrap().bind().scene().lights().is_empty());
}

#[test]
fn serialized_meshes_are_asked_for_by_index() {
    let body = "<shape type=\"serialized\"><string name=\"filename\" value=\"m.serialized\"/>\
        <integer name=\"shape_index\" value=\"2\"/></shape>";
    let message = message("serialized", &load_body("serialized", body).unwrap_err());
    assert!(message.starts_with("scene.xml:2: <shape type=\"serialized\">: m.serialized: "), "{message}");
}

#[test]
fn textured_scenes_come_back_as_they_were_written() {
    let texture = |name: &str, extra: &str| {
        format!("<texture type=\"bitmap\" name=\"{name}\">{BITMAP}{extra}</texture>")
    };
    let to_uv = "<string name=\"wrap_mode\" value=\"mirror\"/><transform name=\"to_uv\"><scale x=\"2\" y=\"-3\"/><translate x=\".25\"/></transform>";
    let matte = format!("<bsdf type=\"diffuse\">{}</bsdf>", texture("reflectance", to_uv));
    let metal = format!(
        "<bsdf type=\"roughconductor\"><string name=\"distribution\" value=\"ggx\"/><string name=\"material\" value=\"none\"/>\
         <texture type=\"checkerboard\" name=\"alpha\"/>{}</bsdf>",
        texture("specular_reflectance", "")
    );
    let turn = placed("<rotate y=\"1\" angle=\"90\"/><translate x=\"2\"/>");
    let body = format!(
        "<shape type=\"sphere\">{turn}{matte}</shape><shape type=\"cylinder\">{FLIP}{metal}</shape>\
         <shape type=\"cube\">{CHECKERS}</shape><shape type=\"disk\">{FLIP}{turn}{matte}</shape>\
         <shape type=\"rectangle\"><emitter type=\"area\">{}</emitter></shape>",
        texture("radiance", "")
    );
    let first = with_picture("written", texels(), &body).unwrap().description;
    let path = folder("again").join("again.xml");
    halflight::load::export_mitsuba(&first, &path).unwrap();
    let second = load(&path, &LoadOptions::default()).unwrap().description;
    assert_eq!(first.materials, second.materials);
    for (a, b) in first.objects.iter().zip(&second.objects) {
        assert_eq!((&a.emission, a.material), (&b.emission, b.material));
        let close = |a: Vec3, b: Vec3| (a - b).length() < 1e-5;
        match (a.object_space, b.object_space) {
            (Some(a), Some(b)) => {
                let columns = [(a.origin, b.origin), (a.to_object.x_axis, b.to_object.x_axis)];
                assert!(columns.iter().all(|(a, b)| close(*a, *b)), "{a:?} {b:?}");
            }
            (a, b) => assert!(a.is_none() && b.is_none()),
        }
    }
    let uv = |d: &Description| uv_in(d, [2.1, 0.2, 5.0], DOWN);
    assert!((uv(&first) - uv(&second)).length() < 1e-5);
}
