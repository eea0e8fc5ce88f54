//! Lights: one file each, with its radiometry, its densities and its sampler.
//!
//! Surfaces that emit are an [`AreaLight`] over a [`SampledShape`]; the shape's file here says how
//! its surface is sampled. To add a light: its file, a variant and an arm below, and a line in the
//! conformance suite.

mod area;
mod bounds;
mod constant;
mod cylinder;
mod density;
mod directional;
mod disk;
mod distant;
pub(crate) mod environment;
mod error;
mod luminance;
mod painted;
mod point;
mod polygon;
mod portals;
mod projected_view;
mod radiance;
mod rectangle;
#[cfg(test)]
mod round;
mod sphere;
mod spot;
mod triangle;
mod view;

pub use area::{AreaLight, SampledShape, Sides};
pub use bounds::{Cone, LightBounds};
pub(crate) use bounds::{expected_absolute_cosine, expected_cosine};
pub use constant::Constant;
pub use density::SurfaceDensity;
pub use directional::Directional;
pub use distant::DistantDisk;
pub use environment::{
    ClearSky, DrawsBy, EnvironmentDensity, EnvironmentMap, EnvironmentTable, Lobe, SkyPart, SkyView,
};
pub use error::LightError;
pub use luminance::LuminanceGrid;
pub use painted::{PaintedLight, PaintedRectangle};
pub use point::Point;
pub use polygon::PolygonSolidAngle;
pub use portals::{Portal, Portals};
pub use projected_view::{FlatShape, ProjectedView};
pub use radiance::{Paint, Painted, SurfaceRadiance};
pub use rectangle::RectangleSolidAngle;
pub use spot::Spot;
pub use triangle::TriangleSolidAngle;
pub use view::{AreaView, NoView, SurfaceSample, SurfaceView, UseView, View};

use projected_view::{flat_projected_solid_angle, is_near};

use crate::Rgb;
use crate::shape::{Cylinder, Disk, Rectangle, Sphere, SurfacePoint, Triangle};
use glam::Vec3;

/// Where light is gathered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Receiver {
    /// The point (m).
    pub point: Vec3,
    /// Unit normal on the side that is looked at.
    pub normal: Vec3,
}

/// How likely a direction was to be drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Density {
    /// Over solid angle at the receiver (sr⁻¹); finite and positive. The incident quantity is radiance.
    SolidAngle(f32),
    /// No ray meets this light by chance, so nothing is weighted against it. The incident quantity
    /// is the irradiance on a surface that faces the light (W m⁻²).
    Delta,
}

impl Density {
    /// What an incident quantity is multiplied with: the reciprocal of a density over solid angle (sr), or 1.
    #[inline]
    #[must_use]
    pub fn weight(self) -> f32 {
        match self {
            Self::SolidAngle(pdf) => 1.0 / pdf,
            Self::Delta => 1.0,
        }
    }
}

/// A direction toward a light, and what arrives from there when nothing is in the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LightSample {
    /// Unit direction from the receiver to the light.
    pub wi: Vec3,
    /// How far the light is (m); infinite for lights without a place.
    pub distance: f32,
    /// Radiance (W m⁻² sr⁻¹), or irradiance (W m⁻²) of a delta light.
    pub incident: Rgb,
    /// How likely `wi` was.
    pub density: Density,
}

/// A source of light.
///
/// Samplers are total: "no light from here" is `None`, and a density that is returned is finite and
/// positive. What [`Emitter::sample`] returns as density is what [`Emitter::pdf_solid_angle`] or
/// [`Emitter::pdf_escaping`] returns for that direction.
pub trait Emitter: Copy {
    /// Draws a direction from which light may arrive at `from`.
    ///
    /// * `method` – how a surface is sampled; other lights have only one way
    /// * `u` – two independent uniforms, each in `[0, 1)`
    fn sample(&self, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) -> Option<LightSample>;

    /// Density with which [`Emitter::sample`] draws the direction `wi` that meets the light's
    /// surface at `at` (sr⁻¹); 0 where it never does.
    fn pdf_solid_angle(&self, from: &Receiver, method: SurfaceDensity, wi: Vec3, at: &SurfacePoint) -> f32 {
        let _ = (from, method, wi, at);
        0.0
    }

    /// Density with which [`Emitter::sample`] draws the direction `wi` that meets nothing (sr⁻¹);
    /// 0 unless the light is an environment.
    fn pdf_escaping(&self, from: &Receiver, wi: Vec3) -> f32 {
        let _ = (from, wi);
        0.0
    }

    /// Radiance that a point of the light's surface sends toward the unit direction `wo`
    /// (W m⁻² sr⁻¹).
    fn radiance(&self, at: &SurfacePoint, wo: Vec3) -> Rgb {
        let _ = (at, wo);
        Rgb::BLACK
    }

    /// Radiance that arrives along `wi` from beyond all surfaces (W m⁻² sr⁻¹).
    fn radiance_escaping(&self, wi: Vec3) -> Rgb {
        let _ = wi;
        Rgb::BLACK
    }

    /// Irradiance at `from` when nothing is in the way, in closed form (W m⁻²); `None` for a light
    /// that has none, and where `f32` cannot hold it.
    fn unshadowed_irradiance(&self, from: &Receiver) -> Option<Rgb> {
        let _ = from;
        None
    }

    /// True for a light that surrounds the scene.
    fn is_environment(&self) -> bool {
        false
    }

    /// True for a light that hardly draws directions toward a part of it, and leaves that to the BSDF's.
    fn leaves_to_bsdf(&self) -> bool {
        false
    }

    /// The picture of a light that is one.
    fn environment_map(&self) -> Option<&EnvironmentMap<'_>> {
        None
    }

    /// True for a light that no ray meets by chance.
    fn is_delta(&self) -> bool {
        false
    }

    /// Where the light is and whither it shines; `None` for a light without a place, which a tree of
    /// lights does not hold and every receiver samples.
    fn bounds(&self) -> Option<LightBounds> {
        None
    }

    /// The corners of a flat light that has three or four, in order, as [`crate::shape::Shape::outline`].
    fn outline(&self) -> Option<[Vec3; 4]> {
        None
    }

    /// Checks a light that was made without checks, as those in a program's constants are.
    ///
    /// # Errors
    /// What the checking constructor says. A light without another constructor has nothing to check.
    fn check(&self) -> Result<(), LightError> {
        Ok(())
    }

    /// Power into a scene that fits a sphere of `scene_radius` (m), as average over the channels (W).
    /// Used for choosing among lights; positive for every light that emits.
    fn power(&self, scene_radius: f32) -> f32;
}

/// Any of the lights: what a frontend that reads arbitrary scenes uses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AnyLight<'a> {
    /// A rectangle that emits.
    Rectangle(AreaLight<Rectangle>),
    /// A disk or ellipse that emits.
    Disk(AreaLight<Disk>),
    /// A sphere that emits.
    Sphere(AreaLight<Sphere>),
    /// A triangle that emits.
    Triangle(AreaLight<Triangle>),
    /// A cylinder that emits.
    Cylinder(AreaLight<Cylinder>),
    /// A surface that emits a picture.
    Painted(PaintedLight<'a>),
    /// A point.
    Point(Point),
    /// A point with a cone.
    Spot(Spot),
    /// Parallel light.
    Directional(Directional),
    /// The same radiance from everywhere.
    Constant(Constant),
    /// A disk infinitely far away.
    DistantDisk(DistantDisk),
    /// A picture of the radiance from everywhere.
    EnvironmentMap(EnvironmentMap<'a>),
    /// The same radiance from everywhere, seen through openings.
    ConstantPortals(Portals<'a, Constant>),
    /// A picture of the radiance from everywhere, seen through openings.
    EnvironmentPortals(Portals<'a, EnvironmentMap<'a>>),
}

/// The only list of variants; every method goes through it.
macro_rules! each_light {
    ($light:expr, $inner:ident => $body:expr) => {
        match $light {
            AnyLight::Rectangle($inner) => $body,
            AnyLight::Disk($inner) => $body,
            AnyLight::Sphere($inner) => $body,
            AnyLight::Triangle($inner) => $body,
            AnyLight::Cylinder($inner) => $body,
            AnyLight::Painted($inner) => $body,
            AnyLight::Point($inner) => $body,
            AnyLight::Spot($inner) => $body,
            AnyLight::Directional($inner) => $body,
            AnyLight::Constant($inner) => $body,
            AnyLight::DistantDisk($inner) => $body,
            AnyLight::EnvironmentMap($inner) => $body,
            AnyLight::ConstantPortals($inner) => $body,
            AnyLight::EnvironmentPortals($inner) => $body,
        }
    };
}

impl AnyLight<'_> {
    /// The kinds of light, by name.
    pub const NAMES: [&'static str; 14] = [
        "rectangle",
        "disk",
        "sphere",
        "triangle",
        "cylinder",
        "painted",
        "point",
        "spot",
        "directional",
        "constant",
        "distant",
        "envmap",
        "constant through portals",
        "envmap through portals",
    ];

    /// The name of this kind of light.
    #[must_use]
    pub fn name(&self) -> &'static str {
        let index = match self {
            Self::Rectangle(_) => 0,
            Self::Disk(_) => 1,
            Self::Sphere(_) => 2,
            Self::Triangle(_) => 3,
            Self::Cylinder(_) => 4,
            Self::Painted(_) => 5,
            Self::Point(_) => 6,
            Self::Spot(_) => 7,
            Self::Directional(_) => 8,
            Self::Constant(_) => 9,
            Self::DistantDisk(_) => 10,
            Self::EnvironmentMap(_) => 11,
            Self::ConstantPortals(_) => 12,
            Self::EnvironmentPortals(_) => 13,
        };
        Self::NAMES[index]
    }
}

impl Emitter for AnyLight<'_> {
    #[inline]
    fn sample(&self, from: &Receiver, method: SurfaceDensity, u: [f32; 2]) -> Option<LightSample> {
        each_light!(self, l => l.sample(from, method, u))
    }

    #[inline]
    fn pdf_solid_angle(&self, from: &Receiver, method: SurfaceDensity, wi: Vec3, at: &SurfacePoint) -> f32 {
        each_light!(self, l => l.pdf_solid_angle(from, method, wi, at))
    }

    #[inline]
    fn pdf_escaping(&self, from: &Receiver, wi: Vec3) -> f32 {
        each_light!(self, l => l.pdf_escaping(from, wi))
    }

    #[inline]
    fn radiance(&self, at: &SurfacePoint, wo: Vec3) -> Rgb {
        each_light!(self, l => l.radiance(at, wo))
    }

    #[inline]
    fn radiance_escaping(&self, wi: Vec3) -> Rgb {
        each_light!(self, l => l.radiance_escaping(wi))
    }

    fn unshadowed_irradiance(&self, from: &Receiver) -> Option<Rgb> {
        each_light!(self, l => l.unshadowed_irradiance(from))
    }

    #[inline]
    fn is_environment(&self) -> bool {
        each_light!(self, l => l.is_environment())
    }

    fn leaves_to_bsdf(&self) -> bool {
        each_light!(self, l => l.leaves_to_bsdf())
    }

    fn environment_map(&self) -> Option<&EnvironmentMap<'_>> {
        each_light!(self, l => l.environment_map())
    }

    #[inline]
    fn is_delta(&self) -> bool {
        each_light!(self, l => l.is_delta())
    }

    #[cfg_attr(feature = "small", inline(never))]
    fn bounds(&self) -> Option<LightBounds> {
        each_light!(self, l => l.bounds())
    }

    fn outline(&self) -> Option<[Vec3; 4]> {
        each_light!(self, l => l.outline())
    }

    fn check(&self) -> Result<(), LightError> {
        each_light!(self, l => l.check())
    }

    fn power(&self, scene_radius: f32) -> f32 {
        each_light!(self, l => l.power(scene_radius))
    }
}
