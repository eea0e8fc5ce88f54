//! The scene as the kernel sees it: borrowed slices, checked once.
//!
//! Generic over what it holds, so that a program whose scene has one kind of shape, light and BSDF
//! links no other. [`AnyScene`] is the instance that holds everything.

use crate::Rgb;
use crate::bsdf::{AnyBsdf, Bsdf, TwoSided};
use crate::bvh::Bvh;
use crate::geom::{PreparedRay, Ray, offset_origin};
use crate::light::{AnyLight, Emitter};
use crate::shape::{AnyShape, Shape, ShapeHit, SurfacePoint};
use core::fmt;
use glam::Vec3;

/// No light, no shading normals: what a [`Surface`] names when it has none.
pub const NONE: u32 = u32::MAX;

/// How much of the way to a light a shadow ray is followed: a light's own surface, or a lamp's
/// housing in the same plane, does not shadow it through rounding. A fraction, not a length.
const SHADOW_REACH: f32 = 1.0 - 1e-4;

/// A shape with what it looks like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Surface<S> {
    /// Its form.
    pub shape: S,
    /// Index of its BSDF.
    pub bsdf: u32,
    /// Index of the light that it is, or [`NONE`].
    pub light: u32,
    /// Index of its shading normals, or [`NONE`]; for triangles.
    pub normals: u32,
}

/// Shading normals at the three corners of a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CornerNormals(pub [Vec3; 3]);

/// Borrowed tables of a scene.
#[derive(Debug)]
pub struct Scene<'a, S, L, B> {
    bvh: Bvh<'a>,
    surfaces: &'a [Surface<S>],
    normals: &'a [CornerNormals],
    lights: &'a [L],
    bsdfs: &'a [B],
    environment: Option<u32>,
    has_delta_light: bool,
    has_light_to_meet: bool,
}

// Not derived: a scene is copied as a view, whatever it is generic over.
impl<S, L, B> Clone for Scene<'_, S, L, B> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<S, L, B> Copy for Scene<'_, S, L, B> {}

/// The scene that holds any shape, light and BSDF.
pub type AnyScene<'a> = Scene<'a, AnyShape, AnyLight, TwoSided<AnyBsdf>>;

/// Why a scene was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SceneError {
    /// A surface names something that is not in its table.
    IndexOutOfRange {
        /// Which surface.
        surface: usize,
        /// Which table.
        table: &'static str,
    },
    /// More than one light surrounds the scene.
    TwoEnvironments {
        /// The first.
        first: usize,
        /// The second.
        second: usize,
    },
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::IndexOutOfRange { surface, table } => {
                write!(f, "surface {surface} names an entry that the table of {table} does not have")
            }
            Self::TwoEnvironments { first, second } => {
                write!(f, "lights {first} and {second} both surround the scene; keep one")
            }
        }
    }
}

impl core::error::Error for SceneError {}

/// What a ray has met.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interaction {
    /// Place, error bound and geometric normal, on the front side.
    pub at: SurfacePoint,
    /// Shading normal, on the front side.
    pub shading_normal: Vec3,
    /// Distance along the ray (m).
    pub distance: f32,
    /// Index of the BSDF.
    pub bsdf: u32,
    /// Index of the light, or [`NONE`].
    pub light: u32,
}

impl<'a, S: Shape, L: Emitter, B: Bsdf> Scene<'a, S, L, B> {
    /// Borrows the tables of a scene. Primitive `i` of the tree is `surfaces[i]`.
    ///
    /// # Errors
    /// When a surface names a missing entry, or two lights surround the scene. That the tree fits the
    /// surfaces is [`Bvh::new`]'s business, to which their number has been told.
    pub fn new(
        bvh: Bvh<'a>,
        surfaces: &'a [Surface<S>],
        normals: &'a [CornerNormals],
        lights: &'a [L],
        bsdfs: &'a [B],
    ) -> Result<Self, SceneError> {
        for (surface, s) in surfaces.iter().enumerate() {
            let has = |index: u32, len: usize| index == NONE || (index as usize) < len;
            for (table, ok) in [
                ("BSDFs", (s.bsdf as usize) < bsdfs.len()),
                ("lights", has(s.light, lights.len())),
                ("shading normals", has(s.normals, normals.len())),
            ] {
                if !ok {
                    return Err(SceneError::IndexOutOfRange { surface, table });
                }
            }
        }
        let mut around = lights.iter().enumerate().filter(|(_, l)| l.is_environment()).map(|(i, _)| i);
        let environment = around.next();
        if let (Some(first), Some(second)) = (environment, around.next()) {
            return Err(SceneError::TwoEnvironments { first, second });
        }
        Ok(Self {
            bvh,
            surfaces,
            normals,
            lights,
            bsdfs,
            environment: environment.map(|i| i as u32),
            has_delta_light: lights.iter().any(L::is_delta),
            has_light_to_meet: lights.iter().any(|l| !l.is_delta()),
        })
    }

    /// The tree.
    #[must_use]
    pub fn bvh(&self) -> &Bvh<'a> {
        &self.bvh
    }

    /// The surfaces.
    #[must_use]
    pub fn surfaces(&self) -> &'a [Surface<S>] {
        self.surfaces
    }

    /// The lights.
    #[must_use]
    pub fn lights(&self) -> &'a [L] {
        self.lights
    }

    /// The BSDFs.
    #[must_use]
    pub fn bsdfs(&self) -> &'a [B] {
        self.bsdfs
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

    /// The light around the scene and its index.
    #[inline]
    #[must_use]
    pub fn environment(&self) -> Option<(usize, &'a L)> {
        self.environment.map(|i| (i as usize, &self.lights[i as usize]))
    }

    /// The nearest surface within `reach` (m) along a ray with unit direction.
    #[inline]
    #[must_use]
    pub fn closest_hit(&self, ray: &Ray, reach: f32) -> Option<Interaction> {
        let prepared = PreparedRay::new(*ray);
        let (index, hit) = self.bvh.closest_hit(&prepared, reach, |primitive, t_max| {
            let hit = self.surfaces.get(primitive as usize)?.shape.intersect(&prepared, t_max)?;
            Some((hit.t, (primitive, hit)))
        })?;
        self.surfaces.get(index as usize).map(|surface| self.interaction(surface, ray, &hit))
    }

    /// Everything about a hit.
    #[inline]
    fn interaction(&self, surface: &Surface<S>, ray: &Ray, hit: &ShapeHit) -> Interaction {
        let at = surface.shape.surface_point(ray, hit);
        let shading_normal = match self.normals.get(surface.normals as usize) {
            Some(CornerNormals([a, b, c])) => {
                let n = *a * (1.0 - hit.u - hit.v) + *b * hit.u + *c * hit.v;
                crate::geom::unit(n).unwrap_or(at.normal)
            }
            None => at.normal,
        };
        Interaction { at, shading_normal, distance: hit.t, bsdf: surface.bsdf, light: surface.light }
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
            self.surfaces.get(primitive as usize).is_some_and(|s| {
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
        match self.lights.get(at.light as usize) {
            Some(light) => light.radiance(at.at.normal, wo),
            None => Rgb::BLACK,
        }
    }
}
