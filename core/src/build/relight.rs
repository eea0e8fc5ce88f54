//! Lights that move while the rest of the scene stays.

use super::primitives::list_where;
use super::{BuildError, Description, SceneBuffers};
use crate::bvh::{Child, WIDTH};
use crate::geom::Aabb;
use crate::scene::NONE;
use crate::shape::Shape;
use core::mem::take;
use std::vec::Vec;

impl SceneBuffers {
    /// Takes over the lights of a description that differs from the one built from in its lights only:
    /// in their kinds, places, sizes and emission, not in the number of those with and without a surface.
    /// The tree keeps its form and gets new boxes; that is far less work than building it.
    ///
    /// False, with nothing changed, when there are more or fewer lights than before, or lights with a
    /// picture: then build anew.
    ///
    /// # Errors
    /// When a light contradicts itself; see [`BuildError`]. The tables then have to be built anew.
    pub fn relight(&mut self, description: &Description) -> Result<bool, BuildError> {
        if !self.painted.is_empty() || has_picture(description) {
            return Ok(false);
        }
        let (primitives, _) = list_where(description, |object| object.emission.is_some())?;
        let before = take(&mut self.lights);
        let light_of = self.list_lights(description, &primitives)?;
        let old: Vec<u32> = self.surfaces.iter().map(|s| s.light).filter(|&light| light != NONE).collect();
        let new: Vec<_> = light_of.iter().zip(&primitives).filter(|(light, _)| **light != NONE).collect();
        let same = |(light, _): &(&u32, _)| old.contains(light);
        if self.lights.len() != before.len() || new.len() != old.len() || !new.iter().all(same) {
            self.lights = before;
            return Ok(false);
        }
        let first = new.first().map_or(NONE, |(light, _)| **light);
        for surface in self.surfaces.iter_mut().filter(|s| s.light != NONE) {
            let (_, primitive) = new[(surface.light - first) as usize];
            if let Some(shape) = primitive.shape(description) {
                surface.shape = shape;
            }
        }
        let bounds = self.refit();
        self.power = Vec::new();
        self.prepare_choices(0.5 * bounds.diagonal())?;
        Ok(true)
    }

    /// Computes the boxes of all nodes anew; the box around everything. Children stand behind their
    /// parents.
    fn refit(&mut self) -> Aabb {
        for index in (0..self.nodes.len()).rev() {
            let mut node = self.nodes[index];
            for slot in 0..WIDTH {
                let child = node.child(slot);
                let bounds = match child {
                    Child::Empty => Aabb::EMPTY,
                    Child::Node(below) => self.nodes[below as usize].bounds(),
                    Child::Leaf { first, count } => self.surfaces[first as usize..(first + count) as usize]
                        .iter()
                        .fold(Aabb::EMPTY, |b, s| b.union(s.shape.bounds())),
                };
                node = node.with_child(slot, child, bounds);
            }
            self.nodes[index] = node;
        }
        self.nodes.first().map_or(Aabb::EMPTY, |root| root.bounds())
    }
}

/// True when a light has a picture, of which the tables keep more than the light.
fn has_picture(description: &Description) -> bool {
    description.objects.iter().any(|o| o.emission.as_ref().is_some_and(|e| e.texture.is_some()))
}

#[cfg(all(test, feature = "load"))]
mod tests {
    use super::*;
    use crate::Rgb;
    use crate::build::Geometry;
    use crate::bvh::Bvh;
    use crate::light::{AnyLight, Point};
    use crate::load::builtin::builtin;
    use crate::shape::{AnyShape, Disk, Sphere};
    use glam::Vec3;

    /// The first light of a scene becomes another one.
    fn with_light(description: &Description, shape: AnyShape) -> Description {
        let mut moved = description.clone();
        let lamp = moved.objects.iter_mut().find(|o| o.emission.is_some()).unwrap();
        lamp.geometry = Geometry::Shape(shape);
        moved
    }

    #[test]
    fn lights_that_moved_are_those_of_a_scene_built_anew() {
        let before = builtin("colours").unwrap();
        let ball = AnyShape::Sphere(Sphere::new(Vec3::new(0.3, 7.0, -2.0), 0.5).unwrap());
        let disk = AnyShape::Disk(Disk::new(Vec3::Y * 9.0, Vec3::Z, Vec3::X * 0.3).unwrap());
        let mut buffers = SceneBuffers::new(&before).unwrap();
        for shape in [ball, disk] {
            let after = with_light(&before, shape);
            assert!(buffers.relight(&after).unwrap());
            let anew = SceneBuffers::new(&after).unwrap();
            assert_eq!(buffers.lights, anew.lights);
            assert_eq!(buffers.power, anew.power);
            assert_eq!(buffers.light_tree, anew.light_tree);
            assert_eq!(buffers.nodes[0].bounds(), anew.nodes[0].bounds());
            Bvh::new(&buffers.nodes, buffers.surfaces.len()).unwrap();
            let lamps = |b: &SceneBuffers| {
                let mut lamps: Vec<_> = b.surfaces.iter().filter(|s| s.light != NONE).copied().collect();
                lamps.sort_by_key(|s| s.light);
                lamps
            };
            assert_eq!(lamps(&buffers), lamps(&anew));
        }
    }

    #[test]
    fn what_did_not_move_keeps_every_bit() {
        let description = builtin("still-life").unwrap();
        let mut buffers = SceneBuffers::new(&description).unwrap();
        let nodes = buffers.nodes.clone();
        assert!(buffers.relight(&description).unwrap());
        assert_eq!(buffers.nodes, nodes);
    }

    #[test]
    fn another_number_of_lights_is_left_to_building() {
        let description = builtin("still-life").unwrap();
        let mut buffers = SceneBuffers::new(&description).unwrap();
        let lights = buffers.lights.clone();
        let mut more = description.clone();
        more.lights.push(AnyLight::Point(Point::new(Vec3::Y, Rgb::WHITE).unwrap()));
        assert!(!buffers.relight(&more).unwrap());
        let mut dark = description.clone();
        dark.objects.iter_mut().for_each(|o| o.emission = None);
        assert!(!buffers.relight(&dark).unwrap());
        assert_eq!(buffers.lights, lights);
    }
}
