//! Integrals in double precision.

/// Nodes and weights of the five-point Gauss-Legendre rule on [0, 1] (Abramowitz and Stegun, table 25.4).
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_5),
    (0.230_765_344_947_158_5, 0.239_314_335_249_683_2),
    (0.5, 0.284_444_444_444_444_4),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_2),
    (0.953_089_922_969_332, 0.118_463_442_528_094_5),
];

/// `∫ f` from `a` to `b`, by Gauss's rule in each of `pieces` equal parts.
pub fn integrate(a: f64, b: f64, pieces: usize, mut f: impl FnMut(f64) -> f64) -> f64 {
    let h = (b - a) / pieces as f64;
    let mut sum = 0.0;
    for i in 0..pieces {
        for (x, w) in GAUSS {
            sum += w * f(a + h * (i as f64 + x));
        }
    }
    sum * h
}

/// Visits the nodes of the rule on the unit square with their weights, which add up to 1.
pub fn nodes_of_square(mut f: impl FnMut(f64, f64, f64)) {
    for (x, wx) in GAUSS {
        for (y, wy) in GAUSS {
            f(x, y, wx * wy);
        }
    }
}

/// `∫ f` over the unit square.
pub fn integrate_square(pieces: usize, mut f: impl FnMut(f64, f64) -> f64) -> f64 {
    integrate(0.0, 1.0, pieces, |s| integrate(0.0, 1.0, pieces, |t| f(s, t)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_of_degree_nine_are_exact() {
        assert!((integrate(0.0, 2.0, 1, |x| 10.0 * x.powi(9)) - 1024.0).abs() < 1e-9);
        assert!((integrate_square(1, |x, y| x.powi(3) * y.powi(5)) - 1.0 / 24.0).abs() < 1e-14);
    }
}
