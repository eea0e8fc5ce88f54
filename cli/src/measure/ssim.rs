//! Structural similarity.

use super::convolve::{Plane, normalized, weights};
use crate::picture::{Picture, encode};

/// The window: a Gaussian of this deviation (pixels), cut off at this radius.
const DEVIATION: f32 = 1.5;
const RADIUS: usize = 5;

/// Structural similarity of two pictures of one size as shown, in sRGB: the mean over channels and over all
/// windows that lie in the picture; 1 for equal ones. `None` when the picture is smaller than a window.
///
/// Source: Wang, Bovik, Sheikh, Simoncelli 2004, *Image Quality Assessment: From Error Visibility to
/// Structural Similarity*, IEEE Transactions on Image Processing 13(4), equation 13, with `K1 = 0.01`,
/// `K2 = 0.03`. Differs: for each channel instead of the luminance.
pub(crate) fn ssim(picture: &Picture, reference: &Picture) -> Option<f64> {
    let (width, height) = (picture.width as usize, picture.height as usize);
    if width <= 2 * RADIUS || height <= 2 * RADIUS {
        return None;
    }
    let means = [0, 1, 2].map(|channel| {
        let plane = |p: &Picture| Plane::new(width, height, |i| encode(p.pixels[i].to_array()[channel]));
        of_planes(&plane(picture), &plane(reference))
    });
    Some(means.iter().sum::<f64>() / 3.0)
}

fn of_planes(a: &Plane, b: &Plane) -> f64 {
    let window = normalized(weights(RADIUS, |x| (-0.5 * (x / DEVIATION).powi(2)).exp()));
    let product = |a: &Plane, b: &Plane| {
        Plane::new(a.width, a.height, |i| a.values[i] * b.values[i]).convolved(&window, &window)
    };
    let [mean_a, mean_b] = [a, b].map(|p| p.convolved(&window, &window));
    let (aa, bb, ab) = (product(a, a), product(b, b), product(a, b));
    let (c1, c2) = (0.01_f64.powi(2), 0.03_f64.powi(2));
    let (mut sum, mut count) = (0.0, 0.0);
    for y in RADIUS..a.height - RADIUS {
        for i in (RADIUS..a.width - RADIUS).map(|x| y * a.width + x) {
            let at = |plane: &Plane| f64::from(plane.values[i]);
            let (ma, mb) = (at(&mean_a), at(&mean_b));
            let (va, vb, cov) = (at(&aa) - ma * ma, at(&bb) - mb * mb, at(&ab) - ma * mb);
            sum += (2.0 * ma * mb + c1) * (2.0 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
            count += 1.0;
        }
    }
    sum / count
}
