//! Which triangles of a surface that emits a picture emit anything: the others need not be lights.

use super::mesh::renumber;
use crate::build::{Mesh, TextureDescription};
use crate::texture::{Kind, Wrap};
use std::vec;
use std::vec::Vec;

/// Parts of a mesh: what may emit, and what certainly does not; `None` where that is nothing.
pub(super) fn split(mesh: Mesh, texture: &TextureDescription) -> [Option<Mesh>; 2] {
    let Some(lit) = LitTexels::new(texture) else { return [Some(mesh), None] };
    let to_uv = texture.pattern.transform();
    let place =
        |corner: &u32| mesh.uvs.get(*corner as usize).map_or([f32::NAN; 2], |uv| to_uv.apply(*uv).into());
    let (glowing, dark): (Vec<_>, Vec<_>) =
        mesh.triangles.iter().copied().partition(|t: &[u32; 3]| lit.any(t.each_ref().map(place)));
    if dark.is_empty() {
        return [Some(mesh), None];
    }
    [glowing, dark].map(|triangles| (!triangles.is_empty()).then(|| part(&mesh, triangles)))
}

/// Some triangles of a mesh, with the corners that they have.
fn part(mesh: &Mesh, mut triangles: Vec<[u32; 3]>) -> Mesh {
    fn of<T: Copy>(all: &[T], used: &[u32]) -> Vec<T> {
        used.iter().filter_map(|&i| all.get(i as usize).copied()).collect()
    }
    let used = renumber(&mut triangles);
    let (positions, normals) = (of(&mesh.positions, &used), of(&mesh.normals, &used));
    Mesh { positions, normals, uvs: of(&mesh.uvs, &used), triangles }
}

/// How many texels that are not black lie above and to the left of each.
struct LitTexels {
    size: [i64; 2],
    wrap: Wrap,
    sums: Vec<u32>,
}

impl LitTexels {
    /// `None` for what is no picture.
    fn new(texture: &TextureDescription) -> Option<Self> {
        let Kind::Picture { width, height, wrap, .. } = texture.pattern.kind() else { return None };
        let (texels, row) = (texture.texels.as_ref()?.texels(), width as usize + 1);
        let mut sums = vec![0_u32; row * (height as usize + 1)];
        for y in 0..height as usize {
            let mut sum = 0;
            for x in 0..width as usize {
                sum += u32::from(!texels.get(y * width as usize + x).is_black());
                sums[(y + 1) * row + x + 1] = sums[y * row + x + 1] + sum;
            }
        }
        Some(Self { size: [width, height].map(i64::from), wrap, sums })
    }

    /// False when all texels around a triangle, whose corners are given in pictures, are black.
    fn any(&self, corners: [[f32; 2]; 3]) -> bool {
        let [Some([left, right]), Some([top, bottom])] = [0, 1].map(|axis| self.range(corners, axis)) else {
            return true;
        };
        let at = |x: usize, y: usize| self.sums[y * (self.size[0] as usize + 1) + x];
        at(right, bottom) + at(left, top) != at(left, bottom) + at(right, top)
    }

    /// The texels around a triangle along an axis, from one to before another; `None` when they are not all
    /// in one picture.
    fn range(&self, corners: [[f32; 2]; 3], axis: usize) -> Option<[usize; 2]> {
        let size = self.size[axis];
        let places = corners.map(|corner| f64::from(corner[axis]) * size as f64);
        if !places.iter().all(|place| place.abs() < 1e9) {
            return None;
        }
        let low = places.iter().fold(f64::INFINITY, |a, b| a.min(*b));
        let high = places.iter().fold(f64::NEG_INFINITY, |a, b| a.max(*b));
        // Half a texel for the blend with neighbours, the other half for roundings.
        let (mut low, mut high) = (low.floor() as i64 - 1, high.floor() as i64 + 2);
        match self.wrap {
            Wrap::Clamp => (low, high) = (low.clamp(0, size - 1), high.clamp(1, size)),
            Wrap::Repeat => {
                let pictures = low.div_euclid(size) * size;
                (low, high) = (low - pictures, high - pictures);
            }
            Wrap::Mirror => {}
        }
        (low >= 0 && high <= size).then_some([low as usize, high as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::TexelBuffer;
    use crate::texture::Pattern;
    use glam::{Vec2, Vec3};
    use std::sync::Arc;

    #[test]
    fn only_triangles_near_light_texels_glow() {
        let mut codes = vec![[0_u8; 3]; 64];
        codes[3 * 8 + 5] = [0, 1, 0];
        let texels = Some(Arc::new(TexelBuffer::Srgb8(codes)));
        let texture = TextureDescription { pattern: Pattern::picture(8, 8), texels };
        let lit = LitTexels::new(&texture).unwrap();
        for y in 0..8 {
            for x in 0..8 {
                let [u, v] = [x, y].map(|c| (c as f32 + 0.5) / 8.0);
                let near = (4..=6).contains(&x) && (2..=4).contains(&y);
                let edge = [x, y].iter().any(|c| [0, 7].contains(c));
                assert_eq!(lit.any([[u, v]; 3]), near || edge, "{x} {y}");
            }
        }
        assert!(
            lit.any([[f32::NAN; 2]; 3])
                && lit.any([[1e30; 2]; 3])
                && lit.any([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
        );
        let mesh = Mesh {
            positions: [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z].to_vec(),
            uvs: [[0.3, 0.3], [0.31, 0.3], [0.3, 0.31], [0.7, 0.45]].map(Vec2::from_array).to_vec(),
            triangles: [[0, 1, 2], [3, 1, 2]].to_vec(),
            ..Mesh::default()
        };
        let [Some(glowing), Some(dark)] = split(mesh, &texture) else { panic!("two parts") };
        assert_eq!((glowing.positions.len(), dark.positions.len()), (3, 3));
        assert_eq!((glowing.positions[2], glowing.triangles[0]), (Vec3::Z, [2, 0, 1]));
    }
}
