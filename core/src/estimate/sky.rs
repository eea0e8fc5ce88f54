//! What is known of the sky above a few pixels.
//!
//! From all points of a flat surface that some pixels see, the tree is asked part by part whether something
//! is in the way of the sky (see [`super::known`]). The parts where nothing is count in closed form.

use super::known::{Sight, meets_any};
use super::{AdaptiveTile, Estimator, Foreseen, Job, Known, Met};
use crate::film::PixelRect;
use crate::geom::{Aabb, Region};
use crate::light::{ClearSky, Emitter, EnvironmentMap, SkyPart, SkyView};
use crate::material::Material;
use crate::num;
use crate::scene::Scene;
use crate::shape::Shape;
use glam::Vec3;

/// What is known of the sky above a group of blocks.
#[expect(clippy::large_enum_variant, reason = "under a sky most are seen, and here is no heap")]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) enum Sky {
    /// Nobody has asked yet.
    #[default]
    Unasked,
    /// Nothing.
    Unknown,
    /// A surface with that normal sees that much of the environment map with that index.
    Seen { light: usize, normal: Vec3, clear: ClearSky },
}

/// The sky above the group whose blocks are being sampled.
#[derive(Debug, Default)]
pub(super) struct Above {
    group: Option<usize>,
    view: Option<(usize, SkyView)>,
}

impl Above {
    /// What is known of a block, and of the sky above its group.
    pub(super) fn foreseen<S: Shape, L: Emitter, M: Material, E: Estimator, Q>(
        &mut self,
        job: &Job<'_, S, L, M, E, Q>,
        tile: &mut AdaptiveTile,
        group: usize,
        known: Known,
    ) -> Foreseen<'_> {
        if !matches!(known.met(), Met::Surface(_)) {
            return known.into();
        }
        if self.group != Some(group) {
            (self.group, self.view) = (Some(group), job.view(job.sky_above(tile, group)));
        }
        Foreseen::new(known, self.view.as_ref().map(|(light, view)| (*light, view)))
    }
}

impl<S: Shape, L: Emitter, M: Material, E: Estimator, Q> Job<'_, S, L, M, E, Q> {
    /// What is known of the sky above a group.
    fn sky_above<'t>(&self, tile: &'t mut AdaptiveTile, group: usize) -> &'t Sky {
        let part = tile.group(group);
        let sky = tile.sky(group);
        if *sky == Sky::Unasked {
            *sky = self.look_up(part).unwrap_or(Sky::Unknown);
        }
        sky
    }

    /// How a surface sees the sky above it, and which light that is.
    fn view(&self, sky: &Sky) -> Option<(usize, SkyView)> {
        let Sky::Seen { light, normal, clear } = sky else { return None };
        let map = self.scene.lights().get(*light)?.environment_map()?;
        Some((*light, map.view(*normal, clear)?))
    }

    /// Finds out which parts of the sky are open from all that some pixels see.
    fn look_up(&self, part: PixelRect) -> Option<Sky> {
        let scene = &self.scene;
        let (light, map) = scene.environments().find_map(|(i, light)| Some((i, light.environment_map()?)))?;
        let sight = Sight::of_part(scene, &self.camera, &self.film, part)?;
        // Interpolated normals differ from point to point.
        let is_plain = sight.hits.iter().all(|hit| hit.shading_normal == hit.at.normal);
        let (hit, wo) = sight.first();
        if !(is_plain && self.estimator.uses_sky(scene, &hit, wo)) {
            return None;
        }
        let clear = clear_above(&sight, scene, map)?;
        Some(Sky::Seen { light, normal: sight.normal(), clear })
    }
}

/// The parts of a map that are open from all points that are seen.
fn clear_above<S: Shape, L: Emitter, M: Material, const STACK: usize>(
    sight: &Sight,
    scene: &Scene<'_, S, L, M, STACK>,
    map: &EnvironmentMap<'_>,
) -> Option<ClearSky> {
    let (seen, normal, points) = (sight.hits[0].surface, sight.normal(), sight.points());
    let (lift, everything) = (sight.lift(), scene.bvh().bounds());
    map.clear(normal, |part| {
        let mut region = toward(&points, part, &everything);
        region.cut(-normal, points[0]);
        meets_any(scene, &region, |index, shape| index == seen || shape.support(points[0], normal) <= lift)
    })
}

/// All that lies from four points in a part of the sky, as far as the scene reaches.
fn toward(points: &[Vec3; 4], part: &SkyPart, everything: &Aabb) -> Region {
    let from = Aabb::around(points);
    let SkyPart { outward, axis, sin_radius } = part;
    let cos_radius = num::sqrt((1.0 - sin_radius) * (1.0 + sin_radius));
    // Along each axis of the world, the least and the largest of a cone's directions.
    let spread = axis.map(|a: f32| num::sqrt(num::larger((1.0 - a) * (1.0 + a), 0.0)) * sin_radius + SLACK);
    let (least, largest) = (*axis * cos_radius - spread, *axis * cos_radius + spread);
    let mut bounds = everything.union(from);
    bounds.min = Vec3::select(least.cmpge(Vec3::ZERO), from.min, bounds.min);
    bounds.max = Vec3::select(largest.cmple(Vec3::ZERO), from.max, bounds.max);
    let mut region = Region::within(bounds);
    for normal in *outward {
        let farthest = |a: Vec3, b: Vec3| if normal.dot(b - a) > 0.0 { b } else { a };
        region.cut(normal, points.iter().copied().fold(points[0], farthest));
    }
    region
}

/// More than directions are rounded by.
const SLACK: f32 = 1e-5;

#[cfg(all(test, feature = "load"))]
mod tests;
