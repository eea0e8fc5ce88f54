//! Independent uniforms.

use super::{Dimension, Sequence};
use crate::num;
use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg32;

/// Independent uniforms from a generator that starts anew for each sample of each pixel.
#[derive(Debug, Clone)]
pub struct Random<R = Pcg32> {
    seed: u32,
    generator: R,
}

impl<R: SeedableRng> Random<R> {
    /// A sequence for one picture; another seed gives other noise.
    #[must_use]
    pub fn new(seed: u32) -> Self {
        Self { seed, generator: R::seed_from_u64(u64::from(seed)) }
    }
}

impl<R: Rng + SeedableRng> Sequence for Random<R> {
    #[inline]
    fn start(&mut self, pixel: u32, sample: u32) {
        let state = u64::from(num::hash2(pixel, self.seed)) << 32 | u64::from(num::hash2(sample, pixel));
        self.generator = R::seed_from_u64(state);
    }

    #[inline]
    fn point(&mut self, _: Dimension, _: u32, _: u32) -> [f32; 2] {
        [0; 2].map(|_| num::unit_f32(self.generator.next_u32()))
    }

    #[inline]
    fn choice(&mut self, _: Dimension, _: u32, _: u32) -> f32 {
        num::unit_f32(self.generator.next_u32())
    }
}
