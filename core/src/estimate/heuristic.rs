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
    /// * `this` – its density times its number of samples, above 0
    /// * `other` – the same of the other technique, 0 or more
    ///
    /// Written in the ratio of the two, which is safe wherever the densities themselves are: squares
    /// of 1e20 or 1e-23 never appear. Source: Veach and Guibas 1995, *Optimally Combining Sampling
    /// Techniques*, equations 10 and 12.
    #[inline]
    #[must_use]
    pub fn weight(self, this: f32, other: f32) -> f32 {
        let ratio = other / this;
        match self {
            Self::Balance => 1.0 / (1.0 + ratio),
            Self::Power => 1.0 / (1.0 + ratio * ratio),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_both_techniques_add_up_to_one_at_any_scale() {
        for h in [Heuristic::Balance, Heuristic::Power] {
            for scale in [1e-37, 1e-23, 1.0, 1e20, 1e37] {
                for ratio in [1e-6, 0.3, 1.0, 7.0] {
                    let (a, b) = (scale, scale * ratio);
                    assert!((h.weight(a, b) + h.weight(b, a) - 1.0).abs() < 1e-6, "{h:?} {a} {b}");
                }
            }
            assert_eq!(h.weight(1.0, 0.0), 1.0);
            assert_eq!(h.weight(1e-38, 1e38), 0.0);
        }
    }
}
