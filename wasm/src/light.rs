//! The lights of a scene as things to look at and to change.

use halflight::Rgb;
use halflight::build::{Geometry, Object};
use halflight::geom::Frame;
use halflight::glam::Vec3;
use halflight::light::{
    AnyLight, Constant, Directional, DistantDisk, Emitter, LightError, Point, Receiver, Spot, SurfaceDensity,
};
use halflight::num::PI;
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, Shape, ShapeError, Sphere};
use std::fmt;
use wasm_bindgen::prelude::*;

/// A light as JavaScript sees it.
#[wasm_bindgen(getter_with_clone)]
#[derive(Debug, Clone, PartialEq)]
pub struct Light {
    /// Its name in the scene, or that of its kind.
    #[wasm_bindgen(readonly)]
    pub name: String,
    /// `rectangle`, `disk`, `sphere`, `cylinder`, `point`, `spot`, `directional`, `distant` (a far disk, like
    /// the sun), `constant` (from all around) and `none` can be changed into one another; `mesh`, `triangle`
    /// and `painted` cannot, but can be moved, made brighter and of another colour; a `map` of the
    /// surroundings can be turned and made brighter.
    #[wasm_bindgen(readonly)]
    pub kind: String,
    /// Its middle (m); of lights without a place, the origin.
    #[wasm_bindgen(readonly)]
    pub position: Vec<f32>,
    /// Where it shines: the unit normal of a flat light, the way of parallel light.
    #[wasm_bindgen(readonly)]
    pub direction: Vec<f32>,
    /// Full width and height (m); a sphere and a disk have their diameter. Of a spot the full angles in
    /// which it shines at all, and undimmed (degrees); of a distant disk that which it fills. Of a map how far
    /// it is turned about the vertical (degrees, counter-clockwise seen from above), and 0.
    #[wasm_bindgen(readonly)]
    pub size: Vec<f32>,
    /// Intensity straight ahead (W sr⁻¹) of lights with a place, irradiance (W m⁻²) of parallel light,
    /// radiance (W m⁻² sr⁻¹) of one all around and of a mesh, what multiplies the picture of a painted one
    /// and of a map: red, green, blue, which are the same for a map.
    #[wasm_bindgen(readonly)]
    pub strength: Vec<f32>,
    /// Corners of a flat light, for drawing it: x, y, z each (m).
    #[wasm_bindgen(readonly)]
    pub outline: Vec<f32>,
    /// True when [`crate::Scene::set_light`] can change its kind and its form.
    #[wasm_bindgen(readonly)]
    pub editable: bool,
}

/// What a light is to become.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Wanted<'a> {
    pub(crate) kind: &'a str,
    pub(crate) position: Vec3,
    pub(crate) direction: Vec3,
    pub(crate) size: [f32; 2],
    pub(crate) strength: Rgb,
}

/// What came of it.
#[derive(Debug, Clone)]
pub(crate) enum Made {
    /// A surface and its radiance.
    Surface(AnyShape, Rgb),
    /// A light without one.
    Free(AnyLight<'static>),
    /// None.
    Nothing,
}

/// Why a light was refused.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Refused {
    Kind(String),
    Direction,
    Shape(ShapeError),
    Light(LightError),
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Kind(kind) => write!(f, "a light cannot be changed into or from a light of kind {kind}"),
            Self::Direction => write!(f, "the light's direction has no length"),
            Self::Shape(e) => e.fmt(f),
            Self::Light(e) => e.fmt(f),
        }
    }
}

impl std::error::Error for Refused {}

/// Radiance that a surface can have.
pub(crate) fn check_emission(radiance: Rgb) -> Result<Rgb, LightError> {
    Constant::new(radiance).map(|_| radiance)
}

impl From<ShapeError> for Refused {
    fn from(e: ShapeError) -> Self {
        Self::Shape(e)
    }
}

impl From<LightError> for Refused {
    fn from(e: LightError) -> Self {
        Self::Light(e)
    }
}

impl Wanted<'_> {
    /// Makes the light.
    ///
    /// * `before` – the shape that it had: a flat light that is only moved or tilted keeps its turn
    ///
    /// # Errors
    /// When it has no extent, is not finite, or is of a kind that cannot be made.
    pub(crate) fn make(&self, before: Option<&AnyShape>) -> Result<Made, Refused> {
        let direction = self.direction.try_normalize().ok_or(Refused::Direction)?;
        let [width, height] = self.size;
        let (u, v) = axes(before, direction);
        let shape = match self.kind {
            "rectangle" => {
                AnyShape::Rectangle(Rectangle::new(self.position, u * (0.5 * width), v * (0.5 * height))?)
            }
            "disk" => AnyShape::Disk(Disk::new(self.position, u * (0.5 * width), v * (0.5 * height))?),
            "sphere" => AnyShape::Sphere(Sphere::new(self.position, 0.5 * width)?),
            "cylinder" => {
                let base = self.position - direction * (0.5 * height);
                AnyShape::Cylinder(Cylinder::new(base, direction * height, 0.5 * width)?)
            }
            "none" => return Ok(Made::Nothing),
            _ => return self.without_surface(direction).map(Made::Free),
        };
        Ok(Made::Surface(shape, self.strength / seen_area(&shape)))
    }

    /// A light that is no surface.
    fn without_surface(&self, direction: Vec3) -> Result<AnyLight<'static>, Refused> {
        let Self { position, strength, .. } = *self;
        let [across, inner] = self.size.map(|degrees| 0.5 * degrees.to_radians());
        Ok(match self.kind {
            "point" => AnyLight::Point(Point::new(position, strength)?),
            "spot" => AnyLight::Spot(Spot::new(position, direction, strength, inner.min(across), across)?),
            "directional" => AnyLight::Directional(Directional::new(direction, strength)?),
            "distant" => {
                let sin = halflight::num::sin_cos(across).0;
                AnyLight::DistantDisk(DistantDisk::new(-direction, across, strength / (PI * sin * sin))?)
            }
            "constant" => AnyLight::Constant(Constant::new(strength)?),
            other => return Err(Refused::Kind(other.to_owned())),
        })
    }
}

/// Unit vectors along the width and the height of a flat light that faces `direction`: those of `before`,
/// turned the shortest way.
fn axes(before: Option<&AnyShape>, direction: Vec3) -> (Vec3, Vec3) {
    let old = match before {
        Some(AnyShape::Rectangle(r)) => Some((r.half_u(), r.normal())),
        Some(AnyShape::Disk(d)) => Some((d.axis_u(), d.normal())),
        _ => None,
    };
    let kept = old.and_then(|(u, normal)| {
        // The part of the old axis in the new plane, after the turn that takes normal to direction.
        let half = (normal + direction).try_normalize()?;
        let mirrored = u - half * (2.0 * u.dot(half));
        (mirrored - direction * mirrored.dot(direction)).try_normalize()
    });
    let u = kept.unwrap_or_else(|| Frame::from_normal(direction).to_world(Vec3::X));
    (u, direction.cross(u))
}

/// Area that a light shows straight ahead (m²): from the side, of a cylinder.
fn seen_area(shape: &AnyShape) -> f32 {
    match shape {
        AnyShape::Rectangle(r) => 4.0 * r.half_u().cross(r.half_v()).length(),
        AnyShape::Disk(d) => PI * d.axis_u().cross(d.axis_v()).length(),
        AnyShape::Sphere(s) => PI * s.radius() * s.radius(),
        AnyShape::Cylinder(c) => 2.0 * c.radius() * c.axis().length(),
        AnyShape::Triangle(_) => shape.area(),
    }
}

impl Light {
    /// A surface that emits.
    pub(crate) fn of_object(object: &Object) -> Option<Self> {
        let emission = object.emission.as_ref()?;
        let mut light = Self::new("mesh", emission.texture.is_none());
        match &object.geometry {
            Geometry::Shape(shape) => light.fill_from(shape, emission.radiance),
            Geometry::Mesh(mesh) => {
                let sum: Vec3 = mesh.positions.iter().sum();
                light.position = (sum / mesh.positions.len().max(1) as f32).to_array().to_vec();
                light.editable = false;
            }
        }
        if emission.texture.is_some() {
            light.kind = "painted".to_owned();
        }
        if !light.editable {
            light.strength = emission.radiance.to_array().to_vec();
        }
        if !object.name.is_empty() {
            light.name.clone_from(&object.name);
        }
        Some(light)
    }

    /// A picture of the surroundings.
    pub(crate) fn of_map(scale: f32, degrees: f32) -> Self {
        Self { size: vec![degrees, 0.0], strength: vec![scale; 3], ..Self::new("map", false) }
    }

    /// One that was taken away.
    pub(crate) fn none() -> Self {
        Self::new("none", true)
    }

    /// A light without a surface.
    pub(crate) fn of_light(light: &AnyLight<'_>) -> Self {
        let mut shown = Self::new(light.name(), true);
        let facing = |normal| Receiver { point: Vec3::ZERO, normal };
        match light {
            AnyLight::Point(p) => {
                shown.position = p.position().to_array().to_vec();
                shown.strength = p.intensity().to_array().to_vec();
            }
            AnyLight::Spot(s) => {
                shown.position = s.position().to_array().to_vec();
                shown.direction = s.axis().to_array().to_vec();
                shown.strength = s.intensity().to_array().to_vec();
                let (beam, cutoff) = s.angles();
                shown.size = [cutoff, beam].map(|half| 2.0 * half.to_degrees()).to_vec();
            }
            AnyLight::Directional(d) => {
                shown.direction = d.direction().to_array().to_vec();
                shown.strength = d.irradiance().to_array().to_vec();
            }
            AnyLight::DistantDisk(d) => {
                shown.direction = (-d.axis()).to_array().to_vec();
                shown.strength = d.irradiance().to_array().to_vec();
                let sin = halflight::num::sqrt(d.sin2_radius());
                let cos = halflight::num::sqrt(1.0 - d.sin2_radius());
                let across =
                    2.0 * halflight::num::atan2_in_double(f64::from(sin), f64::from(cos)).to_degrees();
                shown.size = vec![across as f32; 2];
            }
            other => {
                let sample = other.sample(&facing(Vec3::Y), SurfaceDensity::Auto, [0.5; 2]);
                shown.strength = sample.map_or(Rgb::BLACK, |s| s.incident).to_array().to_vec();
            }
        }
        shown
    }

    fn new(kind: &str, editable: bool) -> Self {
        Self {
            name: kind.to_owned(),
            kind: kind.to_owned(),
            position: vec![0.0; 3],
            direction: vec![0.0, -1.0, 0.0],
            size: vec![0.0; 2],
            strength: vec![0.0; 3],
            outline: Vec::new(),
            editable,
        }
    }

    fn fill_from(&mut self, shape: &AnyShape, radiance: Rgb) {
        let flat = |centre: Vec3, u: Vec3, v: Vec3, normal: Vec3| (centre, normal, [u.length(), v.length()]);
        let (kind, (centre, direction, half)) = match shape {
            AnyShape::Rectangle(r) => ("rectangle", flat(r.centre(), r.half_u(), r.half_v(), r.normal())),
            AnyShape::Disk(d) => ("disk", flat(d.centre(), d.axis_u(), d.axis_v(), d.normal())),
            AnyShape::Sphere(s) => ("sphere", (s.centre(), Vec3::NEG_Y, [s.radius(); 2])),
            AnyShape::Cylinder(c) => {
                let (axis, length) = (c.unit_axis(), c.axis().length());
                ("cylinder", (c.base() + c.axis() * 0.5, axis, [c.radius(), 0.5 * length]))
            }
            AnyShape::Triangle(t) => {
                let [a, b, c] = t.corners();
                self.editable = false;
                ("triangle", ((a + b + c) / 3.0, t.normal(), [0.0; 2]))
            }
        };
        kind.clone_into(&mut self.kind);
        self.position = centre.to_array().to_vec();
        self.direction = direction.to_array().to_vec();
        self.size = half.map(|h| 2.0 * h).to_vec();
        self.strength = (radiance * seen_area(shape)).to_array().to_vec();
        self.outline = outline(shape);
    }
}

/// Corners to draw a flat light by; of a disk, some of its edge.
fn outline(shape: &AnyShape) -> Vec<f32> {
    let points: Vec<Vec3> = match shape {
        AnyShape::Rectangle(r) => {
            let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            corners.map(|(u, v)| r.centre() + r.half_u() * u + r.half_v() * v).to_vec()
        }
        AnyShape::Disk(d) => (0..32)
            .map(|i| {
                let (sin, cos) = halflight::num::sin_cos(i as f32 / 16.0 * PI);
                d.centre() + d.axis_u() * cos + d.axis_v() * sin
            })
            .collect(),
        _ => Vec::new(),
    };
    points.iter().flat_map(|p| p.to_array()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wanted(kind: &str) -> Wanted<'_> {
        let position = Vec3::new(1.0, 2.0, 3.0);
        let direction = Vec3::new(0.6, -0.8, 0.0);
        Wanted { kind, position, direction, size: [0.4, 0.4], strength: Rgb::new(3.0, 2.0, 1.0) }
    }

    fn shown(made: &Made) -> Light {
        match made {
            Made::Surface(shape, radiance) => {
                let mut light = Light::new("mesh", true);
                light.fill_from(shape, *radiance);
                light
            }
            Made::Free(light) => Light::of_light(light),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn a_light_that_was_made_shows_what_was_wanted() {
        let near = |a: &[f32], b: &[f32]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-5);
        for kind in
            ["rectangle", "disk", "sphere", "cylinder", "point", "spot", "directional", "distant", "constant"]
        {
            let w = wanted(kind);
            let light = shown(&w.make(None).unwrap());
            assert_eq!(light.kind, kind);
            assert!(near(&light.strength, &[3.0, 2.0, 1.0]), "{light:?}");
            if !matches!(kind, "directional" | "distant" | "constant") {
                assert!(near(&light.position, &[1.0, 2.0, 3.0]), "{light:?}");
            }
            if !matches!(kind, "sphere" | "point" | "constant") {
                assert!(near(&light.direction, &[0.6, -0.8, 0.0]), "{light:?}");
            }
            if !matches!(kind, "point" | "directional" | "constant") {
                assert!(near(&light.size, &[0.4, 0.4]), "{light:?}");
            }
        }
    }

    #[test]
    fn a_rectangle_that_is_tilted_keeps_its_turn() {
        let before = Rectangle::new(Vec3::ZERO, Vec3::new(0.6, 0.0, 0.8), Vec3::new(-0.8, 0.0, 0.6)).unwrap();
        let facing = |direction| match (Wanted { direction, ..wanted("rectangle") })
            .make(Some(&AnyShape::Rectangle(before)))
        {
            Ok(Made::Surface(AnyShape::Rectangle(r), _)) => r,
            other => panic!("{other:?}"),
        };
        let same = facing(before.normal());
        assert!((same.half_u() / 0.2 - before.half_u()).length() < 1e-5, "{same:?}");
        // About the axis along its width nothing happens to the width.
        let tilted = facing((before.normal() + before.half_v() * 0.3).normalize());
        assert!((tilted.half_u() / 0.2 - before.half_u()).length() < 1e-5, "{tilted:?}");
    }

    #[test]
    fn lights_that_are_none_are_refused() {
        assert!(wanted("laser").make(None).is_err());
        assert!(Wanted { direction: Vec3::ZERO, ..wanted("disk") }.make(None).is_err());
        assert!(Wanted { size: [0.0, f32::NAN], ..wanted("rectangle") }.make(None).is_err());
        assert!(Wanted { strength: Rgb::splat(-1.0), ..wanted("point") }.make(None).is_err());
    }
}
