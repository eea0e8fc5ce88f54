//! The axes of the matrix: what is varied, and how it is called.

use halflight::light::SurfaceDensity;

/// The shape that emits.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Light {
    /// A rectangle.
    Rectangle,
    /// A triangle.
    Triangle,
    /// A convex polygon of five corners.
    Polygon,
    /// A disk, or an ellipse.
    Disk,
    /// A sphere.
    Sphere,
    /// An open cylinder.
    Cylinder,
}

impl Light {
    /// All of them. To add a light: a variant, its name, and its line in `setup.rs`.
    pub const ALL: [Self; 6] =
        [Self::Rectangle, Self::Triangle, Self::Polygon, Self::Disk, Self::Sphere, Self::Cylinder];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Rectangle => "rectangle",
            Self::Triangle => "triangle",
            Self::Polygon => "polygon",
            Self::Disk => "disk",
            Self::Sphere => "sphere",
            Self::Cylinder => "cylinder",
        }
    }

    /// The aspects that it comes in.
    #[must_use]
    pub const fn aspects(self) -> &'static [f32] {
        match self {
            Self::Sphere => &[1.0],
            _ => &[1.0, 1e3, 1e6],
        }
    }
}

/// Every density with its name.
pub const DENSITIES: [(SurfaceDensity, &str); 4] = [
    (SurfaceDensity::Area, "area"),
    (SurfaceDensity::SolidAngle, "solid_angle"),
    (SurfaceDensity::Projected, "projected"),
    (SurfaceDensity::Auto, "auto"),
];

/// From the light's surface to the receiver, in half-lengths of the light.
pub const DISTANCES: [f32; 6] = [0.0, 1e-6, 1e-3, 1.0, 1e3, 1e6];

/// Half-lengths of the light (m).
pub const SCALES: [f32; 3] = [1e-6, 1.0, 1e6];

/// Where the receiver is against the normal of the light's surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Angle {
    /// On the normal.
    Facing,
    /// 60° aside.
    Aside,
    /// 1 mrad above the plane of the surface.
    Grazing,
    /// In that plane.
    InPlane,
    /// 150° from the normal.
    Behind,
}

impl Angle {
    /// All of them.
    pub const ALL: [Self; 5] = [Self::Facing, Self::Aside, Self::Grazing, Self::InPlane, Self::Behind];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Facing => "facing",
            Self::Aside => "60_degrees",
            Self::Grazing => "grazing",
            Self::InPlane => "in_plane",
            Self::Behind => "behind",
        }
    }

    /// Sine and cosine; those of the first and of the one in the plane are exact.
    #[must_use]
    pub fn sin_cos(self) -> (f64, f64) {
        match self {
            Self::Facing => (0.0, 1.0),
            Self::Aside => (0.75_f64.sqrt(), 0.5),
            Self::Grazing => (1e-3_f64.cos(), 1e-3_f64.sin()),
            Self::InPlane => (1.0, 0.0),
            Self::Behind => (0.5, -(0.75_f64.sqrt())),
        }
    }
}

/// One cell of the matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cell {
    /// The shape.
    pub light: Light,
    /// How it is sampled: index into [`DENSITIES`].
    pub density: usize,
    /// In half-lengths of the light.
    pub distance: f32,
    /// Where the receiver is.
    pub angle: Angle,
    /// Half-length of the light (m).
    pub scale: f32,
    /// Length over width.
    pub aspect: f32,
}

impl Cell {
    /// Every cell.
    pub fn all() -> impl Iterator<Item = Self> {
        Light::ALL.into_iter().flat_map(|light| {
            (0..DENSITIES.len()).flat_map(move |density| {
                places().flat_map(move |(distance, angle, scale)| {
                    light.aspects().iter().map(move |&aspect| Self {
                        light,
                        density,
                        distance,
                        angle,
                        scale,
                        aspect,
                    })
                })
            })
        })
    }

    /// How the light is sampled.
    #[must_use]
    pub fn method(&self) -> SurfaceDensity {
        DENSITIES[self.density].0
    }

    /// Its path in the list of tests.
    #[must_use]
    pub fn name(&self) -> String {
        let (light, density) = (self.light.name(), DENSITIES[self.density].1);
        let mut name = format!("{light}::{density}::distance_{}", number(self.distance));
        name += &format!("::{}::scale_{}", self.angle.name(), number(self.scale));
        if self.light.aspects().len() > 1 {
            name += &format!("::aspect_{}", number(self.aspect));
        }
        name
    }
}

/// Every distance, angle and scale.
fn places() -> impl Iterator<Item = (f32, Angle, f32)> {
    DISTANCES.into_iter().flat_map(|d| {
        Angle::ALL.into_iter().flat_map(move |angle| SCALES.into_iter().map(move |scale| (d, angle, scale)))
    })
}

/// `1`, `1e-6`, `1e3`.
fn number(x: f32) -> String {
    if x == 0.0 || x == 1.0 { format!("{x}") } else { format!("{x:e}") }
}
