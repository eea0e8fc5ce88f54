//! How a picture is turned into what a display is given.

use super::values::finite;
use clap::{Args, ValueEnum};

/// What applies to pictures that are shown as they are: .png.
#[derive(Debug, Clone, Copy, Default, Args)]
pub(crate) struct Showing {
    /// From light to what a display shows [default: standard]
    #[arg(long, value_enum, value_name = "VIEW")]
    pub(crate) view: Option<View>,

    /// Brighten by this many stops
    #[arg(long, value_name = "EV", value_parser = finite, allow_negative_numbers = true)]
    pub(crate) exposure: Option<f32>,
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

    /// The flags that were given.
    pub(crate) fn given(&self) -> impl Iterator<Item = &'static str> {
        let flags = [("--view", self.view.is_some()), ("--exposure", self.exposure.is_some())];
        flags.into_iter().filter_map(|(flag, given)| given.then_some(flag))
    }
}
