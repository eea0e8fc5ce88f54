//! The arguments of `halflight merge`.

use super::Showing;
use clap::Args;
use std::path::PathBuf;

/// `halflight merge`
#[derive(Debug, Args)]
pub(crate) struct MergeArgs {
    /// All parts, in any order: files that render --part has made of the same scene with the same flags
    #[arg(value_name = "PART", required = true)]
    pub(crate) parts: Vec<PathBuf>,

    /// The picture: .png, .jpg (sRGB), .exr, .pfm (linear, 32-bit float) or .hdr (linear, RGBE)
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: PathBuf,

    #[command(flatten)]
    pub(crate) showing: Showing,

    /// Write layers beside the radiance, into .exr, as render does; the parts need --layers too
    #[arg(long)]
    pub(crate) layers: bool,

    /// Write the samples of each pixel as a picture (.png): white is the most of any
    #[arg(long, value_name = "FILE.png")]
    pub(crate) samples_image: Option<PathBuf>,

    /// Write the fraction of the light that is seen as a picture (.png); the parts need --layers
    #[arg(long, value_name = "FILE.png")]
    pub(crate) visibility_image: Option<PathBuf>,

    /// Print no summary
    #[arg(long)]
    pub(crate) quiet: bool,

    /// Print the summary as one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}
