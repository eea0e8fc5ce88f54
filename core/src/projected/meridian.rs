//! Meridians of a polygon: what it has at one azimuth.

use glam::Vec3;

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
}

impl Meridian {
    #[inline]
    pub(super) fn times(self, k: f32) -> Self {
        Self { outer: self.outer * k, rise: self.rise * k }
    }

    /// The meridian at the fraction `t` of the chords from `self` to `other`.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn toward(&self, other: &Self, t: f32) -> Self {
        let s = 1.0 - t;
        Self { outer: self.outer * s + other.outer * t, rise: self.rise * s + other.rise * t }
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
}

/// Where the ends of a meridian are, in homogeneous coordinates of the plane and to its scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Places {
    pub(super) outer: Vec3,
    pub(super) inner: Vec3,
}

impl Places {
    /// The place at a height above the outer end of a meridian with a rise.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(super) fn at(&self, height: f32, rise: f32) -> Vec3 {
        let t = if rise > 0.0 { (height / rise).min(1.0) } else { 0.0 };
        self.outer * (1.0 - t) + self.inner * t
    }

    /// The height of a place above the outer end: the inverse of [`Places::at`].
    #[inline]
    pub(super) fn height(&self, place: Vec3, rise: f32) -> f32 {
        let f = fraction(place, self.outer, self.inner);
        let outer = f * self.outer.z;
        let sum = outer + (1.0 - f) * self.inner.z;
        if sum > 0.0 { rise * (outer / sum) } else { 0.0 }
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
