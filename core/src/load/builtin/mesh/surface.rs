//! Surfaces given by a function of two parameters.

use super::{push_quad, unit_or_up};
use crate::build::Mesh;
use glam::Vec3;

/// An open patch: the points `f(u, v)` on a grid over `[0, 1]²`, with smooth normals `∂u × ∂v`.
pub(crate) fn surface(columns: u32, rows: u32, f: impl Fn(f32, f32) -> Vec3) -> Mesh {
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        for column in 0..=columns {
            let (u, v) = (column as f32 / columns as f32, row as f32 / rows as f32);
            mesh.positions.push(f(u, v));
        }
    }
    let width = columns + 1;
    for row in 0..rows {
        for column in 0..columns {
            let at = row * width + column;
            push_quad(&mut mesh, [at, at + 1, at + width + 1, at + width]);
        }
    }
    smooth(&mut mesh);
    mesh
}

/// Gives each corner the mean normal of its triangles, weighted with their area.
fn smooth(mesh: &mut Mesh) {
    mesh.normals = std::vec![Vec3::ZERO; mesh.positions.len()];
    for t in &mesh.triangles {
        let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
        let cross = (b - a).cross(c - a);
        for i in t {
            mesh.normals[*i as usize] += cross;
        }
    }
    for n in &mut mesh.normals {
        *n = unit_or_up(*n);
    }
}

#[cfg(test)]
mod tests {
    use super::super::checks;
    use super::*;

    #[test]
    fn a_patch_faces_its_cross_product() {
        let mesh = surface(4, 3, |u, v| Vec3::new(u, v, 0.1 * u * v));
        checks::assert_faces_agree_with_normals("patch", &mesh);
        assert!(mesh.normals.iter().all(|n| n.z > 0.9));
        assert_eq!(mesh.triangles.len(), 24);
    }
}
