//! The arguments of `halflight tradeoff`.

use super::SceneArgs;
use super::render::resolution;
use super::values::positive;
use clap::Args;
use clap::builder::RangedU64ValueParser;
use std::path::PathBuf;

/// `halflight tradeoff`
#[derive(Debug, Args)]
#[command(after_help = COLUMNS)]
pub(crate) struct TradeoffArgs {
    /// A scene file (Mitsuba 3 XML or glTF 2.0) or the name of a built-in scene [default: the first of
    /// `halflight scenes`]
    #[arg(value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,

    /// How long to measure (s); the reference takes up to half as long besides
    #[arg(long, value_name = "SECONDS", default_value_t = 60.0, value_parser = positive, allow_negative_numbers = true)]
    pub(crate) budget: f32,

    /// A converged picture of the scene to judge by (.exr or .hdr), in place of one that is computed
    #[arg(long, value_name = "FILE")]
    pub(crate) reference: Option<PathBuf>,

    /// Where the results go: NAME.svg, NAME.csv and NAME.json [default: the scene's name with
    /// -tradeoff, in this folder]
    #[arg(short, long, value_name = "NAME")]
    pub(crate) output: Option<PathBuf>,

    /// Columns of the pictures that are judged; the rows follow [default: those of the reference, or
    /// at most 200]
    #[arg(long, value_name = "PIXELS", value_parser = resolution(), allow_negative_numbers = true)]
    pub(crate) width: Option<u32>,

    /// Which random numbers
    #[arg(long, value_name = "N", default_value_t = 0, allow_negative_numbers = true)]
    pub(crate) seed: u32,

    /// Threads [default: one for each core]
    #[arg(long, value_name = "N", value_parser = RangedU64ValueParser::<usize>::new().range(1..=1024), allow_negative_numbers = true)]
    pub(crate) threads: Option<usize>,

    #[command(flatten)]
    pub(crate) reading: SceneArgs,

    /// Print no progress
    #[arg(long)]
    pub(crate) quiet: bool,

    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

/// Closes the help.
const COLUMNS: &str = "\
Each row of the table is what `auto` takes with one choice changed, with the same samples for every
pixel but in the row `adaptive on`, whose samples go where the error is, as those of --error and
--time do. All are rendered with several seeds in turn, and judged at the same CPU time, which the
heading names.
  error        relative RMS error, the root of relMSE (see `halflight compare --help`)
  time to 1 %  CPU time until that is 1 %; ~ where it had to be extrapolated
  efficiency   1 / (relMSE × CPU time), relative to auto, with its standard error over the seeds
  order        of convergence: the error falls as samples to the minus this power
  open         error where the lights are seen in full
  penumbra     error where a part of their light is blocked
The noise of the reference is taken off, and no choice is judged where it is not well above that.";
