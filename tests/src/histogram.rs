//! Directions in cells, counted and integrated.

use crate::random::Uniforms;
use crate::statistics::chi_square;
use crate::{Verdict, ensure};
use halflight::glam::{DVec3, Vec3};
use std::f64::consts::TAU;

/// Equal-area coordinates of a cone of directions, each in `[0, 1)`: from the axis outward, and
/// around it.
#[derive(Debug, Clone, Copy)]
pub struct ConeGrid {
    axes: [DVec3; 3],
    extent: f64,
}

impl ConeGrid {
    /// From a unit axis and `1 − cos` of the half-angle.
    #[must_use]
    pub fn new(axis: Vec3, extent: f64) -> Self {
        let n = axis.as_dvec3().normalize();
        let s = n.any_orthonormal_vector();
        Self { axes: [s, n.cross(s), n], extent }
    }

    /// Solid angle of the cone.
    #[must_use]
    pub fn solid_angle(&self) -> f64 {
        TAU * self.extent
    }

    /// The direction with the given coordinates.
    #[must_use]
    pub fn direction(&self, s: f64, t: f64) -> Vec3 {
        let x = s * self.extent;
        let across = (x * (2.0 - x)).max(0.0).sqrt();
        let (sin, cos) = (TAU * t).sin_cos();
        let [a, b, n] = self.axes;
        (a * (across * cos) + b * (across * sin) + n * (1.0 - x)).as_vec3()
    }

    /// The coordinates of a direction; the first is 1 or more outside.
    fn coordinates(&self, wi: Vec3) -> [f64; 2] {
        let [a, b, n] = self.axes.map(|axis| axis.dot(wi.as_dvec3().normalize()));
        let sin2 = a * a + b * b;
        let x = if n > 0.0 { sin2 / (1.0 + (1.0 - sin2).max(0.0).sqrt()) } else { 1.0 - n };
        [x / self.extent, (b.atan2(a) / TAU).rem_euclid(1.0).min(1.0 - 1e-12)]
    }
}

/// Cells from the axis outward, and around it.
const CELLS: [usize; 2] = [16, 32];

/// Points in each cell along each axis for the integral of the density.
const POINTS: usize = 64;

/// Directions in the cone are as frequent as their density (sr⁻¹) says.
///
/// # Errors
/// When the histogram is too unlikely, or the density integrates to something else than the share
/// of samples that there are.
pub fn directions_follow_density(
    grid: &ConeGrid,
    samples: u64,
    mut draw: impl FnMut(&mut Uniforms) -> Option<Vec3>,
    pdf: impl Fn(Vec3) -> f64,
) -> Verdict {
    let mut random = Uniforms::new(14);
    let n = samples as f64;
    let mut expected = vec![0.0; CELLS[0] * CELLS[1]];
    let points = POINTS as f64;
    for (cell, sum) in expected.iter_mut().enumerate() {
        let (i, j) = ((cell / CELLS[1]) as f64, (cell % CELLS[1]) as f64);
        for k in 0..POINTS * POINTS {
            let [a, b] = random.two().map(f64::from);
            let s = (i + ((k / POINTS) as f64 + a) / points) / CELLS[0] as f64;
            let t = (j + ((k % POINTS) as f64 + b) / points) / CELLS[1] as f64;
            *sum += pdf(grid.direction(s, t));
        }
        *sum *= n * grid.solid_angle() / (CELLS[0] * CELLS[1] * POINTS * POINTS) as f64;
    }
    let mut observed = vec![0; CELLS[0] * CELLS[1]];
    for _ in 0..samples {
        let Some(wi) = draw(&mut random) else { continue };
        let [s, t] = grid.coordinates(wi);
        if s < 1.0 {
            observed[(s * CELLS[0] as f64) as usize * CELLS[1] + (t * CELLS[1] as f64) as usize] += 1;
        }
    }
    let drawn = observed.iter().sum::<u64>() as f64;
    let held = expected.iter().sum::<f64>();
    let spread = 5.0 * (drawn * (1.0 - drawn / n)).sqrt() + 3e-3 * n;
    ensure!(
        (drawn - held).abs() <= spread,
        "{} of the samples exist, the density holds {}",
        drawn / n,
        held / n
    );
    chi_square("directions", &observed, &expected, 0.01)
}
