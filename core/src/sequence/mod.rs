//! Where the uniforms come from.
//!
//! A sample of a pixel asks for uniforms by *dimension* (what they decide) and *draw* (which of
//! the draws for that decision this is). Within a dimension the points of all samples of a pixel form
//! one sequence, so that any power of two of them is well spread.
//!
//! # How dimensions are padded
//!
//! A Sobol sequence is best in its first coordinates, and a sample makes more decisions than those
//! decide. So each decision has the first coordinates of a scramble of its own, shuffled so that
//! the points of two decisions meet at random:
//!
//! | decision | coordinates | of the scramble of |
//! |---|---|---|
//! | the only light point, or the only direction for occlusion | 0, 1 | `Film` |
//! | place in the pixel | 2, 3 | `Film` |
//! | point of any other light, one of several draws, BSDF direction | 0, 1 | that dimension |
//! | which light, which lobe | 2 | the dimension of the point that it goes with |
//! | whether a path goes on | 2 | that dimension |
//! | each of these after a bounce | the same | that dimension at that bounce |
//!
//! What goes together in one integral over few variables is one point: a penumbra seen through a
//! pixel, or a light chosen and its point.
//!
//! # How pixels relate
//!
//! [`Random`] and [`Sobol`] give each pixel a seed of its own: nothing is correlated between
//! pixels. [`ZSobol`] deals one sequence out to neighbouring pixels, so that their errors are opposed.

mod points;
mod random;
mod sobol;
mod zsobol;

pub use random::Random;
pub use sobol::Sobol;
pub use zsobol::ZSobol;

use crate::num;

/// What a draw decides. Each decision has its own, independently scrambled points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// The place within the pixel's filter.
    Film,
    /// A point of a light, and which light when one is chosen. With a shadow ray to every light,
    /// each light has its own.
    Light(u32),
    /// Which light, where one uniform cannot tell all of them apart.
    Choice,
    /// A direction from the BSDF, and which lobe.
    Bsdf,
    /// A direction for ambient occlusion.
    Occlusion,
    /// Whether a path goes on.
    Roulette,
    /// Another decision after a bounce, by its number: see [`Dimension::after`].
    Later(u32),
}

impl Dimension {
    /// A number for each decision, for seeding.
    #[inline]
    #[must_use]
    pub const fn key(self) -> u32 {
        match self {
            Self::Film => 0,
            Self::Bsdf => 1,
            Self::Occlusion => 2,
            Self::Choice => u32::MAX,
            Self::Roulette => u32::MAX - 1,
            Self::Later(key) => key,
            Self::Light(light) => 3_u32.wrapping_add(light),
        }
    }

    /// The same decision after so many bounces of a path: a dimension of its own, whose points meet those
    /// of all others at random. Each is well spread by itself; before the first bounce it is the
    /// decision itself.
    #[inline]
    #[must_use]
    pub const fn after(self, bounces: u32) -> Self {
        if bounces == 0 { self } else { Self::Later(num::hash2(bounces, self.key())) }
    }
}

/// A source of uniforms for the samples of a picture.
///
/// What it returns depends on the seed, the pixel, the sample, the dimension and the index only, and
/// not on which thread asks or in what order pixels come.
pub trait Sequence {
    /// Turns to sample `sample` of pixel number `pixel`.
    fn start(&mut self, pixel: u32, sample: u32);

    /// Two uniforms in `[0, 1)` for a point.
    ///
    /// * `draw` – which of the `draws` that every sample makes in this dimension
    fn point(&mut self, dimension: Dimension, draw: u32, draws: u32) -> [f32; 2];

    /// One uniform in `[0, 1)` for a choice that goes with that point.
    fn choice(&mut self, dimension: Dimension, draw: u32, draws: u32) -> f32;
}

/// Any of the sequences, chosen at run time.
#[derive(Debug, Clone)]
pub enum AnySequence {
    /// Independent points.
    Random(Random),
    /// Owen-scrambled Sobol points, for each pixel alone.
    Sobol(Sobol),
    /// Owen-scrambled Sobol points that neighbouring pixels share.
    ZSobol(ZSobol),
}

impl Sequence for AnySequence {
    #[inline]
    fn start(&mut self, pixel: u32, sample: u32) {
        match self {
            Self::Random(s) => s.start(pixel, sample),
            Self::Sobol(s) => s.start(pixel, sample),
            Self::ZSobol(s) => s.start(pixel, sample),
        }
    }

    #[inline]
    fn point(&mut self, dimension: Dimension, draw: u32, draws: u32) -> [f32; 2] {
        match self {
            Self::Random(s) => s.point(dimension, draw, draws),
            Self::Sobol(s) => s.point(dimension, draw, draws),
            Self::ZSobol(s) => s.point(dimension, draw, draws),
        }
    }

    #[inline]
    fn choice(&mut self, dimension: Dimension, draw: u32, draws: u32) -> f32 {
        match self {
            Self::Random(s) => s.choice(dimension, draw, draws),
            Self::Sobol(s) => s.choice(dimension, draw, draws),
            Self::ZSobol(s) => s.choice(dimension, draw, draws),
        }
    }
}
