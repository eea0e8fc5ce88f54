//! Longitude and latitude: where a direction falls among the texels, and back.
//!
//! A texel is a node of the grid; between nodes radiance is interpolated. Columns stand in the middle
//! of their share of the longitude and go around; the first and the last row stand on the poles.
//! Source: the convention of Mitsuba 3, plugin `envmap`. Differs: a map of one row or one column is
//! a map too.
//!
//! A cell is what lies between four nodes. In it two coordinates run along the meridian: `t` in
//! latitude, which the radiance is linear in, and `tau` in `cos θ`, which the density is linear in,
//! so that no density grows at a pole. They agree but for the rows next to the poles.

use crate::num;
use glam::Vec3;

/// The cells of a map.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Grid {
    /// Columns of texels, and of cells.
    pub(crate) width: u32,
    /// Rows of texels.
    pub(crate) height: u32,
}

/// Where a direction falls: a cell, and how far into it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    /// Column of the cell.
    pub(crate) x: u32,
    /// Row of the cell.
    pub(crate) y: u32,
    /// Along the parallel, in `[0, 1]`.
    pub(crate) s: f32,
    /// Along the meridian, linear in the latitude, in `[0, 1]`.
    pub(crate) t: f32,
}

impl Grid {
    /// Rows of cells.
    #[inline]
    pub(crate) const fn rows(&self) -> u32 {
        if self.height > 1 { self.height - 1 } else { 1 }
    }

    /// The texels around a cell: above left, above right, below left, below right.
    #[inline]
    pub(crate) fn corners(&self, x: u32, y: u32) -> [usize; 4] {
        let right = if x + 1 < self.width { x + 1 } else { 0 };
        let above = y as usize * self.width as usize;
        let below = (y + 1).min(self.height - 1) as usize * self.width as usize;
        let (x, right) = (x as usize, right as usize);
        [above + x, above + right, below + x, below + right]
    }

    /// The cell of a direction in the map's own space, where `y` is up and the middle column lies
    /// toward `+z`.
    #[inline]
    pub(crate) fn place(&self, d: Vec3) -> Place {
        let columns = self.width as f32;
        let turns = num::atan2(d.x, -d.z) * (0.5 * num::FRAC_1_PI);
        let across = turns * columns - 0.5;
        let across = if across < 0.0 { across + columns } else { across };
        let x = (across as u32).min(self.width - 1);
        // From the sine, not from the cosine, which says nothing near the poles.
        let theta = num::atan2(num::sqrt(d.x * d.x + d.z * d.z), d.y);
        let down = theta * num::FRAC_1_PI * self.rows() as f32;
        let y = (down as u32).min(self.rows() - 1);
        let within = |v: f32| num::clamp(v, 0.0, 1.0);
        Place { x, y, s: within(across - x as f32), t: within(down - y as f32) }
    }

    /// The row counted from the nearer pole, and whether that is the lower one.
    #[inline]
    fn nearer_pole(&self, y: u32) -> (u32, bool) {
        let mirrored = self.rows() - 1 - y;
        if mirrored < y { (mirrored, true) } else { (y, false) }
    }

    /// How much `cos θ` changes over a row of cells: `cos θ₀ − cos θ₁`, never 0.
    ///
    /// Derived: as a product, `2 sin ½(θ₀ + θ₁) sin ½(θ₁ − θ₀)`, it does not cancel at the poles.
    #[inline]
    pub(crate) fn drop(&self, y: u32) -> f32 {
        let turn = 0.25 / self.rows() as f32;
        let middle = (2 * self.nearer_pole(y).0 + 1) as f32 * turn;
        2.0 * num::sin_cos_turns(middle).0 * num::sin_cos_turns(turn).0
    }

    /// `sin² ½θ` at the end of a row that is nearer to the pole.
    #[inline]
    fn haversine(&self, row: u32) -> f32 {
        let sin = num::sin_cos_turns(row as f32 * (0.25 / self.rows() as f32)).0;
        sin * sin
    }

    /// How far down a row of cells a direction is, linear in `cos θ`, in `[0, 1]`.
    #[inline]
    pub(crate) fn tau(&self, y: u32, d: Vec3) -> f32 {
        let (row, south) = self.nearer_pole(y);
        let cos = if south { -d.y } else { d.y };
        // (1 − cos θ) / 2 of a unit vector, near the pole from its sine.
        let sin2 = d.x * d.x + d.z * d.z;
        let haversine = if cos > 0.0 { 0.5 * sin2 / (1.0 + cos) } else { 0.5 - 0.5 * cos };
        let along = (haversine - self.haversine(row)) / (0.5 * self.drop(y));
        let along = num::clamp(along, 0.0, 1.0);
        if south { 1.0 - along } else { along }
    }

    /// The direction of a place in a cell.
    ///
    /// * `s`, `tau` – in `[0, 1]`
    #[inline]
    pub(crate) fn direction(&self, [x, y]: [u32; 2], s: f32, tau: f32) -> Vec3 {
        let (row, south) = self.nearer_pole(y);
        let along = if south { 1.0 - tau } else { tau };
        let haversine = self.haversine(row) + along * 0.5 * self.drop(y);
        let sin = 2.0 * num::sqrt(haversine * (1.0 - haversine));
        let cos = 1.0 - 2.0 * haversine;
        let (sin_phi, cos_phi) = num::sin_cos_turns((x as f32 + (s + 0.5)) / self.width as f32);
        Vec3::new(sin * sin_phi, if south { -cos } else { cos }, -sin * cos_phi)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    #[test]
    fn drops_add_up_to_the_sphere_even_at_the_poles() {
        for height in [1, 2, 3, 7, 512, 4096] {
            let grid = Grid { width: 1, height };
            let drops: Vec<f64> = (0..grid.rows()).map(|y| f64::from(grid.drop(y))).collect();
            let sum: f64 = drops.iter().sum();
            assert!((sum - 2.0).abs() < 1e-6, "{height}: {sum}");
            let step = core::f64::consts::PI / f64::from(grid.rows());
            let first = 2.0 * libm::sin(0.5 * step).powi(2);
            assert!((drops[0] / first - 1.0).abs() < 1e-6, "{height}");
        }
    }

    #[test]
    fn a_direction_is_found_where_it_was_made() {
        for (width, height) in [(1, 1), (1, 5), (6, 1), (8, 4), (9, 6), (512, 257), (8192, 4096)] {
            let grid = Grid { width, height };
            for i in 0..20_000_u32 {
                let u = |k| num::unit_f32(num::hash2(i, k));
                let cell = [(u(0) * width as f32) as u32, (u(1) * grid.rows() as f32) as u32];
                let (s, tau) = (0.01 + 0.98 * u(2), 0.01 + 0.98 * u(3));
                let d = grid.direction(cell, s, tau);
                assert!((d.length() - 1.0).abs() < 1e-6);
                let place = grid.place(d);
                assert_eq!([place.x, place.y], cell, "{width}×{height} {d}");
                assert!((place.s - s).abs() < 2e-3, "{} {s}", place.s);
                assert!((grid.tau(place.y, d) - tau).abs() < 2e-3, "{} {tau}", grid.tau(place.y, d));
            }
        }
    }
}
