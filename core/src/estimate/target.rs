//! How good a picture is to be.

/// When a tile is good enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Target {
    relative_mse: f32,
    most: u32,
}

impl Target {
    /// * `relative_error` – `√relMSE` that is wanted, as a fraction: above 0
    /// * `most` – samples that no pixel exceeds
    #[must_use]
    pub fn new(relative_error: f64, most: u32) -> Self {
        let relative_mse = (relative_error * relative_error).max(f64::from(f32::MIN_POSITIVE)) as f32;
        Self { relative_mse, most: most.max(1) }
    }

    /// relMSE that is wanted; above 0.
    pub(super) const fn relative_mse(&self) -> f32 {
        self.relative_mse
    }

    /// Samples that no pixel exceeds; at least 1.
    pub(super) const fn most(&self) -> u32 {
        self.most
    }

    /// Samples that every pixel gets: 8, or 16 for an error below 0.9 %.
    #[must_use]
    pub fn fewest(&self) -> u32 {
        let fewest = if self.relative_mse < 0.009 * 0.009 { 16 } else { 8 };
        fewest.min(self.most)
    }
}
