//! The tables that a scene borrows.

use crate::light::Emitter;
use crate::texture::ObjectSpace;
use core::fmt;
use glam::{Vec2, Vec3};

/// No light, no normals, no texture coordinates: what a [`Surface`] names when it has none.
pub const NONE: u32 = u32::MAX;

/// A shape with what it looks like.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "bytes", derive(bytemuck::AnyBitPattern))]
#[repr(C)]
pub struct Surface<S> {
    /// Its form.
    pub shape: S,
    /// Index of its material.
    pub material: u32,
    /// Index of the light that it is, or [`NONE`].
    pub light: u32,
    /// Index of its shading normals, or [`NONE`]; for triangles.
    pub normals: u32,
    /// Index of its texture coordinates, or [`NONE`] for the shape's own: first come the entries of
    /// [`Tables::uvs`], for triangles, then those of [`Tables::object_spaces`], for other shapes.
    pub uvs: u32,
}

/// Shading normals at the three corners of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "bytes", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(transparent)]
pub struct CornerNormals(pub [Vec3; 3]);

/// Texture coordinates at the three corners of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "bytes", derive(bytemuck::Pod, bytemuck::Zeroable))]
#[repr(transparent)]
pub struct CornerUvs(pub [Vec2; 3]);

impl CornerUvs {
    /// Those of the point with barycentric coordinates `1 − b1 − b2`, `b1`, `b2`.
    #[inline]
    #[must_use]
    pub fn at(&self, b1: f32, b2: f32) -> Vec2 {
        let [a, b, c] = self.0;
        a * (1.0 - b1 - b2) + b * b1 + c * b2
    }

    /// Direction in which the first coordinate grows, of any length and either sign; zero where the
    /// coordinates have no area.
    ///
    /// * `edges` – from the first corner to the second and to the third
    #[must_use]
    pub fn tangent(&self, edges: [Vec3; 2]) -> Vec3 {
        let [a, b, c] = self.0;
        let (ab, ac) = (b - a, c - a);
        if ab.perp_dot(ac) == 0.0 { Vec3::ZERO } else { edges[0] * ac.y - edges[1] * ab.y }
    }
}

/// What a scene is made of, borrowed.
#[derive(Debug)]
pub struct Tables<'a, S, L, M> {
    /// The surfaces. Primitive `i` of the tree is `surfaces[i]`.
    pub surfaces: &'a [Surface<S>],
    /// Shading normals of triangles.
    pub normals: &'a [CornerNormals],
    /// Texture coordinates of triangles.
    pub uvs: &'a [CornerUvs],
    /// What gives other shapes their texture coordinates.
    pub object_spaces: &'a [ObjectSpace],
    /// The lights; those that surround the scene come last.
    pub lights: &'a [L],
    /// The materials.
    pub materials: &'a [M],
}

impl<S, L, M> Tables<'_, S, L, M> {
    /// Nothing at all: for the tables that a scene does without.
    pub const EMPTY: Self =
        Self { surfaces: &[], normals: &[], uvs: &[], object_spaces: &[], lights: &[], materials: &[] };
}

// Not derived: tables are copied as views, whatever they hold.
impl<S, L, M> Clone for Tables<'_, S, L, M> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S, L, M> Copy for Tables<'_, S, L, M> {}

/// Why a scene was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SceneError {
    /// A surface names something that is not in its table.
    IndexOutOfRange {
        /// Which surface.
        surface: usize,
        /// Which table.
        table: &'static str,
    },
    /// A light that surrounds the scene stands before one that does not.
    EnvironmentNotLast {
        /// Which light.
        light: usize,
    },
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::IndexOutOfRange { surface, table } => {
                write!(f, "surface {surface} names an entry that the table of {table} does not have")
            }
            Self::EnvironmentNotLast { light } => {
                write!(
                    f,
                    "light {light} surrounds the scene but is not among the last; put it behind the others"
                )
            }
        }
    }
}

impl core::error::Error for SceneError {}

impl<S, L: Emitter, M> Tables<'_, S, L, M> {
    /// Refuses surfaces that name missing entries.
    pub(super) fn check_surfaces(&self) -> Result<(), SceneError> {
        let has = |index: u32, len: usize| index == NONE || (index as usize) < len;
        for (surface, s) in self.surfaces.iter().enumerate() {
            for (table, ok) in [
                ("materials", (s.material as usize) < self.materials.len()),
                ("lights", has(s.light, self.lights.len())),
                ("shading normals", has(s.normals, self.normals.len())),
                ("texture coordinates", has(s.uvs, self.uvs.len() + self.object_spaces.len())),
            ] {
                if !ok {
                    return Err(SceneError::IndexOutOfRange { surface, table });
                }
            }
        }
        Ok(())
    }

    /// Where the lights that surround the scene begin.
    pub(super) fn first_environment(&self) -> Result<usize, SceneError> {
        let around = self.lights.iter().rev().take_while(|l| l.is_environment()).count();
        let first = self.lights.len() - around;
        match self.lights.iter().take(first).position(L::is_environment) {
            Some(light) => Err(SceneError::EnvironmentNotLast { light }),
            None => Ok(first),
        }
    }
}
