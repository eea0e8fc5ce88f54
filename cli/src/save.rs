//! The files that a render leaves.

use crate::args::{RenderArgs, Showing};
use crate::driver::{Rendered, samples};
use crate::failure::Failure;
use crate::output::Output;
use crate::picture::{Format, Header, Layer, Picture, encode_exr};
use halflight::Rgb;
use halflight::estimate::{LayeredPixel, Pixel, PixelStats};
use std::path::Path;

/// The files that were asked for, each checked.
#[derive(Debug)]
pub(crate) struct Files {
    picture: (Format, Output),
    samples: Option<Output>,
    visibility: Option<Output>,
}

/// A pixel that can be saved.
pub(crate) trait Saved: Pixel {
    /// What is known beside the radiance.
    fn layered(&self) -> Option<&LayeredPixel> {
        None
    }
}

impl Saved for PixelStats {}

impl Saved for LayeredPixel {
    fn layered(&self) -> Option<&LayeredPixel> {
        Some(self)
    }
}

impl Files {
    /// Checks that all files can be written.
    ///
    /// # Errors
    /// When one cannot, or its format has no place for what is asked.
    pub(crate) fn check(args: &RenderArgs) -> Result<Self, Failure> {
        let format = Format::of(&args.output)?;
        if args.layers && format != Format::Exr {
            let file = args.output.display();
            return Err(Failure::new(format!("cannot write layers into {file}: only .exr has them"))
                .tip("end the name after -o in .exr, or leave --layers out"));
        }
        let png = |path: &Path| match Format::of(path)? {
            Format::Png => Output::check(path),
            _ => Err(Failure::new(format!("cannot write {}: it is to be a .png", path.display()))),
        };
        Ok(Self {
            samples: args.samples_image.as_deref().map(png).transpose()?,
            visibility: args.visibility_image.as_deref().map(png).transpose()?,
            picture: (format, Output::check(&args.output)?),
        })
    }

    /// How the picture is written.
    pub(crate) fn format(&self) -> Format {
        self.picture.0
    }

    /// Writes them.
    ///
    /// # Errors
    /// When the system refuses.
    pub(crate) fn write<P: Saved>(
        &self,
        args: &RenderArgs,
        rendered: &Rendered<P>,
        header: &Header,
    ) -> Result<(), Failure> {
        let (width, height) = rendered.size();
        let picture = |value: &dyn Fn(&P) -> Rgb| Picture { width, height, pixels: rendered.pixels(value) };
        let radiance = picture(&|p| p.stats().mean());
        let (format, output) = &self.picture;
        let bytes = match format {
            Format::Exr => {
                let layers = if args.layers { layers(rendered) } else { Vec::new() };
                encode_exr(&radiance, layers, header)?
            }
            _ => format.encode(&radiance, &args.showing)?,
        };
        output.write(&bytes)?;
        if let Some(output) = &self.samples {
            let most = rendered.samples_per_pixel().1.max(1) as f32;
            let share = picture(&|p| Rgb::splat(samples(p.stats()) as f32 / most));
            output.write(&Format::Png.encode(&share, &Showing::default())?)?;
        }
        if let Some(output) = &self.visibility {
            let seen = picture(&|p| Rgb::splat(p.layered().map_or(0.0, LayeredPixel::visibility)));
            output.write(&Format::Png.encode(&seen, &Showing::default())?)?;
        }
        Ok(())
    }
}

/// Standard error of the mean per channel, as of so many independent samples. Those of other sequences do
/// better, by how much a pixel's own samples do not tell: over ten scenes of 96×72 pixels the root mean square of
/// the true errors was 0.3 to 0.8 of this with 64 samples (median 0.45), and 0.3 to 0.6 with 256.
fn standard_error(pixel: &PixelStats) -> Rgb {
    (pixel.variance() / pixel.count().max(1) as f32).map(halflight::num::sqrt)
}

/// What is known beside the radiance, by the names that OpenEXR has for it.
fn layers<P: Saved>(rendered: &Rendered<P>) -> Vec<Layer> {
    let layer = |name, value: &dyn Fn(&P) -> f32| Layer { name, values: rendered.pixels(value) };
    let seen = |name, value: fn(&LayeredPixel) -> f32| layer(name, &|p| p.layered().map_or(0.0, value));
    vec![
        layer("error.R", &|p| standard_error(p.stats()).r),
        layer("error.G", &|p| standard_error(p.stats()).g),
        layer("error.B", &|p| standard_error(p.stats()).b),
        layer("samples", &|p| samples(p.stats()) as f32),
        seen("albedo.R", |p| p.albedo().r),
        seen("albedo.G", |p| p.albedo().g),
        seen("albedo.B", |p| p.albedo().b),
        seen("N.X", |p| p.normal().x),
        seen("N.Y", |p| p.normal().y),
        seen("N.Z", |p| p.normal().z),
        seen("Z", LayeredPixel::depth),
        seen("visibility", LayeredPixel::visibility),
    ]
}
