//! Why a scene was not read: where, what, and what would be accepted.

use super::image::ImageError;
use super::mesh_error::MeshError;
use super::suggest::nearest;
use crate::bsdf::BsdfError;
use crate::camera::CameraError;
use crate::film::FilmError;
use crate::light::LightError;
use crate::shape::ShapeError;
use crate::texture::TextureError;
use core::fmt;
use std::boxed::Box;
use std::io;
use std::path::{Path, PathBuf};
use std::string::String;
use std::sync::Arc;
use std::vec::Vec;

/// A place in a scene file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Position {
    /// The file.
    pub file: Arc<Path>,
    /// Line, from 1.
    pub line: u32,
    /// Column in characters, from 1.
    pub column: u32,
}

impl fmt::Display for Position {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file.display(), self.line)
    }
}

/// Why a scene was not read.
#[derive(Debug)]
#[non_exhaustive]
pub enum LoadError {
    /// The scene's file is missing, or cannot be read.
    Unreadable {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file's name does not end like that of a scene.
    Format {
        /// The file.
        path: PathBuf,
    },
    /// A parameter given from outside has no usable name, or is given twice.
    Define {
        /// The name.
        name: String,
        /// True when it is given twice.
        twice: bool,
    },
    /// The file is not well-formed XML.
    Syntax {
        /// Where it stops to be.
        at: Position,
        /// What is wrong.
        what: String,
    },
    /// An element cannot be understood or used.
    Element {
        /// Where it starts.
        at: Position,
        /// Its tag, with type and name.
        element: String,
        /// What is wrong with it.
        problem: Box<Problem>,
    },
    /// The file is not JSON, or its JSON is not that of a glTF scene.
    Json {
        /// The file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What is wrong.
        what: String,
    },
    /// A part of a glTF file cannot be understood or used.
    Item {
        /// The file.
        path: PathBuf,
        /// Which part.
        item: String,
        /// What is wrong with it.
        problem: Box<Problem>,
    },
    /// There is nothing to see: no shape, and no light around the scene.
    Empty {
        /// The file.
        path: PathBuf,
    },
}

/// What is wrong with an element of a scene file.
#[derive(Debug)]
#[non_exhaustive]
pub enum Problem {
    /// A name that is not known.
    Unknown {
        /// What it names: an element, a plugin, a property, a parameter…
        what: &'static str,
        /// The name.
        name: String,
        /// The names that are known.
        supported: Vec<String>,
    },
    /// Something that Mitsuba has and this loader does not.
    NotSupported {
        /// What it is.
        what: String,
        /// What to write instead.
        instead: &'static str,
    },
    /// A part of a file that breaks the rules of its format.
    Malformed {
        /// What is wrong.
        what: String,
    },
    /// An attribute, property or nested element that must be there.
    Missing {
        /// Which one.
        what: String,
    },
    /// A value that cannot be read.
    Value {
        /// Attribute that holds it.
        attribute: String,
        /// Its text.
        text: String,
        /// What would be accepted.
        expected: &'static str,
    },
    /// A property with another type than its name calls for.
    Type {
        /// The property.
        name: String,
        /// What would be accepted.
        expected: &'static str,
    },
    /// Two things that exclude each other, or one thing twice.
    Conflict {
        /// The second one.
        what: String,
        /// Where the first one is.
        first: Position,
    },
    /// A transform that the shape, light or camera cannot follow.
    Transform {
        /// What it must be.
        must: &'static str,
    },
    /// Files that include each other, or too deeply.
    Include {
        /// The file that is included again.
        path: PathBuf,
        /// True for a cycle, false for depth.
        cycle: bool,
    },
    /// More elements, or more deeply nested ones, than any scene has.
    TooLarge {
        /// What there is too much of.
        what: &'static str,
        /// How much is accepted.
        limit: usize,
    },
    /// A file that the element names cannot be read.
    File {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// A mesh was refused.
    Mesh {
        /// Its file.
        path: PathBuf,
        /// Why.
        source: MeshError,
    },
    /// A picture was refused.
    Image {
        /// Its file.
        path: PathBuf,
        /// Why.
        source: ImageError,
    },
    /// A texture was refused.
    Texture(TextureError),
    /// A picture cannot be an environment map.
    Map {
        /// Its file.
        path: PathBuf,
        /// Why.
        source: LightError,
    },
    /// A shape was refused.
    Shape(ShapeError),
    /// A light was refused.
    Light(LightError),
    /// A material was refused.
    Bsdf(BsdfError),
    /// The camera was refused.
    Camera(CameraError),
    /// The film was refused.
    Film(FilmError),
}

impl Problem {
    /// True when the scene still makes sense without the element.
    pub(super) const fn can_be_left_out(&self) -> bool {
        matches!(self, Self::Unknown { .. } | Self::NotSupported { .. })
    }

    pub(super) fn unknown(what: &'static str, name: &str, supported: &[&str]) -> Self {
        let supported = supported.iter().copied().map(String::from).collect();
        Self::Unknown { what, name: name.into(), supported }
    }
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable { path, source } => write!(f, "{}: {source}", path.display()),
            Self::Format { path } => {
                write!(
                    f,
                    "{}: not a scene file; scenes are read from Mitsuba 3 XML (.xml) and glTF 2.0 (.gltf, .glb)",
                    path.display()
                )
            }
            Self::Define { name, twice: true } => {
                write!(f, "the parameter \"{name}\" is given twice; give it once")
            }
            Self::Define { name, .. } => write!(
                f,
                "\"{name}\" cannot be the name of a parameter; write -D name=value with a name of letters, digits, _ and -"
            ),
            Self::Syntax { at, what } => {
                write!(f, "{}:{}:{}: not well-formed XML: {what}", at.file.display(), at.line, at.column)
            }
            Self::Json { path, line, column, what } => {
                write!(f, "{}:{line}:{column}: not a glTF scene: {what}", path.display())
            }
            Self::Item { path, item, problem } => write!(f, "{}: {item}: {problem}", path.display()),
            Self::Element { at, element, problem } => write!(f, "{at}: {element}: {problem}"),
            Self::Empty { path } => write!(
                f,
                "{}: the scene is empty: it needs a surface, or a light around it to look at",
                path.display()
            ),
        }
    }
}

impl core::error::Error for LoadError {
    fn source(&self) -> Option<&(dyn core::error::Error + 'static)> {
        match self {
            Self::Unreadable { source, .. } => Some(source),
            _ => None,
        }
    }
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown { what, name, supported } => unknown(f, what, name, supported),
            Self::Malformed { what } => f.write_str(what),
            Self::NotSupported { what, instead } => write!(f, "{what} is not supported; {instead}"),
            Self::Missing { what } => write!(f, "{what} is missing"),
            Self::Value { attribute, text, expected } => {
                write!(f, "{attribute}=\"{text}\" cannot be read; it must be {expected}")
            }
            Self::Type { name, expected } => write!(f, "property \"{name}\" must be {expected}"),
            Self::Conflict { what, first } => write!(f, "{what}; the first one is at {first}"),
            Self::Transform { must } => write!(f, "the transform cannot be used: it must {must}"),
            Self::Include { path, cycle: true } => {
                write!(f, "{} includes itself, directly or through others", path.display())
            }
            Self::Include { path, .. } => write!(
                f,
                "{} is included more than {} files deep",
                path.display(),
                super::mitsuba::MAX_INCLUDE_DEPTH
            ),
            Self::TooLarge { what, limit } => write!(f, "{what}: more than {limit}"),
            Self::File { path, source } => write!(f, "{}: {source}", path.display()),
            Self::Mesh { path, source } => write!(f, "{}: {source}", path.display()),
            Self::Image { path, source } => write!(f, "{}: {source}", path.display()),
            Self::Texture(e) => e.fmt(f),
            Self::Map { path, source } => write!(f, "{}: {source}", path.display()),
            Self::Shape(e) => e.fmt(f),
            Self::Light(e) => e.fmt(f),
            Self::Bsdf(e) => e.fmt(f),
            Self::Camera(e) => e.fmt(f),
            Self::Film(e) => e.fmt(f),
        }
    }
}

/// The most names that a message lists: a scene may have thousands of ids.
const MOST_NAMES: usize = 24;

/// "unknown bsdf; did you mean "diffuse"? supported: diffuse, phong".
fn unknown(f: &mut fmt::Formatter<'_>, what: &str, name: &str, supported: &[String]) -> fmt::Result {
    write!(f, "unknown {what} \"{name}\"")?;
    if supported.is_empty() {
        return write!(f, "; there is none to choose from");
    }
    if let Some(best) = nearest(name, supported.iter().map(String::as_str)) {
        write!(f, "; did you mean \"{best}\"?")?;
    } else {
        write!(f, ";")?;
    }
    let shown = supported.len().min(MOST_NAMES);
    write!(f, " supported: {}", supported[..shown].join(", "))?;
    if shown < supported.len() { write!(f, " and {} more", supported.len() - shown) } else { Ok(()) }
}

/// Something in a scene file that was read, but not as written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Warning {
    /// Where it is; `None` when it is about the call, not a place in a file.
    pub at: Option<Position>,
    /// What is done instead.
    pub text: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.at {
            Some(at) => write!(f, "{at}: {}", self.text),
            None => f.write_str(&self.text),
        }
    }
}

macro_rules! problem_from {
    ($($error:ty => $variant:ident),*) => {
        $(impl From<$error> for Problem {
            fn from(e: $error) -> Self {
                Self::$variant(e)
            }
        })*
    };
}

problem_from!(TextureError => Texture, ShapeError => Shape, LightError => Light, BsdfError => Bsdf, CameraError => Camera, FilmError => Film);
