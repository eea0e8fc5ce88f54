//! Built-in scenes, made in code: nothing to download. One file per scene.

mod author;
mod cornell;
mod mesh;
mod plates;
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
pub const BUILTIN: [Builtin; 3] = [
    Builtin {
        name: "still-life",
        about: "things on a table under one rectangle of light: shadows sharp at the contact, wide away from it",
        make: still_life::make,
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
