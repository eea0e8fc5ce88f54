//! Sampling a convex polygon in proportion to the receiver's cosine.

use super::Chart;
use super::chains::Layout;
use super::clip::Above;
use super::meridian::{Cut, Meridian, fraction};
use super::sector::Sector;
use crate::geom::Frame;
use crate::num;
use glam::{DVec3, Vec2, Vec3};

/// The part of a planar convex polygon above a receiver's horizon, ready to be sampled uniformly over
/// its projected solid angle.
///
/// It is cut along meridians into sectors between at most two edges. The first uniform picks the
/// sector and the azimuth, the second the height.
///
/// * `N` – four more than the polygon has corners: the horizon may cut off one and leave two, and the
///   largest sectors, three at most, are halved
///
/// Source: Peters 2021, *BRDF Importance Sampling for Polygonal Lights*, TOG 40(4), section 4.
/// Differs: the sectors' areas and their inverses are sums of what is known without cancellation, so
/// that no light is too small or too far; the place on the polygon comes with the direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProjectedPolygon<const N: usize> {
    frame: Frame,
    /// One unit of length (m).
    unit: f32,
    /// The zenith in homogeneous coordinates of the plane, times `volume`.
    zenith: Vec3,
    /// Determinant of the plane's origin and axes.
    volume: f32,
    sectors: [Sector; N],
    len: usize,
    /// Sum of the sectors' areas (sr).
    total: f32,
}

/// A direction toward a polygon, and where it meets it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolygonSample {
    /// Unit direction.
    pub wi: Vec3,
    /// Distance to the polygon (m).
    pub distance: f32,
    /// Where it meets the polygon, in the coordinates of the [`Chart`].
    pub place: Vec2,
}

/// The lowest uniform that is used: the middle of the first cell, as 0 may be on the horizon itself.
const LOWEST: f32 = 0.5 * num::UNIT_ROUND_OFF;

impl<const N: usize> ProjectedPolygon<N> {
    /// Prepares a polygon; `None` when nothing of it is above the horizon, or the receiver is in its
    /// plane.
    ///
    /// * `normal` – the receiver's unit normal
    /// * `chart` – the polygon's plane, seen from the receiver
    /// * `corners` – at most `N − 4`, convex, counter-clockwise in the chart's coordinates
    #[inline]
    #[must_use]
    pub fn new(normal: Vec3, chart: &Chart, corners: &[Vec2]) -> Option<Self> {
        let above = Above::<N>::new(normal, chart, corners)?;
        let Above { frame, unit, .. } = above;
        let (volume, zenith) = (above.volume as f32, above.zenith.as_vec3());
        let mut polygon =
            Self { frame, unit, zenith, volume, sectors: [Sector::ZERO; N], len: 0, total: 0.0 };
        match Layout::of(&above)? {
            Layout::Around => polygon.sweep(&above, true, above.around()),
            Layout::Beside(chains) => polygon.sweep(&above, false, chains.meridians()),
        }
        // More than the hemisphere is rounding, of numbers too far apart for double precision.
        (polygon.total > 0.0 && polygon.total < num::PI * 1.000_1).then_some(polygon)
    }

    /// Adds the sectors between meridians, which come in the order of their azimuth.
    #[inline]
    fn sweep(&mut self, above: &Above<N>, to_zenith: bool, mut cuts: impl Iterator<Item = Cut>) {
        let Some(mut before) = cuts.next() else { return };
        let mut scale = before.scale();
        for cut in cuts {
            let cut_scale = cut.scale();
            let width = above.azimuth_between(before.corner, cut.corner);
            if width > 0.0 {
                let pole = DVec3 { z: width, ..before.outer.cross(cut.outer) } * (scale * cut_scale);
                let [first, last] = [before.scaled(scale), cut.scaled(cut_scale)];
                self.push(Sector::new(first, last, pole.as_vec3(), to_zenith));
            }
            (before, scale) = (cut, cut_scale);
        }
    }

    /// Adds a sector.
    #[inline]
    fn push(&mut self, sector: Sector) {
        if sector.is_wide() {
            return self.push_halves(&sector);
        }
        if let Some(slot) = self.sectors.get_mut(self.len) {
            *slot = sector;
            self.total += slot.measure();
            self.len += 1;
        }
    }

    #[cold]
    fn push_halves(&mut self, sector: &Sector) {
        let [first, last] = sector.halves();
        self.push(first);
        self.push(last);
    }

    /// The projected solid angle (sr), above 0 and at most π.
    #[inline]
    #[must_use]
    pub fn projected_solid_angle(&self) -> f32 {
        self.total
    }

    /// Density of the unit direction `wi`, which meets the polygon: `cos θ / E` (sr⁻¹); `None` below the
    /// horizon.
    #[inline]
    #[must_use]
    pub fn pdf_solid_angle(&self, wi: Vec3) -> Option<f32> {
        let pdf = self.frame.n.dot(wi) / self.total;
        (pdf > 0.0 && pdf < f32::INFINITY).then_some(pdf)
    }

    /// Draws a direction; `None` when rounding leaves none.
    ///
    /// * `u` – two independent uniforms, each in `[0, 1)`
    #[inline]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> Option<PolygonSample> {
        let (sector, area) = self.pick(u[0].max(LOWEST) * self.total);
        let meridian = sector.at(sector.fraction_at(area));
        let above = sector.height_of(&meridian, u[1].max(LOWEST));
        let v = meridian.outer + Vec3::Z * above;
        let place = if sector.is_to_zenith() {
            meridian.outer_place + self.zenith * (above / self.volume)
        } else {
            meridian.place(above)
        };
        let length = num::sqrt(v.length_squared());
        let distance = length / place.z * self.unit;
        let wi = self.frame.to_world(v / length);
        let place = place.truncate() / place.z;
        (distance > 0.0 && distance < f32::INFINITY && wi.is_finite() && place.is_finite())
            .then_some(PolygonSample { wi, distance, place })
    }

    /// The sector in which the projected solid angle `area` ends, and what of it remains (sr).
    #[inline]
    fn pick(&self, mut area: f32) -> (&Sector, f32) {
        let mut picked = &self.sectors[0];
        for sector in &self.sectors[1..self.len] {
            if area < picked.area() {
                break;
            }
            area -= picked.area();
            picked = sector;
        }
        (picked, area.min(picked.area()))
    }

    /// The uniforms for which [`ProjectedPolygon::sample`] draws the point at `place`, in the chart's
    /// coordinates; each in `[0, 1)`.
    #[must_use]
    pub fn invert(&self, place: Vec2) -> [f32; 2] {
        let place = place.extend(1.0);
        let azimuth = |a: Vec3, b: Vec3| self.zenith.dot(a.cross(b));
        let mut before = 0.0;
        for (i, sector) in self.sectors[..self.len].iter().enumerate() {
            let from_first = azimuth(sector.first.outer_place, place);
            let to_last = azimuth(place, sector.last.outer_place);
            // In the last one at the latest, as far as rounding goes.
            if (from_first >= 0.0 && to_last >= 0.0) || i + 1 == self.len {
                let (a, b) = (from_first.max(0.0), to_last.max(0.0));
                let t = if a + b > 0.0 { a / (a + b) } else { 0.0 };
                let meridian = sector.at(t);
                let share = (before + sector.area_to(t)) / self.total;
                let above = if sector.is_to_zenith() {
                    self.height_toward_zenith(&meridian, place)
                } else {
                    meridian.height(place)
                };
                let v = sector.share_below(&meridian, above);
                return [share, v].map(|u| if u > 0.0 { u.min(num::ONE_MINUS_EPSILON) } else { 0.0 });
            }
            before += sector.area();
        }
        [0.0; 2]
    }

    /// The height above the outer end of a place between there and the zenith.
    #[inline]
    fn height_toward_zenith(&self, meridian: &Meridian, place: Vec3) -> f32 {
        let f = fraction(place, meridian.outer_place, self.zenith).min(num::ONE_MINUS_EPSILON);
        f * meridian.outer_place.z * self.volume / ((1.0 - f) * self.zenith.z)
    }
}
