//! All sectors of a polygon.

use super::chains::Layout;
use super::clip::Above;
use super::lanes::{self, Ends};
use super::meridian::{Cut, Meridian};
use super::sector::{Sector, WIDE};
use crate::num;
use glam::{DVec3, Vec3, Vec4};

/// The sectors of a polygon, in the order of azimuth; `N − 1` at most.
///
/// Coordinate by coordinate, so that the areas of four are worked out at once.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sectors<const N: usize> {
    /// True when they reach up to the zenith.
    pub(super) to_zenith: bool,
    /// How many there are.
    len: usize,
    /// Unit of length for places (m).
    pub(super) unit: f32,
    /// Sum of the areas (sr).
    pub(super) total: f32,
    /// Their areas (sr).
    areas: [f32; N],
    /// Their poles, as in [`Sector::new`].
    poles: [[f32; N]; 3],
    /// Their sides: the sector of index i is between those of i and i + 1.
    outer: [[f32; N]; 3],
    rises: [f32; N],
    places: [[Vec3; 2]; N],
}

/// The rise beyond which an inner end is as good as at the zenith: what is left out there is less
/// than its inverse square of the meridian's `sin² θ`, and squares of products stay finite.
const HIGH: f64 = 1e7;

/// The side that a sweep has reached.
#[derive(Debug, Clone, Copy)]
struct Reached {
    corner: usize,
    outer: DVec3,
    scale: f64,
}

impl<const N: usize> Sectors<N> {
    /// None.
    pub(super) const EMPTY: Self = Self {
        to_zenith: false,
        len: 0,
        unit: 0.0,
        total: 0.0,
        areas: [0.0; N],
        poles: [[0.0; N]; 3],
        outer: [[0.0; N]; 3],
        rises: [0.0; N],
        places: [[Vec3::ZERO; 2]; N],
    };

    /// Adds those of a polygon; none when rounding has turned it inside out, or it has no width.
    #[inline(always)]
    pub(super) fn fill(&mut self, above: &Above<N>) {
        if let Some(layout) = Layout::of(above) {
            self.to_zenith = layout.is_around();
            self.sweep(above, layout);
            self.measure();
        }
    }

    #[inline(always)]
    fn sweep(&mut self, above: &Above<N>, mut layout: Layout) {
        let n = above.corners().len();
        let cut = above.cut(&layout.first(n));
        let scale = cut.scale();
        let unit = 1.0 / scale;
        let mut before = Reached { corner: cut.corner, outer: cut.outer * scale, scale };
        self.unit = unit as f32;
        self.put(0, &cut, &before, 1.0);
        for i in 0..N - 1 {
            let Some(step) = layout.advance(above) else { break };
            let cut = above.cut(&step);
            let scale = cut.scale();
            let here = Reached { corner: cut.corner, outer: cut.outer * scale, scale };
            let width = above.azimuth_between(before.corner, here.corner);
            if width > 0.0 {
                let z = width * before.scale * scale;
                let pole = DVec3 { z, ..before.outer.cross(here.outer) };
                for (values, value) in self.poles.iter_mut().zip(pole.as_vec3().to_array()) {
                    values[i] = value;
                }
            }
            self.len = i + 1;
            self.put(i + 1, &cut, &here, (scale * unit) as f32);
            before = here;
        }
    }

    /// Stores a side.
    #[inline(always)]
    fn put(&mut self, i: usize, cut: &Cut, reached: &Reached, weight: f32) {
        for (values, value) in self.outer.iter_mut().zip(reached.outer.as_vec3().to_array()) {
            values[i] = value;
        }
        let rise = cut.rise * reached.scale;
        let kept = if rise > HIGH { HIGH / rise } else { 1.0 };
        let inner_place = cut.outer_place.lerp(cut.inner_place, kept as f32);
        self.rises[i] = (rise * kept) as f32;
        self.places[i] = [cut.outer_place * weight, inner_place * weight];
    }

    /// Works out the areas.
    #[inline(always)]
    fn measure(&mut self) {
        self.measure_four(0);
        for i in (4..self.len).step_by(4) {
            self.measure_four(i);
        }
    }

    #[inline(always)]
    fn measure_four(&mut self, i: usize) {
        let pole = self.poles.each_ref().map(|p| four(p, i));
        let (cos, areas) = lanes::areas(&self.ends(i), &self.ends(i + 1), pole, self.to_zenith);
        // Beyond the end the poles are 0, and so are the areas.
        let areas = areas.to_array();
        match self.areas.get_mut(i..i + 4) {
            Some(all) => all.copy_from_slice(&areas),
            None => self.areas.iter_mut().skip(i).zip(areas).for_each(|(slot, area)| *slot = area),
        }
        if cos.min_element() < WIDE {
            self.measure_wide(i);
        }
        self.total = self.areas.iter().sum();
        // A little more than the hemisphere is rounding.
        if self.total > num::PI && self.total < num::PI * 1.000_1 {
            self.total = num::PI;
        }
    }

    #[cold]
    fn measure_wide(&mut self, from: usize) {
        for i in from..self.len.min(from + 4) {
            let sector = self.get(i);
            if sector.is_wide() {
                // Without width, the ends may be opposite.
                self.areas[i] = if self.poles[2][i] > 0.0 { sector.area_of_halves() } else { 0.0 };
            }
        }
    }

    #[inline(always)]
    fn ends(&self, i: usize) -> Ends {
        Ends { outer: self.outer.each_ref().map(|o| four(o, i)), rise: four(&self.rises, i) }
    }

    /// The areas (sr).
    #[inline]
    pub(super) fn areas(&self) -> &[f32] {
        &self.areas[..self.len]
    }

    /// The side with the index `i`.
    #[inline]
    pub(super) fn meridian(&self, i: usize) -> Meridian {
        let [x, y, z] = self.outer.each_ref().map(|o| o[i]);
        let [outer_place, inner_place] = self.places[i];
        Meridian { outer: Vec3::new(x, y, z), rise: self.rises[i], outer_place, inner_place }
    }

    /// The sector with the index `i`.
    #[inline]
    pub(super) fn get(&self, i: usize) -> Sector {
        let pole = self.poles.each_ref().map(|p| p[i]).into();
        Sector::new(self.meridian(i), self.meridian(i + 1), pole, self.to_zenith)
    }
}

/// Four numbers from index `i` on, 0 beyond the end.
#[inline(always)]
fn four(values: &[f32], i: usize) -> Vec4 {
    match values.get(i..i + 4) {
        Some(four) => Vec4::from_slice(four),
        None => rest(values, i),
    }
}

#[cold]
fn rest(values: &[f32], i: usize) -> Vec4 {
    core::array::from_fn(|k| values.get(i + k).copied().unwrap_or(0.0)).into()
}
