//! The cube `[−1, 1]³`.

use crate::build::Mesh;
use glam::{Vec2, Vec3};
use std::vec::Vec;

/// The corners of each side, counter-clockwise seen from outside, those of the texture coordinates
/// (0, 1), (1, 1), (1, 0) and (0, 0) in this order; as in Mitsuba 3. A corner has its coordinates in
/// its bits: x lowest.
const SIDES: [[u32; 4]; 6] =
    [[1, 5, 4, 0], [3, 2, 6, 7], [1, 3, 7, 5], [5, 7, 6, 4], [4, 6, 2, 0], [3, 1, 0, 2]];

/// A cube with flat sides: two triangles for each.
pub(super) fn mesh() -> Mesh {
    let sign = |bit: u32| if bit == 0 { -1.0 } else { 1.0 };
    let uvs = [Vec2::Y, Vec2::ONE, Vec2::X, Vec2::ZERO];
    let first = |side: usize| 4 * side as u32;
    Mesh {
        positions: SIDES.iter().flatten().map(|i| Vec3::new(sign(i & 1), sign(i & 2), sign(i & 4))).collect(),
        normals: Vec::new(),
        uvs: uvs.repeat(SIDES.len()),
        triangles: (0..SIDES.len())
            .flat_map(|s| [[0, 1, 2], [3, 0, 2]].map(|t| t.map(|i| first(s) + i)))
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_side_faces_outward() {
        let cube = mesh();
        let mut sides = Vec3::ZERO;
        for [a, b, c] in cube.triangles.iter().map(|t| t.map(|i| cube.positions[i as usize])) {
            let n = (b - a).cross(c - a) / 4.0;
            assert_eq!(n.length(), 1.0);
            assert_eq!(n.dot(a + b + c), 3.0, "the side is at distance 1 in its normal's direction");
            sides += n.abs();
        }
        assert_eq!(sides, Vec3::splat(4.0));
    }
}
