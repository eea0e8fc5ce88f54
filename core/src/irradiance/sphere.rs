//! Irradiance from a sphere.

use crate::light::Receiver;
use crate::num::PI;
use crate::projected::ProjectedCap;
use crate::shape::Sphere;

/// Projected solid angle of a sphere above the horizon of `from` (sr), in `[0, π]`: the irradiance
/// for a radiance of 1 on the side that is seen. From inside it is π.
///
/// Source: [`ProjectedCap::new`].
#[must_use]
pub fn sphere(from: &Receiver, sphere: &Sphere) -> f32 {
    sphere_at(from, sphere, sphere.clearance(from.point))
}

/// The same for a receiver that is taken to be `gap` outside of the sphere (m).
pub(crate) fn sphere_at(from: &Receiver, sphere: &Sphere, gap: f32) -> f32 {
    if !(gap > 0.0) {
        return PI;
    }
    let to_centre = sphere.centre() - from.point;
    ProjectedCap::of_sphere(from, to_centre, sphere.radius(), gap).map_or(0.0, |(cap, _)| cap.area())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num;
    use glam::Vec3;

    /// Slices across the cap in double precision, four thousand of them.
    fn exact(s: f64, k: f64, c: f64, b: f64) -> f64 {
        let pi = core::f64::consts::PI;
        if c >= s || c <= -s {
            return if c > 0.0 { pi * s * s * c } else { 0.0 };
        }
        let slices = 4000;
        let y_turn = libm::sqrt((s - c) * (s + c)) / b;
        let end = if c > 0.0 { libm::atan2(y_turn, c * k / b) } else { pi / 2.0 };
        let width = if c > 0.0 { s } else { y_turn };
        let sum: f64 = (0..slices)
            .map(|i| {
                let psi = end * (f64::from(i) + 0.5) / f64::from(slices);
                let across = width * libm::cos(psi);
                let q2 = if c > 0.0 { across * across } else { (c * k / b) * (c * k / b) + across * across };
                let q = libm::sqrt(q2);
                let rise = if c > 0.0 { b * q + c * k } else { b * across * across / (q - c * k / b) };
                across * rise * rise / (libm::sqrt(k * k + q2) + b * k - c * q)
            })
            .sum();
        let clear = if c > 0.0 { pi / 2.0 - end - 0.5 * libm::sin(2.0 * end) } else { 0.0 };
        2.0 * (sum * end / f64::from(slices) + c * s * s * clear)
    }

    #[test]
    fn spheres_agree_with_the_integral_at_every_size_and_height() {
        for size in [1e-6, 1.0, 1e6_f32] {
            for gap in [1e-6, 1e-3, 0.1, 1.0, 1e3, 1e6_f32] {
                for height in [1.0, 0.9, 0.5, 0.1, 1e-3, 0.0, -0.01, -0.5, -0.9] {
                    // In units of the angular radius, up to where it clears the horizon.
                    let reach = if height > 0.3 { 1.0 } else { 1.0 / (1.0 + gap) };
                    let c = height * reach;
                    let to_centre =
                        Vec3::new(num::sqrt((1.0 - c) * (1.0 + c)), 0.0, c) * (size * (1.0 + gap));
                    let ball = Sphere::new(to_centre, size).unwrap();
                    let e = f64::from(sphere(&Receiver { point: Vec3::ZERO, normal: Vec3::Z }, &ball));
                    let v = to_centre.as_dvec3();
                    let (d, r) = (v.length(), f64::from(size));
                    let k = libm::sqrt((d - r) * (d + r)) / d;
                    let truth = exact(r / d, k, v.z / d, libm::sqrt(v.x * v.x + v.y * v.y) / d);
                    assert!((e - truth).abs() <= 8e-6 * truth, "{size} {gap} {height}: {e} {truth}");
                }
            }
        }
    }

    #[test]
    fn a_sphere_that_is_touched_fills_what_it_faces() {
        let up = Receiver { point: Vec3::ZERO, normal: Vec3::Z };
        let at = |c: Vec3| sphere(&up, &Sphere::new(c, 1.0).unwrap());
        assert!((at(Vec3::Z) - PI).abs() < 1e-5);
        assert!((at(Vec3::X * 1.000_001) - 0.5 * PI).abs() < 3e-3);
        assert_eq!(at(Vec3::NEG_Z * 1.5), 0.0);
        assert_eq!(at(Vec3::X * 0.5), PI);
    }
}
