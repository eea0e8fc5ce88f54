//! Sampling a convex polygon in proportion to the receiver's cosine.

use super::Chart;
use super::clip::Above;
use super::meridian::{Meridian, Places, fraction};
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

/// Where a point was found.
#[derive(Debug, Clone, Copy)]
struct Found {
    /// The index of the sector.
    index: usize,
    /// The sector, or half of it.
    sector: Sector,
    /// The projected solid angle before that (sr).
    before: f32,
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
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[must_use]
    pub fn new(normal: Vec3, chart: &Chart, corners: &[Vec2]) -> Option<Self> {
        let mut polygon = Self::EMPTY;
        if polygon.prepare(normal, chart, corners) { Some(polygon) } else { None }
    }

    /// Nothing yet.
    pub(crate) const EMPTY: Self = Self {
        frame: Frame { s: Vec3::ZERO, t: Vec3::ZERO, n: Vec3::ZERO },
        zenith: Vec3::ZERO,
        sectors: Sectors::EMPTY,
    };

    /// [`ProjectedPolygon::new`] in place, from nothing; false instead of `None`.
    #[cfg_attr(not(feature = "small"), inline(always))]
    pub(crate) fn prepare(&mut self, normal: Vec3, chart: &Chart, corners: &[Vec2]) -> bool {
        self.frame = Frame::from_normal(normal);
        self.cut(chart, corners);
        self.sectors.measure();
        // More than the hemisphere is rounding, of numbers too far apart for double precision.
        self.sectors.total > 0.0 && self.sectors.total < num::PI * 1.000_1
    }

    /// Cuts what is above the horizon into sectors.
    #[cfg_attr(not(feature = "small"), inline(always))]
    #[cfg_attr(feature = "small", inline(never))]
    fn cut(&mut self, chart: &Chart, corners: &[Vec2]) {
        let mut above = Above::<N>::EMPTY;
        if above.fill(&mut self.frame, chart, corners) {
            // Their number as the caller knows it: as a constant, for all but polygons.
            self.sectors.fill(&above, corners.len());
        } else {
            self.sectors.fill_clipped(&mut above);
        }
        self.zenith = (above.outline.zenith * (f64::from(self.sectors.unit) / above.volume)).as_vec3();
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
    #[cfg_attr(not(feature = "small"), inline)]
    #[cfg_attr(feature = "small", inline(never))]
    #[must_use]
    pub fn sample(&self, u: [f32; 2]) -> Option<PolygonSample> {
        let (i, mut area) = self.pick(u[0].max(LOWEST) * self.sectors.total);
        let (mut sector, mut whole) = (self.sectors.get(i), self.sectors.area(i));
        if sector.is_wide() {
            (sector, area, whole) = sector.half_at(area);
        }
        let (meridian, sides) = sector.at(sector.fraction_at(area, whole));
        let above = sector.height_of(&meridian, u[1].max(LOWEST));
        let v = meridian.outer + Vec3::Z * above;
        let places = self.sectors.places_between(i, sides);
        let place = if self.sectors.to_zenith {
            places.outer + self.zenith * above
        } else {
            places.at(above, meridian.rise)
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
            |_, places| self.zenith.dot(places.outer.cross(place)),
            |meridian, places| {
                if self.sectors.to_zenith {
                    self.height_toward_zenith(places.outer, place)
                } else {
                    places.height(place, meridian.rise)
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
            |end, _| end.outer.truncate().perp_dot(across),
            |meridian, _| {
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
    fn invert_at(
        &self,
        beyond: impl Fn(&Meridian, &Places) -> f32,
        height: impl Fn(&Meridian, &Places) -> f32,
    ) -> [f32; 2] {
        let found = self.locate(&beyond);
        let to = |t| {
            let (meridian, sides) = found.sector.at(t);
            (meridian, self.sectors.places_between(found.index, sides))
        };
        let ((first, at_first), (last, at_last)) = (to(0.0), to(1.0));
        let from_first = beyond(&first, &at_first).max(0.0);
        let to_last = (-beyond(&last, &at_last)).max(0.0);
        let sum = from_first + to_last;
        let t = if sum > 0.0 { from_first / sum } else { 0.0 };
        let (meridian, places) = to(t);
        let share = (found.before + found.sector.area_to(t)) / self.sectors.total;
        [share, found.sector.share_below(&meridian, height(&meridian, &places))].map(num::clamp_unit)
    }

    /// The sector in which a point is, half of it when it is wide.
    fn locate(&self, beyond: impl Fn(&Meridian, &Places) -> f32) -> Found {
        let side = |i| beyond(&self.sectors.meridian(i), &self.sectors.places(i));
        let is_inside = |i: &usize| side(*i) >= 0.0 && side(i + 1) <= 0.0;
        let areas = self.sectors.areas();
        let parts = || (0..areas.len()).filter(|i| areas[*i] > 0.0);
        // In the last one at the latest, as far as rounding goes.
        let index = parts().find(is_inside).or_else(|| parts().next_back()).unwrap_or(0);
        let before = areas[..index].iter().sum();
        let sector = self.sectors.get(index);
        if !sector.is_wide() {
            return Found { index, sector, before };
        }
        let [first, last] = sector.halves();
        let (middle, sides) = first.at(1.0);
        if beyond(&middle, &self.sectors.places_between(index, sides)) <= 0.0 {
            Found { index, sector: first, before }
        } else {
            Found { index, sector: last, before: before + first.area_to(1.0) }
        }
    }

    /// The height above the outer end of a place between there and the zenith.
    #[inline]
    fn height_toward_zenith(&self, outer: Vec3, place: Vec3) -> f32 {
        let f = fraction(place, outer, self.zenith).min(num::ONE_MINUS_EPSILON);
        f * outer.z / ((1.0 - f) * self.zenith.z)
    }
}
