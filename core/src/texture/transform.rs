//! What is done with texture coordinates before a lookup.

use super::TextureError;
use glam::Vec2;

/// An affine map of texture coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UvTransform {
    /// For each coordinate the factors of `u` and `v`, and what is added.
    rows: [[f32; 3]; 2],
}

impl UvTransform {
    /// Leaves the coordinates as they are.
    pub const IDENTITY: Self = Self { rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] };

    /// `u' = a u + b v + c` from the row `[a, b, c]`, and `v'` from the second row.
    ///
    /// # Errors
    /// When a number is not finite.
    pub fn new(rows: [[f32; 3]; 2]) -> Result<Self, TextureError> {
        let finite = rows.iter().flatten().all(|c| c.is_finite());
        if finite { Ok(Self { rows }) } else { Err(TextureError::Transform) }
    }

    /// The rows of [`UvTransform::new`].
    #[must_use]
    pub const fn rows(&self) -> [[f32; 3]; 2] {
        self.rows
    }

    /// The image of texture coordinates.
    #[inline]
    #[must_use]
    pub fn apply(&self, uv: Vec2) -> Vec2 {
        let [u, v] = self.rows.map(|[a, b, c]| a * uv.x + b * uv.y + c);
        Vec2::new(u, v)
    }
}
