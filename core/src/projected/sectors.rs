//! All sectors of a polygon.

use super::chains::{Cut, Layout, Step};
use super::clip::{Above, Outline, entry, set_entry};
use super::lanes::{self, Ends};
use super::meridian::{Meridian, Places};
use super::sector::{Sector, WIDE};
use crate::num;
use crate::num::lanes::{LANES, Lane, Number};
use glam::{DVec3, Vec2, Vec3};

/// The sectors of a polygon, in the order of azimuth; `N − 1` at most.
///
/// Coordinate by coordinate, so that several areas are worked out at once.
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
    /// What the places of the sides are made of.
    outline: Outline<N>,
    sources: [Source; N],
}

/// Where a side comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Source {
    step: Step,
    /// How much of the ends of the step's edge is in the end of the side there.
    shares: [f32; 2],
    /// What brings places to scale, and what is kept of the rise.
    weight: f32,
    kept: f32,
}

impl Source {
    const NONE: Self = Self { step: Step::FIRST, shares: [0.0; 2], weight: 0.0, kept: 0.0 };
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
        outline: Outline::EMPTY,
        sources: [Source::NONE; N],
    };

    /// Adds those of a polygon; none when rounding has turned it inside out, or it has no width.
    ///
    /// * `n` – how many corners it has
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn fill(&mut self, above: &Above<N>, n: usize) {
        if let Some(layout) = Layout::of(&above.outline, n) {
            self.to_zenith = layout.is_around();
            self.outline = above.outline;
            self.sweep(above, layout, n);
        }
    }

    /// Adds those of a polygon that may reach below the horizon.
    #[inline(never)]
    pub(super) fn fill_clipped(&mut self, above: &mut Above<N>) {
        above.clip();
        let n = above.outline.places().len();
        if n >= 3 {
            self.fill(above, n);
        }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sweep(&mut self, above: &Above<N>, mut layout: Layout, n: usize) {
        let outline = &above.outline;
        let mut before = self.put(0, above, &layout.first(n), 1.0);
        let unit = 1.0 / before.scale;
        self.unit = unit as f32;
        for i in 0..N - 1 {
            let Some(step) = layout.advance(outline, n) else { break };
            let here = self.put(i + 1, above, &step, unit);
            let width = outline.azimuth(before.corner, here.corner);
            if width > 0.0 {
                let z = width * before.scale * here.scale;
                let pole = DVec3 { z, ..before.outer.cross(here.outer) };
                for (values, value) in self.poles.iter_mut().zip(pole.as_vec3().to_array()) {
                    values[i] = value;
                }
            }
            self.len = i + 1;
            before = here;
        }
    }

    /// Stores a side; the first one sets the unit.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn put(&mut self, i: usize, above: &Above<N>, step: &Step, unit: f64) -> Reached {
        let Cut { outer, rise, shares } = above.cut(step);
        let scale = 1.0 / num::sqrt_in_double(outer.length_squared());
        let (outer, rise) = (outer * scale, rise * scale);
        for (values, value) in self.outer.iter_mut().zip(outer.as_vec3().to_array()) {
            set_entry(values, i, value);
        }
        let kept = if rise > HIGH { HIGH / rise } else { 1.0 };
        set_entry(&mut self.rises, i, (rise * kept) as f32);
        let weight = if i == 0 { 1.0 } else { (scale * unit) as f32 };
        set_entry(&mut self.sources, i, Source { step: *step, shares, weight, kept: kept as f32 });
        Reached { corner: step.corner.into(), outer, scale }
    }

    /// Works out the areas of what has been added.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn measure(&mut self) {
        self.measure_some(0);
        for i in (LANES..self.len).step_by(LANES) {
            self.measure_some(i);
        }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn measure_some(&mut self, i: usize) {
        let pole = self.poles.each_ref().map(|p| Lane::load(p, i));
        let (cos, areas) = lanes::areas(&self.ends(i), &self.ends(i + 1), pole, self.to_zenith);
        // Beyond the end the poles are 0, and so are the areas.
        areas.store(&mut self.areas, i);
        if cos.least() < WIDE {
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
        for i in from..self.len.min(from + LANES) {
            let sector = self.get(i);
            if sector.is_wide() {
                // Without width, the ends may be opposite.
                let area = if entry(&self.poles[2], i) > 0.0 { sector.area_of_halves() } else { 0.0 };
                set_entry(&mut self.areas, i, area);
            }
        }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn ends(&self, i: usize) -> Ends {
        Ends { outer: self.outer.each_ref().map(|o| Lane::load(o, i)), rise: Lane::load(&self.rises, i) }
    }

    /// The area with the index `i` (sr).
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn area(&self, i: usize) -> f32 {
        entry(&self.areas, i)
    }

    /// The areas (sr).
    #[inline]
    pub(super) fn areas(&self) -> &[f32] {
        self.areas.get(..self.len).unwrap_or_default()
    }

    /// The side with the index `i`.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn meridian(&self, i: usize) -> Meridian {
        let [x, y, z] = self.outer.each_ref().map(|o| entry(o, i));
        Meridian { outer: Vec3::new(x, y, z), rise: entry(&self.rises, i) }
    }

    /// Where the side with the index `i` is.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn places(&self, i: usize) -> Places {
        let Source { step, shares: [a, b], weight, kept } = entry(&self.sources, i);
        let here = self.outline.homogeneous(step.corner);
        let [first, last] = step.edge.map(|i| self.outline.homogeneous(i));
        let there = first * a + last * b;
        let (outer, inner) = if step.outward { (here, there) } else { (there, here) };
        Places { outer: outer * weight, inner: outer.lerp(inner, kept) * weight }
    }

    /// Where a meridian of the sector with the index `i` is.
    ///
    /// * `sides` – how much of the two sides of the sector is in it
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn places_between(&self, i: usize, sides: Vec2) -> Places {
        let (a, b) = (self.places(i), self.places(i + 1));
        Places { outer: a.outer * sides.x + b.outer * sides.y, inner: a.inner * sides.x + b.inner * sides.y }
    }

    /// The sector with the index `i`.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn get(&self, i: usize) -> Sector {
        let pole = self.poles.each_ref().map(|p| entry(p, i)).into();
        Sector::new(self.meridian(i), self.meridian(i + 1), pole, self.to_zenith)
    }
}
