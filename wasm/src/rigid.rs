//! Lights that keep their form: meshes and painted surfaces are moved, environment maps are turned.

use halflight::build::{EnvironmentDescription, Geometry, Object};
use halflight::glam::{Mat3, Vec3};
use halflight::shape::{AnyShape, Cylinder, Disk, Rectangle, ShapeError, Sphere, Triangle};
use halflight::texture::ObjectSpace;

/// A light with a surface, as it was read.
///
/// Every place is counted from here, so that it does not depend on the places in between.
#[derive(Debug, Clone)]
pub(crate) struct Home {
    middle: Vec3,
    form: Form,
    object_space: Option<ObjectSpace>,
    /// Where the middle is now (m).
    pub(crate) position: Vec3,
}

#[derive(Debug, Clone)]
enum Form {
    Shape(AnyShape),
    Corners(Vec<Vec3>),
}

impl Home {
    /// * `middle` – of the light (m)
    pub(crate) fn new(object: &Object, middle: Vec3) -> Self {
        let form = match &object.geometry {
            Geometry::Shape(shape) => Form::Shape(*shape),
            Geometry::Mesh(mesh) => Form::Corners(mesh.positions.clone()),
        };
        Self { middle, form, object_space: object.object_space, position: middle }
    }

    /// Puts the object, with its middle, to a place (m).
    ///
    /// # Errors
    /// When that is too far away.
    pub(crate) fn put(&mut self, object: &mut Object, position: Vec3) -> Result<(), ShapeError> {
        let by = position - self.middle;
        if !by.is_finite() {
            return Err(ShapeError::NotFinite { field: "position" });
        }
        match (&self.form, &mut object.geometry) {
            (Form::Corners(corners), Geometry::Mesh(mesh)) => {
                mesh.positions.iter_mut().zip(corners).for_each(|(to, from)| *to = *from + by);
            }
            (Form::Shape(shape), geometry) => *geometry = Geometry::Shape(moved(shape, by)?),
            (Form::Corners(_), Geometry::Shape(_)) => {}
        }
        let origin = |space: ObjectSpace| ObjectSpace { origin: space.origin + by, ..space };
        object.object_space = self.object_space.map(origin);
        self.position = position;
        Ok(())
    }
}

/// A shape elsewhere (m).
fn moved(shape: &AnyShape, by: Vec3) -> Result<AnyShape, ShapeError> {
    Ok(match shape {
        AnyShape::Rectangle(r) => {
            AnyShape::Rectangle(Rectangle::new(r.centre() + by, r.half_u(), r.half_v())?)
        }
        AnyShape::Disk(d) => AnyShape::Disk(Disk::new(d.centre() + by, d.axis_u(), d.axis_v())?),
        AnyShape::Sphere(s) => {
            let ball = Sphere::new(s.centre() + by, s.radius())?;
            AnyShape::Sphere(if s.is_inward() { ball.flipped() } else { ball })
        }
        AnyShape::Cylinder(c) => {
            let tube = Cylinder::new(c.base() + by, c.axis(), c.radius())?;
            AnyShape::Cylinder(if c.is_inward() { tube.flipped() } else { tube })
        }
        AnyShape::Triangle(t) => {
            let [a, b, c] = t.corners().map(|corner| corner + by);
            AnyShape::Triangle(Triangle::new(a, b, c)?)
        }
    })
}

/// An environment map's turn.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Turn {
    as_read: Mat3,
    /// About the vertical, `+y`, from how it was read (degrees, counter-clockwise seen from above).
    pub(crate) degrees: f32,
}

impl Turn {
    /// None yet.
    pub(crate) const fn none(map: &EnvironmentDescription) -> Self {
        Self { as_read: map.to_world, degrees: 0.0 }
    }

    /// Turns the map.
    pub(crate) fn put(&mut self, map: &mut EnvironmentDescription, degrees: f32) {
        self.degrees = degrees;
        // As it was read to the last bit, and not by a turn of nothing.
        let turned = || Mat3::from_rotation_y(degrees.to_radians()) * self.as_read;
        map.to_world = if degrees == 0.0 { self.as_read } else { turned() };
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Scene;
    use crate::light::Wanted;
    use halflight::Rgb;
    use halflight::build::{Mesh, TextureDescription};
    use halflight::texture::{Kind, Pattern};

    fn wanted(kind: &str, position: Vec3, size: [f32; 2]) -> Wanted<'_> {
        Wanted { kind, position, direction: Vec3::Y, size, strength: Rgb::splat(2.0) }
    }

    /// The built-in scene with its lamp made of two triangles, or painted.
    fn with_lamp(painted: bool) -> Scene {
        let mut description = halflight::load::builtin::builtin("colours").unwrap();
        let lamp = description.objects.iter_mut().find(|o| o.emission.is_some()).unwrap();
        if painted {
            let pattern = Pattern::from(Kind::Checkerboard([Rgb::BLACK, Rgb::WHITE]));
            lamp.emission.as_mut().unwrap().texture = Some(TextureDescription { pattern, texels: None });
        } else {
            let positions = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
            let positions = positions.map(|(x, z)| Vec3::new(x, 5.0, z)).to_vec();
            let triangles = vec![[0, 1, 2], [0, 2, 3]];
            lamp.geometry = Geometry::Mesh(Mesh { positions, triangles, ..Mesh::default() });
        }
        Scene::new(description, Vec::new()).unwrap()
    }

    fn rendered(scene: &mut Scene) -> Vec<u32> {
        scene.resize(24, 16).unwrap();
        let mut words = vec![0; 24 * 16 * crate::render::WORDS];
        let tile = halflight::film::PixelRect { x0: 0, y0: 0, x1: 24, y1: 16 };
        scene.add_samples(tile, 0..4, &mut words).unwrap();
        words
    }

    #[test]
    fn meshes_and_painted_lights_move_whichever_way_they_went() {
        for (painted, kind) in [(false, "mesh"), (true, "painted")] {
            let [mut straight, mut around] = [with_lamp(painted), with_lamp(painted)];
            assert_eq!(straight.lights()[0].kind, kind);
            let before = rendered(&mut straight);
            let to = Vec3::new(0.4, 5.5, -0.7);
            straight.change_light(0, &wanted(kind, to, [0.0; 2])).unwrap();
            around.change_light(0, &wanted(kind, Vec3::splat(3.3), [0.0; 2])).unwrap();
            around.change_light(0, &wanted(kind, to, [0.0; 2])).unwrap();
            assert_eq!(straight.lights()[0].position, to.to_array());
            for scene in [&mut straight, &mut around] {
                scene.settle().unwrap();
            }
            let [a, b] = [rendered(&mut straight), rendered(&mut around)];
            assert!(a == b && a != before, "{kind}");
            let far = wanted(kind, Vec3::splat(f32::INFINITY), [0.0; 2]);
            assert!(straight.change_light(0, &far).is_err());
            assert!(straight.change_light(0, &wanted("disk", to, [1.0; 2])).is_err());
        }
    }

    #[test]
    fn a_sky_turns_all_the_way_round_and_is_scaled() {
        let mut scene = Scene::builtin("morning").unwrap();
        let index = scene.lights().iter().position(|light| light.kind == "map").unwrap();
        let before = rendered(&mut scene);
        let turn = |degrees, strength| Wanted {
            strength: Rgb::splat(strength),
            ..wanted("map", Vec3::ZERO, [degrees, 0.0])
        };
        scene.change_light(index, &turn(90.0, 3.0)).unwrap();
        let light = &scene.lights()[index];
        assert_eq!((light.size[0], light.strength[0]), (90.0, 3.0));
        assert!(rendered(&mut scene) != before);
        assert!(scene.change_light(index, &turn(f32::NAN, 1.0)).is_err());
        assert!(scene.change_light(index, &turn(0.0, -1.0)).is_err());
        scene.change_light(index, &turn(0.0, 1.0)).unwrap();
        assert!(rendered(&mut scene) == before);
    }
}
