//! From a mesh as its file has it to one in world space: transform, normals, orientation.

use super::MeshError;
use crate::build::Mesh;
use crate::shape::Triangle;
use glam::{DMat3, DMat4, DVec3, Vec3};
use std::vec::Vec;

/// How a mesh is put into the scene.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placement {
    /// From the file's space to the world.
    pub(super) to_world: DMat4,
    /// Flat shading, whatever normals the file has.
    pub(super) face_normals: bool,
    /// Turns all normals around.
    pub(super) flip_normals: bool,
}

/// Puts a mesh into the scene, and counts the triangles without area that are left out.
///
/// As Mitsuba 3: normals of the file are kept, missing ones are computed, unless the faces are to be
/// flat. The front is the side that the shading normals are on.
pub(super) fn place(mut mesh: Mesh, placement: &Placement) -> Result<(Mesh, usize), MeshError> {
    transform_positions(&mut mesh.positions, &placement.to_world)?;
    let before = mesh.triangles.len();
    let positions = &mesh.positions;
    mesh.triangles.retain(|t| triangle(positions, *t).is_some());
    let dropped = before - mesh.triangles.len();
    if mesh.triangles.is_empty() {
        return Err(MeshError::Empty);
    }
    if placement.face_normals {
        mesh.normals = Vec::new();
    }
    if mesh.normals.is_empty() {
        if placement.flip_normals {
            mesh.triangles.iter_mut().for_each(|t| t.swap(1, 2));
        }
        if !placement.face_normals {
            mesh.normals = smooth_normals(&mesh);
        }
    } else {
        transform_normals(&mut mesh, placement)?;
        turn_to_normals(&mut mesh);
    }
    Ok((mesh, dropped))
}

fn triangle(positions: &[Vec3], [a, b, c]: [u32; 3]) -> Option<Triangle> {
    let corner = |i: u32| positions.get(i as usize).copied();
    Triangle::new(corner(a)?, corner(b)?, corner(c)?).ok()
}

fn transform_positions(positions: &mut [Vec3], to_world: &DMat4) -> Result<(), MeshError> {
    for (vertex, p) in positions.iter_mut().enumerate() {
        *p = to_world.transform_point3(p.as_dvec3()).as_vec3();
        if !p.is_finite() {
            return Err(MeshError::NotFinite { vertex });
        }
    }
    Ok(())
}

/// Normals follow the inverse transpose. Where the file has one without length, the faces decide.
fn transform_normals(mesh: &mut Mesh, placement: &Placement) -> Result<(), MeshError> {
    let normal_to_world = DMat3::from_mat4(placement.to_world).inverse().transpose();
    let sign = if placement.flip_normals { -1.0 } else { 1.0 };
    let mut unknown = Vec::new();
    for (vertex, n) in mesh.normals.iter_mut().enumerate() {
        if !n.is_finite() {
            return Err(MeshError::NotFinite { vertex });
        }
        let turned = normal_to_world * n.as_dvec3() * sign;
        // A unit normal stays as it is, to the last bit.
        if (turned.length_squared() - 1.0).abs() < 1e-6 {
            *n = turned.as_vec3();
        } else if let Some(unit) = turned.try_normalize() {
            *n = unit.as_vec3();
        } else {
            unknown.push(vertex);
        }
    }
    if !unknown.is_empty() {
        let smooth = smooth_normals(mesh);
        unknown.into_iter().for_each(|v| mesh.normals[v] = smooth[v]);
    }
    Ok(())
}

/// Orders the corners so that the geometric normal is on the side of the shading normals.
fn turn_to_normals(mesh: &mut Mesh) {
    for t in &mut mesh.triangles {
        let [a, b, c] = t.map(|i| mesh.positions[i as usize].as_dvec3());
        let n: DVec3 = t.iter().map(|i| mesh.normals[*i as usize].as_dvec3()).sum();
        if (b - a).cross(c - a).dot(n) < 0.0 {
            t.swap(1, 2);
        }
    }
}

/// Normals of the faces around each vertex, weighted by their angle there.
///
/// Source: Thürmer and Wüthrich 1998, *Computing Vertex Normals from Polygonal Facets*, Journal of
/// Graphics Tools 3(1).
fn smooth_normals(mesh: &Mesh) -> Vec<Vec3> {
    let mut sums = [DVec3::ZERO].repeat(mesh.positions.len());
    for t in &mesh.triangles {
        let corners = t.map(|i| mesh.positions[i as usize].as_dvec3());
        let [a, b, c] = corners;
        let Some(n) = (b - a).cross(c - a).try_normalize() else { continue };
        for (k, i) in t.iter().enumerate() {
            let (to_next, to_last) = (corners[(k + 1) % 3] - corners[k], corners[(k + 2) % 3] - corners[k]);
            let angle = libm::atan2(to_next.cross(to_last).length(), to_next.dot(to_last));
            sums[*i as usize] += n * angle;
        }
    }
    // A vertex of no face, or of faces that cancel, has no direction of its own.
    sums.iter().map(|n| n.try_normalize().unwrap_or(DVec3::X).as_vec3()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad() -> Mesh {
        let p = |x, y, z| Vec3::new(x, y, z);
        Mesh {
            positions: [p(-1., -1., 0.), p(1., -1., 0.), p(1., 1., 0.5), p(-1., 1., 0.)].to_vec(),
            triangles: [[0, 1, 2], [0, 2, 3], [1, 1, 2]].to_vec(),
            ..Mesh::default()
        }
    }

    fn placed(mesh: Mesh, scale: [f64; 3], face_normals: bool, flip_normals: bool) -> Mesh {
        let to_world = DMat4::from_scale(DVec3::from_array(scale));
        place(mesh, &Placement { to_world, face_normals, flip_normals }).unwrap().0
    }

    fn front(mesh: &Mesh) -> Vec3 {
        triangle(&mesh.positions, mesh.triangles[0]).unwrap().normal()
    }

    #[test]
    fn triangles_without_area_are_left_out_and_counted() {
        let placement = Placement { to_world: DMat4::IDENTITY, face_normals: true, flip_normals: false };
        let (mesh, dropped) = place(quad(), &placement).unwrap();
        assert_eq!((mesh.triangles.len(), dropped), (2, 1));
        assert_eq!(
            place(Mesh { triangles: [[0, 0, 1]].to_vec(), ..quad() }, &placement),
            Err(MeshError::Empty)
        );
    }

    #[test]
    fn a_mirrored_mesh_without_normals_shows_its_back_as_in_mitsuba() {
        let flat = |scale, flip| front(&placed(quad(), scale, true, flip)).z;
        assert!(flat([1.0, 1.0, 1.0], false) > 0.0 && flat([1.0, 1.0, 1.0], true) < 0.0);
        assert!(flat([-1.0, 1.0, 1.0], false) < 0.0 && flat([-1.0, 1.0, 1.0], true) > 0.0);
    }

    #[test]
    fn a_mirrored_mesh_with_normals_follows_them_as_in_mitsuba() {
        let smooth = Mesh { normals: [Vec3::Z].repeat(4), ..quad() };
        for (scale, flip, z) in
            [([-1.0, 1.0, 1.0], false, 1.0), ([-1.0, 1.0, 1.0], true, -1.0), ([1.0, 1.0, -1.0], false, -1.0)]
        {
            let mesh = placed(smooth.clone(), scale, false, flip);
            assert_eq!(mesh.normals[0], Vec3::Z * z);
            assert!(front(&mesh).z * z > 0.0, "{scale:?} {flip}");
        }
    }

    #[test]
    fn missing_normals_are_weighted_by_angle() {
        let mesh = placed(quad(), [1.0, 1.0, 1.0], false, false);
        // Vertex 1 belongs to the first face only; vertices 0 and 2 to both.
        assert!((mesh.normals[1] - front(&mesh)).length() < 1e-6);
        assert!(mesh.normals[0].x < 0.0 && mesh.normals[0].y < 0.0);
    }

    #[test]
    fn normals_stay_at_right_angles_under_uneven_scale() {
        let slanted = Vec3::new(0.0, -0.242_535_63, 0.970_142_5);
        let mesh = placed(Mesh { normals: [slanted].repeat(4), ..quad() }, [1.0, 1.0, 3.0], false, false);
        assert!((mesh.normals[1] - front(&mesh)).length() < 1e-6, "{} {}", mesh.normals[1], front(&mesh));
    }

    #[test]
    fn a_transform_beyond_f32_is_refused() {
        let to_world = DMat4::from_scale(DVec3::splat(1e39));
        let placement = Placement { to_world, face_normals: true, flip_normals: false };
        assert_eq!(place(quad(), &placement), Err(MeshError::NotFinite { vertex: 0 }));
    }
}
