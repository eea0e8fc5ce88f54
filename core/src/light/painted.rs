//! Surfaces that emit a picture.

use super::luminance::LuminanceTable;
use super::{
    AreaLight, Density, Emitter, LightBounds, LightSample, LuminanceGrid, Painted, Receiver, SurfaceDensity,
    SurfaceRadiance, SurfaceSample, SurfaceView,
};
use crate::Rgb;
use crate::measure::area_to_solid_angle;
use crate::num;
use crate::shape::{Cylinder, Disk, Rectangle, Shape, Sphere, SurfacePoint, Triangle};
use crate::texture::Kind;
use glam::Vec3;

/// A rectangle that emits a picture, sampled where the picture is bright.
///
/// From a distance the density is the picture's luminance over the area, `pmf / cell area` (m⁻²). Near
/// the light, and where solid angle or projected solid angle are asked for, half of the samples come
/// from that density of the plain rectangle instead, and the density is the mean of the two: what is
/// bright and what is near are both found.
///
/// Source: the mean of densities is the balance heuristic of Veach 1997, *Robust Monte Carlo Methods
/// for Light Transport Simulation*, section 9.2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PaintedRectangle<'a> {
    light: AreaLight<Rectangle, Painted<'a>>,
    luminance: LuminanceTable<'a>,
}

/// How far the picture's edges may be from those of the rectangle, in pictures.
const ALIGNED: f32 = 1e-4;

impl<'a> PaintedRectangle<'a> {
    /// A grid for the picture of a light; `None` when its texels do not lie along the edges of the
    /// rectangle, or are black: the light is then sampled without regard to them.
    #[must_use]
    pub fn grid(light: &AreaLight<Rectangle, Painted<'_>>) -> Option<LuminanceGrid> {
        let (shape, painted) = (light.shape(), light.surface_radiance());
        let Kind::Picture { width, height, .. } = painted.paint().pattern().kind() else { return None };
        let corner = |x: f32, y: f32| painted.place(shape, shape.point(x, y).point);
        let (origin, along, across) = (corner(-1.0, -1.0), corner(1.0, -1.0), corner(-1.0, 1.0));
        let near = |x: f32, whole: f32| (x - whole).abs() < ALIGNED;
        let pictures = |step: f32, off: f32, start: f32| {
            let count = (step.abs() + 0.5) as u32;
            let whole = near(step.abs(), count as f32) && near(num::fraction(start + 0.5), 0.5);
            (near(off, 0.0) && whole && count > 0).then_some(count)
        };
        let columns = pictures(along.x - origin.x, along.y - origin.y, origin.x)?;
        let rows = pictures(across.y - origin.y, across.x - origin.x, origin.y)?;
        Some(LuminanceGrid::new(width.checked_mul(columns)?, height.checked_mul(rows)?))
    }

    /// Fills the table of a grid; false when the picture is black.
    ///
    /// * `table` – [`LuminanceGrid::table_len`] entries
    pub fn fill(light: &AreaLight<Rectangle, Painted<'_>>, grid: &LuminanceGrid, table: &mut [f32]) -> bool {
        let shape = light.shape();
        grid.fill(table, |place| {
            light.surface_radiance().at(shape, point(shape, place).point).luminance().min(f32::MAX)
        })
    }

    /// The light with its filled table; `None` when the table does not have the grid's length.
    #[must_use]
    pub fn new(
        light: AreaLight<Rectangle, Painted<'a>>,
        grid: &'a LuminanceGrid,
        table: &'a [f32],
    ) -> Option<Self> {
        LuminanceTable::new(grid, table).map(|luminance| Self { light, luminance })
    }

    /// Density of the picture's luminance at a surface point (m⁻²).
    fn pdf_area(&self, point: Vec3) -> f32 {
        let shape = self.light.shape();
        let (x, y) = shape.coordinates(point);
        let place = [x, y].map(|c| num::clamp(0.5 * c + 0.5, 0.0, 1.0));
        self.luminance.pdf(place) / shape.area()
    }

    /// The other density, where there is one: none far from the light.
    fn plain<'s>(&'s self, from: &'s Receiver, method: SurfaceDensity) -> Option<impl SurfaceView + 's> {
        let shape = self.light.shape();
        let radius = (shape.half_u() + shape.half_v()).length();
        match method.required(from, shape.centre(), radius, SurfaceDensity::Area) {
            SurfaceDensity::Area => None,
            near => self.light.density(from, near),
        }
    }

    /// The density of a direction: the picture's, or the mean of both.
    fn pdf<V: SurfaceView>(
        &self,
        plain: Option<&V>,
        from: &Receiver,
        wi: Vec3,
        at: &SurfacePoint,
    ) -> Option<f32> {
        let cos_light = self.light.sides().cos_light(at.normal, wi);
        if !(cos_light > 0.0) {
            return None;
        }
        let squared = at.point.distance_squared(from.point);
        let bright = area_to_solid_angle(self.pdf_area(at.point), squared, cos_light).unwrap_or(0.0);
        let pdf = match plain {
            Some(view) => 0.5 * (bright + view.pdf_solid_angle(at, wi, cos_light).unwrap_or(0.0)),
            None => bright,
        };
        (pdf > 0.0 && pdf < f32::INFINITY).then_some(pdf)
    }
}

/// The surface point at a place of the unit square.
fn point(shape: &Rectangle, [s, t]: [f32; 2]) -> SurfacePoint {
    shape.point(2.0 * s - 1.0, 2.0 * t - 1.0)
}

impl Emitter for PaintedRectangle<'_> {
    fn sample(&self, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        let plain = self.plain(from, method);
        let shape = self.light.shape();
        let bright = |u| SurfaceSample::toward(from.point, point(shape, self.luminance.sample(u)?));
        let sample = match &plain {
            None => bright(u)?,
            Some(_) if u[0] < 0.5 => bright([2.0 * u[0], u[1]])?,
            Some(view) => view.sample([2.0 * u[0] - 1.0, u[1]])?,
        };
        let pdf = self.pdf(plain.as_ref(), from, sample.wi, &sample.at)?;
        let incident = self.light.radiance(&sample.at, -sample.wi);
        let density = Density::SolidAngle(pdf);
        Some(LightSample { wi: sample.wi, distance: sample.distance, incident, density })
    }

    fn pdf_solid_angle(&self, from: &Receiver, method: SurfaceDensity, wi: Vec3, at: &SurfacePoint) -> f32 {
        self.pdf(self.plain(from, method).as_ref(), from, wi, at).unwrap_or(0.0)
    }

    fn radiance(&self, at: &SurfacePoint, wo: Vec3) -> Rgb {
        self.light.radiance(at, wo)
    }

    fn bounds(&self) -> Option<LightBounds> {
        self.light.bounds()
    }

    fn power(&self, scene_radius: f32) -> f32 {
        self.light.power(scene_radius)
    }
}

/// A surface of any shape that emits a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PaintedLight<'a> {
    /// A rectangle, sampled where the picture is bright.
    Bright(PaintedRectangle<'a>),
    /// A rectangle, sampled like a plain one.
    Rectangle(AreaLight<Rectangle, Painted<'a>>),
    /// A disk or ellipse.
    Disk(AreaLight<Disk, Painted<'a>>),
    /// A sphere.
    Sphere(AreaLight<Sphere, Painted<'a>>),
    /// A triangle.
    Triangle(AreaLight<Triangle, Painted<'a>>),
    /// A cylinder.
    Cylinder(AreaLight<Cylinder, Painted<'a>>),
}

/// The only list of variants; every method goes through it.
macro_rules! each_shape {
    ($light:expr, $inner:ident => $body:expr) => {
        match $light {
            PaintedLight::Bright($inner) => $body,
            PaintedLight::Rectangle($inner) => $body,
            PaintedLight::Disk($inner) => $body,
            PaintedLight::Sphere($inner) => $body,
            PaintedLight::Triangle($inner) => $body,
            PaintedLight::Cylinder($inner) => $body,
        }
    };
}

// Out of line: scenes without pictures on lights stay as fast as if there were none.
impl Emitter for PaintedLight<'_> {
    #[inline(never)]
    fn sample(&self, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        each_shape!(self, l => l.sample(from, method, u))
    }

    #[inline(never)]
    fn pdf_solid_angle(&self, from: &Receiver, method: SurfaceDensity, wi: Vec3, at: &SurfacePoint) -> f32 {
        each_shape!(self, l => l.pdf_solid_angle(from, method, wi, at))
    }

    #[inline(never)]
    fn radiance(&self, at: &SurfacePoint, wo: Vec3) -> Rgb {
        each_shape!(self, l => l.radiance(at, wo))
    }

    fn bounds(&self) -> Option<LightBounds> {
        each_shape!(self, l => l.bounds())
    }

    fn power(&self, scene_radius: f32) -> f32 {
        each_shape!(self, l => l.power(scene_radius))
    }
}
