//! glTF files that nobody means well with: an error, and never a panic or a full memory.

use crate::gltf::{CORNERS, floats, glb, read_with, triangle};
use halflight::load::LoadOptions;

/// Tries a GLB; what it is refused for, or nothing.
fn attempt(bytes: &[u8]) -> Option<String> {
    let options = LoadOptions { lenient: true, ..LoadOptions::default() };
    let result = read_with("scene.glb", &[("scene.glb", bytes)], &options);
    if let Ok(loaded) = &result {
        let _ = halflight::build::SceneBuffers::new(&loaded.description);
    }
    result.err().map(|error| error.to_string())
}

#[track_caller]
fn refused(json: &str, why: &str) {
    let error = attempt(&glb(json, &floats(&CORNERS))).expect("it is refused");
    assert!(error.contains(why), "{error}\nshould contain: {why}");
}

#[test]
fn every_truncation_is_refused() {
    let whole = glb(&triangle("", "", ""), &floats(&CORNERS));
    assert_eq!(attempt(&whole), None);
    for length in 0..whole.len() {
        assert!(attempt(&whole[..length]).is_some(), "{length} of {} bytes", whole.len());
    }
}

#[test]
fn a_byte_that_is_wrong_does_no_harm() {
    let whole = glb(&triangle(r#","scale":[1,2,3]"#, r#","indices":0"#, ""), &floats(&CORNERS));
    for at in 0..whole.len() {
        for wrong in [0, b'0', b'9', b'-', b'"', 0x7f, 0xff] {
            let mut bytes = whole.clone();
            bytes[at] = wrong;
            attempt(&bytes);
        }
    }
}

#[test]
fn nodes_in_a_circle_or_with_two_parents_are_refused() {
    let nodes = |nodes: &str| triangle("", "", "").replace(r#"[{"mesh":0}]"#, nodes);
    let shown = triangle("", "", r#","scenes":[{"nodes":[0]}]"#);
    let circle = shown.replace(r#"[{"mesh":0}]"#, r#"[{"children":[1]},{"children":[0]}]"#);
    refused(&circle, "nodes[0]: it is reached twice");
    refused(&nodes(r#"[{"children":[1,1]},{"mesh":0}]"#), "nodes[1]: it is reached twice");
    refused(&nodes(r#"[{"children":[7]},{"mesh":0}]"#), "nodes[7] does not exist");
    // All in a circle: no node to begin with.
    refused(&nodes(r#"[{"children":[1]},{"children":[0]}]"#), "the scene is empty");
    let chain: Vec<String> = (1..20_000).map(|i| format!(r#"{{"children":[{i}]}}"#)).collect();
    let deep = nodes(&format!(r#"[{},{{"mesh":0}}]"#, chain.join(",")));
    assert_eq!(attempt(&glb(&deep, &floats(&CORNERS))), None);
}

#[test]
fn counts_and_offsets_are_held_against_the_bytes_that_there_are() {
    let with = |old: &str, new: &str| triangle("", "", "").replace(old, new);
    refused(
        &with(r#""count":3"#, r#""count":4"#),
        "accessors[0]: 48 bytes from byte 0 on are more than the 36",
    );
    refused(&with(r#""count":3"#, r#""count":18446744073709551615"#), "too many");
    refused(&with(r#""count":3"#, r#""count":-1"#), "not a glTF scene");
    refused(&with(r#""count":3"#, r#""count":3,"byteOffset":18446744073709551615"#), "more than the 36");
    refused(&with(r#"{"bufferView":0,"#, r#"{"bufferView":5,"#), "bufferViews[5] does not exist");
    refused(
        &with(r#"{"bufferView":0,"#, "{").replace(r#""count":3"#, r#""count":4000000000"#),
        "elements without data",
    );
    refused(
        &with(r#""byteLength":36}],"buffers""#, r#""byteLength":9999999999}],"buffers""#),
        "bufferViews[0]",
    );
    refused(
        &with(r#""buffers":[{"byteLength":36"#, r#""buffers":[{"byteLength":99999999"#),
        "promises 99999999 bytes",
    );
    refused(
        &with(r#""buffers":[{"byteLength":36"#, r#""buffers":[{"byteLength":99999999999"#),
        "bytes of buffers",
    );
    refused(&with(r#""buffer":0,"#, r#""buffer":0,"byteStride":1,"#), "only 1 bytes apart");
    refused(&with(r#""type":"VEC3""#, r#""type":"VEC2""#), "a VEC3 is needed");
    refused(&with(r#""componentType":5126"#, r#""componentType":1"#), "no component type 1");
    refused(&with(r#""POSITION":0"#, r#""POSITION":1"#), "accessors[1] does not exist");
    refused(&triangle("", r#","indices":0"#, ""), "a SCALAR is needed");
    refused(&triangle(r#","rotation":[0,0,0,0]"#, "", ""), "no length");
    refused(&triangle("", r#","material":3"#, ""), "materials[3] does not exist");
}

#[test]
fn files_that_are_no_files_are_refused() {
    let uri = |uri: &str| {
        triangle("", "", "")
            .replace(r#""byteLength":36}]}"#, &format!(r#""byteLength":36,"uri":"{uri}"}}]}}"#))
    };
    refused(&uri("data:text/plain,hello"), "not in base64");
    refused(&uri("data:;base64,****"), "damaged");
    refused(&uri("data:;base64,AAAA"), "promises 36 bytes, but has 3");
    refused(&uri("%zz"), "not a URI");
    // A file without an end.
    let folder = crate::folder("device");
    std::fs::write(folder.join("scene.gltf"), uri("/dev/zero")).unwrap();
    let error = halflight::load::load(&folder.join("scene.gltf"), &LoadOptions::default()).unwrap_err();
    assert!(error.to_string().contains("promises 36 bytes"), "{error}");
}
