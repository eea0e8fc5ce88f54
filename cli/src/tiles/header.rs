//! What a file of tiles says of itself.

use super::TilesError;
use halflight::film::{MAX_RESOLUTION, PixelRect};
use serde_json::{Value, json};

/// Which part of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Part {
    /// From 1.
    pub(crate) number: u32,
    /// Parts in all.
    pub(crate) of: u32,
}

impl Part {
    /// All of it.
    pub(crate) const WHOLE: Self = Self { number: 1, of: 1 };

    /// Most parts of a picture.
    pub(crate) const MOST: u32 = 1 << 16;
}

/// What each tile is rendered to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Aim {
    /// So many samples of each pixel.
    Samples(u32),
    /// That relative error (a fraction), with at most so many samples of a pixel.
    Error {
        /// Of the picture.
        target: f64,
        /// Samples.
        most: u32,
        /// Tile by tile, or by the picture as a whole.
        adaptive: bool,
    },
}

/// What a picture says of itself, besides: the same for all of its parts.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct About {
    /// Triangles in the scene.
    pub(crate) triangles: u64,
    /// Lights in the scene.
    pub(crate) lights: u64,
    /// The random numbers' seed.
    pub(crate) seed: u32,
    /// Columns and rows of the film.
    pub(crate) film: (u32, u32),
    /// Choices by the names of their flags.
    pub(crate) choices: Vec<(String, String)>,
}

/// The header: what the tiles are of, and how they were rendered.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Header {
    /// The scene's name, for reports; files of the same scene may differ in it.
    pub(crate) scene: String,
    /// A hash of the scene as it was read: its numbers, not its files' names.
    pub(crate) fingerprint: String,
    /// Everything else that decides the bits, by the names of the flags where there are some.
    pub(crate) settings: Vec<(String, String)>,
    /// For what is said of the picture.
    pub(crate) about: About,
    /// What each tile is rendered to.
    pub(crate) aim: Aim,
    /// What a pixel holds: [`super::Stored::KIND`].
    pub(crate) pixels: String,
    /// The picture's window.
    pub(crate) crop: PixelRect,
    /// Side of a tile (pixels).
    pub(crate) side: u32,
    /// Which part of it.
    pub(crate) part: Part,
    /// False in a checkpoint.
    pub(crate) complete: bool,
}

impl Header {
    /// What the two were not rendered alike in; `None` when they are parts of one picture, or states of
    /// one part. "its spp is 64, not 16".
    pub(crate) fn difference(&self, expected: &Self) -> Option<String> {
        if self.fingerprint != expected.fingerprint {
            return Some("its scene is another, or has been changed since".to_owned());
        }
        let value = |of: &Self, name: &str| {
            of.settings.iter().find(|(known, _)| known == name).map(|(_, value)| value.clone())
        };
        let names = expected.settings.iter().chain(&self.settings).map(|(name, _)| name);
        for name in names {
            let (ours, theirs) = (value(self, name), value(expected, name));
            match (ours, theirs) {
                (Some(ours), Some(theirs)) if ours == theirs => {}
                (Some(ours), Some(theirs)) => return Some(format!("its {name} is {ours}, not {theirs}")),
                (ours, _) => {
                    let has = if ours.is_some() { "has" } else { "lacks" };
                    return Some(format!("it {has} a {name}, unlike the other"));
                }
            }
        }
        if self.part.of != expected.part.of {
            let (one, other) = (self.part.of, expected.part.of);
            return Some(format!("its picture is made of {one} parts, not {other}"));
        }
        let alike = (self.aim, &self.pixels, self.crop, self.side)
            == (expected.aim, &expected.pixels, expected.crop, expected.side);
        (!alike).then(|| "its tiles are others".to_owned())
    }

    /// As it is written.
    pub(super) fn json(&self) -> Value {
        let PixelRect { x0, y0, x1, y1 } = self.crop;
        let aim = match self.aim {
            Aim::Samples(samples) => json!({ "samples": samples }),
            // As text, which is read again as the same number.
            Aim::Error { target, most, adaptive } => {
                json!({ "error": target.to_string(), "most": most, "adaptive": adaptive })
            }
        };
        json!({
            "scene": self.scene,
            "fingerprint": self.fingerprint,
            "settings": self.settings,
            "triangles": self.about.triangles,
            "lights": self.about.lights,
            "seed": self.about.seed,
            "film": [self.about.film.0, self.about.film.1],
            "choices": self.about.choices,
            "aim": aim,
            "pixels": self.pixels,
            "crop": [x0, y0, x1, y1],
            "side": self.side,
            "part": [self.part.number, self.part.of],
            "complete": self.complete,
        })
    }

    /// What [`Header::json`] was made from.
    ///
    /// # Errors
    /// When something is missing or cannot be.
    pub(super) fn from_json(json: &Value) -> Result<Self, TilesError> {
        let missing = |what: &str| TilesError::Header(format!("lacks {what}"));
        let text = |name: &str| json[name].as_str().map(str::to_owned).ok_or_else(|| missing(name));
        let number = |v: &Value, name: &str| {
            v.as_u64().and_then(|n| u32::try_from(n).ok()).ok_or_else(|| missing(name))
        };
        let crop = |i: usize| number(&json["crop"][i], "crop");
        let header = Self {
            scene: text("scene")?,
            fingerprint: text("fingerprint")?,
            settings: pairs(&json["settings"]).ok_or_else(|| missing("settings"))?,
            about: about(json).ok_or_else(|| missing("what the picture is"))?,
            aim: aim(&json["aim"]).ok_or_else(|| missing("aim"))?,
            pixels: text("pixels")?,
            crop: PixelRect { x0: crop(0)?, y0: crop(1)?, x1: crop(2)?, y1: crop(3)? },
            side: number(&json["side"], "side")?,
            part: Part { number: number(&json["part"][0], "part")?, of: number(&json["part"][1], "part")? },
            complete: json["complete"].as_bool().ok_or_else(|| missing("complete"))?,
        };
        header.check().map_err(|what| TilesError::Header(what.to_owned()))?;
        Ok(header)
    }

    /// Says what cannot be.
    fn check(&self) -> Result<(), &'static str> {
        let PixelRect { x0, y0, x1, y1 } = self.crop;
        if !(x0 < x1 && y0 < y1 && x1 <= MAX_RESOLUTION && y1 <= MAX_RESOLUTION) {
            return Err("has a window that no picture has");
        }
        if !(1..=halflight::estimate::TILE).contains(&self.side) {
            return Err("has tiles of a side that there is not");
        }
        let Part { number, of } = self.part;
        if !(1..=of).contains(&number) || of > Part::MOST {
            return Err("tells of a part that there is not");
        }
        Ok(())
    }
}

/// Pairs of texts.
fn pairs(json: &Value) -> Option<Vec<(String, String)>> {
    let pair = |v: &Value| Some((v[0].as_str()?.to_owned(), v[1].as_str()?.to_owned()));
    json.as_array()?.iter().map(pair).collect()
}

/// What is said of the picture.
fn about(json: &Value) -> Option<About> {
    let number = |v: &Value| u32::try_from(v.as_u64()?).ok();
    Some(About {
        triangles: json["triangles"].as_u64()?,
        lights: json["lights"].as_u64()?,
        seed: number(&json["seed"])?,
        film: (number(&json["film"][0])?, number(&json["film"][1])?),
        choices: pairs(&json["choices"])?,
    })
}

/// What was aimed at.
fn aim(json: &Value) -> Option<Aim> {
    let number = |v: &Value| u32::try_from(v.as_u64()?).ok();
    if let Some(samples) = number(&json["samples"]) {
        return Some(Aim::Samples(samples));
    }
    let target = json["error"].as_str()?.parse().ok().filter(|target| *target > 0.0)?;
    Some(Aim::Error { target, most: number(&json["most"])?, adaptive: json["adaptive"].as_bool()? })
}
