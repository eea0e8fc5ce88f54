//! What a texture does with its coordinates.

use super::{Texels, UvTransform};
use crate::Rgb;
use crate::num;
use glam::Vec2;

/// What lies between the middles of texels.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Interpolation {
    /// The nearest texel.
    Nearest,
    /// A blend of the four texels around.
    #[default]
    Bilinear,
}

/// What lies beyond the edges of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// The picture mirrored, and so on.
    Mirror,
    /// The texels at the edge.
    Clamp,
}

/// The kinds of texture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// The same everywhere.
    Constant(Rgb),
    /// Four fields in each unit square: the first colour where `u` and `v` lie in the same half.
    Checkerboard([Rgb; 2]),
    /// A picture over the unit square.
    Picture {
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// What lies between texels.
        interpolation: Interpolation,
        /// What lies beyond the edges.
        wrap: Wrap,
    },
}

/// A texture without its texels.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pattern {
    to_uv: UvTransform,
    kind: Kind,
}

impl From<Kind> for Pattern {
    fn from(kind: Kind) -> Self {
        Self { to_uv: UvTransform::IDENTITY, kind }
    }
}

impl Pattern {
    /// A picture that is repeated, with bilinear interpolation.
    #[must_use]
    pub const fn picture(width: u32, height: u32) -> Self {
        let (interpolation, wrap) = (Interpolation::Bilinear, Wrap::Repeat);
        Self { to_uv: UvTransform::IDENTITY, kind: Kind::Picture { width, height, interpolation, wrap } }
    }

    /// The same after a transform of the coordinates.
    #[must_use]
    pub const fn with_transform(self, to_uv: UvTransform) -> Self {
        Self { to_uv, ..self }
    }

    /// The transform of the coordinates.
    #[must_use]
    pub const fn transform(&self) -> UvTransform {
        self.to_uv
    }

    /// Its kind.
    #[must_use]
    pub const fn kind(&self) -> Kind {
        self.kind
    }

    /// The value at the texture coordinates `uv`.
    #[inline]
    #[must_use]
    pub fn at(&self, texels: Texels<'_>, uv: Vec2) -> Rgb {
        match self.kind {
            Kind::Constant(colour) => colour,
            Kind::Checkerboard(colours) => checkerboard(colours, self.to_uv.apply(uv)),
            Kind::Picture { width, height, interpolation, wrap } => {
                let uv = self.to_uv.apply(uv);
                let (x, y) = (folded(uv.x, wrap) * width as f32, folded(uv.y, wrap) * height as f32);
                match interpolation {
                    Interpolation::Nearest => nearest(texels, [width, height], x, y),
                    Interpolation::Bilinear => bilinear(texels, [width, height], wrap, x, y),
                }
            }
        }
    }

    /// The colours that are not in texels.
    pub(super) fn colours(&self) -> [Option<Rgb>; 2] {
        match self.kind {
            Kind::Constant(colour) => [Some(colour), None],
            Kind::Checkerboard([a, b]) => [Some(a), Some(b)],
            Kind::Picture { .. } => [None, None],
        }
    }

    /// Column and row of a texel.
    pub(super) fn place(&self, index: usize) -> Option<[u32; 2]> {
        match self.kind {
            Kind::Picture { width, .. } => {
                Some([(index % width as usize) as u32, (index / width as usize) as u32])
            }
            _ => None,
        }
    }
}

/// As Mitsuba 3's `checkerboard`: a coordinate of exactly one half counts as the first half.
#[inline]
fn checkerboard([first, second]: [Rgb; 2], uv: Vec2) -> Rgb {
    if (num::fraction(uv.x) > 0.5) == (num::fraction(uv.y) > 0.5) { first } else { second }
}

/// A coordinate brought into `[0, 1]`; 0 for NaN.
#[inline]
fn folded(x: f32, wrap: Wrap) -> f32 {
    match wrap {
        Wrap::Repeat => num::fraction(x),
        Wrap::Mirror => {
            let twice = 2.0 * num::fraction(0.5 * x);
            if twice > 1.0 { 2.0 - twice } else { twice }
        }
        Wrap::Clamp => num::clamp(x, 0.0, 1.0),
    }
}

#[inline]
fn nearest(texels: Texels<'_>, [width, height]: [u32; 2], x: f32, y: f32) -> Rgb {
    let (x, y) = ((x as u32).min(width - 1), (y as u32).min(height - 1));
    texels.get(y as usize * width as usize + x as usize)
}

#[inline]
fn bilinear(texels: Texels<'_>, [width, height]: [u32; 2], wrap: Wrap, x: f32, y: f32) -> Rgb {
    let ([x0, x1], s) = neighbours(x, width, wrap);
    let ([y0, y1], t) = neighbours(y, height, wrap);
    let row = |y: u32| {
        let start = y as usize * width as usize;
        texels.get(start + x0 as usize) * (1.0 - s) + texels.get(start + x1 as usize) * s
    };
    row(y0) * (1.0 - t) + row(y1) * t
}

/// The two texels of a line of `count` around the place `x`, and the share of the second.
#[inline]
fn neighbours(x: f32, count: u32, wrap: Wrap) -> ([u32; 2], f32) {
    // One more than the index of the first, so that it is not negative.
    let shifted = x + 0.5;
    let next = (shifted as u32).min(count);
    let share = num::clamp(shifted - next as f32, 0.0, 1.0);
    let (before, after) = match wrap {
        Wrap::Repeat => (count - 1, 0),
        Wrap::Mirror | Wrap::Clamp => (0, count - 1),
    };
    let first = if next == 0 { before } else { next - 1 };
    ([first, if next == count { after } else { next }], share)
}
