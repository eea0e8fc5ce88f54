//! Sampling a convex polygon in proportion to the receiver's cosine.

use super::Chart;
use super::clip::Above;
use super::meridian::{Meridian, fraction};
use super::sector::Sector;
use super::sectors::Sectors;
use crate::geom::Frame;
use crate::num;
use glam::{Vec2, Vec3};

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
    /// The zenith in homogeneous coordinates of the plane.
    zenith: Vec3,
    sectors: Sectors<N>,
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
        let above = Above::<N>::new(normal, chart, corners);
        if above.corners().len() < 3 {
            return None;
        }
        let mut polygon = Self { frame: above.frame, zenith: Vec3::ZERO, sectors: Sectors::EMPTY };
        polygon.sectors.fill(&above);
        let Sectors { total, unit, .. } = polygon.sectors;
        polygon.zenith = (above.zenith * (f64::from(unit) / above.volume)).as_vec3();
        // More than the hemisphere is rounding, of numbers too far apart for double precision.
        if total > 0.0 && total < num::PI * 1.000_1 { Some(polygon) } else { None }
    }

    /// The projected solid angle (sr), above 0 and at most π.
    #[inline]
    #[must_use]
    pub fn projected_solid_angle(&self) -> f32 {
        self.sectors.total
    }

    /// Density of the unit direction `wi`, which meets the polygon: `cos θ / E` (sr⁻¹); `None` below the
    /// horizon.
    #[inline]
    #[must_use]
    pub fn pdf_solid_angle(&self, wi: Vec3) -> Option<f32> {
        let pdf = self.frame.n.dot(wi) / self.sectors.total;
        (pdf > 0.0 && pdf < f32::INFINITY).then_some(pdf)
    }

    /// Draws a direction; `None` when rounding leaves none.
    ///
    /// * `u` – two independent uniforms, each in `[0, 1)`
    #[inline]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> Option<PolygonSample> {
        let (i, mut area) = self.pick(u[0].max(LOWEST) * self.sectors.total);
        let (mut sector, mut whole) = (self.sectors.get(i), self.sectors.areas()[i]);
        if sector.is_wide() {
            (sector, area, whole) = sector.half_at(area);
        }
        let meridian = sector.at(sector.fraction_at(area, whole));
        let above = sector.height_of(&meridian, u[1].max(LOWEST));
        let v = meridian.outer + Vec3::Z * above;
        let place = if self.sectors.to_zenith {
            meridian.outer_place + self.zenith * above
        } else {
            meridian.place(above)
        };
        let length = num::sqrt(v.length_squared());
        let distance = length / place.z * self.sectors.unit;
        let wi = self.frame.to_world(v / length);
        let place = place.truncate() / place.z;
        (distance > 0.0 && distance < f32::INFINITY && (wi.element_sum() + place.element_sum()).is_finite())
            .then_some(PolygonSample { wi, distance, place })
    }

    /// The sector in which the projected solid angle `area` ends, and what of it remains (sr).
    #[inline]
    fn pick(&self, mut area: f32) -> (usize, f32) {
        let mut picked = (0, 0.0);
        for (i, part) in self.sectors.areas().iter().copied().enumerate() {
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
        self.invert_at(
            |end| self.zenith.dot(end.outer_place.cross(place)),
            |meridian| {
                if self.sectors.to_zenith {
                    self.height_toward_zenith(meridian, place)
                } else {
                    meridian.height(place)
                }
            },
        )
    }

    /// The same for the point that the unit direction `wi` meets: near the polygon, where a place of
    /// single precision does not tell directions apart.
    #[must_use]
    pub fn invert_direction(&self, wi: Vec3) -> [f32; 2] {
        let v = self.frame.to_local(wi);
        let across = v.truncate();
        self.invert_at(
            |end| end.outer.truncate().perp_dot(across),
            |meridian| {
                let scale = num::sqrt(meridian.outer.truncate().length_squared() / across.length_squared());
                // The zenith is as high as anything that has a square.
                let above = (v.z * scale.min(1.0e15) - meridian.outer.z).max(0.0);
                if self.sectors.to_zenith { above } else { above.min(meridian.rise) }
            },
        )
    }

    /// The uniforms of a point by how far its azimuth is beyond that of a meridian, and by its height
    /// above the outer end of its own.
    ///
    /// * `beyond` – cross product of both azimuths, up to a factor
    fn invert_at(&self, beyond: impl Fn(&Meridian) -> f32, height: impl Fn(&Meridian) -> f32) -> [f32; 2] {
        let (sector, before) = self.locate(&beyond);
        let from_first = beyond(&sector.first).max(0.0);
        let to_last = (-beyond(&sector.last)).max(0.0);
        let sum = from_first + to_last;
        let t = if sum > 0.0 { from_first / sum } else { 0.0 };
        let meridian = sector.at(t);
        let share = (before + sector.area_to(t)) / self.sectors.total;
        [share, sector.share_below(&meridian, height(&meridian))].map(num::clamp_unit)
    }

    /// The sector in which a point is, half of it when it is wide, and the area before that (sr).
    fn locate(&self, beyond: impl Fn(&Meridian) -> f32) -> (Sector, f32) {
        let is_before = |end: &Meridian| beyond(end) <= 0.0;
        let is_inside =
            |i: &usize| beyond(&self.sectors.meridian(*i)) >= 0.0 && is_before(&self.sectors.meridian(i + 1));
        let areas = self.sectors.areas();
        let parts = || (0..areas.len()).filter(|i| areas[*i] > 0.0);
        // In the last one at the latest, as far as rounding goes.
        let i = parts().find(is_inside).or_else(|| parts().next_back()).unwrap_or(0);
        let before = areas[..i].iter().sum();
        let sector = self.sectors.get(i);
        if !sector.is_wide() {
            return (sector, before);
        }
        let [first, last] = sector.halves();
        if is_before(&first.last) { (first, before) } else { (last, before + first.area_to(1.0)) }
    }

    /// The height above the outer end of a place between there and the zenith.
    #[inline]
    fn height_toward_zenith(&self, meridian: &Meridian, place: Vec3) -> f32 {
        let f = fraction(place, meridian.outer_place, self.zenith).min(num::ONE_MINUS_EPSILON);
        f * meridian.outer_place.z / ((1.0 - f) * self.zenith.z)
    }
}
