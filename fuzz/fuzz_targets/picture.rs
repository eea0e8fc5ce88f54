//! Any bytes as a picture of the light from all around, .exr, .hdr, .png or .jpg: read or refused, never a
//! panic, and never more memory than the file can fill.
#![no_main]

use halflight_fuzz::render_files;
use libfuzzer_sys::fuzz_target;

const SCENE: &[u8] = br#"<scene version="3.0.0">
    <sensor type="perspective"><float name="fov" value="40"/></sensor>
    <shape type="sphere"><point name="center" value="0, 0, -5"/></shape>
    <emitter type="envmap"><string name="filename" value="sky"/></emitter>
</scene>"#;

fuzz_target!(|data: &[u8]| {
    render_files("scene.xml", &[("scene.xml", SCENE), ("sky", data)]);
});
