//! Six square pictures around the scene, and the same light in longitude and latitude.

use crate::Rgb;
use crate::build::Image;
use crate::light::environment::grid::Grid;
use glam::Vec3;
use std::vec::Vec;

/// The faces of a cube, in the order +x, −x, +y, −y, +z, −z.
///
/// Source: Khronos Group 2022, *OpenGL 4.6 (Core Profile)*, section 8.13, table 8.19. Differs: the rows of
/// a picture run the other way, from the bottom up, as `EXT_lights_image_based` has them.
#[derive(Debug)]
pub(super) struct CubeMap {
    /// Columns, and rows, of a face.
    pub(super) size: u32,
    /// `size × size` texels each.
    pub(super) faces: Vec<Vec<Rgb>>,
}

impl CubeMap {
    /// The radiance from a direction, of any length: bilinear within the face that it meets.
    pub(super) fn radiance(&self, d: Vec3) -> Rgb {
        let (face, across, [u, v]) = meet(d);
        let place = |w: f32| {
            let last = (self.size - 1) as f32;
            let at = (0.5 * (w / across + 1.0) * self.size as f32 - 0.5).clamp(0.0, last);
            (at as usize, (at as usize + 1).min(last as usize), at.fract())
        };
        let ((left, right, s), (below, above, t)) = (place(u), place(v));
        let texel = |x: usize, y: usize| self.faces[face][y * self.size as usize + x];
        let row = |y| texel(left, y) * (1.0 - s) + texel(right, y) * s;
        row(below) * (1.0 - t) + row(above) * t
    }

    /// The same light in longitude and latitude, of [`Self::resampled`] columns and rows.
    pub(super) fn longitude_latitude(&self) -> Image {
        let [width, height] = Self::resampled(self.size);
        let grid = Grid { width, height };
        let mut texels = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            // The last row stands at the end of the last row of cells.
            let (cell, tau) = if y < grid.rows() { (y, 0.0) } else { (y - 1, 1.0) };
            texels.extend((0..width).map(|x| self.radiance(grid.direction([x, cell], 0.0, tau))));
        }
        Image { width, height, texels }
    }

    /// Columns and rows in longitude and latitude between which no texel of a cube is lost.
    ///
    /// * `size` – of a face
    ///
    /// Derived: a step of `2 / n` along `u` in the plane of a face is the angle
    /// `2 / n · √(1 + v²) / (1 + u² + v²)`, at least `2 / n · √2 / 3`, which is in a corner. A turn has
    /// `6.67 n` of those.
    pub(super) const fn resampled(size: u32) -> [u32; 2] {
        [7 * size, (7 * size).div_ceil(2) + 1]
    }
}

/// Which face a direction meets, its distance from there, and where.
fn meet(d: Vec3) -> (usize, f32, [f32; 2]) {
    let a = d.abs();
    if a.x >= a.y && a.x >= a.z {
        if d.x > 0.0 { (0, a.x, [-d.z, d.y]) } else { (1, a.x, [d.z, d.y]) }
    } else if a.y >= a.z {
        if d.y > 0.0 { (2, a.y, [d.x, -d.z]) } else { (3, a.y, [d.x, d.z]) }
    } else if d.z > 0.0 {
        (4, a.z, [d.x, d.y])
    } else {
        (5, a.z, [-d.x, d.y])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec;

    /// Light of one texel alone never vanishes between nodes: the nearest is half a texel away at most,
    /// along both edges, and sees a quarter of it.
    #[test]
    fn no_texel_is_lost() {
        for size in [1, 2, 5, 16] {
            for face in 0..6 {
                for texel in 0..(size * size) as usize {
                    let mut cube = CubeMap { size, faces: vec![vec![Rgb::BLACK; (size * size) as usize]; 6] };
                    cube.faces[face][texel] = Rgb::WHITE;
                    let image = cube.longitude_latitude();
                    let brightest = image.texels.iter().fold(0.0_f32, |m, t| m.max(t.g));
                    assert!(brightest > 0.25, "{size}: face {face}, texel {texel}: {brightest}");
                }
            }
        }
    }
}
