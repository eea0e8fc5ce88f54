//! What the samples of a pixel may have missed, as its neighbours tell.

use super::Pixel;

/// Expected squared error over `R² + 0.01` of a pixel beside a brighter one, for what hides in it.
///
/// Where two neighbours differ, an edge runs between their middles. It may reach into the darker pixel
/// so little that none of its `n` samples has met the brighter side: the share that is covered is
/// below `1/n` with probability `1/n`, and then as likely one as another. A lamp a thousand times
/// brighter than what is behind it makes such a pixel as wrong as can be, and no sample tells.
/// (Derived here; the integral over the share is taken at its middle.)
///
/// * `mean`, `brighter` – of the pixel and of its brightest neighbour (W m⁻² sr⁻¹)
/// * `samples` – of the pixel, above 0
#[inline]
fn of_pixel(mean: f32, brighter: f32, samples: u32) -> f32 {
    let n = samples as f32;
    let covered = (brighter - mean).max(0.0) / n;
    let truth = mean + 0.5 * covered;
    // Divided twice: squares of a lamp's radiance leave the range of f32 before their ratio does.
    let relative = covered / crate::num::sqrt(truth * truth + 0.01).min(f32::MAX);
    (relative * relative / 3.0).min(1.0) / n
}

/// The same for a pixel of a part of a picture; 0 before its first sample.
///
/// * `pixels` – row by row, `width` in each
/// * `index` – of the pixel
#[inline]
pub(super) fn behind_samples<P: Pixel>(pixels: &[P], width: usize, index: usize) -> f32 {
    let brightness = |i: usize| pixels.get(i).map_or(0.0, |p| p.stats().mean().average());
    let samples = pixels.get(index).map_or(0, |p| p.stats().count());
    if samples == 0 || width == 0 {
        return 0.0;
    }
    let column = index % width;
    let beside = [
        (column > 0).then(|| index - 1),
        (column + 1 < width).then_some(index + 1),
        index.checked_sub(width),
        Some(index + width),
    ];
    let brightest = beside.into_iter().flatten().map(brightness).fold(0.0, f32::max);
    of_pixel(brightness(index), brightest, samples)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rgb;
    use crate::estimate::PixelStats;

    #[test]
    fn a_lamp_may_hide_in_the_pixel_beside_it_and_nothing_in_an_even_one() {
        assert_eq!(of_pixel(1.0, 1.0, 16), 0.0);
        assert_eq!(of_pixel(1.0, 0.2, 16), 0.0);
        // As wrong as can be, once in sixteen pixels.
        assert!((of_pixel(0.1, 1e4, 16) * 16.0 - 1.0).abs() < 1e-6);
        // An edge between greys is no matter.
        assert!(of_pixel(0.2, 0.8, 16) < 1e-3);
        for (mean, brighter) in [(0.0, 3e38), (3e38, 3e38), (0.0, 1e-30)] {
            let error = of_pixel(mean, brighter, 1);
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
        let ratio = f64::from(of_pixel(0.1, lamp as f32, n)) / (sum / f64::from(runs));
        assert!((0.7..1.4).contains(&ratio), "{ratio}");
    }

    #[test]
    fn neighbours_are_those_at_the_sides() {
        let mut pixels = [PixelStats::NEW; 9];
        pixels.iter_mut().for_each(|p| p.add(Rgb::splat(0.1)));
        pixels[4].add(Rgb::splat(1e6));
        let found: [bool; 9] = core::array::from_fn(|i| behind_samples(&pixels, 3, i) > 0.1);
        assert_eq!(found, [false, true, false, true, false, true, false, true, false]);
    }
}
