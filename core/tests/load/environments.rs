//! Environment maps in files.

use crate::folder;
use halflight::Rgb;
use halflight::build::{Image, SceneBuffers};
use halflight::glam::Vec3;
use halflight::load::{LoadError, LoadOptions, Loaded, export_mitsuba, load, write_exr};
use std::fs;
use std::io::Cursor;

/// Reads a scene with an environment map and the picture beside it.
fn with_picture(name: &str, image: &Image, more: &str) -> Result<Loaded, LoadError> {
    let folder = folder(name);
    let mut bytes = Cursor::new(Vec::new());
    write_exr(image, &mut bytes).expect("a picture can be written");
    fs::write(folder.join("map.exr"), bytes.into_inner()).expect("files can be written");
    let emitter = format!(
        "<scene version=\"3.0.0\">\n<emitter type=\"envmap\">\n\
         <string name=\"filename\" value=\"map.exr\"/>{more}</emitter></scene>"
    );
    fs::write(folder.join("scene.xml"), emitter).expect("files can be written");
    load(&folder.join("scene.xml"), &LoadOptions::default())
}

/// Texels that tell where they are.
fn picture(width: u32, height: u32) -> Image {
    let texels = (0..height).flat_map(|y| (0..width).map(move |x| Rgb::new(x as f32, y as f32, 1.0)));
    Image { width, height, texels: texels.collect() }
}

fn radiance(loaded: &Loaded, wi: Vec3) -> Rgb {
    let buffers = SceneBuffers::new(&loaded.description).expect("a scene");
    buffers.bind().scene().radiance_escaping(wi.normalize())
}

/// The numbers are those of Mitsuba 3.9.1.
#[test]
fn directions_are_where_mitsuba_has_them() {
    let turned = "<float name=\"scale\" value=\"2\"/>\
        <transform name=\"to_world\"><rotate x=\"1\" angle=\"20\"/><rotate y=\"1\" angle=\"70\"/></transform>";
    for (more, expected) in [("", &PLAIN), (turned, &TURNED)] {
        let loaded = with_picture("directions", &picture(8, 4), more).expect("a scene");
        for (wi, [r, g]) in DIRECTIONS.iter().zip(expected) {
            let got = radiance(&loaded, Vec3::from(*wi));
            assert!((got.r - r).abs() < 2e-4 && (got.g - g).abs() < 2e-4, "{wi:?}: {got:?}, not {r} {g}");
        }
    }
}

const DIRECTIONS: [[f32; 3]; 16] = [
    [1.0, 0.0, 0.0],
    [-1.0, 0.0, 0.0],
    [0.0, 0.99, 0.1],
    [0.0, -0.9, -0.1],
    [0.0, 0.0, 1.0],
    [0.1, 0.0, -1.0],
    [-0.1, 0.0, -1.0],
    [0.35, 0.82, 0.33],
    [-1.3, 0.91, 0.45],
    [-0.54, 0.58, 0.36],
    [0.29, 0.03, 0.55],
    [-0.74, -0.16, -0.48],
    [0.6, 0.04, -0.29],
    [-0.78, -0.26, 0.01],
    [-0.28, 1.29, 1.01],
    [-2.71, -1.89, -0.17],
];

const PLAIN: [[f32; 2]; 16] = [
    [1.5, 1.5],
    [5.5, 1.5],
    [3.5, 0.0961],
    [3.5, 2.8943],
    [3.5, 1.5],
    [2.6117, 1.5],
    [4.3883, 1.5],
    [2.4626, 0.5066],
    [5.0757, 0.9419],
    [4.7513, 0.8036],
    [2.8822, 1.454],
    [6.2326, 1.6714],
    [0.9267, 1.44275],
    [5.4837, 1.8072],
    [3.8443, 0.6515],
    [5.5798, 2.0807],
];

const TURNED: [[f32; 2]; 16] = [
    [6.059, 2.3751],
    [13.5871, 3.6249],
    [12.3035, 0.6264],
    [6.1635, 5.3746],
    [10.1608, 2.7761],
    [2.4018, 3.1614],
    [1.918, 3.2844],
    [9.4324, 0.4733],
    [13.5146, 2.424],
    [13.0859, 2.0543],
    [8.985, 2.4213],
    [2.4174, 3.9905],
    [4.8453, 2.4294],
    [13.896, 4.2304],
    [11.8533, 1.3911],
    [13.9747, 4.7906],
];

#[test]
fn a_map_without_a_usable_file_says_why() {
    let missing = crate::refusal(
        "missing",
        "<emitter type=\"envmap\"><string name=\"filename\" value=\"no.exr\"/></emitter>",
    );
    assert!(
        missing.starts_with("scene.xml:2: <string") && missing.contains("no.exr: No such file"),
        "{missing}"
    );
    let mut image = picture(8, 4);
    image.texels[8 + 5].g = f32::NAN;
    let message = with_picture("nan", &image, "").map(|_| ()).unwrap_err().to_string();
    assert!(message.contains("map.exr: the texel in column 5, row 1"), "{message}");
    let scaled = "<transform name=\"to_world\"><scale value=\"2\"/></transform>";
    let message = with_picture("scaled", &picture(8, 4), scaled).map(|_| ()).unwrap_err().to_string();
    assert!(message.contains("only turn or mirror"), "{message}");
    let negative = "<float name=\"scale\" value=\"-1\"/>";
    assert!(with_picture("negative", &picture(8, 4), negative).is_err());
}

/// A square map where one in longitude and latitude belongs is rendered, but not in silence.
#[test]
fn row_40_a_map_of_another_shape_is_told_of() {
    let loaded = with_picture("square", &picture(6, 6), "").expect("a scene");
    let warnings: Vec<_> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert!(warnings.iter().any(|w| w.contains("map.exr has 6×6 texels")), "{warnings:?}");
    let loaded = with_picture("fair", &picture(8, 4), "").expect("a scene");
    assert!(!loaded.warnings.iter().any(|w| w.to_string().contains("texels")), "{:?}", loaded.warnings);
}

#[test]
fn an_exported_map_is_the_same_map() {
    let turned = "<transform name=\"to_world\"><rotate x=\"1\" angle=\"20\"/></transform>";
    let loaded = with_picture("written", &picture(8, 4), turned).expect("a scene");
    let path = folder("exported").join("out.xml");
    export_mitsuba(&loaded.description, &path).expect("a scene can be written");
    let again = load(&path, &LoadOptions::default()).expect("what was written can be read");
    assert_eq!(again.description.environments, loaded.description.environments);
    let mut brighter = loaded.description.clone();
    brighter.environments[0].scale = 2.0;
    export_mitsuba(&brighter, &path).expect("a scene can be written");
    let again = load(&path, &LoadOptions::default()).expect("what was written can be read");
    let [texels, before] = [&again.description, &brighter].map(|d| &d.environments[0].image.texels);
    assert!(texels.iter().zip(before).all(|(texel, before)| *texel == *before * 2.0));
}
