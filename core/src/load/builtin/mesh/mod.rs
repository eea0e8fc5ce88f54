//! Procedural meshes: one file per way of making one, and what all of them share.
//!
//! Closed meshes have outward normals. Angles are in radians, lengths in metres; everything is made
//! with [`crate::num`], so that a scene has the same bits on every host.

mod cuboid;
mod extrude;
mod lathe;
mod profile;
mod surface;
mod tube;

pub(super) use cuboid::{cuboid, rounded_box};
pub(super) use extrude::{portal, sheet};
pub(super) use lathe::lathe;
pub(super) use profile::{arc, spline};
pub(super) use surface::surface;
pub(super) use tube::{Tube, knot, tube};

use crate::build::Mesh;
use glam::{Mat3, Vec3};

/// Where a mesh is put: turned, scaled alike in all directions, then moved.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pose {
    rotation: Mat3,
    scale: f32,
    offset: Vec3,
}

impl Pose {
    /// Moved to (x, y, z).
    pub(super) const fn at(x: f32, y: f32, z: f32) -> Self {
        Self { rotation: Mat3::IDENTITY, scale: 1.0, offset: Vec3::new(x, y, z) }
    }

    /// Turned further about an axis through where it is now [degrees].
    pub(super) fn turned(self, axis: Vec3, degrees: f32) -> Self {
        Self { rotation: Mat3::from_axis_angle(axis, degrees.to_radians()) * self.rotation, ..self }
    }

    /// Scaled about where it is now.
    pub(super) fn scaled(self, factor: f32) -> Self {
        Self { scale: self.scale * factor, ..self }
    }

    /// Puts a point there.
    pub(super) fn point(&self, p: Vec3) -> Vec3 {
        self.rotation * (p * self.scale) + self.offset
    }

    /// Puts a mesh there.
    pub(super) fn apply(&self, mesh: &Mesh) -> Mesh {
        Mesh {
            uvs: mesh.uvs.clone(),
            positions: mesh.positions.iter().map(|p| self.point(*p)).collect(),
            normals: mesh.normals.iter().map(|n| unit_or_up(self.rotation * *n)).collect(),
            triangles: mesh.triangles.clone(),
        }
    }
}

/// Adds all of `part` to `whole`. Both have normals, or neither.
pub(super) fn append(whole: &mut Mesh, part: &Mesh) {
    let first = whole.positions.len() as u32;
    whole.positions.extend_from_slice(&part.positions);
    whole.normals.extend_from_slice(&part.normals);
    whole.triangles.extend(part.triangles.iter().map(|t| t.map(|i| i + first)));
}

/// Unit vector along `v`; up when it has no direction.
fn unit_or_up(v: Vec3) -> Vec3 {
    crate::geom::unit(v).unwrap_or(Vec3::Y)
}

/// Two triangles for the corners a, b, c, d in order, counter-clockwise seen from the front.
fn push_quad(mesh: &mut Mesh, [a, b, c, d]: [u32; 4]) {
    mesh.triangles.extend([[a, b, c], [a, c, d]]);
}

/// A flat four-sided face with corners of its own, and its normal.
fn push_face(mesh: &mut Mesh, corners: [Vec3; 4]) {
    let normal = unit_or_up((corners[2] - corners[0]).cross(corners[3] - corners[1]));
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners);
    mesh.normals.extend([normal; 4]);
    push_quad(mesh, [first, first + 1, first + 2, first + 3]);
}

#[cfg(test)]
pub(super) mod checks {
    use super::*;
    use std::collections::HashMap;

    /// Bits of a position, with one zero.
    fn key(p: Vec3) -> [u32; 3] {
        p.to_array().map(|x| (x + 0.0).to_bits())
    }

    /// Asserts that each edge is run along as often in one direction as in the other (twice where two
    /// solids touch), and that the volume is positive.
    pub(crate) fn assert_closed_and_outward(name: &str, mesh: &Mesh) {
        let mut edges: HashMap<([u32; 3], [u32; 3]), i32> = HashMap::new();
        let mut volume = 0.0;
        for t in &mesh.triangles {
            let p = t.map(|i| mesh.positions[i as usize]);
            volume += p[0].dot(p[1].cross(p[2])) / 6.0;
            for i in 0..3 {
                let (a, b) = (key(p[i]), key(p[(i + 1) % 3]));
                assert_ne!(a, b, "{name}: degenerate triangle at {}", p[i]);
                *edges.entry((a, b)).or_default() += 1;
            }
        }
        for ((a, b), count) in &edges {
            assert_eq!(edges.get(&(*b, *a)), Some(count), "{name}: open edge at {:?}", a.map(f32::from_bits));
        }
        assert!(volume > 0.0, "{name}: inside out, volume {volume}");
        assert_faces_agree_with_normals(name, mesh);
    }

    /// Asserts that shading normals are unit and on the front of their triangles.
    pub(crate) fn assert_faces_agree_with_normals(name: &str, mesh: &Mesh) {
        assert_eq!(mesh.normals.len(), mesh.positions.len(), "{name}");
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|i| mesh.positions[i as usize]);
            let face = crate::geom::unit((b - a).cross(c - a));
            assert!(face.is_some(), "{name}: no area at {a}");
            for n in t.map(|i| mesh.normals[i as usize]) {
                assert!((n.length() - 1.0).abs() < 1e-5, "{name}: normal {n}");
                assert!(
                    face.is_some_and(|f| f.dot(n) > 0.3),
                    "{name}: normal {n} against face {face:?} at {a}"
                );
            }
        }
    }

    #[test]
    fn posing_keeps_normals_outward() {
        let pose = Pose::at(1.0, 2.0, 3.0).scaled(0.5).turned(Vec3::X, 30.0).turned(Vec3::Y, 200.0);
        assert_closed_and_outward("box", &pose.apply(&cuboid(Vec3::ONE)));
        let mut two = cuboid(Vec3::ONE);
        append(&mut two, &pose.apply(&rounded_box(Vec3::ONE, 0.2, 4)));
        assert_closed_and_outward("two", &two);
    }
}
