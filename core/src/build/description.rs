//! A scene as its author thinks of it: named things in world space, owned, easy to make and to edit.
//!
//! Loaders and the built-in scenes make one, exporters write one, and `SceneBuffers` (beside this
//! file) turns it into the tables that a renderer borrows.

use super::{MaterialTextures, TextureDescription};
use crate::Rgb;
use crate::bsdf::{AnyBsdf, TwoSided};
use crate::camera::{Camera, CameraError, View};
use crate::estimate::{Direct, Path};
use crate::film::Filter;
use crate::light::{AnyLight, EnvironmentDensity, Portal};
use crate::num;
use crate::shape::AnyShape;
use crate::texture::ObjectSpace;
use glam::{Mat3, Vec2, Vec3};
use std::string::String;
use std::sync::Arc;
use std::vec::Vec;

/// A whole scene.
#[derive(Debug, Clone)]
pub struct Description {
    /// Name for reports: the file's stem, or the built-in scene's name.
    pub name: String,
    /// What looks at it.
    pub camera: CameraDescription,
    /// Columns of the picture.
    pub width: u32,
    /// Rows of the picture.
    pub height: u32,
    /// Reconstruction filter.
    pub filter: Filter,
    /// How its author wants it integrated.
    pub integrator: IntegratorDescription,
    /// Samples per pixel that its author wants; `None` leaves it to the program.
    pub samples_per_pixel: Option<u32>,
    /// Materials; objects refer to them by index.
    pub materials: Vec<Material>,
    /// Surfaces, some of which emit.
    pub objects: Vec<Object>,
    /// Lights without a surface: point, spot, directional, constant.
    pub lights: Vec<AnyLight<'static>>,
    /// Pictures of the light from all around.
    pub environments: Vec<EnvironmentDescription>,
    /// Openings through which the light from all around comes into the room; none outdoors. A sun of
    /// its own is drawn without them.
    pub portals: Vec<Portal>,
}

/// A picture of the light from all around, with a place of its own in the scene's description because
/// it is large: descriptions share it.
#[derive(Debug, Clone, PartialEq)]
pub struct EnvironmentDescription {
    /// Radiance (W m⁻² sr⁻¹) in longitude and latitude, the zenith on top.
    pub image: Arc<Image>,
    /// A rotation, or one with a mirror.
    pub to_world: Mat3,
    /// What the radiance is multiplied with, 0 or more.
    pub scale: f32,
    /// How directions toward it are drawn.
    pub density: EnvironmentDensity,
}

impl EnvironmentDescription {
    /// A picture as bright as it says, drawn as suits it.
    ///
    /// * `to_world` – a rotation, or one with a mirror
    #[must_use]
    pub fn new(image: Image, to_world: Mat3) -> Self {
        Self { image: Arc::new(image), to_world, scale: 1.0, density: EnvironmentDensity::default() }
    }
}

/// A linear picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Image {
    /// Columns.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// `width × height` texels, row by row from the top.
    pub texels: Vec<Rgb>,
}

/// How the light is to be integrated, as far as the author says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct IntegratorDescription {
    /// Light samples per camera sample.
    pub light_samples: Option<u32>,
    /// BSDF samples per camera sample.
    pub bsdf_samples: Option<u32>,
    /// Which indirect light; `None` for direct light alone.
    pub path: Option<PathDescription>,
}

/// How much indirect light is wanted: see [`crate::estimate::Path`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PathDescription {
    /// Most segments between camera and light, 1 or more; [`u32::MAX`] has no end.
    pub max_depth: u32,
    /// Segments after which Russian roulette decides whether a path goes on.
    pub rr_depth: u32,
    /// Whether lights light but are not seen.
    pub hide_emitters: bool,
}

impl Default for PathDescription {
    /// All of the light.
    fn default() -> Self {
        let Path { max_depth, rr_depth, hide_emitters, .. } = Path::default();
        Self { max_depth, rr_depth, hide_emitters }
    }
}

impl PathDescription {
    /// True when it is nothing but direct light and the lights themselves.
    #[must_use]
    pub const fn is_direct(&self) -> bool {
        self.max_depth == 2 && !self.hide_emitters
    }

    /// The estimator.
    ///
    /// * `direct` – how the light that comes straight from the lights is sampled
    #[must_use]
    pub const fn estimator<'a>(&self, direct: Direct<'a>) -> Path<'a> {
        let Self { max_depth, rr_depth, hide_emitters } = *self;
        Path { direct, max_depth, rr_depth, hide_emitters }
    }
}

/// A named material.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Its name; unique when not empty.
    pub name: String,
    /// What the sides do, where no texture says otherwise.
    pub bsdf: TwoSided<AnyBsdf>,
    /// The textures of the front and of the back. Those of the back are not used when they and the
    /// models of the two sides are the same.
    pub textures: [MaterialTextures; 2],
}

/// A surface in the scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Object {
    /// Name for messages and for exported files.
    pub name: String,
    /// Its form, in world space.
    pub geometry: Geometry,
    /// Index into the materials.
    pub material: usize,
    /// What it emits.
    pub emission: Option<Emission>,
    /// Where its texture coordinates come from, when it is an analytic shape; `None` leaves them to
    /// the shape.
    pub object_space: Option<ObjectSpace>,
}

/// What a surface emits.
#[derive(Debug, Clone, PartialEq)]
pub struct Emission {
    /// Radiance (W m⁻² sr⁻¹), or what the texture is multiplied with.
    pub radiance: Rgb,
    /// How the radiance varies over the surface.
    pub texture: Option<TextureDescription>,
    /// From both sides, or only from the front.
    pub two_sided: bool,
}

/// The form of an object, in world space.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// One analytic shape.
    Shape(AnyShape),
    /// Triangles.
    Mesh(Mesh),
}

impl Geometry {
    /// Leaves out texture coordinates, where no texture asks for them.
    pub fn forget_uvs(&mut self) {
        if let Self::Mesh(mesh) = self {
            mesh.uvs = Vec::new();
        }
    }
}

/// Triangles with shared corners.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Mesh {
    /// Corners (m).
    pub positions: Vec<Vec3>,
    /// A shading normal for each corner, of unit length; empty for flat shading.
    pub normals: Vec<Vec3>,
    /// Texture coordinates for each corner; empty when there are none.
    pub uvs: Vec<Vec2>,
    /// Indices of corners, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
}

/// A camera whose picture may still change its shape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraDescription {
    /// Place and turn.
    pub view: View,
    /// Perspective or orthographic.
    pub projection: ProjectionDescription,
    /// Near clipping distance (m).
    pub near: f32,
    /// Far clipping distance (m).
    pub far: f32,
}

/// How the camera projects.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ProjectionDescription {
    /// Rays through one point.
    Perspective {
        /// Full field of view along `axis` (degrees), in (0, 180).
        fov: f32,
        /// Which extent of the picture `fov` is measured along.
        axis: FovAxis,
    },
    /// Parallel rays.
    Orthographic {
        /// Half of the window's width (m).
        half_width: f32,
    },
}

/// Which extent of the picture a field of view is measured along.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FovAxis {
    /// Its width.
    #[default]
    X,
    /// Its height.
    Y,
    /// Its diagonal.
    Diagonal,
    /// The shorter of width and height.
    Smaller,
    /// The longer of width and height.
    Larger,
}

impl CameraDescription {
    /// The camera for a picture of `width` × `height` pixels.
    ///
    /// # Errors
    /// When the field of view, the window or the clipping distances make no picture.
    pub fn camera(&self, width: u32, height: u32) -> Result<Camera, CameraError> {
        let aspect = width as f32 / height as f32;
        let camera = match self.projection {
            ProjectionDescription::Perspective { fov, axis } => {
                if !(fov > 0.0 && fov < 180.0) {
                    return Err(CameraError::FieldOfView(fov));
                }
                let tangent = num::tan(0.5 * fov.to_radians());
                let half_width = match axis {
                    FovAxis::X => tangent,
                    FovAxis::Y => tangent * aspect,
                    FovAxis::Diagonal => tangent * aspect / num::sqrt(1.0 + aspect * aspect),
                    FovAxis::Smaller => tangent * aspect.max(1.0),
                    FovAxis::Larger => tangent * aspect.min(1.0),
                };
                Camera::perspective(self.view, half_width, half_width / aspect)?
            }
            ProjectionDescription::Orthographic { half_width } => {
                Camera::orthographic(self.view, half_width, half_width / aspect)?
            }
        };
        camera.with_clip(self.near, self.far)
    }
}

impl Description {
    /// Empties the meshes: for a program that has built from them, and wants their memory back.
    pub fn forget_meshes(&mut self) {
        for object in &mut self.objects {
            if let Geometry::Mesh(mesh) = &mut object.geometry {
                *mesh = Mesh::default();
            }
        }
    }

    /// Number of triangles, those of meshes included.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.objects
            .iter()
            .map(|o| match &o.geometry {
                Geometry::Mesh(m) => m.triangles.len(),
                Geometry::Shape(AnyShape::Triangle(_)) => 1,
                Geometry::Shape(_) => 0,
            })
            .sum()
    }
}
