//! What the bits of a picture depend on, and what they do not depend on.

use crate::support::Folder;

/// Renders the scene with further arguments; returns the file.
fn rendered(folder: &Folder, arguments: &str) -> Vec<u8> {
    folder.good(&format!("render scene.xml -o out.exr --width 80 --height 70 {arguments}"));
    folder.bytes("out.exr")
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let folder = Folder::new();
    let one = rendered(&folder, "--threads 1");
    for threads in [2, 5] {
        assert_eq!(rendered(&folder, &format!("--threads {threads}")), one, "{threads} threads");
    }
}

#[test]
fn any_number_of_threads_gives_the_same_error_estimate() {
    let folder = Folder::new();
    let error = |threads: u32| {
        let json = folder.good(&format!("render scene.xml -o out.exr --width 80 --json --threads {threads}"));
        serde_json::from_str::<serde_json::Value>(&json).unwrap()["relative_error"].clone()
    };
    assert!(error(1).is_number());
    assert_eq!(error(1), error(5));
}

#[test]
fn the_seed_decides() {
    let folder = Folder::new();
    let seven = rendered(&folder, "--seed 7");
    assert_eq!(rendered(&folder, "--seed 7"), seven);
    assert_ne!(rendered(&folder, "--seed 8"), seven);
    assert_ne!(rendered(&folder, "--seed 7 --sequence random"), seven);
}

#[test]
fn a_crop_is_cut_out_of_the_whole() {
    let folder = Folder::new();
    rendered(&folder, "");
    let whole = image::open(folder.path("out.exr")).unwrap().to_rgb32f();
    rendered(&folder, "--crop 30,20,75,61");
    let part = image::open(folder.path("out.exr")).unwrap().to_rgb32f();
    assert_eq!(part.dimensions(), whole.dimensions(), "readers show it in its place");
    let inside = |x, y| (30..75).contains(&x) && (20..61).contains(&y);
    for (x, y, p) in part.enumerate_pixels() {
        assert!(if inside(x, y) { p == whole.get_pixel(x, y) } else { p.0 == [0.0; 3] }, "{x} {y}");
    }
    let pixels = exr::prelude::read_first_flat_layer_from_file(folder.path("out.exr")).unwrap();
    assert_eq!(pixels.layer_data.size, exr::prelude::Vec2(45, 41), "the others take no room");
}

#[test]
fn nothing_is_black_that_is_lit() {
    let folder = Folder::new();
    rendered(&folder, "");
    let picture = image::open(folder.path("out.exr")).unwrap().to_rgb32f();
    assert!(picture.get_pixel(5, 65).0.iter().all(|v| v.is_finite() && *v > 0.0));
}
