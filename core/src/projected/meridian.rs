//! Meridians of a polygon: what it has at one azimuth.

use glam::{DVec3, Vec3};

/// The stretch of a meridian inside a polygon: between its outer boundary, nearer the horizon, and
/// its inner one, nearer the zenith.
///
/// The scale is such that the outer end is a unit vector; the inner end has the same azimuth vector.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Meridian {
    /// The outer end: azimuth vector, and height.
    pub(super) outer: Vec3,
    /// By how much the inner end is higher.
    pub(super) rise: f32,
    /// The outer end in homogeneous coordinates of the plane.
    pub(super) outer_place: Vec3,
    /// The inner end likewise.
    pub(super) inner_place: Vec3,
}

impl Meridian {
    #[inline]
    pub(super) fn times(self, k: f32) -> Self {
        Self {
            outer: self.outer * k,
            rise: self.rise * k,
            outer_place: self.outer_place * k,
            inner_place: self.inner_place * k,
        }
    }

    /// The meridian at the fraction `t` of the chords from `self` to `other`.
    #[inline]
    pub(super) fn toward(&self, other: &Self, t: f32) -> Self {
        let s = 1.0 - t;
        Self {
            outer: self.outer * s + other.outer * t,
            rise: self.rise * s + other.rise * t,
            outer_place: self.outer_place * s + other.outer_place * t,
            inner_place: self.inner_place * s + other.inner_place * t,
        }
    }

    /// Sum of the heights of both ends.
    #[inline]
    pub(super) fn height_sum(&self) -> f32 {
        2.0 * self.outer.z + self.rise
    }

    /// Square of the inner end's length less that of the outer one's.
    #[inline]
    pub(super) fn square_rise(&self) -> f32 {
        self.rise * self.height_sum()
    }

    /// The place at a height above the outer end, in homogeneous coordinates.
    #[inline]
    pub(super) fn place(&self, height: f32) -> Vec3 {
        let t = if self.rise > 0.0 { (height / self.rise).min(1.0) } else { 0.0 };
        self.outer_place * (1.0 - t) + self.inner_place * t
    }

    /// The height of a place above the outer end: the inverse of [`Meridian::place`].
    #[inline]
    pub(super) fn height(&self, place: Vec3) -> f32 {
        let f = fraction(place, self.outer_place, self.inner_place);
        let outer = f * self.outer_place.z;
        let sum = outer + (1.0 - f) * self.inner_place.z;
        if sum > 0.0 { self.rise * (outer / sum) } else { 0.0 }
    }
}

/// A meridian through a corner, before it is brought to scale.
#[derive(Debug, Clone, Copy)]
pub(super) struct Cut {
    /// The corner.
    pub(super) corner: usize,
    /// The outer end: azimuth vector, and height.
    pub(super) outer: DVec3,
    /// By how much the inner end is higher.
    pub(super) rise: f64,
    /// The outer end in homogeneous coordinates of the plane.
    pub(super) outer_place: Vec3,
    /// The inner end likewise.
    pub(super) inner_place: Vec3,
}

impl Cut {
    /// What brings the outer end to unit length (m⁻¹).
    #[inline]
    pub(super) fn scale(&self) -> f64 {
        1.0 / self.outer.length()
    }
}

/// Where a place is between two others, in `[0, 1]`; all in homogeneous coordinates.
#[inline]
pub(super) fn fraction(place: Vec3, from: Vec3, to: Vec3) -> f32 {
    let [place, from, to] = [place, from, to].map(|p| p.truncate() / p.z);
    let whole = to - from;
    let squared = whole.length_squared();
    if squared > 0.0 { ((place - from).dot(whole) / squared).clamp(0.0, 1.0) } else { 0.0 }
}
