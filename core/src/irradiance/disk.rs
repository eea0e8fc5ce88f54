//! Irradiance from a disk.

use crate::geom::unit;
use crate::light::Receiver;
use crate::num::{self, TAU};
use crate::shape::Disk;

/// Projected solid angle of either side of a disk above the horizon of `from` (sr), in `[0, π]`: the
/// irradiance for a radiance of 1. 0 in the disk's plane.
///
/// `None` for an ellipse, and for a disk that the horizon cuts: their forms cancel in single
/// precision.
///
/// Source: Howell, *A Catalog of Radiation Configuration Factors*, differential element to a parallel
/// and to a perpendicular disk. Derived from Lambert's integral over the circle: with h and ρ the
/// distances of the plane and of the receiver's foot from the centre, `W = √((h² + (ρ − r)²)
/// (h² + (ρ + r)²))`, `S = W + h² + ρ² + r²`, `f = W + h² + r² − ρ²`, and the unit normal m and the
/// way C from the receiver to the plane and to the centre,
/// `E = (2π r² / W) n·(h C + m r² f / S) / S`. Differs: no term cancels for a distant disk, nor for
/// one that is touched.
#[must_use]
pub fn disk(from: &Receiver, disk: &Disk) -> Option<f32> {
    let to_centre = disk.centre() - from.point;
    let (u, v) = (unit(disk.axis_u())?, unit(disk.axis_v())?);
    let (a, b) = (disk.axis_u().length(), disk.axis_v().length());
    if !((a - b).abs() <= num::gamma(16) * a) {
        return None;
    }
    let r = num::sqrt(a) * num::sqrt(b);
    let rise = num::sum_of_products(disk.normal().to_array(), to_centre.to_array());
    let (h, cos) = (rise.abs(), from.normal.dot(disk.normal()) * 1.0_f32.copysign(rise));
    let up = num::sum_of_products(from.normal.to_array(), to_centre.to_array());
    let (p, q) = (from.normal.dot(u), from.normal.dot(v));
    // How far the disk's edge rises above its centre.
    let extent = r * num::sqrt(p * p + q * q);
    if up <= -extent || h == 0.0 {
        return Some(0.0);
    }
    if up < extent {
        return None;
    }
    let (x, y) = (to_centre.dot(u), to_centre.dot(v));
    let rho = num::sqrt(x * x + y * y);
    let (near, far) = (h * h + (rho - r) * (rho - r), h * h + (rho + r) * (rho + r));
    let w = num::sqrt(near) * num::sqrt(far);
    let s = w + h * h + rho * rho + r * r;
    let g = h * h + (r - rho) * (r + rho);
    let f = if g > 0.0 { w + g } else { h * rho * (4.0 * h * rho / (w - g)) };
    let e = TAU * (r * r / w) * (h * up / s + (r * r / s) * (f / s) * cos);
    e.is_finite().then_some(e.max(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DVec3, Vec3};

    /// Lambert's integral over the circle, in double precision.
    fn exact(from: &Receiver, disk: &Disk) -> f64 {
        let (n, c) = (from.normal.as_dvec3(), disk.centre().as_dvec3() - from.point.as_dvec3());
        let (u, v) = (disk.axis_u().as_dvec3(), disk.axis_v().as_dvec3());
        let integrand = |t: f64| {
            let (sin, cos) = (libm::sin(t), libm::cos(t));
            let (r, dr): (DVec3, DVec3) = (c + u * cos + v * sin, v * cos - u * sin);
            n.dot(r.cross(dr)) / r.length_squared()
        };
        // Exponentially accurate for a periodic integrand.
        let steps = 1 << 12;
        let step = core::f64::consts::TAU / f64::from(steps);
        0.5 * step * (0..steps).map(|i| integrand(step * f64::from(i))).sum::<f64>().abs()
    }

    #[test]
    fn disks_above_the_horizon_agree_with_the_integral() {
        let mut compared = 0;
        for size in [1e-6, 1.0, 1e6_f32] {
            let disk = Disk::new(Vec3::ZERO, Vec3::X * size, Vec3::Y * size).unwrap();
            for distance in [1e-3, 0.1, 1.0, 1e3, 1e6_f32] {
                for foot in [0.0, 0.5, 0.9, 1.3, 4.0] {
                    for slope in [0.0, 0.7, 1.5, -1.5] {
                        let point = Vec3::new(0.6 * foot, 0.8 * foot, distance) * size;
                        let normal = unit(Vec3::new(slope, 0.3 * slope, -1.0)).unwrap();
                        let from = Receiver { point, normal };
                        let Some(e) = super::disk(&from, &disk).filter(|e| *e > 0.0) else { continue };
                        let truth = exact(&from, &disk);
                        let error = (f64::from(e) - truth).abs();
                        assert!(error <= 3e-6 * truth + 1e-30, "{distance} {foot} {slope}: {e} {truth}");
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 150, "{compared}");
    }

    #[test]
    fn nothing_arrives_from_below_and_in_the_plane() {
        let disk = Disk::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap();
        let at = |point, normal| super::disk(&Receiver { point, normal }, &disk);
        assert_eq!(at(Vec3::Z, Vec3::Z), Some(0.0));
        assert_eq!(at(Vec3::X * 3.0, Vec3::NEG_X), Some(0.0));
        assert_eq!(at(Vec3::Z, Vec3::X), None);
    }
}
