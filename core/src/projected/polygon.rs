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
/// * `N` – two more than the polygon has corners: the horizon may cut off one and leave two, and
///   around the zenith the first meridian is the last as well
///
/// Source: Peters 2021, *BRDF Importance Sampling for Polygonal Lights*, TOG 40(4), section 4.
/// Differs: the sectors' areas and their inverses are sums of what is known without cancellation, so
/// that no light is too small or too far; the place on the polygon comes with the direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProjectedPolygon<const N: usize> {
    frame: Frame,
    /// Unit of length for places (m).
    unit: f32,
    /// The zenith in homogeneous coordinates of the plane.
    zenith: Vec3,
    /// True when the sectors reach up to the zenith.
    to_zenith: bool,
    /// The sectors' sides: that of index i is between the meridians i and i + 1.
    meridians: [Meridian; N],
    /// The sectors' poles, as in [`Sector::new`].
    poles: [Vec3; N],
    /// The sectors' areas (sr).
    areas: [f32; N],
    /// How many sectors there are.
    len: usize,
    /// Sum of the areas (sr).
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
    /// * `corners` – at most `N − 2`, convex, counter-clockwise in the chart's coordinates
    #[inline]
    #[must_use]
    pub fn new(normal: Vec3, chart: &Chart, corners: &[Vec2]) -> Option<Self> {
        let above = Above::<N>::new(normal, chart, corners)?;
        let polygon = match Layout::of(&above)? {
            Layout::Around => Self::sweep(&above, true, above.around())?,
            Layout::Beside(chains) => Self::sweep(&above, false, chains.meridians())?,
        };
        // More than the hemisphere is rounding, of numbers too far apart for double precision.
        (polygon.total > 0.0 && polygon.total < num::PI * 1.000_1).then_some(polygon)
    }

    /// The sectors between meridians, which come in the order of their azimuth.
    #[inline]
    fn sweep(above: &Above<N>, to_zenith: bool, mut cuts: impl Iterator<Item = Cut>) -> Option<Self> {
        let mut before = cuts.next()?;
        let mut scale = before.scale();
        let unit = 1.0 / scale;
        let mut polygon = Self {
            frame: above.frame,
            unit: unit as f32,
            zenith: (above.zenith * (unit / above.volume)).as_vec3(),
            to_zenith,
            meridians: [Meridian::ZERO; N],
            poles: [Vec3::ZERO; N],
            areas: [0.0; N],
            len: 0,
            total: 0.0,
        };
        let mut first = before.scaled(scale, unit);
        polygon.meridians[0] = first;
        for cut in cuts.take(N - 1) {
            let cut_scale = cut.scale();
            let last = cut.scaled(cut_scale, unit);
            let width = above.azimuth_between(before.corner, cut.corner);
            if width > 0.0 {
                let pole = DVec3 { z: width, ..before.outer.cross(cut.outer) } * (scale * cut_scale);
                polygon.poles[polygon.len] = pole.as_vec3();
                let area = Sector::new(first, last, pole.as_vec3(), to_zenith).area();
                polygon.areas[polygon.len] = area;
                polygon.total += area;
            }
            polygon.len += 1;
            polygon.meridians[polygon.len] = last;
            (before, scale, first) = (cut, cut_scale, last);
        }
        Some(polygon)
    }

    #[inline]
    fn sector(&self, i: usize) -> Sector {
        Sector::new(self.meridians[i], self.meridians[i + 1], self.poles[i], self.to_zenith)
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
        let (i, mut area) = self.pick(u[0].max(LOWEST) * self.total);
        let (mut sector, mut whole) = (self.sector(i), self.areas[i]);
        if sector.is_wide() {
            (sector, area) = sector.half_at(area);
            whole = sector.area();
        }
        let meridian = sector.at(sector.fraction_at(area, whole));
        let above = sector.height_of(&meridian, u[1].max(LOWEST));
        let v = meridian.outer + Vec3::Z * above;
        let place =
            if self.to_zenith { meridian.outer_place + self.zenith * above } else { meridian.place(above) };
        let length = num::sqrt(v.length_squared());
        let distance = length / place.z * self.unit;
        let wi = self.frame.to_world(v / length);
        let place = place.truncate() / place.z;
        (distance > 0.0 && distance < f32::INFINITY && wi.is_finite() && place.is_finite())
            .then_some(PolygonSample { wi, distance, place })
    }

    /// The sector in which the projected solid angle `area` ends, and what of it remains (sr).
    #[inline]
    fn pick(&self, mut area: f32) -> (usize, f32) {
        let mut picked = (0, 0.0);
        for (i, part) in self.areas[..self.len].iter().copied().enumerate() {
            if part > 0.0 {
                picked = (i, area.min(part));
                if area < part {
                    break;
                }
                area -= part;
            }
        }
        picked
    }

    /// The uniforms for which [`ProjectedPolygon::sample`] draws the point at `place`, in the chart's
    /// coordinates; each in `[0, 1)`.
    #[must_use]
    pub fn invert(&self, place: Vec2) -> [f32; 2] {
        let place = place.extend(1.0);
        let (sector, before) = self.locate(place);
        let from_first = self.azimuth(sector.first.outer_place, place).max(0.0);
        let to_last = self.azimuth(place, sector.last.outer_place).max(0.0);
        let sum = from_first + to_last;
        let t = if sum > 0.0 { from_first / sum } else { 0.0 };
        let meridian = sector.at(t);
        let above =
            if self.to_zenith { self.height_toward_zenith(&meridian, place) } else { meridian.height(place) };
        let share = (before + sector.area_to(t)) / self.total;
        [share, sector.share_below(&meridian, above)].map(num::clamp_unit)
    }

    /// The sector in which a place is, half of it when it is wide, and the area before that (sr).
    fn locate(&self, place: Vec3) -> (Sector, f32) {
        let is_before = |end: &Meridian| self.azimuth(place, end.outer_place) >= 0.0;
        let is_inside = |i: &usize| {
            self.azimuth(self.meridians[*i].outer_place, place) >= 0.0 && is_before(&self.meridians[i + 1])
        };
        let parts = || (0..self.len).filter(|i| self.areas[*i] > 0.0);
        // In the last one at the latest, as far as rounding goes.
        let i = parts().find(is_inside).or_else(|| parts().last()).unwrap_or(0);
        let before = self.areas[..i].iter().sum();
        let sector = self.sector(i);
        if !sector.is_wide() {
            return (sector, before);
        }
        let [first, last] = sector.halves();
        if is_before(&first.last) { (first, before) } else { (last, before + first.area()) }
    }

    /// Cross product of the azimuths of two places, up to a factor.
    #[inline]
    fn azimuth(&self, a: Vec3, b: Vec3) -> f32 {
        self.zenith.dot(a.cross(b))
    }

    /// The height above the outer end of a place between there and the zenith.
    #[inline]
    fn height_toward_zenith(&self, meridian: &Meridian, place: Vec3) -> f32 {
        let f = fraction(place, meridian.outer_place, self.zenith).min(num::ONE_MINUS_EPSILON);
        f * meridian.outer_place.z / ((1.0 - f) * self.zenith.z)
    }
}
