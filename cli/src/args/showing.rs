//! How a picture is turned into what a display is given.

use super::values::finite;
use crate::picture::Format;
use clap::{Args, ValueEnum, value_parser};

/// What applies to pictures that are shown as they are: .png and .jpg.
#[derive(Debug, Clone, Copy, Default, Args)]
pub(crate) struct Showing {
    /// From light to what a display shows, in .png and .jpg [default: standard]
    #[arg(long, value_enum, value_name = "VIEW")]
    pub(crate) view: Option<View>,

    /// Brighten by this many stops, in .png and .jpg
    #[arg(long, value_name = "EV", value_parser = finite, allow_negative_numbers = true)]
    pub(crate) exposure: Option<f32>,

    /// Bits of a channel in .png [default: 8]
    #[arg(long, value_enum, value_name = "BITS")]
    pub(crate) depth: Option<Depth>,

    /// Quality of .jpg, from 1 to 100 [default: 92]
    #[arg(long, value_name = "N", value_parser = value_parser!(u8).range(1..=100), allow_negative_numbers = true)]
    pub(crate) quality: Option<u8>,
}

/// By which protocol a terminal is shown a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum PreviewHow {
    /// What the terminal says it speaks, if there is one
    #[default]
    Auto,
    /// Kitty's graphics protocol
    Kitty,
    /// Sixels, 216 colours
    Sixel,
    /// Half blocks of 24-bit colour
    Blocks,
}

/// Bits of a channel.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum Depth {
    /// As every program reads it
    #[default]
    #[value(name = "8")]
    Eight,
    /// For grading: without bands
    #[value(name = "16")]
    Sixteen,
}

/// From light to what a display shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub(crate) enum View {
    /// sRGB, cut off at white
    #[default]
    Standard,
    /// AgX: contrast of film; bright colours go to white
    Agx,
    /// ACES: reference rendering and output transform for sRGB, as fitted by Stephen Hill
    Aces,
    /// Khronos PBR Neutral: colours as they are up to 0.8, brighter ones squeezed in
    KhronosNeutral,
    /// The linear values, without the curve of sRGB
    None,
}

impl Showing {
    /// As it was rendered, for a display of sRGB, brighter by so many stops.
    pub(crate) fn exposed(exposure: f32) -> Self {
        Self { exposure: Some(exposure), ..Self::default() }
    }

    /// The flags that were given, and have no effect on a file of that format.
    pub(crate) fn in_vain(&self, format: Format) -> impl Iterator<Item = &'static str> {
        let flags = [
            ("--view", self.view.is_some(), format.is_shown()),
            ("--exposure", self.exposure.is_some(), format.is_shown()),
            ("--depth", self.depth.is_some(), format == Format::Png),
            ("--quality", self.quality.is_some(), format == Format::Jpeg),
        ];
        flags.into_iter().filter_map(|(flag, given, has_use)| (given && !has_use).then_some(flag))
    }
}
