//! Sampling a convex polygon: a triangle of its fan, then a place on that.

use super::{
    AreaView, Cone, FlatShape, ProjectedView, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceSample,
    SurfaceView, UseView, View, faces, flat_projected_solid_angle, is_near,
};
use crate::geom::Frame;
use crate::num::{self, ONE_MINUS_EPSILON};
use crate::projected::Chart;
use crate::shape::{Polygon, Shape, SurfacePoint, Triangle};
use crate::solid_angle::{SphericalTriangle, TrianglePlace, triangle_solid_angle};
use crate::warp;
use glam::{Vec2, Vec3};

/// What each triangle of the fan holds of a measure.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shares {
    parts: [f32; Polygon::MAX_CORNERS - 2],
    total: f32,
}

impl Shares {
    #[inline]
    fn new(shape: &Polygon, measure: impl Fn(&Triangle) -> f32) -> Self {
        let mut shares = Self { parts: [0.0; Polygon::MAX_CORNERS - 2], total: 0.0 };
        for (i, part) in shares.parts.iter_mut().take(shape.fan_len()).enumerate() {
            *part = measure(&shape.fan(i));
            shares.total += *part;
        }
        shares
    }

    /// The triangle that holds `u` of the total, and where in it.
    #[inline]
    fn choose(&self, u: f32) -> (usize, f32) {
        let mut left = u * self.total;
        let mut last = 0;
        for (i, part) in self.parts.iter().enumerate() {
            if *part > 0.0 {
                if left < *part {
                    return (i, (left / part).min(ONE_MINUS_EPSILON));
                }
                last = i;
            }
            left -= part;
        }
        (last, ONE_MINUS_EPSILON)
    }

    /// Inverse of [`Shares::choose`].
    fn join(&self, index: usize, u: f32) -> f32 {
        let before: f32 = self.parts[..index].iter().sum();
        ((before + u * self.parts[index]) / self.total).clamp(0.0, ONE_MINUS_EPSILON)
    }
}

impl SampledShape for Polygon {
    type View = View<Self, PolygonSolidAngle, ProjectedView<Self, { Polygon::MAX_CORNERS + 2 }>>;

    /// Density `1 / area` (m⁻²).
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        let (i, first) = Shares::new(self, Triangle::area).choose(u[0]);
        let [b1, b2] = warp::square_to_triangle([first, u[1]]);
        self.place(i, b1, b2)
    }

    fn normals(&self) -> Cone {
        Cone { axis: self.normal(), angle: 0.0 }
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (i, barycentric) = self.locate(point);
        let [first, second] = warp::triangle_to_square(barycentric);
        [Shares::new(self, Triangle::area).join(i, first), second]
    }

    #[inline(always)]
    fn with_view<U: UseView<Self::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        sides: Sides,
        then: U,
    ) -> Option<U::Output> {
        let chart = self.chart(from.point);
        if !faces(&chart, sides) {
            return None;
        }
        let bounds = self.bounds();
        let (centre, radius) = ((bounds.min + bounds.max) * 0.5, (bounds.max - bounds.min).length() * 0.5);
        match method.required(from, centre, radius, SurfaceDensity::Area) {
            SurfaceDensity::Area => then.with(AreaView::new(*self, from), View::Area),
            SurfaceDensity::SolidAngle => {
                then.with(PolygonSolidAngle::new(*self, from.point)?, View::SolidAngle)
            }
            _ => then.with(ProjectedView::new(self, from, &chart)?, View::Projected),
        }
    }

    fn projected_solid_angle(&self, from: &Receiver, sides: Sides) -> Option<f32> {
        Some(flat_projected_solid_angle::<_, { Self::MAX_CORNERS + 2 }>(self, from, sides))
    }
}

/// Metres from the first corner, along a frame of the normal.
impl FlatShape for Polygon {
    #[inline]
    fn chart(&self, from: Vec3) -> Chart {
        let Frame { s, t, .. } = Frame::from_normal(self.normal());
        Chart::from_axes(from, Self::corners(self)[0], s, t)
    }

    #[inline]
    fn corners(&self) -> impl AsRef<[Vec2]> {
        let Frame { s, t, .. } = Frame::from_normal(self.normal());
        let first = Self::corners(self)[0];
        let mut places = Places { places: [Vec2::ZERO; Self::MAX_CORNERS], count: Self::corners(self).len() };
        for (place, corner) in places.places.iter_mut().zip(Self::corners(self)) {
            let along = *corner - first;
            *place = Vec2::new(s.dot(along), t.dot(along));
        }
        places
    }

    #[inline]
    fn point_at(&self, place: Vec2) -> SurfacePoint {
        let Frame { s, t, n } = Frame::from_normal(self.normal());
        let (first, along) = (Self::corners(self)[0], s * place.x + t * place.y);
        SurfacePoint { point: first + along, error: (first.abs() + along.abs()) * num::gamma(8), normal: n }
    }

    fn place_of(&self, point: Vec3) -> Vec2 {
        let Frame { s, t, .. } = Frame::from_normal(self.normal());
        let along = point - Self::corners(self)[0];
        Vec2::new(s.dot(along), t.dot(along))
    }
}

/// The corners of a polygon in its plane.
struct Places {
    places: [Vec2; Polygon::MAX_CORNERS],
    count: usize,
}

impl AsRef<[Vec2]> for Places {
    fn as_ref(&self) -> &[Vec2] {
        &self.places[..self.count]
    }
}

/// A convex polygon with the density `1 / solid angle` (sr⁻¹) at every distance and angle.
///
/// The second corner of each triangle's map is the one that all share, so that the maps of
/// neighbours fit together: stratified uniforms stay stratified over the whole polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolygonSolidAngle {
    shape: Polygon,
    from: Vec3,
    shares: Shares,
}

impl PolygonSolidAngle {
    #[inline]
    fn new(shape: Polygon, from: Vec3) -> Option<Self> {
        let shares = Shares::new(&shape, |part| triangle_solid_angle(from, &part.corners()));
        (shares.total >= f32::MIN_POSITIVE && shares.total.is_finite()).then_some(Self {
            shape,
            from,
            shares,
        })
    }

    #[inline]
    fn part(&self, index: usize) -> Option<SphericalTriangle> {
        let [shared, first, second] = self.shape.fan(index).corners();
        SphericalTriangle::new(self.from, &[first, shared, second])
    }
}

impl SurfaceView for PolygonSolidAngle {
    #[inline]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        let (i, first) = self.shares.choose(u[0]);
        let TrianglePlace { barycentric: [shared, second], direction: wi, distance } =
            self.part(i)?.sample([first, u[1]])?;
        let at = self.shape.place(i, (1.0 - shared - second).max(0.0) as f32, second as f32);
        Some(SurfaceSample { at, wi, distance })
    }

    #[inline]
    fn pdf_solid_angle(&self, _: &SurfacePoint, _: Vec3, _: f32) -> Option<f32> {
        Some(1.0 / self.shares.total)
    }

    fn invert(&self, at: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        let (i, [b1, b2]) = self.shape.locate(at.point);
        let part = self.part(i)?;
        let met = part.meet(wi)?;
        let barycentric =
            if is_near(at, wi, met.distance) { met.barycentric } else { [1.0 - b1 - b2, b2].map(f64::from) };
        let [first, second] = part.invert(barycentric);
        Some([self.shares.join(i, first), second])
    }
}
