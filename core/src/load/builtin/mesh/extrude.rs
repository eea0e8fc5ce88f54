//! Outlines drawn out along a straight line.

use super::profile::edges;
use super::{arc, push_face, push_quad};
use crate::build::Mesh;
use glam::{Vec2, Vec3};
use std::vec::Vec;

/// Draws an outline of (z, y) along x, from `−half_width` to `half_width`: an open sheet, smooth
/// where the outline is. Its front is to the left of the direction of travel as seen from +x with
/// z to the left: a floor that runs away from the viewer and up a wall faces up and forward.
pub(crate) fn sheet(outline: &[Vec2], half_width: f32) -> Mesh {
    let mut mesh = Mesh::default();
    for edge in edges(outline) {
        let first = mesh.positions.len() as u32;
        for end in [0, 1] {
            let (p, n) = (edge.ends[end], edge.normals[end]);
            mesh.positions.extend([-half_width, half_width].map(|x| Vec3::new(x, p.y, p.x)));
            mesh.normals.extend([Vec3::new(0.0, n.y, n.x); 2]);
        }
        push_quad(&mut mesh, [first, first + 1, first + 3, first + 2]);
    }
    mesh
}

/// A wall with a round-headed opening, standing on y = 0 around x = 0, `2 half_depth` thick.
///
/// * `half_width`, `height` – of the wall
/// * `radius` – half the width of the opening; `springing` – height at which its arch begins
pub(crate) fn portal(half_width: f32, height: f32, radius: f32, springing: f32, half_depth: f32) -> Mesh {
    let steps = 48;
    let crown = arc(Vec2::new(0.0, springing), radius, 180.0, 0.0, steps);
    let inner: Vec<Vec2> = [Vec2::new(-radius, 0.0)]
        .into_iter()
        .chain(crown.iter().copied())
        .chain([Vec2::new(radius, 0.0)])
        .collect();
    // The outer point of each inner one: straight out from the jambs, up to the top from the arch.
    let mut outer: Vec<Vec2> = (0..inner.len())
        .map(|i| match i {
            0 => Vec2::new(-half_width, 0.0),
            1 => Vec2::new(-half_width, springing),
            i if i + 2 == inner.len() => Vec2::new(half_width, springing),
            i if i + 1 == inner.len() => Vec2::new(half_width, 0.0),
            i => outward(inner[i], half_width, height, springing),
        })
        .collect();
    square_corners(&mut outer, half_width, height);
    ribbon(&inner, &outer, half_depth)
}

/// Where the ray from the arch's centre through `p` leaves the wall.
fn outward(p: Vec2, half_width: f32, height: f32, springing: f32) -> Vec2 {
    let v = p - Vec2::new(0.0, springing);
    let to_side = half_width / v.x.abs().max(1e-6);
    let to_top = (height - springing) / v.y.max(1e-6);
    if to_side < to_top {
        Vec2::new(half_width * v.x.signum(), springing + v.y * to_side)
    } else {
        Vec2::new(v.x * to_top, height)
    }
}

/// Moves the last point of each side to the wall's corner, so that the outline is square.
fn square_corners(outer: &mut [Vec2], half_width: f32, height: f32) {
    let on_top = |p: &Vec2| p.y == height && p.x.abs() < half_width;
    let (first, last) = (outer.iter().position(on_top), outer.iter().rposition(on_top));
    for (corner, x) in
        [(first.and_then(|i| i.checked_sub(1)), -half_width), (last.map(|i| i + 1), half_width)]
    {
        if let Some(p) = corner.and_then(|i| outer.get_mut(i)) {
            *p = Vec2::new(x, height);
        }
    }
}

/// The solid between two outlines with as many points each, the inner one to the right.
fn ribbon(inner: &[Vec2], outer: &[Vec2], half_depth: f32) -> Mesh {
    let at = |p: Vec2, z: f32| Vec3::new(p.x, p.y, z);
    let (front, back) = (half_depth, -half_depth);
    let mut mesh = Mesh::default();
    for (i, o) in inner.windows(2).zip(outer.windows(2)) {
        push_face(&mut mesh, [at(i[0], front), at(i[1], front), at(o[1], front), at(o[0], front)]);
        push_face(&mut mesh, [at(o[0], back), at(o[1], back), at(i[1], back), at(i[0], back)]);
        push_face(&mut mesh, [at(o[0], front), at(o[1], front), at(o[1], back), at(o[0], back)]);
    }
    for edge in edges(inner) {
        let first = mesh.positions.len() as u32;
        for end in [0, 1] {
            mesh.positions.extend([front, back].map(|z| at(edge.ends[end], z)));
            mesh.normals.extend([at(edge.normals[end], 0.0); 2]);
        }
        push_quad(&mut mesh, [first, first + 1, first + 3, first + 2]);
    }
    if let (Some((&i0, &o0)), Some((&i1, &o1))) =
        (inner.first().zip(outer.first()), inner.last().zip(outer.last()))
    {
        push_face(&mut mesh, [at(o0, front), at(o0, back), at(i0, back), at(i0, front)]);
        push_face(&mut mesh, [at(i1, front), at(i1, back), at(o1, back), at(o1, front)]);
    }
    mesh
}

#[cfg(test)]
mod tests {
    use super::super::checks;
    use super::*;

    #[test]
    fn a_portal_is_closed() {
        checks::assert_closed_and_outward("portal", &portal(1.0, 3.0, 0.6, 1.5, 0.2));
    }

    #[test]
    fn a_floor_that_turns_into_a_wall_faces_up_and_forward() {
        let mesh = sheet(&[Vec2::new(1.0, 0.0), Vec2::new(-1.0, 0.0), Vec2::new(-1.0, 1.0)], 2.0);
        checks::assert_faces_agree_with_normals("sheet", &mesh);
        assert!((mesh.normals[0] - Vec3::Y).length() < 1e-6, "{}", mesh.normals[0]);
        assert!((mesh.normals[4] - Vec3::Z).length() < 1e-6, "{}", mesh.normals[4]);
    }
}
