//! Lights that move while the rest of the scene stays.

use super::primitives::{Primitive, list_where};
use super::surroundings::EnvironmentBuffer;
use super::{BuildError, Description, SceneBuffers};
use crate::bvh::{Child, WIDTH};
use crate::geom::Aabb;
use crate::scene::NONE;
use crate::shape::Shape;
use core::mem::take;
use core::ops::Range;
use std::vec;
use std::vec::Vec;

impl SceneBuffers {
    /// Takes over the lights of a description that differs from the one built from in its lights only:
    /// in their kinds, places, sizes and emission, not in the number of those with and without a surface,
    /// and in the turn and the scale of environment maps. The tree keeps its form and gets new boxes where
    /// lights have moved; that is far less work than building it.
    ///
    /// False, with nothing changed, when there are more or fewer lights than before, or other environment
    /// maps: then build anew.
    ///
    /// # Errors
    /// When a light contradicts itself; see [`BuildError`]. The tables then have to be built anew.
    pub fn relight(&mut self, description: &Description) -> Result<bool, BuildError> {
        let skies = &description.environments;
        let suits = |(map, wanted): (&EnvironmentBuffer, _)| map.suits(wanted);
        if self.environments.len() != skies.len() || !self.environments.iter().zip(skies).all(suits) {
            return Ok(false);
        }
        let (primitives, _) = list_where(description, |object| object.emission.is_some())?;
        let before = (take(&mut self.lights), take(&mut self.painted));
        let light_of = self.list_lights(description, &primitives)?;
        let old: Vec<u32> = self.surfaces.iter().map(|s| s.light).filter(|&light| light != NONE).collect();
        let new: Vec<_> = light_of.iter().zip(&primitives).filter(|(light, _)| **light != NONE).collect();
        let same = |(light, _): &(&u32, _)| old.contains(light);
        if self.lights.len() != before.0.len() || new.len() != old.len() || !new.iter().all(same) {
            (self.lights, self.painted) = before;
            return Ok(false);
        }
        self.environments.iter_mut().zip(skies).try_for_each(|(map, wanted)| map.follow(wanted))?;
        let first = new.first().map_or(NONE, |(light, _)| **light);
        let moved = self.put(|light| *new[(light - first) as usize].1, description);
        let bounds = self.refit(&moved);
        self.prepare_choices(0.5 * bounds.diagonal())?;
        Ok(true)
    }

    /// Gives the surfaces that are lights the form of their primitives; which surfaces they are, in order.
    fn put(&mut self, primitive: impl Fn(u32) -> Primitive, description: &Description) -> Vec<u32> {
        let mut moved = Vec::new();
        for (index, surface) in (0..).zip(&mut self.surfaces).filter(|(_, s)| s.light != NONE) {
            let primitive = primitive(surface.light);
            if let Some(shape) = primitive.shape(description) {
                surface.shape = shape;
                moved.push(index);
            }
            let space = (surface.uvs as usize).checked_sub(self.uvs.len());
            let space = space.and_then(|i| self.object_spaces.get_mut(i));
            if let Some((space, wanted)) = space.zip(primitive.object_space(description)) {
                *space = wanted;
            }
        }
        moved
    }

    /// Computes the boxes around surfaces that have moved, which stand in order, anew; the box around
    /// everything. Children stand behind their parents.
    fn refit(&mut self, moved: &[u32]) -> Aabb {
        let mut changed = vec![false; self.nodes.len()];
        for index in (0..self.nodes.len()).rev() {
            for slot in 0..WIDTH {
                let child = self.nodes[index].child(slot);
                let bounds = match child {
                    Child::Node(below) if changed[below as usize] => self.nodes[below as usize].bounds(),
                    Child::Leaf { first, count } if any_of(moved, first..first + count) => self.surfaces
                        [first as usize..(first + count) as usize]
                        .iter()
                        .fold(Aabb::EMPTY, |b, s| b.union(s.shape.bounds())),
                    _ => continue,
                };
                self.nodes[index] = self.nodes[index].with_child(slot, child, bounds);
                changed[index] = true;
            }
        }
        self.nodes.first().map_or(Aabb::EMPTY, |root| root.bounds())
    }
}

/// True when one of the numbers, which stand in order, is in the range.
fn any_of(numbers: &[u32], range: Range<u32>) -> bool {
    let first = numbers.partition_point(|&i| i < range.start);
    numbers.get(first).is_some_and(|&i| i < range.end)
}

#[cfg(all(test, feature = "load"))]
mod tests {
    use super::*;
    use crate::Rgb;
    use crate::build::{Geometry, TextureDescription};
    use crate::bvh::Bvh;
    use crate::light::{AnyLight, EnvironmentDensity, Point};
    use crate::load::builtin::builtin;
    use crate::shape::{AnyShape, Disk, Sphere};
    use crate::texture::{Kind, Pattern};
    use glam::{Mat3, Vec3};

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
    fn lights_with_a_picture_move_with_it() {
        let mut before = builtin("colours").unwrap();
        let pattern = Pattern::from(Kind::Checkerboard([Rgb::BLACK, Rgb::WHITE]));
        let checks = TextureDescription { pattern, texels: None };
        let lamp = |d: &Description| d.objects.iter().position(|o| o.emission.is_some()).unwrap();
        let index = lamp(&before);
        before.objects[index].emission.as_mut().unwrap().texture = Some(checks);
        let mut buffers = SceneBuffers::new(&before).unwrap();
        let ball = AnyShape::Sphere(Sphere::new(Vec3::new(0.3, 7.0, -2.0), 0.5).unwrap());
        let after = with_light(&before, ball);
        assert!(buffers.relight(&after).unwrap());
        let anew = SceneBuffers::new(&after).unwrap();
        assert_eq!(buffers.bind().scene().lights(), anew.bind().scene().lights());
        assert_eq!(buffers.power, anew.power);
    }

    #[test]
    fn maps_turn_and_scale_while_their_tables_stay() {
        let mut description = builtin("morning").unwrap();
        let mut buffers = SceneBuffers::new(&description).unwrap();
        let sky = &mut description.environments[0];
        (sky.to_world, sky.scale) = (Mat3::from_rotation_y(0.7), 2.5);
        assert!(buffers.relight(&description).unwrap());
        let anew = SceneBuffers::new(&description).unwrap();
        assert_eq!(buffers.bind().scene().lights(), anew.bind().scene().lights());
        assert_eq!(buffers.power, anew.power);
        description.environments[0].scale = -1.0;
        assert!(buffers.relight(&description).is_err());
        description.environments[0].scale = 1.0;
        description.environments[0].density = EnvironmentDensity::Cosine;
        assert!(!buffers.relight(&description).unwrap());
        description.environments.clear();
        assert!(!buffers.relight(&description).unwrap());
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
