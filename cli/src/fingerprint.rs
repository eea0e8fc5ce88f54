//! What tells one scene from another.

use halflight::build::{Description, Geometry, Image, Mesh, Object};
use std::fmt::{self, Debug, Write};
use std::mem;
use std::sync::Arc;
use xxhash_rust::xxh3::Xxh3Default;

/// A hash of a scene as it was read: of every number in it, but not of its name, so that it is the same
/// wherever the files lie.
///
/// What is hashed is the scene as Rust prints it for programmers. That tells every number to the last bit,
/// and leaves out no field that is added later. Meshes and pictures of the sky, which are long, go in as
/// bytes.
pub(crate) fn of_scene(description: &mut Description) -> String {
    let mut hash = Hash(Xxh3Default::new());
    let name = mem::take(&mut description.name);
    let mut meshes: Vec<Mesh> = description.objects.iter_mut().filter_map(mesh).map(mem::take).collect();
    let empty = Arc::new(Image { width: 0, height: 0, texels: Vec::new() });
    let maps = description.environments.iter_mut();
    let skies: Vec<_> = maps.map(|map| mem::replace(&mut map.image, Arc::clone(&empty))).collect();
    hash.print(description);
    meshes.iter().for_each(|mesh| hash.mesh(mesh));
    skies.iter().for_each(|sky| hash.image(sky));
    description.name = name;
    description.objects.iter_mut().filter_map(mesh).zip(&mut meshes).for_each(|(a, b)| mem::swap(a, b));
    description.environments.iter_mut().zip(skies).for_each(|(map, sky)| map.image = sky);
    hash.digits()
}

/// The mesh of an object that is one.
const fn mesh(object: &mut Object) -> Option<&mut Mesh> {
    match &mut object.geometry {
        Geometry::Mesh(mesh) => Some(mesh),
        Geometry::Shape(_) => None,
    }
}

/// A hash of anything that can be printed, as 32 hexadecimal digits.
pub(crate) fn of(value: &impl Debug) -> String {
    let mut hash = Hash(Xxh3Default::new());
    hash.print(value);
    hash.digits()
}

/// What is written goes into the hash.
struct Hash(Xxh3Default);

impl Hash {
    fn print(&mut self, value: &impl Debug) {
        // Nothing here can fail.
        let _ = write!(self, "{value:?}");
    }

    fn digits(&self) -> String {
        format!("{:032x}", self.0.digest128())
    }

    /// A list of words, with its length.
    fn words(&mut self, words: impl Iterator<Item = u32>) {
        let mut count = 0_u64;
        for word in words {
            self.0.update(&word.to_le_bytes());
            count += 1;
        }
        self.0.update(&count.to_le_bytes());
    }

    fn mesh(&mut self, mesh: &Mesh) {
        // Named one by one, so that no field can be forgotten.
        let Mesh { positions, normals, uvs, triangles } = mesh;
        self.words(positions.iter().flat_map(|p| p.to_array()).map(f32::to_bits));
        self.words(normals.iter().flat_map(|n| n.to_array()).map(f32::to_bits));
        self.words(uvs.iter().flat_map(|uv| uv.to_array()).map(f32::to_bits));
        self.words(triangles.iter().copied().flatten());
    }

    fn image(&mut self, image: &Image) {
        let Image { width, height, texels } = image;
        self.words([*width, *height].into_iter());
        self.words(texels.iter().flat_map(|texel| texel.to_array()).map(f32::to_bits));
    }
}

impl Write for Hash {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text.as_bytes());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use halflight::build::EnvironmentDescription;
    use halflight::glam::Mat3;
    use halflight::load::builtin::builtin;

    #[test]
    fn the_name_does_not_count_and_every_bit_does() {
        let mut scene = builtin("still-life").unwrap();
        let hash = of_scene(&mut scene);
        assert_eq!(scene.name, "still-life");
        scene.name = "other".to_owned();
        assert_eq!(of_scene(&mut scene), hash);
        scene.camera.near = f32::from_bits(scene.camera.near.to_bits() ^ 1);
        assert_ne!(of_scene(&mut scene), hash);
    }

    #[test]
    fn every_bit_of_meshes_and_skies_counts() {
        let mut scene = builtin("still-life").unwrap();
        let texels = vec![halflight::Rgb::WHITE; 6];
        let image = Image { width: 3, height: 2, texels };
        scene.environments.push(EnvironmentDescription::new(image, Mat3::IDENTITY));
        let hash = of_scene(&mut scene);
        assert_eq!(of_scene(&mut scene), hash, "the scene is left as it was");
        let mut other = scene.clone();
        let corner =
            other.objects.iter_mut().find_map(mesh).and_then(|mesh| mesh.positions.last_mut()).unwrap();
        corner.z = f32::from_bits(corner.z.to_bits() ^ 1);
        assert_ne!(of_scene(&mut other), hash);
        Arc::make_mut(&mut scene.environments[0].image).texels[5].b = 0.999;
        assert_ne!(of_scene(&mut scene), hash);
    }
}
