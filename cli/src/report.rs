//! What is said about a render when it is done.

use crate::number::{counted, duration, percent_within, significant, with_prefix};
use crate::picture::Header;
use crate::tiles::Part;
use halflight::estimate::ErrorEstimate;
use serde_json::{Value, json};
use std::path::PathBuf;

/// Where the time went, in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Seconds {
    /// Reading the scene.
    pub(crate) load: f64,
    /// Building tree and tables.
    pub(crate) build: f64,
    /// Taking samples.
    pub(crate) render: f64,
    /// Encoding and writing the picture.
    pub(crate) save: f64,
}

/// A finished render in numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Report {
    /// The picture's file.
    pub(crate) file: PathBuf,
    /// Name of the scene.
    pub(crate) scene: String,
    /// Columns and rows of the picture that was written.
    pub(crate) size: (u32, u32),
    /// Which part of it was rendered; `None` for all.
    pub(crate) part: Option<Part>,
    /// Pixels that were rendered.
    pub(crate) pixels: u64,
    /// First column and row of the film that was rendered.
    pub(crate) at: (u32, u32),
    /// Columns and rows of the film.
    pub(crate) film: (u32, u32),
    /// Fewest and most samples of a pixel.
    pub(crate) samples_per_pixel: (u32, u32),
    /// Samples in all.
    pub(crate) samples: u64,
    /// Triangles in the scene.
    pub(crate) triangles: u64,
    /// Lights in the scene, each emitting triangle counted.
    pub(crate) lights: u64,
    /// Where the time went.
    pub(crate) seconds: Seconds,
    /// How good the picture is.
    pub(crate) error: ErrorEstimate,
    /// Pixels that have all samples that they may have, and more error than their share.
    pub(crate) missed: u64,
    /// True when samples went where the error was.
    pub(crate) adaptive: bool,
    /// Samples that were no numbers to use.
    pub(crate) rejected: u64,
    /// Stopped by the user before its end.
    pub(crate) interrupted: bool,
    /// The random numbers' seed.
    pub(crate) seed: u32,
    /// Threads that worked.
    pub(crate) threads: usize,
    /// Choices by the names of their flags.
    pub(crate) choices: Vec<(String, String)>,
    /// What was remarkable.
    pub(crate) warnings: Vec<String>,
}

impl Report {
    /// Samples per second of rendering.
    fn rate(&self) -> f64 {
        // A clock that has not moved is no reason for an infinity.
        self.samples as f64 / self.seconds.render.max(1e-9)
    }

    /// Samples per pixel, on average.
    fn mean_samples(&self) -> f64 {
        self.samples as f64 / self.pixels.max(1) as f64
    }

    /// "64 samples/pixel", or "37.2 samples/pixel (16 to 512)" where they differ.
    pub(crate) fn samples_per_pixel(&self) -> String {
        match self.samples_per_pixel {
            (1, 1) => "1 sample/pixel".to_owned(),
            (fewest, most) if fewest == most => format!("{most} samples/pixel"),
            (fewest, most) => {
                format!("{} samples/pixel ({fewest} to {most})", significant(self.mean_samples()))
            }
        }
    }

    /// "error 0.98 % ± 0.03", and what half of it costs.
    pub(crate) fn error(&self) -> String {
        let (Some(error), Some(interval)) = (self.error.relative_error(), self.error.interval()) else {
            return "error unknown".to_owned();
        };
        let half = self.error.cost_of_half();
        let half = half.map_or_else(String::new, |k| format!("  half the error: {k:.1}× the time"));
        format!("error {}{half}", percent_within(error, interval))
    }

    /// One line for people.
    pub(crate) fn line(&self) -> String {
        let (width, height) = self.size;
        let part = self.part.map_or_else(String::new, |p| format!("  part {} of {}", p.number, p.of));
        [
            self.file.display().to_string(),
            format!("{width}×{height}{part}"),
            self.samples_per_pixel(),
            counted(self.triangles, "triangle"),
            counted(self.lights, "light"),
            duration(self.seconds.render),
            format!("{} samples/s", with_prefix(self.rate())),
            self.error(),
        ]
        .join("  ")
    }

    /// What a picture says of itself: all that is known but where it lies and how long it took, so that
    /// equal renders are equal files.
    pub(crate) fn header(&self) -> Header {
        let mut settings = self.json();
        if let Some(object) = settings.as_object_mut() {
            for name in ["file", "seconds", "samples_per_second", "threads", "warnings"] {
                object.remove(name);
            }
            object.insert("version".to_owned(), json!(env!("CARGO_PKG_VERSION")));
        }
        let error = self.error.relative_error().zip(self.error.interval());
        let error = error.map_or_else(String::new, |(e, i)| format!(", error {}", percent_within(e, i)));
        let comment = format!("{}, {}, seed {}{error}", self.scene, self.samples_per_pixel(), self.seed);
        Header {
            film: Some(self.film),
            at: self.at,
            comment: Some(comment.replace('±', "+-")),
            settings: Some(settings.to_string()),
        }
    }

    /// One object for scripts.
    pub(crate) fn json(&self) -> Value {
        let choices: serde_json::Map<_, _> =
            self.choices.iter().map(|(flag, value)| (flag.clone(), json!(value))).collect();
        json!({
            "file": self.file.to_string_lossy(),
            "scene": self.scene,
            "width": self.size.0,
            "height": self.size.1,
            "part": self.part.map(|p| [p.number, p.of]),
            "samples_per_pixel": {
                "min": self.samples_per_pixel.0,
                "mean": self.mean_samples(),
                "max": self.samples_per_pixel.1,
            },
            "samples": self.samples,
            "samples_per_second": self.rate(),
            "relative_error": self.error.relative_error(),
            "relative_error_interval": self.error.interval(),
            "time_factor_of_half_the_error": self.error.cost_of_half(),
            "adaptive": self.adaptive,
            "missed_pixels": self.missed,
            "rejected_samples": self.rejected,
            "triangles": self.triangles,
            "lights": self.lights,
            "seconds": {
                "load": self.seconds.load,
                "build": self.seconds.build,
                "render": self.seconds.render,
                "save": self.seconds.save,
            },
            "seed": self.seed,
            "threads": self.threads,
            "choices": choices,
            "interrupted": self.interrupted,
            "warnings": self.warnings,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> Report {
        Report {
            file: "halflight.png".into(),
            scene: "still-life".into(),
            size: (960, 640),
            part: None,
            pixels: 960 * 640,
            at: (0, 0),
            film: (960, 640),
            samples_per_pixel: (64, 64),
            samples: 39_321_600,
            triangles: 24_812,
            lights: 1,
            seconds: Seconds { render: 2.1, ..Seconds::default() },
            error: ErrorEstimate::default(),
            missed: 0,
            adaptive: false,
            rejected: 0,
            interrupted: false,
            seed: 0,
            threads: 2,
            choices: vec![("sequence".to_owned(), "sobol".to_owned())],
            warnings: Vec::new(),
        }
    }

    #[test]
    fn the_line_holds_everything() {
        assert_eq!(
            report().line(),
            "halflight.png  960×640  64 samples/pixel  24 812 triangles  1 light  2.1 s  18.7 M samples/s  error unknown"
        );
    }

    #[test]
    fn an_unknown_error_is_said_to_be_so() {
        let report = Report { samples_per_pixel: (1, 100), ..report() };
        assert!(report.line().ends_with("error unknown"));
        assert!(report.line().contains("64.0 samples/pixel (1 to 100)"));
        assert!(report.json()["relative_error"].is_null());
    }
}
