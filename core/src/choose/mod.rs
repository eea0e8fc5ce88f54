//! Which light to sample.

mod node;
mod power;
mod tree;

pub use node::LightNode;
pub use power::PowerTable;
pub use tree::{DARK, EVERYWHERE, LightTree, LightTreeError, MAX_DEPTH};

use crate::light::Receiver;

/// How the lights of a scene share the light samples of a shading point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LightChoice<'a> {
    /// Every light gets every sample: no noise from choosing, one shadow ray per light.
    All,
    /// One light for each sample, each as likely as the others.
    Uniform,
    /// One light for each sample, in proportion to its power.
    Power(PowerTable<'a>),
    /// One light for each sample, in proportion to what it is expected to send to the point, and every
    /// light without a place besides.
    Tree(LightTree<'a>),
}

impl LightChoice<'_> {
    /// The light for `from`, among `lights`, and its probability; `None` when there is none.
    /// Not for [`LightChoice::All`], which chooses none.
    ///
    /// * `u` – a uniform in `[0, 1)`
    /// * `more` – a second one, for choices among more lights than the bits of one can tell apart
    #[inline]
    #[must_use]
    pub(crate) fn choose(
        &self,
        from: &Receiver,
        lights: usize,
        u: f32,
        more: impl FnOnce() -> f32,
    ) -> Option<(usize, f32)> {
        let light = match self {
            Self::All => None,
            Self::Uniform => {
                let index = (u * lights as f32) as usize;
                (lights > 0).then(|| index.min(lights - 1))
            }
            Self::Power(table) => table.choose(u),
            Self::Tree(tree) => return tree.choose(from, u, more),
        }?;
        Some((light, self.pmf(from, lights, light)))
    }

    /// The lights, among `lights`, that get every light sample.
    #[inline]
    pub(crate) fn not_chosen(&self, lights: usize) -> impl Iterator<Item = usize> {
        let (all, some) = match self {
            Self::All => (0..lights, &[][..]),
            Self::Uniform | Self::Power(_) => (0..0, &[][..]),
            Self::Tree(tree) => (0..0, tree.everywhere()),
        };
        all.chain(some.iter().map(|&light| light as usize))
    }

    /// Probability with which a light sample of `from` goes to `light`, among `lights`; 1 when all get it.
    #[inline]
    #[must_use]
    pub fn pmf(&self, from: &Receiver, lights: usize, light: usize) -> f32 {
        match self {
            Self::All => 1.0,
            Self::Uniform => 1.0 / lights as f32,
            Self::Power(table) => table.pmf(light),
            Self::Tree(tree) => tree.pmf(from, light),
        }
    }
}
