//! The lights of a scene: where they are kept, and how they change.

use crate::Scene;
use crate::light::{Light, Made, Wanted, check_emission};
use crate::rigid::Home;
use crate::scene::Res;
use halflight::Rgb;
use halflight::bsdf::{AnyBsdf, Lambert, TwoSided};
use halflight::build::{Description, Emission, Geometry, Material, Object};
use halflight::glam::Vec3;
use halflight::shape::AnyShape;

/// Most lights that a scene is given.
const MOST_LIGHTS: usize = 64;

/// Where a light is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Place {
    Object(usize),
    Free(usize),
    Map(usize),
    /// Nowhere: it was taken away.
    Nowhere,
}

/// Where the lights are kept.
pub(crate) fn places(description: &Description) -> Vec<Place> {
    let objects = description.objects.iter().enumerate().filter(|(_, o)| o.emission.is_some());
    let free = (0..description.lights.len()).map(Place::Free);
    let maps = (0..description.environments.len()).map(Place::Map);
    objects.map(|(i, _)| Place::Object(i)).chain(free).chain(maps).collect()
}

impl Scene {
    /// The light with an index, at its place.
    pub(crate) fn light(&self, index: usize, place: Place) -> Light {
        let map = |i: usize| Some((self.description.environments.get(i)?.scale, self.turns.get(i)?.degrees));
        let light = match place {
            Place::Object(i) => self.description.objects.get(i).and_then(Light::of_object),
            Place::Free(i) => self.description.lights.get(i).map(Light::of_light),
            Place::Map(i) => map(i).map(|(scale, degrees)| Light::of_map(scale, degrees)),
            Place::Nowhere => None,
        };
        let mut light = light.unwrap_or_else(Light::none);
        if let Some(home) = self.homes.get(&index) {
            light.position = home.position.to_array().to_vec();
        }
        light
    }

    /// Changes a light, or adds one when `index` is one beyond the last.
    pub(crate) fn change_light(&mut self, index: usize, wanted: &Wanted<'_>) -> Res<()> {
        let is_new = index == self.places.len() && index < MOST_LIGHTS;
        let place = if is_new { Place::Nowhere } else { *self.places.get(index).ok_or("no such light")? };
        let before = self.light(index, place);
        if !before.editable {
            if wanted.kind != before.kind {
                return Err(format!("a {} light cannot become another one", before.kind).into());
            }
            self.change_rigid(index, place, wanted)?;
            return self.relight();
        }
        let made = wanted.make(self.shape(place))?;
        if is_new {
            self.places.push(place);
        }
        match (place, made) {
            (Place::Object(i), Made::Surface(shape, radiance)) => {
                self.description.objects[i].geometry = Geometry::Shape(shape);
                self.emit(i, radiance);
            }
            (Place::Free(i), Made::Free(light)) => self.description.lights[i] = light,
            (_, made) => {
                self.take_away(place);
                self.places[index] = self.put(before.name, made)?;
            }
        }
        self.relight()
    }

    /// Takes the lights over into the tables.
    fn relight(&mut self) -> Res<()> {
        self.settled = false;
        if self.buffers.relight(&self.description)? { Ok(()) } else { self.build() }
    }

    /// Changes a light that keeps its form.
    fn change_rigid(&mut self, index: usize, place: Place, wanted: &Wanted<'_>) -> Res<()> {
        let radiance = check_emission(wanted.strength)?;
        match place {
            Place::Object(i) => {
                let middle = self.light(index, place).position;
                let object = self.description.objects.get_mut(i).ok_or("no such light")?;
                let new = || Home::new(object, Vec3::from_slice(&middle));
                self.homes.entry(index).or_insert_with(new).put(object, wanted.position)?;
                self.emit(i, radiance);
            }
            Place::Map(i) => {
                let degrees = wanted.size[0];
                let map = self.description.environments.get_mut(i).ok_or("no such map")?;
                if !degrees.is_finite() {
                    return Err("the map's turn is not a number".into());
                }
                self.turns.get_mut(i).ok_or("no such map")?.put(map, degrees);
                map.scale = radiance.max_component();
            }
            Place::Free(_) | Place::Nowhere => {}
        }
        Ok(())
    }

    fn shape(&self, place: Place) -> Option<&AnyShape> {
        let Place::Object(i) = place else { return None };
        match &self.description.objects.get(i)?.geometry {
            Geometry::Shape(shape) => Some(shape),
            Geometry::Mesh(_) => None,
        }
    }

    fn emit(&mut self, object: usize, radiance: Rgb) {
        if let Some(emission) = &mut self.description.objects[object].emission {
            emission.radiance = radiance;
        }
    }

    fn put(&mut self, name: String, made: Made) -> Res<Place> {
        Ok(match made {
            Made::Surface(shape, radiance) => {
                let object = lamp(&mut self.description, name, shape, radiance)?;
                self.description.objects.push(object);
                Place::Object(self.description.objects.len() - 1)
            }
            Made::Free(light) => {
                self.description.lights.push(light);
                Place::Free(self.description.lights.len() - 1)
            }
            Made::Nothing => Place::Nowhere,
        })
    }

    fn take_away(&mut self, removed: Place) {
        match removed {
            Place::Object(i) => drop(self.description.objects.remove(i)),
            Place::Free(i) => drop(self.description.lights.remove(i)),
            Place::Map(_) | Place::Nowhere => {}
        }
        for place in &mut self.places {
            match (place, removed) {
                (Place::Object(i), Place::Object(gone)) | (Place::Free(i), Place::Free(gone))
                    if *i > gone =>
                {
                    *i -= 1;
                }
                _ => {}
            }
        }
    }
}

/// A surface that emits and reflects nothing.
fn lamp(description: &mut Description, name: String, shape: AnyShape, radiance: Rgb) -> Res<Object> {
    let black = TwoSided::both(AnyBsdf::Lambert(Lambert::new(Rgb::BLACK)?));
    let plain = |m: &Material| m.bsdf == black && m.is_plain();
    let material = match description.materials.iter().position(plain) {
        Some(index) => index,
        None => {
            let textures = <[_; 2]>::default();
            description.materials.push(Material { name: "lamp".to_owned(), bsdf: black, textures });
            description.materials.len() - 1
        }
    };
    let emission = Some(Emission { radiance, texture: None, two_sided: false });
    Ok(Object { name, geometry: Geometry::Shape(shape), material, emission, object_space: None })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wanted(kind: &str) -> Wanted<'_> {
        let (position, direction) = (Vec3::new(0.0, 3.0, 0.0), Vec3::NEG_Y);
        Wanted { kind, position, direction, size: [0.5, 0.5], strength: Rgb::new(3.0, 2.0, 1.0) }
    }

    fn kinds(scene: &Scene) -> Vec<String> {
        scene.lights().into_iter().map(|light| light.kind).collect()
    }

    #[test]
    fn lights_come_go_and_come_back_under_their_index() {
        let mut scene = Scene::builtin("colours").unwrap();
        assert_eq!(kinds(&scene), ["rectangle", "disk", "sphere"]);
        scene.change_light(3, &wanted("spot")).unwrap();
        scene.change_light(0, &wanted("none")).unwrap();
        scene.change_light(1, &wanted("point")).unwrap();
        assert_eq!(kinds(&scene), ["none", "point", "sphere", "spot"]);
        assert_eq!(scene.facts().lights, 3);
        scene.change_light(0, &wanted("distant")).unwrap();
        scene.change_light(3, &wanted("none")).unwrap();
        assert_eq!(kinds(&scene), ["distant", "point", "sphere", "none"]);
        assert!(scene.change_light(9, &wanted("point")).is_err());
        assert_eq!(scene.facts().lights, 3);
    }
}
