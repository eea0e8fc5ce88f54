//! Built-in scenes, made in code: nothing to download. One file per scene.

mod author;
mod colours;
mod contact;
mod cornell;
mod gallery;
mod lanterns;
mod mesh;
mod penumbra;
mod plates;
mod sky;
mod still_life;

use crate::build::Description;
use author::BuiltinError;

/// A scene that comes with the program.
#[derive(Debug, Clone, Copy)]
pub struct Builtin {
    /// What it is asked for by.
    pub name: &'static str,
    /// What it shows, in one line.
    pub about: &'static str,
    make: fn() -> Result<Description, BuiltinError>,
}

/// All built-in scenes; the first is the one that is rendered when none is asked for.
pub const BUILTIN: [Builtin; 10] = [
    Builtin {
        name: "still-life",
        about: "things on a table under one rectangle of light: shadows sharp at the contact, wide away from it",
        make: still_life::make,
    },
    Builtin {
        name: "penumbra",
        about: "the same spray in four niches, under lamps of equal power and growing size: shadows from hard to soft",
        make: penumbra::make,
    },
    Builtin {
        name: "colours",
        about: "a rectangle, a disk and a sphere of three colours on white things: overlapping coloured penumbrae",
        make: colours::make,
    },
    Builtin {
        name: "sky",
        about: "a small town of clay under an even sky: no lamp, only how much of the sky each point sees",
        make: sky::make,
    },
    Builtin {
        name: "morning",
        about: "the town on a clear morning: a low sun of its true width, and the sky that goes with it",
        make: sky::make_morning,
    },
    Builtin {
        name: "gallery",
        about: "sculptures in a room that sun and sky light through four windows, which are portals",
        make: gallery::make,
    },
    Builtin {
        name: "lanterns",
        about: "a party under strings of lanterns: many small lights, of which each point needs few",
        make: lanterns::make,
    },
    Builtin {
        name: "contact",
        about: "a tube, a disk, a ball and a rectangle that all but touch what they light: 1/d² at its worst",
        make: contact::make,
    },
    Builtin {
        name: "plates",
        about: "lamps from tiny to large in plates from smooth to rough: light sampling against BSDF sampling",
        make: plates::make,
    },
    Builtin { name: "cornell", about: "the measured Cornell box, direct light only", make: cornell::make },
];

/// Makes the built-in scene of that name; `None` when there is none.
#[must_use]
pub fn builtin(name: &str) -> Option<Description> {
    BUILTIN.iter().find(|b| b.name == name).and_then(|b| (b.make)().ok())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::build::{Geometry, SceneBuffers};
    use std::collections::HashSet;

    fn each(check: impl Fn(&str, &Description)) {
        for b in BUILTIN {
            match (b.make)() {
                Ok(d) => check(b.name, &d),
                Err(e) => panic!("{}: {e}", b.name),
            }
        }
    }

    #[test]
    fn names_are_unique_and_kebab_case_and_find_their_scene() {
        let names: HashSet<&str> = BUILTIN.iter().map(|b| b.name).collect();
        assert_eq!(names.len(), BUILTIN.len());
        for b in BUILTIN {
            assert!(b.name.split('-').all(|w| !w.is_empty() && w.chars().all(|c| c.is_ascii_lowercase())));
            assert_eq!(builtin(b.name).map(|d| d.name).as_deref(), Some(b.name));
            assert!(!b.about.is_empty() && !b.about.contains('\n'));
        }
        assert!(builtin("no-such-scene").is_none());
    }

    #[test]
    fn every_scene_builds_without_loss() {
        each(|name, d| {
            let buffers = SceneBuffers::new(d).unwrap_or_else(|e| panic!("{name}: {e}"));
            let stats = buffers.stats();
            assert!(stats.lights > 0, "{name} is dark");
            assert_eq!((stats.degenerate, stats.triangles), (0, d.triangle_count()), "{name}");
            assert!(stats.triangles <= 70_000, "{name}: {}", stats.triangles);
            assert!(d.camera.camera(d.width, d.height).is_ok(), "{name}");
        });
    }

    #[test]
    fn every_mesh_is_finite_and_its_normals_are_on_its_front() {
        each(|name, d| {
            for o in &d.objects {
                let Geometry::Mesh(mesh) = &o.geometry else { continue };
                assert!(mesh.positions.iter().all(|p| p.abs().max_element() < 1e3), "{name}/{}", o.name);
                let count = mesh.positions.len() as u32;
                assert!(mesh.triangles.iter().flatten().all(|i| *i < count), "{name}/{}", o.name);
                if !mesh.normals.is_empty() {
                    mesh::checks::assert_faces_agree_with_normals(&o.name, mesh);
                }
            }
        });
    }

    #[test]
    fn objects_and_materials_have_names_of_their_own() {
        each(|name, d| {
            let objects: HashSet<&str> = d.objects.iter().map(|o| o.name.as_str()).collect();
            assert_eq!(objects.len(), d.objects.len(), "{name}");
            let materials: HashSet<&str> = d.materials.iter().map(|m| m.name.as_str()).collect();
            assert_eq!(materials.len(), d.materials.len(), "{name}");
            assert!(d.objects.iter().all(|o| o.material < d.materials.len()), "{name}");
        });
    }

    #[test]
    fn what_should_be_solid_is() {
        // Sheets, leaves and the walls of a box are open; everything else is closed.
        let open = ["backdrop", "stage", "room", "spray"];
        each(|name, d| {
            for o in d.objects.iter().filter(|o| !open.iter().any(|s| o.name.starts_with(s))) {
                let Geometry::Mesh(mesh) = &o.geometry else { continue };
                // Flat meshes have no normals, and a wall of the Cornell box has two triangles.
                if !mesh.normals.is_empty() {
                    mesh::checks::assert_closed_and_outward(&std::format!("{name}/{}", o.name), mesh);
                }
            }
        });
    }

    #[test]
    fn a_scene_made_twice_is_the_same_scene() {
        each(|name, d| {
            let again = builtin(name);
            let same = again.is_some_and(|a| {
                a.objects == d.objects
                    && a.materials == d.materials
                    && a.lights == d.lights
                    && a.camera == d.camera
            });
            assert!(same, "{name}");
        });
    }
}
