//! What the samples of a pixel may have missed, as its neighbours tell.

use super::{Pixel, PixelStats};

/// Expected squared error over `R² + 0.01` of a pixel beside a brighter one, for what hides in it.
///
/// Where two neighbours differ, an edge runs between their middles. It may reach into the darker pixel
/// so little that none of its `n` samples has met the brighter side: the share that is covered is
/// below `1/n` with probability `1/n`, and then as likely one as another. A lamp a thousand times
/// brighter than what is behind it makes such a pixel as wrong as can be, and no sample tells.
/// (Derived here; the integral over the share is taken at its middle.)
///
/// * `mean`, `bright` – of the pixel, and of what is brightest in it as far as it has seen (W m⁻² sr⁻¹)
/// * `brighter` – what is brightest near it (W m⁻² sr⁻¹)
/// * `samples` – of the pixel, above 0
/// * `is_there` – whether something of what is brighter is known to be in the pixel: then its share is below
///   `1/n`, if no sample has met it, with certainty
#[inline]
fn of_pixel(mean: f32, bright: f32, brighter: f32, samples: u32, is_there: bool) -> f32 {
    let n = samples as f32;
    let covered = (brighter - bright).max(0.0) / n;
    let truth = mean + 0.5 * covered;
    // Divided twice: squares of a lamp's radiance leave the range of f32 before their ratio does.
    let relative = covered / crate::num::sqrt(truth * truth + 0.01).min(f32::MAX);
    (relative * relative / 3.0).min(1.0) / if is_there { 1.0 } else { n }
}

/// What is brightest in a pixel (W m⁻² sr⁻¹), as its samples tell: if a share `p` of it has the radiance
/// `L` and the rest is dark, the mean is `p L` and the variance `p (1 − p) L²`, so `L` is the mean and
/// their ratio. A mean below 0.1, which relMSE takes for black, does not make it brighter. (Derived here.)
#[inline]
fn brightest_in(stats: &PixelStats) -> f32 {
    let mean = stats.mean().average();
    mean + stats.variance().average() / mean.max(0.1)
}

/// The expected error of a pixel of a part of a picture; 0 before its first sample.
///
/// * `pixels` – row by row, `width` in each
/// * `index` – of the pixel
/// * `lamp` – radiance of a lamp that may be in it (W m⁻² sr⁻¹)
/// * `is_there` – whether it is known to be
#[inline]
pub(super) fn behind_samples<P: Pixel>(
    pixels: &[P],
    width: usize,
    index: usize,
    lamp: f32,
    is_there: bool,
) -> f32 {
    let Some(stats) = pixels.get(index).map(P::stats).filter(|s| s.count() > 0 && width > 0) else {
        return 0.0;
    };
    let (column, row) = (index % width, index / width);
    let columns = column.saturating_sub(1)..(column + 2).min(width);
    let around = (row.saturating_sub(1)..row + 2).flat_map(|y| columns.clone().map(move |x| y * width + x));
    let brightness = |i: usize| pixels.get(i).map_or(0.0, |p| brightest_in(p.stats()));
    let brighter = around.map(brightness).fold(lamp, f32::max);
    of_pixel(stats.mean().average(), brightest_in(stats), brighter, stats.count(), is_there)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rgb;
    use crate::estimate::PixelStats;

    #[test]
    fn a_lamp_may_hide_in_the_pixel_beside_it_and_nothing_in_an_even_one() {
        let error = |mean, brighter, n| of_pixel(mean, mean, brighter, n, false);
        assert_eq!(error(1.0, 1.0, 16), 0.0);
        assert_eq!(error(1.0, 0.2, 16), 0.0);
        // As wrong as can be, once in sixteen pixels.
        assert!((error(0.1, 1e4, 16) * 16.0 - 1.0).abs() < 1e-6);
        // An edge between greys is no matter.
        assert!(error(0.2, 0.8, 16) < 1e-3);
        for (mean, brighter) in [(0.0, 3e38), (3e38, 3e38), (0.0, 1e-30)] {
            let error = error(mean, brighter, 1);
            assert!((0.0..=1.0).contains(&error), "{mean} {brighter}: {error}");
        }
    }

    #[test]
    fn it_is_what_edges_at_random_places_cost() {
        // A lamp of radiance L covers the share p of a black pixel; n samples at random places.
        let (lamp, n, runs) = (2000.0_f64, 64, 400_000);
        let unit = |i: u32, k: u32| f64::from(crate::num::unit_f32(crate::num::hash2(i, k)));
        let mut sum = 0.0;
        for i in 0..runs {
            let share = unit(i, 0);
            if (1..=n).all(|k| unit(i, k) >= share) {
                let truth = share * lamp + 0.1;
                sum += (share * lamp).powi(2) / (truth * truth + 0.01);
            }
        }
        let ratio = f64::from(of_pixel(0.1, 0.1, lamp as f32, n, false)) / (sum / f64::from(runs));
        assert!((0.7..1.4).contains(&ratio), "{ratio}");
    }

    #[test]
    fn neighbours_are_those_all_around() {
        let mut pixels = [PixelStats::NEW; 20];
        pixels.iter_mut().for_each(|p| p.add(Rgb::splat(0.1)));
        pixels[7].add(Rgb::splat(1e6));
        let found: [bool; 20] = core::array::from_fn(|i| behind_samples(&pixels, 5, i, 0.0, false) > 0.1);
        let near = [1, 2, 3, 6, 8, 11, 12, 13];
        assert_eq!(found, core::array::from_fn(|i| near.contains(&i)));
        // A pixel that has seen it is not surprised; one that may hold a lamp is.
        assert_eq!(behind_samples(&pixels, 5, 7, 0.0, false), 0.0);
        assert!(behind_samples(&pixels, 5, 15, 1e6, false) > 0.1);
    }

    #[test]
    fn a_lamp_is_as_bright_at_its_edge() {
        let mut pixel = PixelStats::NEW;
        for i in 0..100 {
            pixel.add(Rgb::splat(if i < 4 { 500.0 } else { 0.0 }));
        }
        assert!((brightest_in(&pixel) / 500.0 - 1.0).abs() < 0.02, "{}", brightest_in(&pixel));
        // Beyond the range of f32 is bright as well, and no error is NaN.
        pixel.add(Rgb::splat(3e38));
        let pixels = [pixel, PixelStats::from_words([0, 0, 0, 0, 0, 0, 4, 0])];
        for i in 0..2 {
            assert!((0.0..=1.0).contains(&behind_samples(&pixels, 2, i, 0.0, false)));
        }
    }
}
