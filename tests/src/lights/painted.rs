//! Surfaces that emit a picture.

use super::{Area, Seen, Specimen, Subject};
use halflight::Rgb;
use halflight::geom::{PreparedRay, Ray};
use halflight::glam::{Vec2, Vec3};
use halflight::light::{
    AreaLight, Emitter, LightSample, Paint, Painted, PaintedLight, PaintedRectangle, Receiver, SurfaceDensity,
};
use halflight::scene::CornerUvs;
use halflight::shape::{Rectangle, Sphere, Triangle};
use halflight::texture::{SurfaceUvs, Texels, Texture};

/// A picture of 4 × 3 texels, none of them black.
static PICTURE: [Rgb; 12] = {
    let shades = [0.2, 1.0, 0.4, 3.0, 0.7, 0.3, 2.0, 0.5, 0.2, 0.9, 0.25, 1.5];
    let mut texels = [Rgb::BLACK; 12];
    let mut i = 0;
    while i < 12 {
        texels[i] = Rgb::splat(shades[i]);
        i += 1;
    }
    texels
};

/// A plain surface with a picture on it.
#[derive(Debug, Clone, Copy)]
pub struct Pictured<S> {
    plain: Area<S>,
    light: PaintedLight<'static>,
}

/// The picture on a surface; it stays until the tests end.
fn painted<S: Specimen>(plain: &Area<S>, uvs: SurfaceUvs) -> AreaLight<S, Painted<'static>> {
    let texture = Texture::picture(Texels::Float(&PICTURE), 4, 3).expect("a proper picture");
    let paint = Paint::new(plain.light.shape(), &texture, uvs, Rgb::WHITE).expect("a proper radiance");
    AreaLight::painted(
        *plain.light.shape(),
        Painted::new(Box::leak(Box::new(paint)), Texels::Float(&PICTURE)),
    )
}

/// A rectangle that is sampled where its picture is bright.
#[must_use]
pub fn painted_rectangle(plain: Area<Rectangle>) -> Pictured<Rectangle> {
    let light = painted(&plain, SurfaceUvs::Own);
    let grid = Box::leak(Box::new(PaintedRectangle::grid(&light).expect("a picture along the edges")));
    let table = Box::leak(vec![0.0; grid.table_len()].into_boxed_slice());
    assert!(PaintedRectangle::fill(&light, grid, table));
    let bright = PaintedRectangle::new(light, grid, table).expect("the table's length");
    Pictured { plain, light: PaintedLight::Bright(bright) }
}

/// A triangle with texture coordinates at its corners.
#[must_use]
pub fn painted_triangle(plain: Area<Triangle>) -> Pictured<Triangle> {
    let uvs = CornerUvs([Vec2::new(0.1, 0.2), Vec2::new(1.4, 0.1), Vec2::new(0.3, -0.8)]);
    Pictured { plain, light: PaintedLight::Triangle(painted(&plain, SurfaceUvs::Corners(uvs))) }
}

/// A sphere with its own texture coordinates.
#[must_use]
pub fn painted_sphere(plain: Area<Sphere>) -> Pictured<Sphere> {
    Pictured { plain, light: PaintedLight::Sphere(painted(&plain, SurfaceUvs::Own)) }
}

impl<S> Pictured<S> {
    /// The same with another way of sampling the surface.
    #[must_use]
    pub fn by(self, method: SurfaceDensity) -> Self {
        Self { plain: Area { method, ..self.plain }, ..self }
    }
}

impl<S: Specimen> Subject for Pictured<S> {
    fn from(&self) -> Receiver {
        self.plain.from
    }

    fn sample(&self, u: [f32; 2]) -> Option<LightSample> {
        self.light.sample(&self.plain.from, self.plain.method, u)
    }

    fn seen(&self, wi: Vec3) -> Option<Seen> {
        let (from, shape) = (&self.plain.from, self.plain.light.shape());
        let ray = Ray::new(from.point, wi);
        let hit = shape.intersect(&PreparedRay::new(ray), f32::INFINITY)?;
        let at = shape.surface_point(&ray, &hit);
        Some(Seen {
            pdf: self.light.pdf_solid_angle(from, self.plain.method, wi, &at),
            radiance: self.light.radiance(&at, -wi).g,
            distance: hit.t,
            cos_light: -at.normal.dot(wi),
        })
    }

    fn cone(&self) -> (Vec3, f64) {
        self.plain.cone()
    }

    fn size(&self) -> f32 {
        self.plain.size()
    }

    fn measure(&self) -> f64 {
        self.plain.measure
    }
}
