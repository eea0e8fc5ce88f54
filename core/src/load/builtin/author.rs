//! What the authors of the built-in scenes write with: collects materials, surfaces and lights.

use crate::Rgb;
use crate::bsdf::{AnyBsdf, BsdfError, GgxConductor, Lambert, Phong, TwoSided};
use crate::build::{
    CameraDescription, Description, Emission, FovAxis, Geometry, IntegratorDescription, Material, Mesh,
    Object, ProjectionDescription, SkyError,
};
use crate::camera::{CameraError, View};
use crate::film::Filter;
use crate::light::{AnyLight, LightError};
use crate::shape::ShapeError;
use core::fmt;
use glam::Vec3;
use std::string::String;
use std::vec::Vec;

/// A slip in a scene's numbers. The tests make every scene, so none of these reaches a user.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum BuiltinError {
    Shape(ShapeError),
    Bsdf(BsdfError),
    Light(LightError),
    Camera(CameraError),
    Sky(SkyError),
}

impl fmt::Display for BuiltinError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Shape(e) => e.fmt(f),
            Self::Bsdf(e) => e.fmt(f),
            Self::Light(e) => e.fmt(f),
            Self::Camera(e) => e.fmt(f),
            Self::Sky(e) => e.fmt(f),
        }
    }
}

impl core::error::Error for BuiltinError {}

impl From<ShapeError> for BuiltinError {
    fn from(e: ShapeError) -> Self {
        Self::Shape(e)
    }
}

impl From<SkyError> for BuiltinError {
    fn from(e: SkyError) -> Self {
        Self::Sky(e)
    }
}

impl From<BsdfError> for BuiltinError {
    fn from(e: BsdfError) -> Self {
        Self::Bsdf(e)
    }
}

impl From<LightError> for BuiltinError {
    fn from(e: LightError) -> Self {
        Self::Light(e)
    }
}

impl From<CameraError> for BuiltinError {
    fn from(e: CameraError) -> Self {
        Self::Camera(e)
    }
}

/// A colour or a radiance: three linear channels.
pub(super) type Channels = [f32; 3];

/// How a scene is looked at.
#[derive(Debug, Clone, Copy)]
pub(super) struct Shot {
    pub(super) from: Vec3,
    pub(super) to: Vec3,
    pub(super) projection: ProjectionDescription,
    pub(super) size: [u32; 2],
}

impl Shot {
    /// A perspective picture of 960 × 640; `fov` along its width [degrees].
    pub(super) const fn perspective(from: Vec3, to: Vec3, fov: f32) -> Self {
        let projection = ProjectionDescription::Perspective { fov, axis: FovAxis::X };
        Self { from, to, projection, size: [960, 640] }
    }

    /// A parallel projection of 960 × 640; `half_width` of its window [m].
    pub(super) const fn orthographic(from: Vec3, to: Vec3, half_width: f32) -> Self {
        let projection = ProjectionDescription::Orthographic { half_width };
        Self { from, to, projection, size: [960, 640] }
    }
}

/// A scene in the making.
#[derive(Debug, Default)]
pub(super) struct Author {
    materials: Vec<Material>,
    objects: Vec<Object>,
    lights: Vec<AnyLight<'static>>,
}

impl Author {
    fn material(&mut self, name: &str, bsdf: TwoSided<AnyBsdf>) -> usize {
        self.materials.push(Material { name: name.into(), bsdf, textures: <[_; 2]>::default() });
        self.materials.len() - 1
    }

    /// A matte material for both sides.
    pub(super) fn matte(&mut self, name: &str, reflectance: Channels) -> Result<usize, BuiltinError> {
        let bsdf = AnyBsdf::Lambert(Lambert::new(reflectance.into())?);
        Ok(self.material(name, TwoSided::both(bsdf)))
    }

    /// A matte material with a colourless highlight.
    pub(super) fn glossy(
        &mut self,
        name: &str,
        diffuse: Channels,
        specular: f32,
        exponent: f32,
    ) -> Result<usize, BuiltinError> {
        let bsdf = AnyBsdf::Phong(Phong::new(diffuse.into(), Rgb::splat(specular), exponent)?);
        Ok(self.material(name, TwoSided::both(bsdf)))
    }

    /// A rough metal.
    pub(super) fn metal(
        &mut self,
        name: &str,
        reflectance: Channels,
        alpha: f32,
    ) -> Result<usize, BuiltinError> {
        let bsdf = AnyBsdf::GgxConductor(GgxConductor::new(reflectance.into(), alpha)?);
        Ok(self.material(name, TwoSided::front_only(bsdf)))
    }

    /// Triangles.
    pub(super) fn mesh(&mut self, name: &str, mesh: Mesh, material: usize) {
        let geometry = Geometry::Mesh(mesh);
        self.objects.push(Object {
            name: name.into(),
            geometry,
            material,
            emission: None,
            object_space: None,
        });
    }

    /// A surface that emits from its front and reflects nothing.
    pub(super) fn lamp(
        &mut self,
        name: &str,
        geometry: Geometry,
        radiance: Channels,
    ) -> Result<(), BuiltinError> {
        let black = match self.materials.iter().position(|m| m.name == "lamp") {
            Some(index) => index,
            None => self.matte("lamp", [0.0; 3])?,
        };
        let emission = Some(Emission { radiance: radiance.into(), texture: None, two_sided: false });
        self.objects.push(Object {
            name: name.into(),
            geometry,
            material: black,
            emission,
            object_space: None,
        });
        Ok(())
    }

    /// A light without a surface.
    pub(super) fn light(&mut self, light: AnyLight<'static>) {
        self.lights.push(light);
    }

    /// The finished scene.
    pub(super) fn scene(self, name: &str, shot: Shot) -> Result<Description, BuiltinError> {
        let view = View::look_at(shot.from, shot.to, Vec3::Y)?;
        let [width, height] = shot.size;
        // Mitsuba's defaults, so that an exported scene is the same scene.
        let camera = CameraDescription { view, projection: shot.projection, near: 0.01, far: 1e4 };
        Ok(Description {
            name: String::from(name),
            camera,
            width,
            height,
            // The pixel itself: a wider filter costs samples, and shows as noise along edges.
            filter: Filter::PIXEL,
            integrator: IntegratorDescription::default(),
            samples_per_pixel: None,
            materials: self.materials,
            objects: self.objects,
            lights: self.lights,
            environments: Vec::new(),
            portals: Vec::new(),
        })
    }
}
