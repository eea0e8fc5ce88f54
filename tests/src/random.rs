//! Uniforms that are the same in every run.

use halflight::glam::Vec3;
use halflight::num::unit_f32;
use rand_core::Rng;
use rand_pcg::Pcg32;
use std::f32::consts::TAU;

/// A stream of independent uniforms in `[0, 1)`.
#[derive(Debug, Clone)]
pub struct Uniforms(Pcg32);

impl Uniforms {
    /// The stream that belongs to a seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(Pcg32::new(seed, 0x0a02_bdbf_7bb3_c0a7))
    }

    /// One uniform.
    pub fn one(&mut self) -> f32 {
        unit_f32(self.0.next_u32())
    }

    /// Two.
    pub fn two(&mut self) -> [f32; 2] {
        [self.one(), self.one()]
    }

    /// Between two bounds.
    pub fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.one()
    }

    /// An integer below `n`.
    pub fn below(&mut self, n: usize) -> usize {
        (self.0.next_u32() as usize) % n
    }

    /// A unit vector, uniform over the sphere.
    pub fn direction(&mut self) -> Vec3 {
        let z = self.between(-1.0, 1.0);
        let (sin, cos) = (TAU * self.one()).sin_cos();
        let across = ((1.0 - z) * (1.0 + z)).sqrt();
        Vec3::new(across * cos, across * sin, z).normalize()
    }

    /// A point of the cube `[-1, 1]³`.
    pub fn in_cube(&mut self) -> Vec3 {
        Vec3::new(self.between(-1.0, 1.0), self.between(-1.0, 1.0), self.between(-1.0, 1.0))
    }
}

/// Pairs at and next to the edges of the unit square, where samplers divide by 0.
pub fn corners() -> impl Iterator<Item = [f32; 2]> {
    const EDGES: [f32; 7] =
        [0.0, 1.0e-30, f32::EPSILON, 0.5, 0.75, 1.0 - f32::EPSILON, 1.0 - 0.5 * f32::EPSILON];
    EDGES.into_iter().flat_map(|a| EDGES.into_iter().map(move |b| [a, b]))
}
