//! Round tubes along curves.

use super::{push_quad, unit_or_up};
use crate::build::Mesh;
use crate::geom::Frame;
use crate::num::{self, TAU};
use glam::{Mat3, Vec3};
use std::vec::Vec;

/// How a tube is made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tube {
    /// Corners of a cross-section.
    pub(crate) sides: u32,
    /// True when the end meets the beginning; otherwise both ends get a flat cap.
    pub(crate) closed: bool,
}

/// A tube around a curve, given as (centre, radius) for each cross-section.
pub(crate) fn tube(path: &[(Vec3, f32)], kind: Tube) -> Mesh {
    let mut mesh = Mesh::default();
    if path.len() < 3 {
        return mesh;
    }
    for (frame, &(centre, radius)) in frames(path, kind.closed).iter().zip(path) {
        for j in 0..kind.sides {
            let (sin, cos) = num::sin_cos(TAU * (j as f32 / kind.sides as f32));
            let n = unit_or_up(frame.s * cos + frame.t * sin);
            mesh.positions.push(centre + n * radius);
            mesh.normals.push(n);
        }
    }
    let rings = path.len() as u32;
    for ring in 0..if kind.closed { rings } else { rings - 1 } {
        let (here, there) = (ring * kind.sides, (ring + 1) % rings * kind.sides);
        for j in 0..kind.sides {
            let next = (j + 1) % kind.sides;
            push_quad(&mut mesh, [here + j, here + next, there + next, there + j]);
        }
    }
    if !kind.closed {
        cap(&mut mesh, kind.sides, 0, path[0].0, path[1].0);
        cap(&mut mesh, kind.sides, (rings - 1) * kind.sides, path[path.len() - 1].0, path[path.len() - 2].0);
    }
    mesh
}

/// Frames along a curve that turn as little as possible; around a closed curve, what they have
/// turned by the end is taken back evenly.
fn frames(path: &[(Vec3, f32)], closed: bool) -> Vec<Frame> {
    let n = path.len();
    let point = |i: usize| path[i % n].0;
    let tangent = |i: usize| {
        let (before, after) = match i % n {
            0 if !closed => (point(0), point(1)),
            i if !closed && i + 1 == n => (point(n - 2), point(n - 1)),
            i => (point(i + n - 1), point(i + 1)),
        };
        unit_or_up(after - before)
    };
    let mut s = Frame::from_normal(tangent(0)).s;
    let first = s;
    let mut all = Vec::with_capacity(n);
    for i in 0..n {
        let t = tangent(i);
        s = unit_or_up(s - t * s.dot(t));
        all.push(Frame { s, t: t.cross(s), n: t });
    }
    if closed {
        let t = tangent(0);
        s = unit_or_up(s - t * s.dot(t));
        let twist = num::atan2(t.dot(s.cross(first)), s.dot(first));
        for (i, frame) in all.iter_mut().enumerate() {
            let turn = Mat3::from_axis_angle(frame.n, twist * (i as f32 / n as f32));
            (frame.s, frame.t) = (turn * frame.s, turn * frame.t);
        }
    }
    all
}

/// Closes an end with a flat cap that faces away from the curve's next point.
fn cap(mesh: &mut Mesh, sides: u32, ring: u32, centre: Vec3, inner: Vec3) {
    let normal = unit_or_up(centre - inner);
    let first = mesh.positions.len() as u32;
    for j in 0..sides {
        mesh.positions.push(mesh.positions[(ring + j) as usize]);
        mesh.normals.push(normal);
    }
    mesh.positions.push(centre);
    mesh.normals.push(normal);
    for j in 0..sides {
        let (a, b) = (first + j, first + (j + 1) % sides);
        // Rings run counter-clockwise about the direction of travel, which faces in at the start.
        mesh.triangles.push(if ring == 0 { [b, a, first + sides] } else { [a, b, first + sides] });
    }
}

/// The curve of a torus knot about the y axis: `p` times around the axis, `q` times around the ring.
pub(crate) fn knot(p: u32, q: u32, radii: [f32; 2], thickness: f32, steps: u32) -> Vec<(Vec3, f32)> {
    (0..steps)
        .map(|i| {
            let angle = TAU * (i as f32 / steps as f32);
            let (sin_p, cos_p) = num::sin_cos(angle * p as f32);
            let (sin_q, cos_q) = num::sin_cos(angle * q as f32);
            let r = radii[0] + radii[1] * cos_q;
            (Vec3::new(r * cos_p, radii[1] * sin_q, r * sin_p), thickness)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::checks;
    use super::*;

    #[test]
    fn tubes_are_closed() {
        let ring = tube(&knot(1, 0, [1.0, 0.0], 0.2, 48), Tube { sides: 16, closed: true });
        checks::assert_closed_and_outward("torus", &ring);
        let trefoil = tube(&knot(2, 3, [1.0, 0.4], 0.15, 200), Tube { sides: 16, closed: true });
        checks::assert_closed_and_outward("trefoil", &trefoil);
        let stem = [Vec3::ZERO, Vec3::Y, Vec3::new(0.3, 2.0, 0.0)].map(|p| (p, 0.1));
        checks::assert_closed_and_outward("stem", &tube(&stem, Tube { sides: 8, closed: false }));
    }

    #[test]
    fn too_few_points_make_nothing() {
        assert!(tube(&[(Vec3::ZERO, 1.0); 2], Tube { sides: 8, closed: false }).triangles.is_empty());
    }
}
