//! Sampling a rectangle.

use super::{
    Cone, FlatShape, ProjectedView, Receiver, SampledShape, Sides, SurfaceDensity, SurfaceSample,
    SurfaceView, UseView, View, flat_projected_solid_angle,
};
use crate::num::{self, ONE_MINUS_EPSILON};
use crate::projected::Chart;
use crate::shape::{Rectangle, SurfacePoint};
use crate::solid_angle::{RectanglePlace, SphericalRectangle};
use glam::{Vec2, Vec3};

impl SampledShape for Rectangle {
    type View = View<Self, RectangleSolidAngle, ProjectedView<Self, 6>>;

    /// Density `1 / (w h)` (m⁻²).
    #[inline]
    fn sample_area(&self, u: [f32; 2]) -> SurfacePoint {
        self.point(2.0 * u[0] - 1.0, 2.0 * u[1] - 1.0)
    }

    fn normals(&self) -> Cone {
        Cone { axis: self.normal(), angle: 0.0 }
    }

    fn sample_area_inverse(&self, point: Vec3) -> [f32; 2] {
        let (a, b) = self.coordinates(point);
        [a, b].map(|x| (0.5 * x + 0.5).clamp(0.0, ONE_MINUS_EPSILON))
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
        Some(flat_projected_solid_angle::<_, 6>(self, from, sides))
    }
}

impl FlatShape for Rectangle {
    type SolidAngle = RectangleSolidAngle;

    #[inline]
    fn sphere(&self) -> (Vec3, f32) {
        (self.centre(), (self.half_u() + self.half_v()).length())
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn solid_angle_view(&self, _: Vec3, chart: &Chart) -> Option<RectangleSolidAngle> {
        RectangleSolidAngle::new(*self, Local::new(self, chart))
    }

    #[inline]
    fn chart(&self, from: Vec3) -> Chart {
        Chart::from_axes(from, self.centre(), self.half_u(), self.half_v())
    }

    #[inline]
    fn corners(&self) -> impl AsRef<[Vec2]> {
        [Vec2::NEG_ONE, Vec2::new(1.0, -1.0), Vec2::ONE, Vec2::new(-1.0, 1.0)]
    }

    #[inline]
    fn point_at(&self, place: Vec2) -> SurfacePoint {
        self.point(place.x, place.y)
    }

    fn place_of(&self, point: Vec3) -> Vec2 {
        self.coordinates(point).into()
    }
}

/// A rectangle from the foot of a receiver's perpendicular on its plane.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Local {
    /// Unit axes, the third from the receiver to the plane.
    axes: [Vec3; 3],
    /// Low corner and size along the first two, height along the third (m).
    corner: [f32; 2],
    size: [f32; 2],
    height: f32,
}

impl Local {
    /// In double precision: 1 mrad above the plane, or at 1e-6 sizes from it, single has two or
    /// three digits of the height, and of a corner near the foot none.
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn new(shape: &Rectangle, chart: &Chart) -> Self {
        let Chart { origin, u, v, .. } = *chart;
        let (uu, vv) = (u.length_squared(), v.length_squared());
        let (per_u, per_v) = (1.0 / libm::sqrt(uu), 1.0 / libm::sqrt(vv));
        let below = u.cross(v).dot(origin) * (per_u * per_v);
        let normal = shape.normal();
        Self {
            axes: [
                shape.half_u() * per_u as f32,
                shape.half_v() * per_v as f32,
                if below < 0.0 { -normal } else { normal },
            ],
            corner: [((u.dot(origin) - uu) * per_u) as f32, ((v.dot(origin) - vv) * per_v) as f32],
            size: [(2.0 * uu * per_u) as f32, (2.0 * vv * per_v) as f32],
            height: below.abs() as f32,
        }
    }
}

/// A rectangle with the density `1 / solid angle` (sr⁻¹) at every distance and angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RectangleSolidAngle {
    shape: Rectangle,
    local: Local,
    seen: SphericalRectangle,
}

impl RectangleSolidAngle {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn new(shape: Rectangle, local: Local) -> Option<Self> {
        let seen = SphericalRectangle::new(local.corner, local.size, local.height)?;
        Some(Self { shape, local, seen })
    }
}

impl SurfaceView for RectangleSolidAngle {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sample(&self, u: [f32; 2]) -> Option<SurfaceSample> {
        let place = self.seen.sample(u);
        let [x, y, z] = self.local.axes;
        // In units of the reach, with a height that its square can hold: no extremes here.
        let way = x * place.offset[0] + y * place.offset[1] + z * self.seen.height();
        let length = num::sqrt(way.length_squared());
        let distance = length * self.seen.reach();
        if !(distance > 0.0) {
            return None;
        }
        let [s, t] = place.fraction;
        let at = self.shape.point(2.0 * s - 1.0, 2.0 * t - 1.0);
        Some(SurfaceSample { at, wi: way * (1.0 / length), distance })
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn pdf_solid_angle(&self, _: &SurfacePoint, _: Vec3, _: f32) -> Option<f32> {
        Some(1.0 / self.seen.solid_angle())
    }

    fn invert(&self, at: &SurfacePoint, wi: Vec3) -> Option<[f32; 2]> {
        let Local { axes, corner, size, height } = self.local;
        let [x, y, z] = axes.map(|axis| axis.dot(wi));
        if !(z > 0.0) {
            return None;
        }
        // Near, the direction says best where the place is; far and low, the place itself.
        let distance = height / z;
        let place = if at.point.abs().max_element() > distance / z {
            let offset = [x * distance, y * distance];
            let fraction = [0, 1].map(|i| (offset[i] - corner[i]) / size[i]);
            RectanglePlace { offset, fraction }
        } else {
            let (s, t) = self.shape.coordinates(at.point);
            let fraction = [s, t].map(|s| 0.5 * s + 0.5);
            RectanglePlace { offset: [0, 1].map(|i| corner[i] + fraction[i] * size[i]), fraction }
        };
        let offset = place.offset.map(|x| x / self.seen.reach());
        let fraction = place.fraction.map(|f| f.clamp(0.0, 1.0));
        Some(self.seen.invert(&RectanglePlace { offset, fraction }))
    }
}
