//! Light beyond what a format can show.

use crate::support::Folder;

/// Values that a format cannot hold, cut off too early or not at all: black or undefined pixels
/// where it is brightest, in renderers that clamp what they keep or write 16-bit floats.
#[test]
fn row_58_light_is_cut_off_only_where_the_format_ends() {
    let folder = Folder::with_change("20, 20, 20", "1e30, 1e-30, 2e30");
    let render = |name: &str| {
        folder.good(&format!("render scene.xml -o {name}"));
        image::open(folder.path(name)).unwrap()
    };
    let (exr, png) = (render("out.exr").to_rgb32f(), render("out.png").to_rgb8());
    let brightest = exr.pixels().max_by(|a, b| a.0[0].total_cmp(&b.0[0])).unwrap();
    assert!(brightest.0[0] > 1e20 && brightest.0.iter().all(|v| v.is_finite()), "{brightest:?}");
    assert!((brightest.0[2] / brightest.0[0] / 2.0 - 1.0).abs() < 1e-5, "{brightest:?} is cut off");
    for (linear, shown) in exr.pixels().zip(png.pixels()) {
        let full = |channel: usize| shown.0[channel] == 255;
        assert!(full(0) == (linear.0[0] > 0.0) && full(2) == full(0), "{linear:?} is shown as {shown:?}");
        assert_eq!(shown.0[1], 0, "{linear:?} is shown as {shown:?}");
    }
}
