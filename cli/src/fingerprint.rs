//! What tells one scene from another.

use halflight::build::Description;
use std::fmt::{self, Debug, Write};
use std::mem;
use xxhash_rust::xxh3::Xxh3Default;

/// A hash of a scene as it was read: of every number in it, but not of its name, so that it is the same
/// wherever the files lie.
///
/// What is hashed is the scene as Rust prints it for programmers. That tells every number to the last bit,
/// and leaves out no field that is added later.
pub(crate) fn of_scene(description: &mut Description) -> String {
    let name = mem::take(&mut description.name);
    let hash = of(description);
    description.name = name;
    hash
}

/// A hash of anything that can be printed, as 32 hexadecimal digits.
pub(crate) fn of(value: &impl Debug) -> String {
    let mut hash = Hash(Xxh3Default::new());
    // Nothing here can fail.
    let _ = write!(hash, "{value:?}");
    format!("{:032x}", hash.0.digest128())
}

/// What is written goes into the hash.
struct Hash(Xxh3Default);

impl Write for Hash {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.update(text.as_bytes());
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
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
}
