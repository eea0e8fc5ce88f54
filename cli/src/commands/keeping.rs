//! What a render keeps for others, or for itself later: the flags --part and --checkpoint.

use super::render::Prepared;
use crate::args::RenderArgs;
use crate::driver::{self, Goal};
use crate::failure::Failure;
use crate::fingerprint;
use crate::keep::{self, Keeper};
use crate::output::Output;
use crate::save::Files;
use crate::tiles::{About, Header, Part};
use std::time::Duration;

/// Ten years: what is longer does not fit a clock.
const MOST_SECONDS: f32 = 3.15e8;

/// Where a render goes, checked.
#[derive(Debug)]
pub(super) enum Destination {
    /// To a picture.
    Picture(Files),
    /// To a part of one.
    Part(Output),
}

impl Destination {
    /// What is asked for.
    ///
    /// # Errors
    /// When a file cannot be written, or a flag is for pictures and there is none.
    pub(super) fn check(args: &RenderArgs) -> Result<Self, Failure> {
        let Some(Part { number, of }) = args.part else { return Files::check(args).map(Self::Picture) };
        let for_pictures = [
            ("--exposure", args.showing.exposure.is_some()),
            ("--view", args.showing.view.is_some()),
            ("--depth", args.showing.depth.is_some()),
            ("--quality", args.showing.quality.is_some()),
            ("--samples-image", args.samples_image.is_some()),
            ("--visibility-image", args.visibility_image.is_some()),
        ];
        if let Some((flag, _)) = for_pictures.iter().find(|(_, given)| *given) {
            return Err(Failure::new(format!("{flag} has no use with --part, which makes no picture"))
                .tip(format!("give {flag} to halflight merge; what needs layers needs --layers here")));
        }
        if args.output.extension().is_none_or(|extension| extension != "part") {
            let file = args.output.display();
            return Err(Failure::new(format!(
                "cannot write a part into {file}: the name of a part ends in .part"
            ))
            .tip(format!("name it, for example -o {number}-of-{of}.part")));
        }
        Output::check(&args.output).map(Self::Part)
    }
}

/// What keeps the part or the checkpoint that is asked for.
///
/// # Errors
/// When there is a checkpoint that cannot be used, or the goal cannot be reached part by part.
pub(super) fn keeper(
    args: &RenderArgs,
    prepared: &mut Prepared,
    to: &Destination,
) -> Result<Keeper, Failure> {
    let file = match to {
        Destination::Part(file) => Some(file.clone()),
        Destination::Picture(_) if args.checkpoint.is_none() => return Ok(Keeper::default()),
        Destination::Picture(_) => None,
    };
    let aim = keep::aim(prepared.goal)?;
    if let (Some(_), Goal::Error { adaptive: false, .. }) = (args.part, prepared.goal) {
        return Err(Failure::new(
            "--adaptive off and --error have no use with --part, as no part knows the whole picture",
        )
        .tip("leave --adaptive off out, or say --spp"));
    }
    let stats = prepared.buffers.stats();
    let header = Header {
        scene: prepared.found.description.name.clone(),
        fingerprint: prepared.fingerprint.clone(),
        settings: settings(args, prepared),
        about: About {
            triangles: stats.triangles as u64,
            lights: stats.lights as u64,
            seed: args.seed,
            film: (prepared.film.width(), prepared.film.height()),
            choices: prepared.choices(),
        },
        aim,
        pixels: if args.sees_layers() { "layers" } else { "radiance" }.to_owned(),
        crop: prepared.film.crop(),
        side: driver::side(prepared.goal),
        part: args.part.unwrap_or(Part::WHOLE),
        complete: false,
    };
    let keeper = Keeper::new(header, file);
    match args.checkpoint {
        Some(seconds) => {
            keeper.with_checkpoint(&args.output, Duration::from_secs_f32(seconds.min(MOST_SECONDS)))
        }
        None => Ok(keeper),
    }
}

/// Everything beside the scene that decides the bits.
fn settings(args: &RenderArgs, prepared: &Prepared) -> Vec<(String, String)> {
    let (film, crop) = (&prepared.film, prepared.film.crop());
    let layers = if args.sees_layers() { "on" } else { "off" };
    let mut settings = vec![
        ("version of halflight", env!("CARGO_PKG_VERSION").to_owned()),
        ("width", film.width().to_string()),
        ("height", film.height().to_string()),
        ("crop", format!("{},{},{},{}", crop.x0, crop.y0, crop.x1, crop.y1)),
        ("seed", args.seed.to_string()),
        ("layers", layers.to_owned()),
    ];
    match prepared.goal {
        Goal::Samples(samples) => settings.push(("spp", samples.to_string())),
        Goal::Error { target, most, adaptive } => settings.extend([
            ("error", format!("{} %", target * 100.0)),
            ("max-spp", most.to_string()),
            ("adaptive", if adaptive { "on" } else { "off" }.to_owned()),
        ]),
        Goal::Time { .. } => {}
    }
    settings.extend(prepared.plan.flags());
    // What has no flag, and what may get one that is forgotten here.
    settings.push(("plan", fingerprint::of(&(&prepared.plan, film, &prepared.camera))));
    settings.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}
