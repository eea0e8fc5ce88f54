//! Owen-scrambled Sobol points.

use super::{Dimension, Sequence};
use crate::num;

/// Points per scramble; beyond it a new, independent scramble begins.
const BLOCK: u32 = 1 << 16;

/// Owen-scrambled Sobol points, with the same first dimensions padded for each decision.
///
/// Source: Burley 2020, *Practical Hash-based Owen Scrambling*, JCGT 9(4); crate `sobol_burley`.
#[derive(Debug, Clone)]
pub struct Sobol {
    seed: u32,
    pixel_seed: u32,
    sample: u32,
}

impl Sobol {
    /// A sequence for one picture; another seed gives other noise.
    #[must_use]
    pub const fn new(seed: u32) -> Self {
        Self { seed, pixel_seed: 0, sample: 0 }
    }
}

impl Sequence for Sobol {
    #[inline]
    fn start(&mut self, pixel: u32, sample: u32) {
        self.pixel_seed = num::hash2(pixel, self.seed);
        self.sample = sample;
    }

    #[inline]
    fn next(&mut self, dimension: Dimension, draw: u32, draws: u32) -> [f32; 3] {
        let index = u64::from(self.sample) * u64::from(draws) + u64::from(draw);
        let block = (index / u64::from(BLOCK)) as u32;
        let seed = num::hash2(self.pixel_seed, dimension.key() ^ block.rotate_left(16));
        let [x, y, z, _] = sobol_burley::sample_4d(index as u32 % BLOCK, 0, seed);
        [x, y, z]
    }
}
