//! Surfaces of revolution.

use super::profile::edges;
use super::unit_or_up;
use crate::build::Mesh;
use crate::num::{self, TAU};
use glam::{Vec2, Vec3};
use std::vec::Vec;

/// Turns an outline of (radius, height) about the y axis.
///
/// The outside is to the right of the direction of travel: upward along an outer wall, downward
/// along an inner one. An outline that starts and ends on the axis makes a closed mesh.
pub(crate) fn lathe(profile: &[Vec2], segments: u32) -> Mesh {
    let circle: Vec<Vec2> = (0..segments)
        .map(|j| {
            let (sin, cos) = num::sin_cos(TAU * (j as f32 / segments as f32));
            Vec2::new(cos, sin)
        })
        .collect();
    let around = |p: Vec2| circle.iter().map(move |c| Vec3::new(p.x * c.x, p.y, p.x * c.y));
    let mut mesh = Mesh::default();
    let mut last: Option<(Vec2, Vec2, u32)> = None;
    for edge in edges(profile) {
        let rings = [0, 1].map(|end| {
            let (p, n) = (edge.ends[end], edge.normals[end]);
            if let Some((_, _, ring)) = last.filter(|l| l.0 == p && l.1 == n) {
                return ring;
            }
            let ring = mesh.positions.len() as u32;
            mesh.positions.extend(around(p));
            mesh.normals.extend(around(n).map(unit_or_up));
            last = Some((p, n, ring));
            ring
        });
        let radii = edge.ends.map(|p| p.x);
        join(&mut mesh, rings, radii, segments);
    }
    mesh
}

/// Triangles between two rings; at the axis a ring is a point, and half of them have no area.
fn join(mesh: &mut Mesh, [lower, upper]: [u32; 2], radii: [f32; 2], segments: u32) {
    for j in 0..segments {
        let next = (j + 1) % segments;
        if radii[0] != 0.0 {
            mesh.triangles.push([lower + j, upper + j, lower + next]);
        }
        if radii[1] != 0.0 {
            mesh.triangles.push([lower + next, upper + j, upper + next]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{arc, checks, spline};
    use super::*;

    #[test]
    fn outlines_from_axis_to_axis_make_closed_meshes() {
        let mut ball = arc(Vec2::ZERO, 1.0, -90.0, 90.0, 16);
        (ball[0].x, ball[16].x) = (0.0, 0.0);
        let mesh = lathe(&ball, 32);
        checks::assert_closed_and_outward("ball", &mesh);
        assert_eq!(mesh.triangles.len(), 2 * 32 * 15);
        assert_eq!(mesh.positions.len(), 32 * 17, "smooth rings are shared");
        let cup = [(0.0, 0.0), (1.0, 0.0), (1.2, 1.0), (1.1, 1.0), (0.9, 0.1), (0.0, 0.1)];
        checks::assert_closed_and_outward("cup", &lathe(&cup.map(Vec2::from), 24));
        let vase = spline(&[(0.0, 0.0), (1.0, 0.1), (0.4, 2.0), (0.0, 2.2)].map(Vec2::from), 8);
        checks::assert_closed_and_outward("vase", &lathe(&vase, 24));
    }

    #[test]
    fn normals_of_a_ball_are_radial() {
        let mesh = lathe(&arc(Vec2::ZERO, 2.0, -90.0, 90.0, 64), 64);
        let radial = |(p, n): (&Vec3, &Vec3)| (*p / 2.0 - *n).length() < 0.03;
        assert!(mesh.positions.iter().zip(&mesh.normals).all(radial));
    }
}
