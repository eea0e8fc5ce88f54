//! The arguments of `halflight render`.

use super::values::{count, crop, depth, frames, part, positive};
use super::{Frames, PreviewHow, SceneArgs, Showing};
use crate::tiles::Part;
use clap::builder::RangedU64ValueParser;
use clap::{Args, ValueEnum, value_parser};
use halflight::film::{MAX_RESOLUTION, PixelRect};
use std::path::PathBuf;

/// `halflight render`
#[derive(Debug, Clone, Args)]
pub(crate) struct RenderArgs {
    /// A scene file (Mitsuba 3 XML or glTF 2.0) or the name of a built-in scene [default: the first of
    /// `halflight scenes`]
    #[arg(value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,

    /// More scenes, each to a picture of its own: -o out/ or -o 'out/{name}.exr'
    #[arg(value_name = "MORE")]
    pub(crate) more: Vec<PathBuf>,

    /// The picture: .png, .jpg (sRGB), .exr, .pfm (linear, 32-bit float) or .hdr (linear, RGBE);
    /// with --part: .part
    #[arg(short, long, value_name = "OUT", default_value = DEFAULT_OUTPUT)]
    pub(crate) output: PathBuf,

    /// Samples per pixel [default: what the scene says, or 64]
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    #[arg(conflicts_with_all = ["error", "time"])]
    pub(crate) spp: Option<u32>,

    /// Take samples until the picture's relative error is estimated to be this: the root of relMSE,
    /// the mean of (I - R)² / (R² + 0.01) over pixels and channels
    #[arg(long, value_name = "PERCENT", value_parser = positive, allow_negative_numbers = true, conflicts_with = "time")]
    pub(crate) error: Option<f32>,

    /// Take the samples that make the best picture in this time, reading and building included
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) time: Option<f32>,

    /// Most samples of a pixel, with --error or --time [default: 65536]
    #[arg(long, value_name = "N", value_parser = count, allow_negative_numbers = true)]
    pub(crate) max_spp: Option<u32>,

    /// Whether samples go where the error is, with --error or --time
    #[arg(long, value_enum, value_name = "WHETHER", default_value_t)]
    pub(crate) adaptive: Adaptive,

    /// Write layers beside the radiance, into .exr: error.R .G .B (standard error of so many independent
    /// samples: two or three times the true one), samples, albedo.R .G .B, N.X .Y .Z (normal), Z (depth),
    /// visibility (fraction of the light that is seen)
    #[arg(long)]
    pub(crate) layers: bool,

    /// Write the samples of each pixel as a picture (.png): white is the most of any
    #[arg(long, value_name = "FILE.png")]
    pub(crate) samples_image: Option<PathBuf>,

    /// Write the fraction of the light that is seen as a picture (.png): black in the umbra, white in
    /// full light
    #[arg(long, value_name = "FILE.png")]
    pub(crate) visibility_image: Option<PathBuf>,

    /// Columns; the rows follow unless --height is given too
    #[arg(long, value_name = "PIXELS", value_parser = resolution(), allow_negative_numbers = true)]
    pub(crate) width: Option<u32>,

    /// Rows; the columns follow unless --width is given too
    #[arg(long, value_name = "PIXELS", value_parser = resolution(), allow_negative_numbers = true)]
    pub(crate) height: Option<u32>,

    /// Render only this window: first column and row, one past the last column and row
    #[arg(long, value_name = "X0,Y0,X1,Y1", value_parser = crop, allow_hyphen_values = true)]
    pub(crate) crop: Option<PixelRect>,

    #[command(flatten)]
    pub(crate) showing: Showing,

    /// Show the picture in the terminal while it is rendered
    #[arg(long, value_enum, value_name = "HOW", num_args = 0..=1, require_equals = true)]
    #[arg(default_missing_value = "auto")]
    pub(crate) preview: Option<PreviewHow>,

    /// Render frames A to B of the camera's way, to OUT with a number: #### or %04d in its name stands for
    /// it. The way is that of a glTF camera's animation, or through the sensors of a Mitsuba scene, a
    /// second apart. Frames that exist whole are kept
    #[arg(long, value_name = "A..B", value_parser = frames, allow_hyphen_values = true)]
    pub(crate) frames: Option<Frames>,

    /// Frames of a second; frame 0 is at 0 s [default: 24]
    #[arg(long, value_name = "N", value_parser = positive, allow_negative_numbers = true, requires = "frames")]
    pub(crate) fps: Option<f32>,

    /// Render again whenever the scene's file or one that it refers to changes, until Ctrl-C
    #[arg(long, conflicts_with_all = ["frames", "more"])]
    pub(crate) watch: bool,

    /// With several scenes or frames: render those anew that exist
    #[arg(long)]
    pub(crate) overwrite: bool,

    /// Render only part I of N into a file for `halflight merge`, which -o names: OUT.part
    #[arg(long, value_name = "I/N", value_parser = part, conflicts_with_all = ["frames", "more", "watch"])]
    pub(crate) part: Option<Part>,

    /// Keep what there is every so often in OUT.checkpoint, from where the same command goes on after it
    /// was killed; the bits are those of a render that was not
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_negative_numbers = true)]
    #[arg(conflicts_with = "watch")]
    pub(crate) checkpoint: Option<f32>,

    /// Which random numbers: the same seed gives the same bits, with any number of threads
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true)]
    pub(crate) seed: u32,

    /// Threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=1024), allow_negative_numbers = true)]
    pub(crate) threads: Option<usize>,

    #[command(flatten)]
    pub(crate) choices: Choices,

    #[command(flatten, next_help_heading = None)]
    pub(crate) reading: SceneArgs,

    /// Print neither progress nor summary
    #[arg(long)]
    pub(crate) quiet: bool,

    /// Print the summary as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

impl RenderArgs {
    /// True when more than the radiance is asked for.
    pub(crate) const fn sees_layers(&self) -> bool {
        self.layers || self.visibility_image.is_some()
    }
}

/// Choices that trade time for accuracy; `auto` takes what the scene requires.
#[derive(Debug, Clone, Copy, Args, Default)]
#[command(next_help_heading = "Choices that trade time for accuracy")]
pub(crate) struct Choices {
    /// How the surface of a light is sampled
    #[arg(long, value_enum, value_name = "HOW", default_value_t)]
    pub(crate) lights: Lights,

    /// Where directions come from
    #[arg(long, value_enum, value_name = "HOW", default_value_t)]
    pub(crate) technique: Technique,

    /// How mis weighs its two techniques [default: power]
    #[arg(long, value_enum, value_name = "HOW")]
    pub(crate) heuristic: Option<Heuristic>,

    /// Light samples for each sample of a pixel [default: what the scene says, or 1]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=MAX_SPLIT), allow_negative_numbers = true)]
    pub(crate) light_samples: Option<u32>,

    /// BSDF samples for each sample of a pixel [default: what the scene says, or 1]
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(1..=MAX_SPLIT), allow_negative_numbers = true)]
    pub(crate) bsdf_samples: Option<u32>,

    /// How far away a surface still shades, with --technique occlusion [default: any distance]
    #[arg(long, value_name = "METRES", value_parser = positive, allow_negative_numbers = true)]
    pub(crate) occlusion_distance: Option<f32>,

    /// Most segments between camera and light: 1 shows the lights, 2 direct light, 3 and more indirect light
    /// too, -1 all of it [default: what the scene says, or 2]
    #[arg(long, value_name = "N", value_parser = depth, allow_negative_numbers = true)]
    pub(crate) max_depth: Option<u32>,

    /// Which light is sampled where there are several
    #[arg(long, value_enum, value_name = "HOW", default_value_t)]
    pub(crate) choose: Choose,

    /// How directions toward an environment map are drawn
    #[arg(long, value_enum, value_name = "HOW", default_value_t)]
    pub(crate) environment: Environment,

    /// Whether directions toward the sky are drawn through the scene's portals, where it has some
    #[arg(long, value_enum, value_name = "WHETHER", default_value_t)]
    pub(crate) portals: Portals,

    /// Where the uniform numbers come from
    #[arg(long, value_enum, value_name = "HOW", default_value_t)]
    pub(crate) sequence: Sequence,
}

/// The picture when nothing else is said.
const DEFAULT_OUTPUT: &str = "halflight.png";

/// Most light or BSDF samples for one camera sample.
const MAX_SPLIT: i64 = 65_536;

/// A number of pixels that a film can have.
pub(super) fn resolution() -> clap::builder::RangedI64ValueParser<u32> {
    value_parser!(u32).range(1..=i64::from(MAX_RESOLUTION))
}

/// Whether samples go where the error is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Adaptive {
    /// With --error and --time
    #[default]
    Auto,
    /// To where the error is
    On,
    /// To every pixel alike
    Off,
}

/// How the surface of a light is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Lights {
    /// What the scene requires
    #[default]
    Auto,
    /// Uniform over its area
    Area,
    /// Uniform over the solid angle it fills
    SolidAngle,
    /// Uniform over the projected solid angle: the cosine is in the density
    Projected,
}

/// Where directions come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Technique {
    /// What the scene requires
    #[default]
    Auto,
    /// From the lights
    Light,
    /// From the materials
    Bsdf,
    /// From both, weighted (multiple importance sampling)
    Mis,
    /// On diffuse surfaces the unshadowed answer in closed form, less an estimate of its blocked part
    Control,
    /// Ambient occlusion: how much of the sky is open, without lights
    Occlusion,
}

/// How two techniques are weighed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Heuristic {
    /// By their densities
    Balance,
    /// By the squares of their densities
    Power,
}

/// Which light is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Choose {
    /// What the scene requires
    #[default]
    Auto,
    /// Every light, each time
    All,
    /// One, each as likely
    Uniform,
    /// One, by its power
    Power,
    /// One, by what it is expected to send to the point: a tree of the lights
    Tree,
}

/// How directions toward an environment map are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Environment {
    /// What the scene requires
    #[default]
    Auto,
    /// By the cosine at the surface alone
    Cosine,
    /// By luminance
    Luminance,
    /// By luminance above its mean: for --technique mis, which finds the rest
    Compensated,
    /// By luminance times the cosine at the surface
    Product,
}

/// Whether the scene's portals are used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Portals {
    /// Half of the samples go through them
    #[default]
    On,
    /// As if the scene had none
    Off,
}

/// Where the uniform numbers come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Sequence {
    /// What the scene requires
    #[default]
    Auto,
    /// Independent random numbers
    Random,
    /// Owen-scrambled Sobol points, for each pixel alone
    Sobol,
    /// The same, shared by neighbouring pixels: an error that looks finer
    Zsobol,
}

impl Default for RenderArgs {
    /// What `halflight` alone does.
    fn default() -> Self {
        Self {
            scene: None,
            more: Vec::new(),
            output: DEFAULT_OUTPUT.into(),
            spp: None,
            error: None,
            time: None,
            max_spp: None,
            adaptive: Adaptive::Auto,
            layers: false,
            samples_image: None,
            visibility_image: None,
            width: None,
            height: None,
            crop: None,
            showing: Showing::default(),
            preview: None,
            frames: None,
            fps: None,
            watch: false,
            overwrite: false,
            part: None,
            checkpoint: None,
            seed: 0,
            threads: None,
            choices: Choices::default(),
            reading: SceneArgs::default(),
            quiet: false,
            json: false,
        }
    }
}
