//! glTF from end to end.

use crate::support::Folder;

/// A triangle that emits, before a camera, as a GLB file.
fn lamp() -> Vec<u8> {
    let mut json =
        br#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0},{"camera":0,"translation":[0.3,0.3,2]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
        "materials":[{"emissiveFactor":[1,0.5,0.25],"normalTexture":{"index":0}}],
        "cameras":[{"type":"perspective","perspective":{"yfov":0.6,"znear":0.1,"aspectRatio":1}}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36}]}"#
            .to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let corners = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0].map(f32::to_le_bytes);
    let word = |n: usize| (n as u32).to_le_bytes();
    let head = [&b"glTF"[..], &word(2), &word(28 + json.len() + 36)].concat();
    [head, word(json.len()).into(), b"JSON".into(), json, word(36).into(), b"BIN\0".into(), corners.concat()]
        .concat()
}

#[test]
fn a_glb_is_inspected_rendered_and_exported() {
    let folder = Folder::new();
    std::fs::write(folder.path("lamp.glb"), lamp()).unwrap();
    let run = folder.run("inspect lamp.glb");
    assert_eq!(run.code, Some(0), "{run:?}");
    assert!(run.stdout.contains("1 metallic-roughness") && run.stdout.contains("576×576"), "{run:?}");
    assert!(run.stderr.contains("lamp.glb: materials[0]: its normal map is left out"), "{run:?}");
    folder.good("render lamp.glb -o lamp.exr --quiet --width 16 --height 16 --spp 4");
    let picture = image::open(folder.path("lamp.exr")).unwrap().to_rgb32f();
    assert_eq!(picture.get_pixel(8, 8).0, [1.0, 0.5, 0.25]);
    folder.good("export lamp.glb -o lamp.xml");
    folder.good("render lamp.xml -o again.exr --quiet --width 16 --height 16 --spp 4");
    let again = image::open(folder.path("again.exr")).unwrap().to_rgb32f();
    assert_eq!(again.get_pixel(8, 8).0, [1.0, 0.5, 0.25]);
}

#[test]
fn a_broken_glb_is_code_2_and_says_where() {
    let folder = Folder::new();
    std::fs::write(folder.path("half.glb"), &lamp()[..200]).unwrap();
    let run = folder.run("render half.glb -o out.png");
    assert_eq!(run.code, Some(2), "{run:?}");
    assert!(run.stderr.contains("half.glb: the GLB container: it promises"), "{run:?}");
}
