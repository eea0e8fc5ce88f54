//! The scene as the kernel sees it: borrowed slices, checked once.
//!
//! Generic over what it holds, so that a program whose scene has one kind of shape, light and BSDF
//! links no other. [`AnyScene`] is the instance that holds everything.

mod baked;
mod tables;

pub use baked::BakedError;
pub use tables::{CornerNormals, CornerUvs, NONE, SceneError, Surface, Tables};

use crate::Rgb;
use crate::bvh::Bvh;
use crate::geom::{PreparedRay, Ray, offset_origin};
use crate::light::{AnyLight, Emitter, Receiver};
use crate::material::{AnyMaterial, Material};
use crate::shape::{AnyShape, Shape, ShapeHit, SurfacePoint};
use glam::{Vec2, Vec3};

/// How much of the way to a light a shadow ray is followed: a light's own surface, or a lamp's
/// housing in the same plane, does not shadow it through rounding. A fraction, not a length.
const SHADOW_REACH: f32 = 1.0 - 1e-4;

/// A scene: its tree and its tables.
///
/// * `STACK` – entries of the traversal stack, as in [`Bvh`]
#[derive(Debug)]
pub struct Scene<'a, S, L, M, const STACK: usize = { crate::bvh::STACK }> {
    bvh: Bvh<'a, STACK>,
    tables: Tables<'a, S, L, M>,
    first_environment: usize,
    has_delta_light: bool,
    has_light_to_meet: bool,
    leaves_to_bsdf: bool,
}

// Not derived: a scene is copied as a view, whatever it is generic over.
impl<S, L, M, const STACK: usize> Clone for Scene<'_, S, L, M, STACK> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S, L, M, const STACK: usize> Copy for Scene<'_, S, L, M, STACK> {}

/// The scene that holds any shape, light and material.
pub type AnyScene<'a> = Scene<'a, AnyShape, AnyLight<'a>, AnyMaterial<'a>>;

/// What a ray has met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interaction {
    /// Place, error bound and geometric normal, on the front side.
    pub at: SurfacePoint,
    /// Shading normal, on the front side.
    pub shading_normal: Vec3,
    /// Distance along the ray (m).
    pub distance: f32,
    /// Index of the material.
    pub material: u32,
    /// Index of the light, or [`NONE`].
    pub light: u32,
    /// Index of the surface.
    pub surface: u32,
    /// Where on it, in the coordinates of [`ShapeHit`].
    pub place: Vec2,
}

impl Interaction {
    /// Where a viewer in the unit direction `wo` sees light gathered: the shading normal on the side that
    /// is looked at, or the geometric one where the shading normal turns away from the viewer.
    #[inline]
    #[must_use]
    pub fn receiver(&self, wo: Vec3) -> Receiver {
        let front = self.at.normal.dot(wo) >= 0.0;
        let agrees = (self.shading_normal.dot(wo) >= 0.0) == front;
        let normal = if agrees { self.shading_normal } else { self.at.normal };
        Receiver { point: self.at.point, normal: if front { normal } else { -normal } }
    }
}

impl<'a, S: Shape, L: Emitter, M: Material, const STACK: usize> Scene<'a, S, L, M, STACK> {
    /// Borrows the tables of a scene. Primitive `i` of the tree is `surfaces[i]`.
    ///
    /// # Errors
    /// When a surface names a missing entry, or a light that surrounds the scene is not among the last.
    /// That the tree fits the surfaces is [`Bvh::new`]'s business, to which their number has been told.
    pub fn new(bvh: Bvh<'a, STACK>, tables: Tables<'a, S, L, M>) -> Result<Self, SceneError> {
        tables.check_surfaces()?;
        Self::known_to_fit(bvh, tables)
    }

    /// [`Scene::new`] for tables whose surfaces were checked before, which takes a look at each.
    ///
    /// # Errors
    /// When a light that surrounds the scene is not among the last.
    pub(crate) fn known_to_fit(bvh: Bvh<'a, STACK>, tables: Tables<'a, S, L, M>) -> Result<Self, SceneError> {
        Ok(Self {
            bvh,
            tables,
            first_environment: tables.first_environment()?,
            has_delta_light: tables.lights.iter().any(L::is_delta),
            has_light_to_meet: tables.lights.iter().any(|l| !l.is_delta()),
            leaves_to_bsdf: tables.lights.iter().any(L::leaves_to_bsdf),
        })
    }

    /// The tree.
    #[must_use]
    pub fn bvh(&self) -> &Bvh<'a, STACK> {
        &self.bvh
    }

    /// The tables.
    #[must_use]
    pub fn tables(&self) -> &Tables<'a, S, L, M> {
        &self.tables
    }

    /// The surfaces.
    #[must_use]
    pub fn surfaces(&self) -> &'a [Surface<S>] {
        self.tables.surfaces
    }

    /// The lights.
    #[must_use]
    pub fn lights(&self) -> &'a [L] {
        self.tables.lights
    }

    /// The materials.
    #[must_use]
    pub fn materials(&self) -> &'a [M] {
        self.tables.materials
    }

    /// True when a light can only be sampled, because no ray meets it.
    #[inline]
    #[must_use]
    pub fn has_delta_light(&self) -> bool {
        self.has_delta_light
    }

    /// True when a ray can meet a light.
    #[inline]
    #[must_use]
    pub fn has_light_to_meet(&self) -> bool {
        self.has_light_to_meet
    }

    /// True when a light leaves a part of it to directions from the BSDF.
    #[inline]
    #[must_use]
    pub fn leaves_to_bsdf(&self) -> bool {
        self.leaves_to_bsdf
    }

    /// The lights that surround the scene, each with its index.
    #[inline]
    pub fn environments(&self) -> impl Iterator<Item = (usize, &'a L)> + use<'a, S, L, M, STACK> {
        let first = self.first_environment;
        self.tables
            .lights
            .get(first..)
            .unwrap_or_default()
            .iter()
            .enumerate()
            .map(move |(i, light)| (first + i, light))
    }

    /// Radiance that arrives along `wi` from beyond all surfaces (W m⁻² sr⁻¹).
    #[inline]
    #[must_use]
    pub fn radiance_escaping(&self, wi: Vec3) -> Rgb {
        self.environments().fold(Rgb::BLACK, |sum, (_, light)| sum + light.radiance_escaping(wi))
    }

    /// The nearest surface within `reach` (m) along a ray with unit direction.
    #[inline]
    #[must_use]
    pub fn closest_hit(&self, ray: &Ray, reach: f32) -> Option<Interaction> {
        let prepared = PreparedRay::new(*ray);
        let (index, hit) = self.bvh.closest_hit(&prepared, reach, |primitive, t_max| {
            let hit = self.tables.surfaces.get(primitive as usize)?.shape.intersect(&prepared, t_max)?;
            Some((hit.t, (primitive, hit)))
        })?;
        self.tables.surfaces.get(index as usize).map(|surface| self.interaction(index, surface, ray, &hit))
    }

    /// Where a ray with unit direction meets a surface, whatever stands before it.
    #[inline]
    #[must_use]
    pub(crate) fn hit_on(&self, index: u32, ray: &Ray, reach: f32) -> Option<Interaction> {
        let surface = self.tables.surfaces.get(index as usize)?;
        let hit = surface.shape.intersect(&PreparedRay::new(*ray), reach)?;
        Some(self.interaction(index, surface, ray, &hit))
    }

    /// Everything about a hit.
    #[inline]
    fn interaction(&self, index: u32, surface: &Surface<S>, ray: &Ray, hit: &ShapeHit) -> Interaction {
        let at = surface.shape.surface_point(ray, hit);
        let shading_normal = match self.tables.normals.get(surface.normals as usize) {
            Some(CornerNormals([a, b, c])) => {
                let n = *a * (1.0 - hit.u - hit.v) + *b * hit.u + *c * hit.v;
                crate::geom::unit(n).unwrap_or(at.normal)
            }
            None => at.normal,
        };
        Interaction {
            at,
            shading_normal,
            distance: hit.t,
            material: surface.material,
            light: surface.light,
            surface: index,
            place: Vec2::new(hit.u, hit.v),
        }
    }

    /// Texture coordinates of a hit: those between the corners of a triangle, or of the unit shape,
    /// where the surface has such; else the shape's own.
    #[inline]
    #[must_use]
    pub fn uv(&self, hit: &Interaction) -> Vec2 {
        let Some(surface) = self.tables.surfaces.get(hit.surface as usize) else { return Vec2::ZERO };
        let index = surface.uvs as usize;
        if let Some(corners) = self.tables.uvs.get(index) {
            return corners.at(hit.place.x, hit.place.y);
        }
        let unit = match self.tables.object_spaces.get(index.wrapping_sub(self.tables.uvs.len())) {
            Some(space) => space.unit_point(hit.at.point),
            None => surface.shape.unit_point(hit.at.point),
        };
        surface.shape.uv(unit)
    }

    /// Direction in which the first texture coordinate grows at a hit, of any length and either sign;
    /// zero where there is none.
    #[must_use]
    pub fn tangent(&self, hit: &Interaction) -> Vec3 {
        let Some(surface) = self.tables.surfaces.get(hit.surface as usize) else { return Vec3::ZERO };
        let index = surface.uvs as usize;
        if let Some(space) = self.tables.object_spaces.get(index.wrapping_sub(self.tables.uvs.len())) {
            let unit = surface.shape.unit_tangent(space.unit_point(hit.at.point));
            return space.to_object.inverse() * unit;
        }
        let tangents = surface.shape.tangents(hit.at.point);
        match self.tables.uvs.get(index) {
            Some(corners) => corners.tangent(tangents),
            None => tangents[0],
        }
    }

    /// True when nothing stands between a surface point and a light `distance` (m) away, or anything
    /// at all when the distance is infinite.
    #[inline]
    #[must_use]
    pub fn visible(&self, from: &SurfacePoint, wi: Vec3, distance: f32) -> bool {
        self.unblocked(from, wi, distance, None)
    }

    /// True when nothing stands between a surface point and a point of the light with index `light`,
    /// `distance` (m) away. The light's own surface is in the way only of its far side.
    #[inline]
    #[must_use]
    pub fn light_visible(&self, from: &SurfacePoint, wi: Vec3, distance: f32, light: usize) -> bool {
        self.unblocked(from, wi, distance, Some(light as u32))
    }

    #[inline]
    fn unblocked(&self, from: &SurfacePoint, wi: Vec3, distance: f32, light: Option<u32>) -> bool {
        let origin = offset_origin(from.point, from.error, from.normal, wi);
        let prepared = PreparedRay::new(Ray::new(origin, wi));
        let reach = distance * SHADOW_REACH;
        !self.bvh.any_hit(&prepared, reach, |primitive| {
            self.tables.surfaces.get(primitive as usize).is_some_and(|s| {
                if Some(s.light) == light {
                    s.shape.hides_itself(&prepared, reach)
                } else {
                    s.shape.intersect(&prepared, reach).is_some()
                }
            })
        })
    }

    /// What leaves a surface point by its own light, toward the unit direction `wo` (W m⁻² sr⁻¹).
    #[inline]
    #[must_use]
    pub fn emitted(&self, at: &Interaction, wo: Vec3) -> Rgb {
        match self.tables.lights.get(at.light as usize) {
            Some(light) => light.radiance(&at.at, wo),
            None => Rgb::BLACK,
        }
    }
}
