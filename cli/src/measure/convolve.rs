//! Convolution of planes with kernels that are products of one for rows and one for columns.

/// Numbers row by row.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Plane {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) values: Vec<f32>,
}

impl Plane {
    /// From a number for each index.
    pub(super) fn new(width: usize, height: usize, value: impl FnMut(usize) -> f32) -> Self {
        Self { width, height, values: (0..width * height).map(value).collect() }
    }

    /// Convolved; beyond the edge is what is at the edge.
    ///
    /// * `across`, `down` – an odd number of weights each, the first for what is on the left or above
    pub(super) fn convolved(&self, across: &[f32], down: &[f32]) -> Self {
        let rows = self.along(across, |i, offset| {
            let (x, y) = (i % self.width, i / self.width);
            y * self.width + x.saturating_add_signed(offset).min(self.width - 1)
        });
        rows.along(down, |i, offset| {
            let (x, y) = (i % self.width, i / self.width);
            y.saturating_add_signed(offset).min(self.height - 1) * self.width + x
        })
    }

    fn along(&self, weights: &[f32], neighbour: impl Fn(usize, isize) -> usize) -> Self {
        let radius = (weights.len() / 2) as isize;
        Self::new(self.width, self.height, |i| {
            let offsets = -radius..;
            offsets.zip(weights).map(|(offset, weight)| weight * self.values[neighbour(i, offset)]).sum()
        })
    }
}

/// `f` at the whole numbers from `−radius` to `radius`.
pub(super) fn weights(radius: usize, f: impl Fn(f32) -> f32) -> Vec<f32> {
    (0..=2 * radius).map(|i| f(i as f32 - radius as f32)).collect()
}

/// Weights over their sum.
pub(super) fn normalized(mut weights: Vec<f32>) -> Vec<f32> {
    let sum: f32 = weights.iter().sum();
    weights.iter_mut().for_each(|w| *w /= sum);
    weights
}
