//! `halflight compare`: how far a picture is from a reference.

use crate::args::{CompareArgs, Showing};
use crate::failure::{Exit, Failure};
use crate::measure::{Agreement, agreement, flip, heat, ssim};
use crate::number::significant;
use crate::output::Output;
use crate::picture::{Decoded, Format, Picture, encode, read_framed};
use crate::progress::Step;
use crate::terminal;
use halflight::Rgb;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// How far a picture is from its reference, over pixels and channels.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Measures {
    /// Root of the mean squared difference.
    rmse: f64,
    /// Mean squared difference, relative.
    relmse: f64,
    /// Of the pictures as shown, in decibels; infinite for equal ones.
    psnr: f64,
    /// Structural similarity as shown; `None` for pictures smaller than its window.
    ssim: Option<f64>,
    /// Mean of the differences that people see, in `[0, 1]`.
    flip: f64,
    /// Mean over mean; `None` where the reference is black.
    mean_ratio: Option<f64>,
}

/// Compares two pictures.
pub(crate) fn run(args: &CompareArgs) -> Result<Exit, Failure> {
    let (output, heat_map) = (writable(args.output.as_ref())?, writable(args.heat.as_ref())?);
    let step = Step::begin("comparing", args.json);
    let (one, other) = aligned(finite(&args.picture)?, finite(&args.reference)?);
    let (picture, reference) = (&one.picture, &other.picture);
    check_sizes(args, picture, reference)?;
    let seen = flip(picture, reference);
    let measures = measure(picture, reference, &seen);
    let noise = within_noise(&one, &other);
    if let Some((format, output)) = heat_map {
        output.write(&format.encode(&heat(&seen, picture.width, picture.height), &Showing::default())?)?;
    }
    if let Some((format, output)) = output {
        output.write(&format.encode(&difference(picture, reference), &Showing::exposed(args.exposure))?)?;
    }
    drop(step);
    let passed = args.max_relmse.is_none_or(|most| measures.relmse <= most)
        && noise.is_none_or(|agreement| agreement.holds());
    tell(args, &measures, noise.as_ref(), passed)?;
    Ok(if passed { Exit::Good } else { Exit::CheckFailed })
}

/// The format of a picture that is to be written, and its place.
fn writable(path: Option<&PathBuf>) -> Result<Option<(Format, Output)>, Failure> {
    path.map(|path| Ok((Format::of(path)?, Output::check(path)?))).transpose()
}

/// How well the pictures agree, when both carry standard errors.
fn within_noise(one: &Decoded, other: &Decoded) -> Option<Agreement> {
    let (a, b) = (one.errors.as_ref()?, other.errors.as_ref()?);
    Some(agreement((&one.picture, a), (&other.picture, b)))
}

/// Two different parts of one film are compared as the whole film, black around them.
fn aligned(one: Decoded, other: Decoded) -> (Decoded, Decoded) {
    if one.film != other.film || one.window == other.window {
        return (one, other);
    }
    let framed = |part: Decoded| Decoded { picture: part.framed(), errors: None, ..part };
    (framed(one), framed(other))
}

/// Reads a picture, all of whose values must be numbers.
fn finite(path: &Path) -> Result<Decoded, Failure> {
    let read = read_framed(path)?;
    match read.picture.pixels.iter().position(|p| !p.is_finite()) {
        Some(i) => {
            let (x, y) = (i % read.picture.width as usize, i / read.picture.width as usize);
            let name = path.display();
            Err(Failure::new(format!("{name}: pixel ({x}, {y}) is infinite or not a number"))
                .tip("such a picture cannot be measured; render it anew"))
        }
        None => Ok(read),
    }
}

/// Only pictures of one size can be compared.
fn check_sizes(args: &CompareArgs, picture: &Picture, reference: &Picture) -> Result<(), Failure> {
    if (picture.width, picture.height) == (reference.width, reference.height) {
        return Ok(());
    }
    Err(Failure::new(format!(
        "{} is {}×{} pixels, {} is {}×{}",
        args.picture.display(),
        picture.width,
        picture.height,
        args.reference.display(),
        reference.width,
        reference.height
    ))
    .tip("only pictures of the same size can be compared"))
}

/// Pairs of values, picture first.
fn pairs<'a>(picture: &'a Picture, reference: &'a Picture) -> impl Iterator<Item = (f32, f32)> + 'a {
    picture.pixels.iter().zip(&reference.pixels).flat_map(|(i, r)| i.to_array().into_iter().zip(r.to_array()))
}

/// Takes all measures.
///
/// * `seen` – of FLIP, for each pixel
fn measure(picture: &Picture, reference: &Picture, seen: &[f32]) -> Measures {
    let mean = |term: &dyn Fn(f32, f32) -> f64| {
        pairs(picture, reference).map(|(i, r)| term(i, r)).sum::<f64>() / (3 * picture.pixels.len()) as f64
    };
    let square = |i: f32, r: f32| (f64::from(i) - f64::from(r)).powi(2);
    let mse = mean(&square);
    let reference_mean = mean(&|_, r| f64::from(r));
    Measures {
        rmse: mse.sqrt(),
        relmse: mean(&|i, r| square(i, r) / (f64::from(r).powi(2) + 0.01)),
        psnr: -10.0 * mean(&|i, r| square(encode(i), encode(r))).log10(),
        ssim: ssim(picture, reference),
        flip: seen.iter().map(|&error| f64::from(error)).sum::<f64>() / seen.len() as f64,
        mean_ratio: (reference_mean > 0.0).then(|| mean(&|i, _| f64::from(i)) / reference_mean),
    }
}

/// |I − R| per channel.
fn difference(picture: &Picture, reference: &Picture) -> Picture {
    let apart = |i: Rgb, r: Rgb| (i - r).map(f32::abs);
    let pixels = picture.pixels.iter().zip(&reference.pixels).map(|(&i, &r)| apart(i, r)).collect();
    Picture { pixels, ..*picture }
}

/// Prints the measures, and the outcome of the checks if there are any.
fn tell(
    args: &CompareArgs,
    measures: &Measures,
    noise: Option<&Agreement>,
    passed: bool,
) -> Result<(), Failure> {
    if args.json {
        terminal::json(&object(args, measures, noise, passed))?;
    } else {
        terminal::result(&line(measures))?;
        if let Some(noise) = noise.filter(|noise| noise.holds()) {
            terminal::result(&format!("they agree within noise: {}", worst(noise)))?;
        }
    }
    if let Some(noise) = noise.filter(|noise| !noise.holds()) {
        terminal::remark(format!("check failed: they differ by more than noise: {}", worst(noise)));
    }
    if let Some(most) = args.max_relmse.filter(|most| measures.relmse > *most) {
        let (relmse, most) = (significant(measures.relmse), significant(most));
        terminal::remark(format!("check failed: relMSE {relmse} is above {most}"));
    }
    Ok(())
}

/// The measures in one line.
fn line(measures: &Measures) -> String {
    let Measures { rmse, relmse, psnr, ssim, flip, mean_ratio } = *measures;
    let ratio = mean_ratio.map_or_else(|| "unknown".to_owned(), |r| format!("{r:.5}"));
    let psnr = if psnr.is_finite() { format!("{psnr:.2}") } else { "∞".to_owned() };
    let ssim = ssim.map_or_else(|| "unknown".to_owned(), |s| format!("{s:.4}"));
    let [rmse, relmse, flip] = [rmse, relmse, flip].map(significant);
    format!("RMSE {rmse}  relMSE {relmse}  PSNR {psnr} dB  SSIM {ssim}  FLIP {flip}  mean {ratio}")
}

/// The worst block.
fn worst(noise: &Agreement) -> String {
    let [x, y] = noise.worst;
    format!(
        "the worst block, from pixel ({x}, {y}) on, is {:.1} standard errors off; up to {:.1} is noise",
        noise.largest, noise.limit
    )
}

/// The measures for scripts.
fn object(args: &CompareArgs, measures: &Measures, noise: Option<&Agreement>, passed: bool) -> Value {
    json!({
        "picture": args.picture.to_string_lossy(),
        "reference": args.reference.to_string_lossy(),
        "rmse": measures.rmse,
        "relmse": measures.relmse,
        // JSON has no infinity: null stands for that of equal pictures.
        "psnr": measures.psnr.is_finite().then_some(measures.psnr),
        "ssim": measures.ssim,
        "flip": measures.flip,
        "mean_ratio": measures.mean_ratio,
        "noise": noise.map(|noise| json!({
            "agree": noise.holds(),
            "typical": noise.typical,
            "largest": noise.largest.is_finite().then_some(noise.largest),
            "limit": noise.limit,
            "worst": noise.worst,
        })),
        "max_relmse": args.max_relmse,
        "passed": passed,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grey(values: &[f32]) -> Picture {
        let pixels = values.iter().map(|&v| Rgb::splat(v)).collect();
        Picture { width: values.len() as u32, height: 1, pixels }
    }

    #[test]
    fn equal_pictures_differ_by_nothing() {
        let measures = measure(&grey(&[0.1, 0.7]), &grey(&[0.1, 0.7]), &[0.0; 2]);
        assert_eq!((measures.rmse, measures.relmse, measures.mean_ratio), (0.0, 0.0, Some(1.0)));
        assert_eq!(measures.psnr, f64::INFINITY);
    }

    #[test]
    fn measures_match_their_definitions() {
        // Differences 0.25 and 0; (1/16)/(0.5² + 0.01)/2.
        let measures = measure(&grey(&[0.75, 0.0]), &grey(&[0.5, 0.0]), &[0.5, 0.0]);
        assert!((measures.rmse - (0.0625_f64 / 2.0).sqrt()).abs() < 1e-12);
        assert!((measures.relmse - 0.0625 / 0.26 / 2.0).abs() < 1e-12);
        assert!((measures.mean_ratio.unwrap() - 1.5).abs() < 1e-12);
        assert_eq!((measures.flip, measures.ssim), (0.25, None));
        let shown = f64::from(encode(0.75)) - f64::from(encode(0.5));
        assert!((measures.psnr + 10.0 * (shown * shown / 2.0).log10()).abs() < 1e-9);
    }

    #[test]
    fn the_mean_of_a_black_reference_is_no_measure() {
        assert_eq!(measure(&grey(&[0.5]), &grey(&[0.0]), &[1.0]).mean_ratio, None);
    }

    #[test]
    fn the_difference_has_no_sign() {
        assert_eq!(difference(&grey(&[0.25, 1.0]), &grey(&[0.5, 0.5])), grey(&[0.25, 0.5]));
    }
}
