//! Sampling a convex polygon: a triangle of its fan, then a place on that.

use super::{
    Cone, FlatShape, ProjectedView, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceSample,
    SurfaceView, UseView, View, flat_projected_solid_angle, is_near,
};
use crate::geom::Frame;
use crate::num::{self, ONE_MINUS_EPSILON};
use crate::projected::Chart;
use crate::shape::{Polygon, Shape, SurfacePoint};
use crate::solid_angle::{Apex, Corner, SphericalTriangle, TrianglePlace, half_solid_angle};
use crate::warp;
use glam::{Vec2, Vec3, Vec4};

/// Room for the triangles of a fan, four at a time.
const LANES: usize = 8;

/// What each triangle of the fan holds of a measure; 0 beyond the last.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Shares {
    parts: [f32; LANES],
    total: f32,
}

impl Shares {
    const NONE: Self = Self { parts: [0.0; LANES], total: 0.0 };

    #[inline]
    fn of_area(shape: &Polygon) -> Self {
        let mut shares = Self::NONE;
        for i in 0..shape.fan_len() {
            shares.parts[i] = shape.fan(i).area();
            shares.total += shares.parts[i];
        }
        shares
    }

    /// Shares of the solid angle (sr).
    #[inline]
    fn of_solid_angle(shape: &Polygon, from: Vec3) -> Self {
        let mut shares = Self::NONE;
        let [first, second, rest @ ..] = shape.corners() else { return shares };
        let apex = Apex::new(from, *first);
        let mut before = Corner::new(&apex, *second);
        let (mut sin, mut cos) = ([0.0; LANES], [1.0; LANES]);
        for (i, corner) in rest.iter().enumerate() {
            let next = Corner::new(&apex, *corner);
            [sin[i], cos[i]] = half_solid_angle(&apex, &before, &next);
            before = next;
        }
        let four = |i: usize| {
            let [sin, cos] = [&sin, &cos].map(|all| Vec4::from_slice(&all[i..]));
            let angles = num::atan2_of_four(sin, cos) * 2.0;
            // NaN at a corner.
            Vec4::select(angles.cmpgt(Vec4::ZERO), angles, Vec4::ZERO)
        };
        let angles = [four(0), if rest.len() > 4 { four(4) } else { Vec4::ZERO }];
        shares.parts[..4].copy_from_slice(&angles[0].to_array());
        shares.parts[4..].copy_from_slice(&angles[1].to_array());
        shares.total = shares.parts.iter().sum();
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
        let (i, first) = Shares::of_area(self).choose(u[0]);
        let [b1, b2] = warp::square_to_triangle([first, u[1]]);
        self.place(i, b1, b2)
    }

    fn normals(&self) -> Cone {
        Cone { axis: self.normal(), angle: 0.0 }
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (i, barycentric) = self.locate(point);
        let [first, second] = warp::triangle_to_square(barycentric);
        [Shares::of_area(self).join(i, first), second]
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn with_view<U: UseView<Self::View>>(
        &self,
        from: &Receiver,
        method: SurfaceDensity,
        sides: Sides,
        then: U,
    ) -> Option<U::Output> {
        self.with_flat_view(from, method, sides, then)
    }

    fn projected_solid_angle(&self, from: &Receiver, sides: Sides) -> Option<f32> {
        Some(flat_projected_solid_angle::<_, { Self::MAX_CORNERS + 2 }>(self, from, sides))
    }
}

/// Metres from the first corner, along a frame of the normal.
impl FlatShape for Polygon {
    type SolidAngle = PolygonSolidAngle;

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn solid_angle_view(&self, from: Vec3, _: &Chart) -> Option<PolygonSolidAngle> {
        PolygonSolidAngle::new(*self, from)
    }

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
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn new(shape: Polygon, from: Vec3) -> Option<Self> {
        let shares = Shares::of_solid_angle(&shape, from);
        (shares.total >= f32::MIN_POSITIVE && shares.total.is_finite()).then_some(Self {
            shape,
            from,
            shares,
        })
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn part(&self, index: usize) -> Option<SphericalTriangle> {
        let [shared, first, second] = self.shape.fan(index).corners();
        let apex = Apex::new(self.from, first);
        let (shared, second) = (Corner::new(&apex, shared), Corner::new(&apex, second));
        SphericalTriangle::from_corners(&apex, &shared, &second, self.shares.parts[index])
    }
}

impl SurfaceView for PolygonSolidAngle {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        let (i, first) = self.shares.choose(u[0]);
        let TrianglePlace { barycentric: [shared, second], direction: wi, distance } =
            self.part(i)?.sample([first, u[1]])?;
        let at = self.shape.place(i, (1.0 - shared - second).max(0.0) as f32, second as f32);
        Some(SurfaceSample { at, wi, distance })
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
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
