//! glTF: what is read, and what of it becomes.

use halflight::Rgb;
use halflight::bsdf::{AnyBsdf, MetallicRoughness, TwoSided};
use halflight::build::{Description, Geometry, Mesh, ProjectionDescription, SceneBuffers};
use halflight::geom::Ray;
use halflight::glam::Vec3;
use halflight::light::AnyLight;
use halflight::load::{Files, LoadError, LoadOptions, Loaded, export_mitsuba, load, load_from};
use halflight::material::Material;
use std::path::{Path, PathBuf};

/// A GLB file.
pub(crate) fn glb(json: &str, binary: &[u8]) -> Vec<u8> {
    let padded = |bytes: &[u8], with: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), with);
        bytes
    };
    let (json, binary) = (padded(json.as_bytes(), b' '), padded(binary, 0));
    let word = |n: usize| (n as u32).to_le_bytes();
    let mut file = [&b"glTF"[..], &word(2), &word(28 + json.len() + binary.len())].concat();
    for (kind, bytes) in [(b"JSON", json), (b"BIN\0", binary)] {
        file.extend([&word(bytes.len())[..], kind, &bytes].concat());
    }
    file
}

pub(crate) fn read_with(
    name: &str,
    files: &[(&str, &[u8])],
    options: &LoadOptions,
) -> Result<Loaded, LoadError> {
    let files = files.iter().map(|(name, bytes)| (PathBuf::from(name), bytes.to_vec()));
    load_from(&Files::in_memory(files), Path::new(name), options)
}

fn read(json: &str, binary: &[u8]) -> Result<Loaded, LoadError> {
    read_with("scene.glb", &[("scene.glb", &glb(json, binary))], &LoadOptions::default())
}

/// The scene of a GLB that is well.
#[track_caller]
fn scene(json: &str, binary: &[u8]) -> Description {
    match read(json, binary) {
        Ok(loaded) => loaded.description,
        Err(error) => panic!("{error}"),
    }
}

/// What a GLB is refused for.
#[track_caller]
fn refusal(json: &str, binary: &[u8]) -> String {
    match read(json, binary) {
        Ok(_) => panic!("it was read"),
        Err(error) => error.to_string(),
    }
}

pub(crate) fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|n| n.to_le_bytes()).collect()
}

/// A triangle in the plane z = 0, as positions.
pub(crate) const CORNERS: [f32; 9] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];

/// A file with one triangle, at one node, and whatever else.
pub(crate) fn triangle(node: &str, primitive: &str, more: &str) -> String {
    format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0{node}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}{primitive}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],"buffers":[{{"byteLength":36}}]{more}}}"#
    )
}

fn mesh(description: &Description, object: usize) -> &Mesh {
    match &description.objects[object].geometry {
        Geometry::Mesh(mesh) => mesh,
        Geometry::Shape(_) => panic!("not a mesh"),
    }
}

fn normal(mesh: &Mesh) -> Vec3 {
    let [a, b, c] = mesh.triangles[0].map(|i| mesh.positions[i as usize]);
    (b - a).cross(c - a).normalize()
}

#[test]
fn a_scene_without_light_and_camera_gets_both_and_says_so() {
    let loaded = read(&triangle("", "", ""), &floats(&CORNERS)).unwrap();
    let texts: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(texts.len(), 2, "{texts:?}");
    assert!(texts[0].starts_with("scene.glb: nothing emits: "), "{texts:?}");
    assert!(texts[1].starts_with("scene.glb: there is no camera: "), "{texts:?}");
    let scene = loaded.description;
    assert!(matches!(scene.lights[..], [AnyLight::Constant(_)]));
    let default = MetallicRoughness::new(Rgb::WHITE, 1.0, 1.0).unwrap();
    assert_eq!(scene.materials[0].bsdf, TwoSided::both(AnyBsdf::MetallicRoughness(default)));
    assert_eq!((normal(mesh(&scene, 0)), scene.triangle_count()), (Vec3::Z, 1));
    assert_eq!((scene.width, scene.height, scene.name.as_str()), (768, 576, "scene"));
}

#[test]
fn buffers_are_in_files_and_in_uris_too() {
    let text = |uri: &str| {
        triangle("", "", "")
            .replace("\"byteLength\":36}]}", &format!("\"byteLength\":36,\"uri\":\"{uri}\"}}]}}"))
    };
    let inside =
        text("data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA");
    let beside = text("my%20mesh.bin");
    let binary = floats(&CORNERS);
    for json in [inside, beside] {
        let files = [("scene.gltf", json.as_bytes()), ("my mesh.bin", &binary[..])];
        let loaded = read_with("scene.gltf", &files, &LoadOptions::default()).unwrap();
        assert_eq!(mesh(&loaded.description, 0).positions[1], Vec3::X);
    }
    let missing = text("gone.bin");
    let error = read_with("scene.gltf", &[("scene.gltf", missing.as_bytes())], &LoadOptions::default());
    let error = error.unwrap_err().to_string();
    assert!(error.starts_with("scene.gltf: buffers[0]: gone.bin: "), "{error}");
    let far = text("https://example.org/a.bin");
    let error = read_with("scene.gltf", &[("scene.gltf", far.as_bytes())], &LoadOptions::default());
    assert!(error.unwrap_err().to_string().contains("put the file beside the scene"));
}

#[test]
fn nodes_place_what_is_below_them_and_a_mirror_keeps_the_front() {
    let json = r#"{"asset":{"version":"2.0"},"scene":1,"scenes":[{"nodes":[1]},{"nodes":[2]}],
        "nodes":[{"mesh":0,"scale":[-2,1,1],"name":"leaf"},{"mesh":0},
            {"children":[3],"translation":[10,0,0]},
            {"children":[0],"rotation":[0,0,0.70710678,0.70710678]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]}"#;
    let scene = scene(json, &floats(&CORNERS));
    assert_eq!((scene.objects.len(), scene.objects[0].name.as_str()), (1, "leaf"));
    let mesh = mesh(&scene, 0);
    // X is mirrored, stretched, turned to −y and moved.
    let expected = [Vec3::new(10.0, 0.0, 0.0), Vec3::new(10.0, -2.0, 0.0), Vec3::new(9.0, 0.0, 0.0)];
    for (seen, expected) in mesh.positions.iter().zip(expected) {
        assert!((*seen - expected).length() < 1e-6, "{seen}");
    }
    assert_eq!(normal(mesh), Vec3::Z);
}

#[test]
fn strips_and_fans_turn_the_same_way_and_points_are_left_out() {
    let square = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0];
    let json = |mode: u32, order: &str| {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"mode":{mode}}},
                {{"attributes":{{"POSITION":0}},"mode":0}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"}},
                {{"bufferView":1,"componentType":5121,"count":4,"type":"SCALAR"}}],
            "bufferViews":[{{"buffer":0,"byteLength":48}},{{"buffer":0,"byteOffset":{order},"byteLength":4}}],
            "buffers":[{{"byteLength":56}}]}}"#
        )
    };
    let binary = [floats(&square), vec![0, 1, 2, 3, 0, 1, 3, 2]].concat();
    for (mode, offset) in [(5, "48"), (6, "52")] {
        let loaded = read(&json(mode, offset), &binary).unwrap();
        let warned =
            loaded.warnings.iter().any(|w| w.to_string().contains("primitives[1]: points and lines"));
        assert!(warned, "{:?}", loaded.warnings);
        let mesh = mesh(&loaded.description, 0);
        assert_eq!(mesh.triangles.len(), 2);
        let area: f32 = mesh
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
                0.5 * (b - a).cross(c - a).z
            })
            .sum();
        assert!((area - 1.0).abs() < 1e-6, "mode {mode}: both triangles face +z: {area}");
    }
}

#[test]
fn sparse_interleaved_and_quantised_numbers_are_what_they_mean() {
    // Signed 16-bit shares, 8 bytes apart, behind a gap; the third position is replaced.
    let json = r#"{"asset":{"version":"2.0"},"extensionsUsed":["KHR_mesh_quantization"],
        "extensionsRequired":["KHR_mesh_quantization"],"nodes":[{"mesh":0}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1}}]}],
        "accessors":[{"bufferView":0,"byteOffset":2,"componentType":5122,"normalized":true,"count":3,"type":"VEC3",
            "sparse":{"count":1,"indices":{"bufferView":1,"componentType":5121},
                "values":{"bufferView":1,"byteOffset":2}}},
            {"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":3,
                "indices":{"bufferView":2,"componentType":5123},"values":{"bufferView":2,"byteOffset":8}}}],
        "bufferViews":[{"buffer":0,"byteLength":26,"byteStride":8},{"buffer":0,"byteOffset":28,"byteLength":8},
            {"buffer":0,"byteOffset":36,"byteLength":44}],"buffers":[{"byteLength":80}]}"#;
    let shorts = |numbers: &[i16]| numbers.iter().flat_map(|n| n.to_le_bytes()).collect::<Vec<u8>>();
    let positions = shorts(&[7, 0, 0, 0, 7, 32767, 0, 0, 7, 9, 9, 9, 7, 7]);
    let instead = [vec![2, 0], shorts(&[0, -32768, 0])].concat();
    let normals = [shorts(&[0, 1, 2, 0]), floats(&[0.0, 0.0, -1.0, 0.0, 0.6, -0.8, 0.0, 0.0, -1.0])].concat();
    let scene = scene(json, &[positions, instead, normals].concat());
    let mesh = mesh(&scene, 0);
    assert_eq!(mesh.positions, [Vec3::ZERO, Vec3::X, Vec3::NEG_Y]);
    assert_eq!(mesh.normals[1], Vec3::new(0.0, 0.6, -0.8));
}

#[test]
fn lights_are_watts_where_the_file_has_candela_and_lux() {
    let lights = r#","extensions":{"KHR_lights_punctual":{"lights":[
        {"type":"point","intensity":683,"color":[1,0.5,0]},
        {"type":"directional","intensity":1366},
        {"type":"spot","intensity":68.3,"spot":{"innerConeAngle":0.2,"outerConeAngle":0.5}}]}},
        "extensionsUsed":["KHR_lights_punctual"]"#;
    let json = triangle("", "", lights).replace(
        r#"[{"mesh":0}]"#,
        r#"[{"mesh":0},{"translation":[1,2,3],"extensions":{"KHR_lights_punctual":{"light":0}}},
            {"rotation":[-0.70710678,0,0,0.70710678],"extensions":{"KHR_lights_punctual":{"light":1}}},
            {"extensions":{"KHR_lights_punctual":{"light":2}}}]"#,
    );
    let scene = scene(&json, &floats(&CORNERS));
    let [AnyLight::Point(point), AnyLight::Directional(sun), AnyLight::Spot(spot)] = scene.lights[..] else {
        panic!("{:?}", scene.lights)
    };
    assert_eq!((point.position(), point.intensity()), (Vec3::new(1.0, 2.0, 3.0), Rgb::new(1.0, 0.5, 0.0)));
    assert!((sun.direction() - Vec3::NEG_Y).length() < 1e-6 && sun.irradiance() == Rgb::splat(2.0));
    assert_eq!((spot.axis(), spot.angles()), (Vec3::NEG_Z, (0.2, 0.5)));
    assert!((spot.intensity().g - 0.1).abs() < 1e-7);
}

#[test]
fn cameras_look_along_negative_z() {
    let with = |camera: &str| {
        let node = r#","camera":0,"translation":[0,0,5],"scale":[3,3,3]"#;
        triangle(node, "", &format!(r#","cameras":[{camera}]"#))
    };
    let json = with(r#"{"perspective":{"aspectRatio":2,"yfov":1,"znear":0.1}}"#);
    let perspective = scene(&json, &floats(&CORNERS));
    let view = perspective.camera.view;
    assert_eq!(
        (view.origin, view.forward, view.right, view.up),
        (Vec3::Z * 5.0, Vec3::NEG_Z, Vec3::X, Vec3::Y)
    );
    assert_eq!((perspective.width, perspective.height), (1152, 576));
    let (_, half_height) = perspective.camera.camera(1152, 576).unwrap().half_extents();
    assert!((half_height - 0.5_f32.tan()).abs() < 1e-6);
    let json = with(r#"{"orthographic":{"xmag":3,"ymag":2,"znear":0,"zfar":9}}"#);
    let parallel = scene(&json, &floats(&CORNERS));
    assert_eq!(parallel.camera.projection, ProjectionDescription::Orthographic { half_width: 3.0 });
    assert_eq!((parallel.width, parallel.camera.far), (864, 9.0));
    let wrong = with(r#"{"perspective":{"yfov":-1,"znear":0.1}}"#);
    assert!(refusal(&wrong, &floats(&CORNERS)).contains("field of view"));
}

/// Two texels beside one another: (255, 128, 0) and (0, 51, 255).
const PNG: &str = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mP438DAYPwfAAnmArJqmPFrAAAAAElFTkSuQmCC";

/// A textured triangle whose corners are at the texel centres.
fn textured(material: &str) -> (String, Vec<u8>) {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{{"mesh":0}}],
        "extensionsUsed":["KHR_texture_transform","KHR_materials_emissive_strength"],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"material":0}}]}}],
        "materials":[{material}],"textures":[{{"source":0,"sampler":0}}],"images":[{{"uri":"{PNG}"}}],
        "samplers":[{{"magFilter":9728,"wrapS":33071,"wrapT":33071}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},
            {{"bufferView":0,"byteOffset":36,"componentType":5126,"count":3,"type":"VEC2"}}],
        "bufferViews":[{{"buffer":0,"byteLength":60}}],"buffers":[{{"byteLength":60}}]}}"#
    );
    (json, [floats(&CORNERS), floats(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0])].concat())
}

/// The surface where a ray from above meets it, and what it emits there.
fn looked_at(description: &Description, x: f32, y: f32) -> (MetallicRoughness, Rgb) {
    let buffers = SceneBuffers::new(description).unwrap();
    let (bound, ray) = (buffers.bind(), Ray::new(Vec3::new(x, y, 1.0), Vec3::NEG_Z));
    let scene = bound.scene();
    let hit = scene.closest_hit(&ray, 2.0).expect("the ray meets the triangle");
    let bsdf = scene.materials()[hit.material as usize].at(|| scene.uv(&hit));
    let AnyBsdf::MetallicRoughness(bsdf) = bsdf.front else { panic!("{bsdf:?}") };
    (bsdf, scene.emitted(&hit, Vec3::Z))
}

#[test]
fn textures_multiply_their_factors() {
    let (json, binary) = textured(
        r#"{"name":"tile","pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[0.5,1,1,1],
            "metallicRoughnessTexture":{"index":0},"metallicFactor":0.5,"roughnessFactor":0.8}}"#,
    );
    let scene = scene(&json, &binary);
    assert_eq!(scene.materials[0].name, "tile");
    let (left, _) = looked_at(&scene, 0.1, 0.1);
    let near = |a: f32, b: f32| assert!((a - b).abs() < 1e-5, "{a} instead of {b}");
    near(left.base_color().r, 0.5);
    near(left.base_color().g, 0.215_860_5);
    // Green is roughness, blue metalness, both without the curve of sRGB.
    near(left.roughness(), 0.8 * 128.0 / 255.0);
    near(left.metallic(), 0.0);
    let (right, _) = looked_at(&scene, 0.8, 0.1);
    near(right.roughness(), 0.8 * 0.2);
    near(right.metallic(), 0.5);
}

#[test]
fn what_is_written_for_mitsuba_comes_back() {
    let (json, binary) = textured(
        r#"{"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[0.5,1,1,1],
            "metallicRoughnessTexture":{"index":0},"metallicFactor":0.5,"roughnessFactor":0.8}}"#,
    );
    let written = scene(&json, &binary);
    let path = crate::folder("gltf-export").join("scene.xml");
    export_mitsuba(&written, &path).unwrap();
    let loaded = load(&path, &LoadOptions::default()).unwrap();
    assert!(loaded.warnings[0].to_string().contains("metallic-roughness"), "{:?}", loaded.warnings);
    for x in [0.1, 0.8] {
        let [a, b] = [&written, &loaded.description].map(|scene| looked_at(scene, x, 0.1).0);
        let numbers = |m: MetallicRoughness| (m.base_color().to_array(), [m.metallic(), m.roughness()]);
        let ((colour, shares), (colour_back, shares_back)) = (numbers(a), numbers(b));
        for (a, b) in colour.iter().chain(&shares).zip(colour_back.iter().chain(&shares_back)) {
            assert!((a - b).abs() < 1e-6, "{a} and {b}");
        }
    }
}

#[test]
fn emission_is_factor_strength_and_texture() {
    let (json, binary) = textured(
        r#"{"emissiveFactor":[1,1,0.5],"emissiveTexture":{"index":0},"doubleSided":true,
            "extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":4}}}"#,
    );
    let scene = scene(&json, &binary);
    let (_, left) = looked_at(&scene, 0.1, 0.1);
    let (_, right) = looked_at(&scene, 0.8, 0.1);
    assert!((left.r - 4.0).abs() < 1e-5 && left.b == 0.0, "{left:?}");
    assert!((right.b - 2.0).abs() < 1e-5 && right.r == 0.0, "{right:?}");
    assert!(scene.lights.is_empty() && scene.objects[0].emission.as_ref().unwrap().two_sided);
}

#[test]
fn texture_coordinates_are_scaled_turned_and_moved() {
    // A quarter turn counter-clockwise takes u = 1 to v = −1; then half a picture to the right.
    let (json, binary) = textured(
        r#"{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":
            {"offset":[0.25,1],"rotation":1.57079633,"scale":[1,0.5]}}}}}"#,
    );
    let scene = scene(&json, &binary);
    // u' = 0.25 + 0.5 v: beyond the middle of the picture where v is above one half.
    assert_eq!(looked_at(&scene, 0.3, 0.4).0.base_color().b, 0.0);
    assert_eq!(looked_at(&scene, 0.3, 0.6).0.base_color().b, 1.0);
}

#[test]
fn what_is_not_read_is_named() {
    let binary = floats(&CORNERS);
    for (name, tip) in [
        ("KHR_draco_mesh_compression", "export without compression"),
        ("EXT_meshopt_compression", "export without compression"),
        ("KHR_texture_basisu", "PNG or JPEG"),
        ("KHR_materials_transmission", "--lenient"),
    ] {
        let required = format!(r#","extensionsUsed":["{name}"],"extensionsRequired":["{name}"]"#);
        let error = refusal(&triangle("", "", &required), &binary);
        assert!(error.contains(name) && error.contains(tip), "{error}");
        let used = format!(r#","extensionsUsed":["{name}"]"#);
        let loaded = read(&triangle("", "", &used), &binary).unwrap();
        assert!(loaded.warnings[0].to_string().contains(name), "{:?}", loaded.warnings);
    }
    let older = triangle("", "", "").replace("2.0", "1.0");
    assert!(refusal(&older, &binary).contains("export as glTF 2.0"));
    let see_through = r#","materials":[{"alphaMode":"BLEND","normalTexture":{"index":9}}]"#;
    let loaded = read(&triangle("", r#","material":0"#, see_through), &binary).unwrap();
    let texts: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert!(
        texts[0].contains("materials[0]: may be transparent") && texts[1].contains("normal map"),
        "{texts:?}"
    );
}
