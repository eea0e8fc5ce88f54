//! Boxes, sharp and rounded.

use super::{push_face, push_quad, unit_or_up};
use crate::build::Mesh;
use crate::num::{self, FRAC_PI_4};
use glam::Vec3;
use std::vec::Vec;

/// The three axes of each of six faces: right, up and out; right × up = out.
const FACES: [[Vec3; 3]; 6] = [
    [Vec3::Y, Vec3::Z, Vec3::X],
    [Vec3::Z, Vec3::Y, Vec3::NEG_X],
    [Vec3::Z, Vec3::X, Vec3::Y],
    [Vec3::X, Vec3::Z, Vec3::NEG_Y],
    [Vec3::X, Vec3::Y, Vec3::Z],
    [Vec3::Y, Vec3::X, Vec3::NEG_Z],
];

/// A box around the origin with sharp edges.
pub(crate) fn cuboid(half: Vec3) -> Mesh {
    let mut mesh = Mesh::default();
    for [u, v, n] in FACES {
        let [u, v, n] = [u * half, v * half, n * half];
        push_face(&mut mesh, [n - u - v, n + u - v, n + u + v, n - u + v]);
    }
    mesh
}

/// A box around the origin whose edges are rounded with `radius`, in `2 steps` facets each.
pub(crate) fn rounded_box(half: Vec3, radius: f32, steps: u32) -> Mesh {
    let core = half - Vec3::splat(radius);
    let count = 2 * (steps + 1);
    // Coordinates along an axis, as (side of the core, tangent of the angle beyond it).
    let marks: Vec<(f32, f32)> = (0..count)
        .map(|i| {
            let sign = if i <= steps { -1.0 } else { 1.0 };
            let k = if i <= steps { steps - i } else { i - steps - 1 };
            let angle = FRAC_PI_4 * (k as f32 / steps as f32);
            (sign, sign * if k == steps { 1.0 } else { num::tan(angle) })
        })
        .collect();
    let mut mesh = Mesh::default();
    for [u, v, n] in FACES {
        let first = mesh.positions.len() as u32;
        for &(side_v, tan_v) in &marks {
            for &(side_u, tan_u) in &marks {
                let normal = unit_or_up(u * tan_u + v * tan_v + n);
                let inner = (u * side_u + v * side_v + n) * core;
                mesh.positions.push(inner + normal * radius);
                mesh.normals.push(normal);
            }
        }
        for i in 0..count - 1 {
            for j in 0..count - 1 {
                let at = first + i * count + j;
                push_quad(&mut mesh, [at, at + 1, at + count + 1, at + count]);
            }
        }
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::super::checks;
    use super::*;

    #[test]
    fn boxes_are_closed() {
        checks::assert_closed_and_outward("cuboid", &cuboid(Vec3::new(1.0, 2.0, 3.0)));
        checks::assert_closed_and_outward("rounded", &rounded_box(Vec3::new(1.0, 2.0, 3.0), 0.1, 3));
    }

    #[test]
    fn rounding_keeps_the_extent() {
        let half = Vec3::new(1.0, 2.0, 3.0);
        let mesh = rounded_box(half, 0.25, 4);
        let extent = mesh.positions.iter().fold(Vec3::ZERO, |m, p| m.max(p.abs()));
        assert!((extent - half).length() < 1e-6, "{extent}");
    }
}
