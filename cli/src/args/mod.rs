//! The command line: what can be typed, and its typed form.

mod merge;
mod render;
mod showing;
mod tradeoff;
mod values;

pub(crate) use merge::MergeArgs;
pub(crate) use render::{
    Adaptive, Choices, Choose, Environment, Heuristic, Lights, Portals, RenderArgs, Sequence, Technique,
};
pub(crate) use showing::{Depth, PreviewHow, Showing, View};
pub(crate) use tradeoff::TradeoffArgs;
pub(crate) use values::Frames;

use anstream::ColorChoice;
use clap::builder::Styles;
use clap::builder::styling::{AnsiColor, Style};
use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Args, CommandFactory, Parser, Subcommand, ValueEnum};
use halflight::build::Sky;
use halflight::load::Files;
use halflight::load::builtin::BUILTIN;
use std::net::{IpAddr, Ipv4Addr};
use std::path::PathBuf;

/// Direct lighting from area and environment lights, to a known accuracy
///
/// Without a command, halflight renders the default built-in scene to halflight.png.
#[derive(Debug, Parser)]
#[command(name = "halflight", version, styles = STYLES, max_term_width = 100, after_help = EXIT_CODES)]
#[command(disable_help_subcommand = true)]
struct CommandLine {
    #[arg(
        long,
        global = true,
        value_enum,
        value_name = "WHEN",
        default_value_t,
        hide_possible_values = true
    )]
    #[arg(help = "Whether messages have colours: auto (on a terminal, without NO_COLOR), always, never")]
    color: Color,

    #[command(subcommand)]
    command: Option<Command>,
}

/// Whether messages have colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
enum Color {
    /// On a terminal, if NO_COLOR is not set
    #[default]
    Auto,
    /// Wherever they go
    Always,
    /// Nowhere
    Never,
}

impl From<Color> for ColorChoice {
    fn from(color: Color) -> Self {
        match color {
            Color::Auto => Self::Auto,
            Color::Always => Self::Always,
            Color::Never => Self::Never,
        }
    }
}

/// What to do.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Render a scene to a picture
    Render(Box<RenderArgs>),
    /// Put the parts of a picture together, which render --part has made
    Merge(MergeArgs),
    /// List the built-in scenes
    Scenes(ScenesArgs),
    /// Write a scene as Mitsuba 3 XML with its meshes beside it, or as Rust source or bytes for firmware
    Export(ExportArgs),
    /// Show what a scene holds, needs and costs
    Inspect(InspectArgs),
    /// Measure how far a picture is from a reference
    Compare(CompareArgs),
    /// Measure error against time for each choice that a scene makes possible
    Tradeoff(TradeoffArgs),
    /// Serve the browser page on this machine
    Serve(ServeArgs),
    /// Print what makes a shell complete halflight's commands and options
    Completions(CompletionsArgs),
    /// Print the manual page, or write those of all commands
    Man(ManArgs),
}

/// `halflight scenes`
#[derive(Debug, Args)]
pub(crate) struct ScenesArgs {
    /// Print JSON
    #[arg(long)]
    pub(crate) json: bool,
}

/// Which scene, and how it is read.
#[derive(Debug, Clone, Args, Default)]
pub(crate) struct SceneArgs {
    /// Set a parameter of the scene file, as in -D spp=16 (repeatable)
    #[arg(short = 'D', value_name = "NAME=VALUE", value_parser = values::definition)]
    pub(crate) define: Vec<(String, String)>,

    /// Put a clear sky and its sun around the scene, in place of its own environment: the sun's
    /// elevation and azimuth (degrees; 0 is toward -z, 90 toward +x) and the air's turbidity (2 to 10)
    #[arg(long, value_name = "E,A[,T]", value_parser = values::sky, allow_hyphen_values = true)]
    pub(crate) sky: Option<Sky>,

    /// Leave out what is not supported, with a warning, instead of refusing the scene
    #[arg(long)]
    pub(crate) lenient: bool,

    /// Where the scene's files are.
    #[arg(skip)]
    pub(crate) files: Files,
}

/// `halflight export`
#[derive(Debug, Args)]
pub(crate) struct ExportArgs {
    /// A scene file (Mitsuba 3 XML or glTF 2.0) or the name of a built-in scene
    #[arg(value_name = "SCENE")]
    pub(crate) scene: PathBuf,

    /// Where to write it [default: the scene's name ending in .xml, .rs or .scene, in this folder]
    #[arg(short, long, value_name = "FILE")]
    pub(crate) output: Option<PathBuf>,

    /// How to write it [default: by the ending of FILE, else xml]
    #[arg(long = "as", value_name = "FORMAT", value_enum)]
    pub(crate) format: Option<SceneFormat>,

    #[command(flatten)]
    pub(crate) reading: SceneArgs,
}

/// How a scene is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum SceneFormat {
    /// Mitsuba 3 XML, meshes and pictures beside it
    Xml,
    /// Rust source: constants for a program without files or heap
    Rust,
    /// Bytes that such a program reads from storage and borrows
    Bytes,
}

impl SceneFormat {
    /// Every one.
    pub(crate) const ALL: [Self; 3] = [Self::Xml, Self::Rust, Self::Bytes];

    /// How the names of such files end.
    pub(crate) const fn extension(self) -> &'static str {
        match self {
            Self::Xml => "xml",
            Self::Rust => "rs",
            Self::Bytes => "scene",
        }
    }
}

/// `halflight inspect`
#[derive(Debug, Args)]
pub(crate) struct InspectArgs {
    /// A scene file (Mitsuba 3 XML or glTF 2.0) or the name of a built-in scene
    #[arg(value_name = "SCENE")]
    pub(crate) scene: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) reading: SceneArgs,

    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

/// `halflight compare`
#[derive(Debug, Args)]
#[command(after_help = MEASURES)]
pub(crate) struct CompareArgs {
    /// The picture to judge: .exr, .pfm, .hdr, or .png and .jpg (taken as sRGB)
    pub(crate) picture: PathBuf,

    /// The picture to judge it by
    pub(crate) reference: PathBuf,

    /// Exit with code 1 if relMSE is above this
    #[arg(long, value_name = "X", value_parser = values::not_negative, allow_negative_numbers = true)]
    pub(crate) max_relmse: Option<f64>,

    /// Write the absolute difference as a picture (.png, .jpg, .exr, .pfm or .hdr)
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Option<PathBuf>,

    /// Write where people see a difference, by FLIP: from black over red and yellow to white
    #[arg(long, value_name = "OUT")]
    pub(crate) heat: Option<PathBuf>,

    /// Brighten the difference by this many stops when it is written as .png or .jpg
    #[arg(long, value_name = "EV", default_value_t = 0.0, value_parser = values::finite, allow_negative_numbers = true)]
    pub(crate) exposure: f32,

    /// Print one JSON object
    #[arg(long)]
    pub(crate) json: bool,
}

/// `halflight serve`
#[derive(Debug, Args)]
pub(crate) struct ServeArgs {
    /// The folder that scripts/build-www.sh has made
    #[arg(value_name = "FOLDER", default_value = "target/www")]
    pub(crate) folder: PathBuf,

    /// Port to listen on; 0 takes a free one
    #[arg(long, value_name = "N", default_value_t = 8080)]
    pub(crate) port: u16,

    /// Address to listen on; others than this one show the page to the network
    #[arg(long, value_name = "IP", default_value_t = IpAddr::V4(Ipv4Addr::LOCALHOST))]
    pub(crate) address: IpAddr,
}

/// `halflight completions`
#[derive(Debug, Args)]
#[command(after_help = COMPLETIONS)]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_name = "SHELL", value_enum)]
    pub(crate) shell: clap_complete::Shell,
}

/// `halflight man`
#[derive(Debug, Args)]
pub(crate) struct ManArgs {
    /// Write a page for each command into this folder, which must exist
    #[arg(value_name = "FOLDER")]
    pub(crate) folder: Option<PathBuf>,
}

/// Colours of the help.
const STYLES: Styles = Styles::styled()
    .header(Style::new().bold())
    .usage(Style::new().bold())
    .literal(AnsiColor::Cyan.on_default())
    .placeholder(Style::new());

/// Closes the help.
const EXIT_CODES: &str = "\
Exit codes: 0 good, 1 a check failed, 2 misuse or bad input, 130 interrupted.
NO_COLOR=1 turns colours off. Results go to standard output, everything else to standard error.";

/// Closes the help of `completions`.
const COMPLETIONS: &str = "\
bash:  halflight completions bash > ~/.local/share/bash-completion/completions/halflight
zsh:   halflight completions zsh > FOLDER/_halflight, with FOLDER in $fpath
fish:  halflight completions fish > ~/.config/fish/completions/halflight.fish";

/// Closes the help of `compare`.
const MEASURES: &str = "\
All measures are taken over pixels and channels; R is the reference, I the picture.
  RMSE    square root of the mean of (I - R)², linear
  relMSE  mean of (I - R)² / (R² + 0.01), linear
  PSNR    of the pictures as shown: sRGB, cut off at white [dB]
  SSIM    structural similarity of the pictures as shown: 1 for equal ones
  FLIP    mean difference that people see when the pictures alternate: 0 none, 1 the largest
  mean    mean of I over mean of R: 1 when the picture is neither too bright nor too dark
When both pictures carry standard errors (render --layers), blocks of 16×16 pixels are compared:
if one is off by more than noise explains, they disagree, and the exit code is 1.";

/// Reads the command line; exits on misuse, and after printing help.
pub(crate) fn parse() -> Option<Command> {
    let line = CommandLine::try_parse().unwrap_or_else(|error| with_hint(error).exit());
    ColorChoice::from(line.color).write_global();
    line.command
}

/// The definition, for what is made from it.
pub(crate) fn definition() -> clap::Command {
    CommandLine::command()
}

/// `halflight scene.xml` and `halflight cornell` are likely slips.
fn with_hint(mut error: clap::Error) -> clap::Error {
    if let (ErrorKind::InvalidSubcommand, Some(ContextValue::String(word))) =
        (error.kind(), error.get(ContextKind::InvalidSubcommand))
        && (word.contains(['.', '/', '\\']) || BUILTIN.iter().any(|b| b.name == *word))
    {
        let hint = format!("to render a scene: halflight render {word}");
        error.remove(ContextKind::SuggestedSubcommand);
        error.insert(ContextKind::Suggested, ContextValue::StyledStrs(vec![hint.into()]));
    }
    error
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_definition_is_consistent() {
        definition().debug_assert();
    }
}
