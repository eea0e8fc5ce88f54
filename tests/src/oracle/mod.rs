//! Closed forms in double precision: irradiance, solid angle and variance.
//!
//! Radiance is 1 throughout. Each irradiance is compared with an integral over the surface in the
//! tests below, so a slip in a formula does not become the truth.

mod adaptive;
mod curved;
mod outlook;
mod polygon;

pub use outlook::{Amounts, CELLS, Outlook};

use crate::quadrature::integrate_square;
use halflight::glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A surface with coordinates `(s, t)` in the unit square.
#[derive(Debug, Clone, Copy)]
pub enum Patch {
    /// A corner and two edges.
    Parallelogram(DVec3, DVec3, DVec3),
    /// Three corners.
    Triangle(DVec3, DVec3, DVec3),
    /// A centre and two semi-axes.
    Ellipse(DVec3, DVec3, DVec3),
    /// A centre and a radius.
    Sphere(DVec3, f64),
    /// The centre of one end, the axis and a radius.
    Tube(DVec3, DVec3, f64),
}

impl Patch {
    /// Point, unit normal, and area for each unit of (s, t).
    fn at(&self, s: f64, t: f64) -> (DVec3, DVec3, f64) {
        let (sin, cos) = (TAU * t).sin_cos();
        match *self {
            Self::Parallelogram(corner, u, v) => {
                let n = u.cross(v);
                (corner + u * s + v * t, n.normalize(), n.length())
            }
            Self::Triangle(a, b, c) => {
                let n = (b - a).cross(c - a);
                (a + (b - a) * s + (c - b) * (s * t), n.normalize(), n.length() * s)
            }
            Self::Ellipse(centre, u, v) => {
                let n = u.cross(v);
                (centre + u * (s * cos) + v * (s * sin), n.normalize(), n.length() * s * TAU)
            }
            Self::Sphere(centre, r) => {
                let z = 1.0 - 2.0 * s;
                let across = (1.0 - z * z).sqrt();
                let n = DVec3::new(across * cos, across * sin, z);
                (centre + n * r, n, 4.0 * PI * r * r)
            }
            Self::Tube(base, axis, r) => {
                let x = axis.normalize().any_orthonormal_vector();
                let n = x * cos + axis.normalize().cross(x) * sin;
                (base + axis * s + n * r, n, TAU * r * axis.length())
            }
        }
    }

    /// Surface area.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.integrate(16, |_, _| 1.0)
    }

    /// `∫ f dA`, with `pieces²` parts.
    pub fn integrate(&self, pieces: usize, mut f: impl FnMut(DVec3, DVec3) -> f64) -> f64 {
        integrate_square(pieces, |s, t| {
            let (p, n, area) = self.at(s, t);
            f(p, n) * area
        })
    }

    /// `∫ f(cos θ_receiver, cos θ_light / d²) dA` over what faces the point from above its horizon.
    fn seen_from(&self, point: DVec3, normal: DVec3, f: impl Fn(f64, f64) -> f64) -> f64 {
        self.integrate(96, |p, n| {
            let w = (p - point).normalize();
            let (cos, cos_light) = (normal.dot(w), -n.dot(w));
            if cos > 0.0 && cos_light > 0.0 { f(cos, cos_light / p.distance_squared(point)) } else { 0.0 }
        })
    }

    /// Irradiance, by integration.
    #[must_use]
    pub fn irradiance(&self, point: DVec3, normal: DVec3) -> f64 {
        self.seen_from(point, normal, |cos, steradians| cos * steradians)
    }

    /// Solid angle of the side that the normal points to, by integration.
    #[must_use]
    pub fn solid_angle(&self, point: DVec3) -> f64 {
        self.integrate(96, |p, n| {
            let w = point - p;
            n.dot(w).max(0.0) / w.length().powi(3)
        })
    }

    /// Variance of one sample of the irradiance, uniform over the area.
    #[must_use]
    pub fn area_sampling_variance(&self, point: DVec3, normal: DVec3) -> f64 {
        let second =
            self.area() * self.seen_from(point, normal, |cos, steradians| (cos * steradians).powi(2));
        second - self.irradiance(point, normal).powi(2)
    }
}

/// Irradiance from a polygon, clipped at the horizon.
///
/// Source: Lambert 1760; the sum over the edges as Schröder and Hanrahan 1993 have it.
#[must_use]
pub fn polygon_irradiance(point: DVec3, normal: DVec3, corners: &[DVec3]) -> f64 {
    let relative: Vec<DVec3> = corners.iter().map(|c| *c - point).collect();
    let above = clip(&relative, normal);
    let edge = |(a, b): (DVec3, DVec3)| {
        let across = a.cross(b);
        across.length().atan2(a.dot(b)) * normal.dot(across) / across.length().max(f64::MIN_POSITIVE)
    };
    let next = above.iter().cycle().skip(1);
    0.5 * above.iter().zip(next).map(|(a, b)| edge((a.normalize(), b.normalize()))).sum::<f64>().abs()
}

/// The part of a polygon on the side of a plane through the origin.
fn clip(corners: &[DVec3], normal: DVec3) -> Vec<DVec3> {
    let mut above = Vec::new();
    for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
        let (da, db) = (normal.dot(*a), normal.dot(*b));
        if da > 0.0 {
            above.push(*a);
        }
        if (da > 0.0) != (db > 0.0) {
            above.push(*a + (*b - *a) * (da / (da - db)));
        }
    }
    above
}

/// Irradiance under the corner of a parallel rectangle of sides `x`, `y` at height `h`.
#[must_use]
pub fn rectangle_over_corner(x: f64, y: f64, h: f64) -> f64 {
    let (x, y) = (x / h, y / h);
    let (a, b) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    0.5 * (x / a * (y / a).atan() + y / b * (x / b).atan())
}

/// Irradiance at the corner of a rectangle at right angles: `w` away from the receiver's plane,
/// `d` along it, at distance `h`.
#[must_use]
pub fn rectangle_at_right_angles(w: f64, d: f64, h: f64) -> f64 {
    let slant = h.hypot(w);
    0.5 * ((d / h).atan() - h / slant * (d / slant).atan())
}

/// Irradiance under a parallel disk of radius `r` at height `h`, `d` off its axis.
#[must_use]
pub fn disk_parallel(r: f64, h: f64, d: f64) -> f64 {
    let sum = d * d + h * h + r * r;
    0.5 * PI * (1.0 - (sum - 2.0 * r * r) / (sum * sum - 4.0 * r * r * d * d).sqrt())
}

/// Irradiance of a receiver that faces the axis of a disk of radius `r` from `d ≥ r` away, at
/// distance `h` from its plane.
#[must_use]
pub fn disk_at_right_angles(r: f64, h: f64, d: f64) -> f64 {
    let (h, r) = (h / d, r / d);
    let z = 1.0 + h * h + r * r;
    0.5 * PI * h * (z / (z * z - 4.0 * r * r).sqrt() - 1.0)
}

/// Irradiance from a sphere of angular radius `sigma` whose centre is seen at an angle of cosine
/// `c` from the normal, cut at the horizon; π from inside is not among its cases.
///
/// Source: Snyder 1996, *Area Light Sources for Real-Time Graphics*, in the form of Lagarde and
/// de Rousiers 2014.
#[must_use]
pub fn sphere(sigma: f64, c: f64) -> f64 {
    let s = sigma.sin();
    if c >= s {
        return PI * s * s * c;
    }
    if c <= -s {
        return 0.0;
    }
    let (x, b) = (1.0 / sigma.tan(), (1.0 - c * c).sqrt());
    let y = -x * c / b;
    let q = b * (1.0 - y * y).sqrt();
    (c * y.acos() - x * q) * s * s + (q / x).atan()
}

/// Irradiance of a receiver that faces the axis of a tube from `h` away, level with one end.
///
/// * `r` – radius, `l` – length
///
/// Source: Howell, *A Catalog of Radiation Configuration Factors*, differential element to a
/// cylinder.
#[must_use]
pub fn tube_from_its_end(r: f64, l: f64, h: f64) -> f64 {
    let (l, h) = (l / r, h / r);
    let (x, y) = ((1.0 + h).powi(2) + l * l, (1.0 - h).powi(2) + l * l);
    let near = (l / (h * h - 1.0).sqrt()).atan() / h;
    let wide = (x - 2.0 * h) / (h * (x * y).sqrt()) * (x * (h - 1.0) / (y * (h + 1.0))).sqrt().atan();
    near + l * (wide - ((h - 1.0) / (h + 1.0)).sqrt().atan() / h)
}

/// Solid angle of a triangle (Van Oosterom and Strackee 1983).
#[must_use]
pub fn triangle_solid_angle(point: DVec3, corners: [DVec3; 3]) -> f64 {
    let [a, b, c] = corners.map(|v| (v - point).normalize());
    2.0 * a.dot(b.cross(c)).abs().atan2(1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}

/// Solid angle of a disk of radius `r` from its axis, `h` away.
#[must_use]
pub fn disk_solid_angle(r: f64, h: f64) -> f64 {
    TAU * (1.0 - h / h.hypot(r))
}

/// Solid angle of a sphere with `s` the sine of its angular radius.
#[must_use]
pub fn sphere_solid_angle(s: f64) -> f64 {
    TAU * s * s / (1.0 + (1.0 - s * s).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn agree(closed: f64, integral: f64, tolerance: f64) {
        assert!((closed - integral).abs() <= tolerance * integral.abs(), "{closed} {integral}");
    }

    #[test]
    fn rectangles_agree_with_the_integral() {
        let over = Patch::Parallelogram(DVec3::new(0.0, 0.0, 1.5), DVec3::Y * 3.0, DVec3::X * 2.0);
        agree(rectangle_over_corner(2.0, 3.0, 1.5), over.irradiance(DVec3::ZERO, DVec3::Z), 1e-8);
        let beside = Patch::Parallelogram(DVec3::new(0.0, 0.0, 1.5), DVec3::Y * 3.0, DVec3::X * 2.0);
        agree(rectangle_at_right_angles(2.0, 3.0, 1.5), beside.irradiance(DVec3::ZERO, DVec3::X), 1e-8);
    }

    #[test]
    fn polygons_agree_with_the_integral_and_with_rectangles() {
        let [a, b, c] = [DVec3::new(-1.0, 2.0, 0.4), DVec3::new(2.0, 1.0, 0.6), DVec3::new(0.5, -1.0, 3.0)];
        let (p, n) = (DVec3::new(0.1, 0.2, -0.5), DVec3::new(0.1, -0.1, 1.0).normalize());
        agree(polygon_irradiance(p, n, &[a, b, c]), Patch::Triangle(a, b, c).irradiance(p, n), 1e-7);
        // With a part below the horizon the integrand has an edge.
        let n = DVec3::new(1.0, 0.0, 0.1).normalize();
        agree(polygon_irradiance(p, n, &[a, b, c]), Patch::Triangle(a, b, c).irradiance(p, n), 1e-4);
        let corners = [
            DVec3::new(0.0, 0.0, 1.5),
            DVec3::new(2.0, 0.0, 1.5),
            DVec3::new(2.0, 3.0, 1.5),
            DVec3::new(0.0, 3.0, 1.5),
        ];
        agree(
            polygon_irradiance(DVec3::ZERO, DVec3::Z, &corners),
            rectangle_over_corner(2.0, 3.0, 1.5),
            1e-12,
        );
        assert_eq!(polygon_irradiance(DVec3::ZERO, DVec3::NEG_Z, &corners), 0.0);
    }

    #[test]
    fn disks_agree_with_the_integral() {
        let disk = Patch::Ellipse(DVec3::new(0.0, 0.0, 2.0), DVec3::Y * 1.5, DVec3::X * 1.5);
        for d in [0.0, 0.7, 4.0] {
            agree(disk_parallel(1.5, 2.0, d), disk.irradiance(DVec3::X * d, DVec3::Z), 1e-8);
        }
        agree(disk_parallel(1.5, 2.0, 0.0), PI * 1.5 * 1.5 / (1.5 * 1.5 + 4.0), 1e-12);
        agree(disk_at_right_angles(1.5, 2.0, 3.0), disk.irradiance(DVec3::X * 3.0, DVec3::NEG_X), 1e-8);
        agree(disk_solid_angle(1.5, 2.0), disk.solid_angle(DVec3::ZERO), 1e-8);
    }

    #[test]
    fn spheres_agree_with_the_integral() {
        let ball = Patch::Sphere(DVec3::Z * 2.0, 1.0);
        let sigma = 0.5_f64.asin();
        for c in [1.0_f64, 0.8, 0.5, 0.3, 0.0, -0.3] {
            let n = DVec3::new((1.0 - c * c).sqrt(), 0.0, c);
            agree(sphere(sigma, c), ball.irradiance(DVec3::ZERO, n), 2e-3);
        }
        agree(sphere(sigma, 0.0), sigma - sigma.sin() * sigma.cos(), 1e-12);
        agree(sphere_solid_angle(0.5), ball.solid_angle(DVec3::ZERO), 1e-4);
    }

    #[test]
    fn tubes_agree_with_the_integral() {
        let tube = Patch::Tube(DVec3::ZERO, DVec3::Y * 3.0, 0.5);
        agree(tube_from_its_end(0.5, 3.0, 2.0), tube.irradiance(DVec3::X * 2.0, DVec3::NEG_X), 1e-4);
        // A long tube, from its middle: π r / d.
        agree(2.0 * tube_from_its_end(0.5, 1e4, 2.0), PI * 0.25, 1e-6);
    }

    #[test]
    fn triangles_agree_with_the_integral() {
        let corners = [DVec3::new(-1.0, 2.0, 0.4), DVec3::new(2.0, 1.0, 0.6), DVec3::new(0.5, -1.0, 3.0)];
        let patch = Patch::Triangle(corners[0], corners[1], corners[2]);
        let p = DVec3::new(0.1, 0.2, -0.5);
        agree(triangle_solid_angle(p, corners), patch.solid_angle(p), 1e-8);
    }

    #[test]
    fn the_variance_of_a_disk_on_its_axis_is_the_closed_form() {
        let disk = Patch::Ellipse(DVec3::Z, DVec3::Y, DVec3::X);
        let k = 0.5;
        let relative = (1.0 - k) * (1.0 - k) / (3.0 * k);
        let e = disk_parallel(1.0, 1.0, 0.0);
        agree(relative * e * e, disk.area_sampling_variance(DVec3::ZERO, DVec3::Z), 1e-8);
    }
}
