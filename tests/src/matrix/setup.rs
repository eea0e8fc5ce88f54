//! Where the light and the receivers of a cell are.

use super::Measured;
use super::axes::{Cell, Light};
use super::examine::examine;
use crate::lights::Specimen;
use halflight::glam::{DMat3, DQuat, DVec3, Vec3};
use halflight::light::Receiver;
use halflight::shape::{Cylinder, Disk, Polygon, Rectangle, Sphere, Triangle};

/// A light in its cell, with one receiver.
#[derive(Debug, Clone, Copy)]
pub(super) struct Setup<S> {
    /// The surface.
    pub(super) shape: S,
    /// Who looks at it.
    pub(super) from: Receiver,
    /// How far along each axis rounding may move the receiver against the surface (m).
    pub(super) grid: DVec3,
    /// A length that holds the light (m).
    pub(super) size: f64,
    /// True when the light stands along the axes: then it is sampled in depth.
    pub(super) aligned: bool,
    /// What it is called in messages.
    pub(super) what: &'static str,
}

/// Roundings in a row that the best arithmetic may need before it knows where a point is.
const ROUNDINGS: f64 = 4.0 * 0.5 * f32::EPSILON as f64;

/// A light whose middle is the origin before it is turned.
struct Pose {
    /// From its own axes to the world.
    turn: DMat3,
    /// The point of the surface from which distances are measured, and which its receivers face.
    foot: DVec3,
    /// Direction in which receivers leave the normal.
    aside: DVec3,
    cell: Cell,
    aligned: bool,
}

impl Pose {
    fn new(cell: Cell, aligned: bool) -> Self {
        let turn = if aligned { DQuat::IDENTITY } else { DQuat::from_xyzw(0.3, -0.5, 0.2, 0.7).normalize() };
        let half_width = f64::from(cell.scale) / f64::from(cell.aspect);
        let (foot, aside) = match cell.light {
            Light::Sphere => (DVec3::Z * f64::from(cell.scale), DVec3::X),
            Light::Cylinder => (DVec3::Z * half_width, DVec3::X),
            _ => (DVec3::ZERO, DVec3::new(0.8, 0.6, 0.0)),
        };
        Self { turn: DMat3::from_quat(turn), foot, aside, cell, aligned }
    }

    /// A vector in the light's own axes, in units of its half-length and half-width.
    fn vector(&self, x: f64, y: f64, z: f64) -> Vec3 {
        let length = f64::from(self.cell.scale);
        let width = length / f64::from(self.cell.aspect);
        self.place(DVec3::new(x * length, y * width, z * width))
    }

    /// A vector in the light's own axes (m).
    fn place(&self, v: DVec3) -> Vec3 {
        (self.turn * v).as_vec3()
    }

    /// A receiver that faces the foot, and one whose horizon cuts the light beside it.
    fn receivers(&self) -> [Receiver; 2] {
        let (sin, cos) = self.cell.angle.sin_cos();
        let out = DVec3::Z * cos + self.aside * sin;
        let distance = f64::from(self.cell.distance) * f64::from(self.cell.scale);
        let at = self.foot + out * distance;
        // A third of the light, or of the way to it, from the foot: the horizon goes through there.
        let beside = self.foot + DVec3::X * (0.35 * distance.clamp(0.0, f64::from(self.cell.scale)));
        let toward_cut = (beside - at).normalize_or(DVec3::X);
        let cut = (-out - toward_cut * toward_cut.dot(-out)).normalize_or(DVec3::Y);
        let point = self.place(at);
        [-out, cut].map(|normal| Receiver { point, normal: self.place(normal).normalize() })
    }

    /// What rounding may do: to the last bits of the numbers given where the light stands along the
    /// axes and each is a distance already; to those of the largest where axes are mixed.
    fn grid(&self, point: Vec3) -> DVec3 {
        let own = point.as_dvec3().abs();
        if self.aligned {
            own * ROUNDINGS
        } else {
            DVec3::splat((own.max_element() + f64::from(self.cell.scale)) * ROUNDINGS)
        }
    }

    fn look<S: Specimen>(&self, shape: S, measured: &mut Measured) {
        let names = [["facing", "tilted"], ["facing, turned", "tilted, turned"]][usize::from(!self.aligned)];
        for (from, what) in self.receivers().into_iter().zip(names) {
            let grid = self.grid(from.point);
            let size = 2.0 * f64::from(self.cell.scale);
            let setup = Setup { shape, from, grid, size, aligned: self.aligned, what };
            examine(&setup, self.cell.method(), measured);
        }
    }
}

/// Runs the checks of a cell on its light, along the axes and turned.
pub(super) fn run(cell: Cell, measured: &mut Measured) {
    for aligned in [true, false] {
        // Four corners are rounded out of their plane by as much as a needle is wide.
        if cell.light == Light::Polygon && !(aligned || cell.aspect == 1.0) {
            measured.skip("rounded corners are in no plane");
            continue;
        }
        let pose = Pose::new(cell, aligned);
        let v = |x, y, z| pose.vector(x, y, z);
        let (zero, size) = (Vec3::ZERO, cell.scale);
        match cell.light {
            Light::Rectangle => {
                pose.look(proper(Rectangle::new(zero, v(1., 0., 0.), v(0., 1., 0.))), measured)
            }
            Light::Disk => pose.look(proper(Disk::new(zero, v(1., 0., 0.), v(0., 1., 0.))), measured),
            Light::Triangle => {
                let [a, b, c] = [v(-0.6, -0.5, 0.), v(0.9, -0.3, 0.), v(-0.2, 0.8, 0.)];
                pose.look(proper(Triangle::new(a, b, c)), measured);
            }
            Light::Polygon => {
                let corners = [[-0.7, -0.6], [0.5, -0.8], [0.95, 0.1], [0.2, 0.9], [-0.8, 0.5]];
                pose.look(proper(Polygon::new(&corners.map(|[x, y]| v(x, y, 0.)))), measured);
            }
            Light::Sphere => pose.look(proper(Sphere::new(zero, size)), measured),
            Light::Cylinder => {
                let width = size / cell.aspect;
                pose.look(proper(Cylinder::new(v(-1., 0., 0.), v(2., 0., 0.), width)), measured);
            }
        }
    }
}

fn proper<S>(shape: Result<S, halflight::shape::ShapeError>) -> S {
    shape.expect("a proper shape")
}
