//! Which light to sample.

mod power;

pub use power::PowerTable;

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
}

impl LightChoice<'_> {
    /// The light for `from` and a uniform `u` in `[0, 1)`, among `lights`, and its
    /// probability; `None` when there is none.
    /// Not for [`LightChoice::All`], which chooses none.
    #[inline]
    #[must_use]
    pub(crate) fn choose(&self, from: &Receiver, lights: usize, u: f32) -> Option<(usize, f32)> {
        let light = match self {
            Self::All => None,
            Self::Uniform => {
                let index = (u * lights as f32) as usize;
                (lights > 0).then(|| index.min(lights - 1))
            }
            Self::Power(table) => table.choose(u),
        }?;
        Some((light, self.pmf(from, lights, light)))
    }

    /// Probability with which a light sample of `from` goes to `light`, among `lights`; 1 when all get it.
    #[inline]
    #[must_use]
    pub fn pmf(&self, from: &Receiver, lights: usize, light: usize) -> f32 {
        let _ = from;
        match self {
            Self::All => 1.0,
            Self::Uniform => 1.0 / lights as f32,
            Self::Power(table) => table.pmf(light),
        }
    }
}
