//! How directions toward an environment map are drawn.

/// How directions toward an environment map are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum EnvironmentDensity {
    /// What measured best: [`EnvironmentDensity::Product`].
    #[default]
    Auto,
    /// Cosine about the receiver's normal, `cos θ / π`: knows nothing of the map and needs no table.
    Cosine,
    /// In proportion to the luminance.
    Luminance,
    /// In proportion to what the luminance is above its mean: leaves the faint rest to the BSDF's
    /// samples, so it is for `Technique::Mis`. A sixteenth of the plain density stays everywhere, so
    /// that nothing is lost without them.
    Compensated,
    /// In proportion to luminance times the cosine at the receiver, the latter block by block.
    Product,
}

impl EnvironmentDensity {
    /// The density that this one means.
    #[must_use]
    pub const fn resolved(self) -> Self {
        match self {
            Self::Auto => Self::Product,
            other => other,
        }
    }

    /// Share of the luminance that [`EnvironmentDensity::Compensated`] keeps everywhere.
    pub(crate) const KEPT: f32 = 1.0 / 16.0;
}
