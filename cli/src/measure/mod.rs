//! Measures of how two pictures differ.

mod convolve;
mod flip;
mod noise;
mod ssim;

pub(crate) use flip::{flip, heat};
pub(crate) use noise::{Agreement, agreement};
pub(crate) use ssim::ssim;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::Picture;
    use halflight::Rgb;

    /// Two pictures that differ in several ways.
    fn pair() -> [Picture; 2] {
        let colour = |x: f32, y: f32| {
            let checked = (x as u32 / 6 + y as u32 / 6).is_multiple_of(2);
            let r = 0.5 + 0.45 * (0.3 * x).sin() * (0.2 * y).cos();
            Rgb::new(r, (x + y) / 80.0, if checked { 0.8 } else { 0.1 })
        };
        let other = |x: f32, y: f32| {
            let Rgb { r, g, b } = colour(x, y);
            if (x, y) == (5.0, 5.0) {
                return Rgb::WHITE;
            }
            let inside = (15.0..30.0).contains(&x) && (10.0..20.0).contains(&y);
            let g = if inside { g + 0.2 } else { g };
            Rgb::new((r * (1.0 + 0.1 * (0.5 * y).sin())).min(1.0), g.min(1.0), b)
        };
        let picture = |of: &dyn Fn(f32, f32) -> Rgb| {
            let pixels = (0..48 * 32).map(|i| of((i % 48) as f32, (i / 48) as f32)).collect();
            Picture { width: 48, height: 32, pixels }
        };
        [picture(&colour), picture(&other)]
    }

    /// Of flip-evaluator 1.7, NVIDIA's own, for the same numbers.
    #[test]
    fn flip_is_that_of_the_reference_implementation() {
        let [reference, test] = pair();
        let errors = flip(&test, &reference);
        let mean = errors.iter().sum::<f32>() / errors.len() as f32;
        assert!((mean - 0.159_906).abs() < 2e-4, "{mean}");
        for ([x, y], expected) in
            [([5, 5], 0.440_435), ([20, 15], 0.614_839), ([0, 0], 0.050_541), ([47, 31], 0.063_869)]
        {
            let error = errors[y * 48 + x];
            assert!((error - expected).abs() < 1e-3, "{x} {y}: {error} instead of {expected}");
        }
        assert!(flip(&test, &test).iter().all(|error| *error == 0.0));
    }

    /// Of scikit-image's `structural_similarity` with a Gaussian window.
    #[test]
    fn ssim_is_that_of_another_implementation() {
        let [reference, test] = pair();
        let found = ssim(&test, &reference).unwrap();
        assert!((found - 0.923_087_6).abs() < 1e-5, "{found}");
        assert!((ssim(&test, &test).unwrap() - 1.0).abs() < 1e-6);
        let small = Picture { width: 10, height: 1, pixels: vec![Rgb::WHITE; 10] };
        assert_eq!(ssim(&small, &small), None);
    }
}
