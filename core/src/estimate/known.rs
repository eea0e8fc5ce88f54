//! What is known of all samples of a few pixels before the first is taken.
//!
//! Most of a picture is not in doubt: its rays meet one flat surface and nothing before it, and between
//! there and a light is nothing at all. Both are found for all rays of some pixels at once, by asking the
//! tree what is in a convex part of space (Heckbert, Hanrahan 1984, *Beam Tracing Polygonal Objects*; Haines,
//! Wallace 1994, *Shaft Culling for Efficient Ray-Cast Radiosity*). There camera rays need no tree, shadow
//! rays are not traced, and the irradiance of a diffuse surface is its closed form, without noise.
//!
//! Nothing is approximated: where a ray could find something else, nothing is known.

use super::{Estimator, Job};
use crate::camera::Camera;
use crate::film::{Film, PixelRect};
use crate::geom::{Aabb, Ray, Region, unit};
use crate::light::{Emitter, SkyView};
use crate::material::Material;
use crate::num;
use crate::scene::{Interaction, Scene};
use crate::shape::Shape;
use glam::Vec3;

/// With more lights than this, none is looked at: it takes a walk of the tree for each.
const MOST_LIGHTS: usize = 8;

/// What all camera rays meet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Met {
    /// Not the same for all, as far as is known.
    #[default]
    Various,
    /// Nothing.
    Nothing,
    /// The surface with that index, which is flat.
    Surface(u32),
}

/// What is known of all samples of a part of the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Known {
    met: Met,
    lit: u8,
    flat: u8,
}

/// What is known of all samples of a few pixels, and of the sky above the surface that they see.
#[derive(Debug, Clone, Copy, Default)]
pub struct Foreseen<'a> {
    known: Known,
    sky: Option<(usize, &'a SkyView)>,
}

impl<'a> Foreseen<'a> {
    /// * `sky` – the index of an environment map, and how the surface sees it
    pub(super) fn new(known: Known, sky: Option<(usize, &'a SkyView)>) -> Self {
        Self { known, sky }
    }

    /// What is known without the sky.
    #[must_use]
    pub const fn known(&self) -> &Known {
        &self.known
    }
}

impl From<Known> for Foreseen<'_> {
    fn from(known: Known) -> Self {
        Self { known, sky: None }
    }
}

/// What is known of the lights where light is gathered.
pub(super) trait Knowledge: Copy {
    /// True when nothing but a light itself can be between it and any of the points.
    fn is_lit(self, light: usize) -> bool;

    /// True when no shadow ray to a light can be blocked, not even by the light itself.
    fn is_open(self, light: usize) -> bool;

    /// True when a part of the sky is known to be open.
    fn sees_sky(&self) -> bool;

    /// What part of the light nothing hides, of one that is a sky.
    fn sky(&self, light: usize) -> Option<&SkyView>;
}

/// Nothing is known.
impl Knowledge for () {
    #[inline(always)]
    fn is_lit(self, _: usize) -> bool {
        false
    }

    #[inline(always)]
    fn is_open(self, _: usize) -> bool {
        false
    }

    #[inline(always)]
    fn sees_sky(&self) -> bool {
        false
    }

    #[inline(always)]
    fn sky(&self, _: usize) -> Option<&SkyView> {
        None
    }
}

impl Knowledge for Foreseen<'_> {
    #[inline]
    fn is_lit(self, light: usize) -> bool {
        light < MOST_LIGHTS && self.known.lit >> light & 1 == 1
    }

    #[inline]
    fn is_open(self, light: usize) -> bool {
        self.is_lit(light) && self.known.flat >> light & 1 == 1
    }

    #[inline]
    fn sees_sky(&self) -> bool {
        self.sky.is_some()
    }

    #[inline]
    fn sky(&self, light: usize) -> Option<&SkyView> {
        self.sky.filter(|(index, _)| *index == light).map(|(_, view)| view)
    }
}

/// What camera rays between four corners do.
pub(super) struct Sight {
    rays: [Ray; 4],
    pub(super) hits: [Interaction; 4],
}

impl Known {
    /// What all camera rays meet.
    #[inline]
    #[must_use]
    pub const fn met(&self) -> Met {
        self.met
    }

    /// Every bit of it, for keeping it elsewhere: what is met, and the lights.
    pub(super) fn to_words(self) -> [u32; 2] {
        let met = match self.met {
            Met::Various => 0,
            Met::Nothing => 1,
            Met::Surface(index) => index.saturating_add(2),
        };
        [met, u32::from(self.lit) | u32::from(self.flat) << 8]
    }

    /// What [`Known::to_words`] was made from; `None` when the words are not.
    pub(super) fn from_words([met, lights]: [u32; 2]) -> Option<Self> {
        let met = match met {
            0 => Met::Various,
            1 => Met::Nothing,
            index => Met::Surface(index - 2),
        };
        let [lit, flat, 0, 0] = lights.to_le_bytes() else { return None };
        Some(Self { met, lit, flat })
    }

    /// What a camera ray meets first.
    #[inline]
    pub(super) fn first_hit<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        self,
        scene: &Scene<'_, S, L, M, STACK>,
        ray: &Ray,
        reach: f32,
    ) -> Option<Interaction> {
        match self.met {
            Met::Nothing => None,
            Met::Various => scene.closest_hit(ray, reach),
            // By rounding, a ray beside a corner may miss what the corner meets.
            Met::Surface(index) => scene.hit_on(index, ray, reach).or_else(|| scene.closest_hit(ray, reach)),
        }
    }

    /// Looks at all rays of some pixels. Also returns what one of them meets.
    pub(super) fn of_part<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        scene: &Scene<'_, S, L, M, STACK>,
        camera: &Camera,
        film: &Film,
        part: PixelRect,
    ) -> (Self, Option<(Interaction, Vec3)>) {
        let nothing = (Self::default(), None);
        let views = film.corners(part).map(|(x, y)| camera.ray(x, y));
        let rays = views.map(|(ray, _)| ray);
        let hits = views.map(|(ray, reach)| scene.closest_hit(&ray, reach));
        match hits {
            [None, None, None, None] if misses_all(scene, &views) => {
                (Self { met: Met::Nothing, ..Self::default() }, None)
            }
            hits => Sight::new(scene, rays, hits)
                .map_or(nothing, |sight| (sight.look_at_lights(scene), Some(sight.first()))),
        }
    }
}

/// True when no ray between four meets anything.
fn misses_all<S: Shape, L: Emitter, M: Material, const STACK: usize>(
    scene: &Scene<'_, S, L, M, STACK>,
    views: &[(Ray, f32); 4],
) -> bool {
    let bounds = scene.bvh().bounds();
    if bounds.is_empty() {
        return true;
    }
    let rays = views.map(|(ray, _)| ray);
    // Beyond everything, but for what is clipped.
    let far = |ray: &Ray| 2.0 * ((ray.origin - bounds.centre()).length() + bounds.diagonal());
    let ends = views.map(|(ray, reach)| ray.at(reach.min(far(&ray))));
    ends.iter().all(|end| end.is_finite())
        && !meets_any(scene, &Region::beam(&rays, &ends), |_, shape| is_beside(shape, &rays))
}

/// True when a surface may be in a region, but for those that `spare` names.
pub(super) fn meets_any<S: Shape, L: Emitter, M: Material, const STACK: usize>(
    scene: &Scene<'_, S, L, M, STACK>,
    region: &Region,
    mut spare: impl FnMut(u32, &S) -> bool,
) -> bool {
    scene.bvh().any_in(region, |index| {
        scene.surfaces().get(index as usize).is_some_and(|surface| {
            let shape = &surface.shape;
            !spare(index, shape)
                && region.may_meet(&shape.bounds(), |direction| shape.support(Vec3::ZERO, direction))
        })
    })
}

/// True when no ray between four meets the shape.
fn is_beside<S: Shape>(shape: &S, rays: &[Ray; 4]) -> bool {
    shape.outline().is_some_and(|outline| Region::is_beside(rays, &outline))
}

/// True when some points and a box are on the same side of the plane of a flat outline, so that no segment
/// between them crosses it.
fn is_on_one_side(outline: &[Vec3; 4], points: &[Vec3; 4], bounds: &Aabb) -> bool {
    let [a, b, c, _] = *outline;
    let Some(normal) = unit((b - a).cross(c - a)) else { return false };
    let slack = |p: Vec3| num::gamma(32) * normal.abs().dot(p.abs() + a.abs());
    let above = |p: Vec3, side: f32| side * normal.dot(p - a) > slack(p);
    [1.0, -1.0].into_iter().any(|side| {
        let nearest = Vec3::select((normal * side).cmpgt(Vec3::ZERO), bounds.min, bounds.max);
        above(nearest, side) && points.iter().all(|&p| above(p, side))
    })
}

impl Sight {
    /// What all rays between four meet, when that is one flat surface.
    fn new<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        scene: &Scene<'_, S, L, M, STACK>,
        rays: [Ray; 4],
        hits: [Option<Interaction>; 4],
    ) -> Option<Self> {
        let [Some(a), Some(b), Some(c), Some(d)] = hits else { return None };
        let sight = Self { rays, hits: [a, b, c, d] };
        sight.is_of_one_surface(scene).then_some(sight)
    }

    /// The same for the rays of some pixels.
    pub(super) fn of_part<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        scene: &Scene<'_, S, L, M, STACK>,
        camera: &Camera,
        film: &Film,
        part: PixelRect,
    ) -> Option<Self> {
        let views = film.corners(part).map(|(x, y)| camera.ray(x, y));
        let hits = views.map(|(ray, reach)| scene.closest_hit(&ray, reach));
        Self::new(scene, views.map(|(ray, _)| ray), hits)
    }

    /// One of the points, and the unit direction from there to the viewer.
    pub(super) fn first(&self) -> (Interaction, Vec3) {
        (self.hits[0], -self.rays[0].direction)
    }

    /// True when all rays meet the flat surface that the corners meet.
    fn is_of_one_surface<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
    ) -> bool {
        let seen = self.hits[0].surface;
        let is_flat = scene.surfaces().get(seen as usize).is_some_and(|s| s.shape.is_flat());
        if !is_flat || self.hits.iter().any(|hit| hit.surface != seen) {
            return false;
        }
        let mut beam = Region::beam(&self.rays, &self.points());
        beam.cut(-self.normal(), self.hits[0].at.point);
        !meets_any(scene, &beam, |index, shape| index == seen || is_beside(shape, &self.rays))
    }

    pub(super) fn points(&self) -> [Vec3; 4] {
        self.hits.map(|hit| hit.at.point)
    }

    /// Geometric normal toward the viewer.
    pub(super) fn normal(&self) -> Vec3 {
        let normal = self.hits[0].at.normal;
        if normal.dot(self.rays[0].direction) <= 0.0 { normal } else { -normal }
    }

    /// Rays leave from so far above the surface: what is below is not in their way (m).
    pub(super) fn lift(&self) -> f32 {
        let normal = self.normal().abs();
        2.0 * self.hits.iter().map(|hit| normal.dot(hit.at.error)).fold(0.0, f32::max)
    }

    /// What is known of the lights of a scene, now that the surface is.
    fn look_at_lights<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
    ) -> Known {
        let mut known = Known { met: Met::Surface(self.hits[0].surface), ..Known::default() };
        let few = scene.lights().len() <= MOST_LIGHTS;
        for (index, light) in scene.lights().iter().enumerate().filter(|_| few) {
            let Some(bounds) = light.bounds() else { continue };
            if let Some(flat) = self.is_lit_by(scene, index as u32, &bounds.region) {
                known.lit |= 1 << index;
                known.flat |= u8::from(flat) << index;
            }
        }
        known
    }

    /// Whether the light is flat, when nothing is between it and what is seen; `None` when there may be.
    fn is_lit_by<S: Shape, L: Emitter, M: Material, const STACK: usize>(
        &self,
        scene: &Scene<'_, S, L, M, STACK>,
        light: u32,
        bounds: &Aabb,
    ) -> Option<bool> {
        let (seen, normal, point) = (self.hits[0].surface, self.normal(), self.hits[0].at.point);
        // Interpolated normals look beyond the plane; what comes from there is not in the closed form.
        let above = |corner: Vec3| normal.dot(corner - point) > 0.0;
        let (near, far) = (bounds.min, bounds.max);
        let lowest = Vec3::select(normal.cmpgt(Vec3::ZERO), near, far);
        if self.hits.iter().any(|hit| hit.shading_normal != hit.at.normal) && !above(lowest) {
            return None;
        }
        let lift = self.lift();
        let shaft = Region::shaft(&Aabb::around(&self.points()), bounds);
        let mut flat = true;
        let blocked = meets_any(scene, &shaft, |index, shape| {
            let is_own = scene.surfaces().get(index as usize).is_some_and(|s| s.light == light);
            flat &= !is_own || shape.is_flat();
            is_own
                || index == seen
                || shape.support(point, normal) <= lift
                || shape.outline().is_some_and(|outline| is_on_one_side(&outline, &self.points(), bounds))
        });
        (!blocked).then_some(flat)
    }
}

impl<S: Shape, L: Emitter, M: Material, E: Estimator, Q> Job<'_, S, L, M, E, Q> {
    /// What is known of a part of the film, and whether a few samples of it will do.
    pub(super) fn look_ahead(&self, part: PixelRect) -> (Known, bool) {
        if !self.estimator.looks_ahead() {
            return (Known::default(), false);
        }
        let (known, hit) = Known::of_part(&self.scene, &self.camera, &self.film, part);
        let is_smooth = match (known.met, hit) {
            (Met::Nothing, _) => self.scene.environments().next().is_none(),
            (Met::Surface(_), Some((hit, wo))) => self.estimator.is_smooth(&self.scene, known, &hit, wo),
            _ => false,
        };
        (known, is_smooth)
    }
}

#[cfg(all(test, feature = "load"))]
mod tests;
