//! Cameras that move.

use super::gltf::Moves;
use crate::build::{CameraDescription, ProjectionDescription};
use crate::camera::View;
use glam::{DMat3, DQuat, DVec3, Vec3};
use std::vec::Vec;

/// A camera over time.
#[derive(Debug, Clone)]
pub struct CameraPath {
    kind: Kind,
}

#[derive(Debug, Clone)]
enum Kind {
    /// A second apart.
    Keys(Vec<CameraDescription>),
    /// The animation of a glTF camera.
    Moves(Moves),
}

impl CameraPath {
    /// From one camera to the next in a second each, straight, at an even turn. `None` for fewer than two, or
    /// if they do not project alike.
    pub(super) fn through(keys: Vec<CameraDescription>) -> Option<Self> {
        let first = keys.first()?;
        let alike = keys.len() > 1 && keys.iter().all(|key| between(first, key, 0.5).is_some());
        alike.then_some(Self { kind: Kind::Keys(keys) })
    }

    /// As an animation has it.
    pub(super) const fn animated(moves: Moves) -> Self {
        Self { kind: Kind::Moves(moves) }
    }

    /// When the camera comes to rest (s).
    #[must_use]
    pub fn end(&self) -> f64 {
        match &self.kind {
            Kind::Keys(keys) => keys.len().saturating_sub(1) as f64,
            Kind::Moves(moves) => moves.end(),
        }
    }

    /// The camera at a time (s): the first one before it begins to move, the last one after the end.
    /// `None` where an animation gives it no direction.
    #[must_use]
    pub fn at(&self, time: f64) -> Option<CameraDescription> {
        match &self.kind {
            Kind::Keys(keys) => {
                let time = time.clamp(0.0, self.end());
                let before = (time as usize).min(keys.len().checked_sub(2)?);
                between(keys.get(before)?, keys.get(before + 1)?, time - before as f64)
            }
            Kind::Moves(moves) => moves.at(time),
        }
    }
}

/// A camera between two, of which `share` in `[0, 1]` is the second; `None` if they do not project alike.
fn between(a: &CameraDescription, b: &CameraDescription, share: f64) -> Option<CameraDescription> {
    if share == 0.0 || a == b {
        return alike(a, b).then_some(*a);
    }
    let mix = |a: f32, b: f32| {
        if a == b { a } else { (f64::from(a) * (1.0 - share) + f64::from(b) * share) as f32 }
    };
    let projection = match (a.projection, b.projection) {
        (
            ProjectionDescription::Perspective { fov: f, axis },
            ProjectionDescription::Perspective { fov: g, axis: other },
        ) if axis == other => ProjectionDescription::Perspective { fov: mix(f, g), axis },
        (
            ProjectionDescription::Orthographic { half_width: v },
            ProjectionDescription::Orthographic { half_width: w },
        ) => ProjectionDescription::Orthographic { half_width: mix(v, w) },
        _ => return None,
    };
    let view = turned(&a.view, &b.view, share)?;
    Some(CameraDescription { view, projection, near: mix(a.near, b.near), far: mix(a.far, b.far) })
}

/// True when there are cameras between the two.
fn alike(a: &CameraDescription, b: &CameraDescription) -> bool {
    a == b || between(a, b, 0.5).is_some()
}

/// A view between two; `None` if only one of them is mirrored.
fn turned(a: &View, b: &View, share: f64) -> Option<View> {
    let mirror = |view: &View| view.right.cross(view.up).dot(view.forward).signum();
    let sign = f64::from(mirror(a));
    if mirror(a) != mirror(b) {
        return None;
    }
    let basis = |view: &View| {
        let [right, up, forward] = [view.right, view.up, view.forward].map(Vec3::as_dvec3);
        DQuat::from_mat3(&DMat3::from_cols(right, up, forward * sign)).normalize()
    };
    let turn = basis(a).slerp(basis(b), share);
    let [right, up, forward] = [DVec3::X, DVec3::Y, DVec3::Z * sign].map(|axis| (turn * axis).as_vec3());
    let origin = a.origin.as_dvec3().lerp(b.origin.as_dvec3(), share).as_vec3();
    Some(View { origin, right, up, forward })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::FovAxis;
    use std::vec;

    fn camera(origin: Vec3, target: Vec3, fov: f32) -> CameraDescription {
        let view = View::look_at(origin, target, Vec3::Y).unwrap();
        let projection = ProjectionDescription::Perspective { fov, axis: FovAxis::X };
        CameraDescription { view, projection, near: 0.01, far: f32::INFINITY }
    }

    #[test]
    fn a_path_goes_through_its_cameras() {
        let (a, b) = (camera(Vec3::Z, Vec3::ZERO, 20.0), camera(Vec3::X, Vec3::ZERO, 40.0));
        let c = camera(Vec3::X * 3.0, Vec3::ZERO, 40.0);
        let path = CameraPath::through(vec![a, b, c]).unwrap();
        assert_eq!(path.end(), 2.0);
        assert_eq!([path.at(-1.0), path.at(0.0)], [Some(a); 2]);
        for (time, camera) in [(1.0, b), (2.0, c), (9.0, c)] {
            let found = path.at(time).unwrap();
            assert!((found.view.origin - camera.view.origin).length() < 1e-6, "{time}");
            assert!((found.view.forward - camera.view.forward).length() < 1e-6, "{time}");
        }
        let half = path.at(0.5).unwrap();
        let diagonal = Vec3::new(-1.0, 0.0, -1.0).normalize();
        assert!((half.view.forward - diagonal).length() < 1e-6, "half of the turn: {half:?}");
        assert_eq!(half.projection, ProjectionDescription::Perspective { fov: 30.0, axis: FovAxis::X });
        assert_eq!((half.near, half.far), (0.01, f32::INFINITY));
    }

    #[test]
    fn cameras_that_have_nothing_between_them_make_no_path() {
        let a = camera(Vec3::Z, Vec3::ZERO, 20.0);
        let mirrored = CameraDescription { view: View { right: -a.view.right, ..a.view }, ..a };
        let flat =
            CameraDescription { projection: ProjectionDescription::Orthographic { half_width: 1.0 }, ..a };
        for other in [mirrored, flat] {
            assert!(CameraPath::through(vec![a, other]).is_none(), "{other:?}");
        }
        assert!(CameraPath::through(vec![mirrored, mirrored]).is_some());
        assert!(CameraPath::through(vec![a]).is_none());
    }
}
