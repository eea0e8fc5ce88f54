//! Weights for multiple importance sampling.

/// How two densities share a direction that both can draw.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Heuristic {
    /// In proportion to the densities.
    Balance,
    /// In proportion to their squares.
    #[default]
    Power,
}

impl Heuristic {
    /// Weight of a sample from the first technique.
    ///
    /// * `this` – its density times its number of samples, 0 or more; may be infinite
    /// * `other` – the same of the other technique
    ///
    /// In `[0, 1]`; 0 where `this` is 0, and ½ where both are the same, infinity included. Both
    /// weights of a direction that either technique draws add up to 1.
    ///
    /// Written in the ratio of the two, which is safe wherever the densities themselves are: squares
    /// of 1e20 or 1e-23 never appear. Source: Veach and Guibas 1995, *Optimally Combining Sampling
    /// Techniques*, equations 10 and 12.
    #[inline]
    #[must_use]
    pub fn weight(self, this: f32, other: f32) -> f32 {
        if !(this > 0.0) {
            return 0.0;
        }
        // Two infinities have no ratio, but they are the same.
        let ratio = if this == other { 1.0 } else { other / this };
        match self {
            Self::Balance => 1.0 / (1.0 + ratio),
            Self::Power => 1.0 / (1.0 + ratio * ratio),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From the smallest number there is to infinity, through subnormal and normal ones.
    const DENSITIES: [f32; 13] = [
        1e-45,
        1e-41,
        f32::MIN_POSITIVE,
        1e-37,
        1e-23,
        1e-6,
        0.3,
        1.0,
        7.0,
        1e20,
        1e37,
        f32::MAX,
        f32::INFINITY,
    ];

    #[test]
    fn weights_of_both_techniques_add_up_to_one_at_any_scale() {
        for h in [Heuristic::Balance, Heuristic::Power] {
            for a in DENSITIES {
                for b in DENSITIES {
                    let (wa, wb) = (h.weight(a, b), h.weight(b, a));
                    assert!((wa + wb - 1.0).abs() < 1e-6, "{h:?} {a:e} {b:e}: {wa} {wb}");
                    assert!(a < b || wa >= 0.5, "{h:?} {a:e} {b:e}: the likelier has {wa}");
                }
            }
        }
    }

    #[test]
    fn a_technique_that_never_draws_has_no_weight_and_leaves_all_to_the_other() {
        for h in [Heuristic::Balance, Heuristic::Power] {
            for p in DENSITIES {
                assert_eq!((h.weight(0.0, p), h.weight(p, 0.0)), (0.0, 1.0), "{h:?} {p:e}");
            }
            assert_eq!(h.weight(0.0, 0.0), 0.0);
            assert_eq!(h.weight(1e-38, 1e38), 0.0);
            assert_eq!(h.weight(f32::NAN, 1.0), 0.0);
        }
    }

    #[test]
    fn ratios_of_densities_decide_whatever_their_scale() {
        for scale in [1e-37_f32, 1e-23, 1.0, 1e20, 1e37] {
            assert!((Heuristic::Balance.weight(scale, 3.0 * scale) - 0.25).abs() < 1e-6, "{scale:e}");
            assert!((Heuristic::Power.weight(scale, 3.0 * scale) - 0.1).abs() < 1e-6, "{scale:e}");
        }
    }
}
