//! Any binary data behind the JSON of a scene that reads it as many things: read or refused, never a panic.
#![no_main]

use halflight_fuzz::load_file;
use libfuzzer_sys::fuzz_target;

/// Positions with sparse ones among them, normals, texture coordinates, indices, and a picture.
const JSON: &str = r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2},"indices":3,"material":0,"mode":5}]}],
"materials":[{"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}}],"textures":[{"source":0}],
"images":[{"bufferView":2}],
"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","sparse":{"count":2,
"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0,"byteOffset":8}}},
{"bufferView":0,"componentType":5120,"normalized":true,"count":4,"type":"VEC3"},
{"bufferView":0,"componentType":5123,"count":4,"type":"VEC2"},
{"bufferView":1,"componentType":5121,"count":6,"type":"SCALAR"}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":8},
{"buffer":0,"byteOffset":56,"byteLength":LENGTH}],"buffers":[{"byteLength":WHOLE}]}"#;

fuzz_target!(|data: &[u8]| {
    let picture = data.len().saturating_sub(56).to_string();
    let json = JSON.replace("LENGTH", &picture).replace("WHOLE", &data.len().to_string());
    let word = |n: usize| (n as u32).to_le_bytes();
    let mut file = [&b"glTF"[..], &word(2), &word(28 + json.len() + data.len())].concat();
    for (kind, bytes) in [(b"JSON", json.as_bytes()), (b"BIN\0", data)] {
        file.extend([&word(bytes.len())[..], kind, bytes].concat());
    }
    load_file("scene.glb", &file);
});
