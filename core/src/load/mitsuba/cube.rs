//! The cube `[−1, 1]³`.

use crate::build::Mesh;
use glam::Vec3;
use std::vec::Vec;

/// Two triangles for each side, counter-clockwise seen from outside. Corner `i` has its coordinates
/// in the bits of `i`: x lowest.
const TRIANGLES: [[u32; 3]; 12] = [
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
];

/// A cube with flat sides.
pub(super) fn mesh() -> Mesh {
    let sign = |bit: u32| if bit == 0 { -1.0 } else { 1.0 };
    Mesh {
        positions: (0..8).map(|i: u32| Vec3::new(sign(i & 1), sign(i & 2), sign(i & 4))).collect(),
        normals: Vec::new(),
        triangles: TRIANGLES.to_vec(),
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
