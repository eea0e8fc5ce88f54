//! Values that need more than a number or a word.

use crate::tiles::Part;
use halflight::build::Sky;
use halflight::film::PixelRect;

/// `x0,y0,x1,y1`.
pub(super) fn crop(text: &str) -> Result<PixelRect, String> {
    let numbers: Option<Vec<u32>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x0, y0, x1, y1]) if x0 < x1 && y0 < y1 => Ok(PixelRect { x0, y0, x1, y1 }),
        Some(&[_, _, _, _]) => Err("the window is empty; X0 must be below X1, and Y0 below Y1".to_owned()),
        _ => Err("four whole numbers are needed, as in 100,80,300,200".to_owned()),
    }
}

/// `elevation,azimuth` or `elevation,azimuth,turbidity`: a sky that can be looked at as it is.
pub(super) fn sky(text: &str) -> Result<Sky, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|n| n.trim().parse().ok()).collect();
    let sky = match numbers.as_deref() {
        Some(&[elevation, azimuth]) => Sky::new(elevation, azimuth, Sky::CLEAR),
        Some(&[elevation, azimuth, turbidity]) => Sky::new(elevation, azimuth, turbidity),
        _ => return Err("two or three numbers are needed, as in 40,120 or 40,120,3".to_owned()),
    };
    sky.map(|sky| sky.scaled(Sky::EXPOSED)).map_err(|e| e.to_string())
}

/// A number of segments: from 1, or -1 for any, which is [`u32::MAX`].
pub(super) fn depth(text: &str) -> Result<u32, String> {
    match (text, text.parse()) {
        ("-1", _) => Ok(u32::MAX),
        (_, Ok(depth @ 1..)) => Ok(depth),
        _ => Err("a whole number from 1 is needed, or -1 for paths without end".to_owned()),
    }
}

/// Frames of a camera's way, both ends among them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Frames {
    /// The first.
    pub(crate) first: u32,
    /// The last.
    pub(crate) last: u32,
}

/// Most frames: half a day at 24 a second.
const MOST_FRAMES: u32 = 1 << 20;

/// `a..b`, or `a`.
pub(super) fn frames(text: &str) -> Result<Frames, String> {
    let (first, last) = text.split_once("..").unwrap_or((text, text));
    let number = |text: &str| text.trim().parse::<u32>().ok().filter(|n| *n <= MOST_FRAMES);
    match (number(first), number(last)) {
        (Some(first), Some(last)) if first <= last => Ok(Frames { first, last }),
        (Some(_), Some(_)) => Err("the last frame comes before the first".to_owned()),
        _ => Err(format!("two whole numbers up to {MOST_FRAMES} are needed, as in 0..47")),
    }
}

/// A number that is neither infinite nor NaN.
pub(super) fn finite(text: &str) -> Result<f32, String> {
    match text.parse() {
        Ok(x) if f32::is_finite(x) => Ok(x),
        _ => Err("a number is needed, as in -1.5".to_owned()),
    }
}

/// A whole number above 0.
pub(super) fn count(text: &str) -> Result<u32, String> {
    match text.parse() {
        Ok(n @ 1..) => Ok(n),
        _ => Err(format!("a whole number from 1 to {} is needed", u32::MAX)),
    }
}

/// A number above 0; may be infinite.
pub(super) fn positive(text: &str) -> Result<f32, String> {
    match text.parse() {
        Ok(x) if x > 0.0 => Ok(x),
        _ => Err("a number above 0 is needed".to_owned()),
    }
}

/// A number of at least 0.
pub(super) fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if x >= 0.0 => Ok(x),
        _ => Err("a number of 0 or more is needed, as in 0.01".to_owned()),
    }
}

/// `I/N`.
pub(super) fn part(text: &str) -> Result<Part, String> {
    let numbers =
        text.split_once('/').and_then(|(i, n)| Some((i.trim().parse().ok()?, n.trim().parse().ok()?)));
    match numbers {
        Some((number, of)) if number >= 1 && number <= of && of <= Part::MOST => Ok(Part { number, of }),
        _ => Err(format!(
            "the number of the part and that of all parts are needed, as in 3/16: from 1, and at most {}",
            Part::MOST
        )),
    }
}

/// `name=value`.
pub(super) fn definition(text: &str) -> Result<(String, String), String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() => {
            Ok((name.trim().to_owned(), value.trim().to_owned()))
        }
        _ => Err("a name and a value are needed, as in spp=16".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_window_has_four_numbers_and_an_inside() {
        assert_eq!(crop("1, 2,3,4"), Ok(PixelRect { x0: 1, y0: 2, x1: 3, y1: 4 }));
        for text in ["", "1,2,3", "1,2,3,4,5", "a,b,c,d", "-1,0,2,2", "3,0,3,2", "0,2,3,1", "0,0,1e9,2"] {
            assert!(crop(text).is_err(), "{text}");
        }
    }

    #[test]
    fn counts_are_whole_and_not_0() {
        assert_eq!(count("64"), Ok(64));
        for text in ["0", "-1", "1e3", "1.5", "", "5000000000"] {
            assert!(count(text).is_err(), "{text}");
        }
    }

    #[test]
    fn frames_are_from_first_to_last() {
        assert_eq!(frames("2..10"), Ok(Frames { first: 2, last: 10 }));
        assert_eq!(frames("7"), Ok(Frames { first: 7, last: 7 }));
        for text in ["", "..", "1..", "5..4", "-1..4", "0..4000000000", "a..b", "1..2..3"] {
            assert!(frames(text).is_err(), "{text}");
        }
    }

    #[test]
    fn numbers_that_are_none_are_refused() {
        assert!(finite("inf").is_err() && finite("nan").is_err() && finite("bright").is_err());
        assert!(positive("0").is_err() && positive("nan").is_err() && positive("inf").is_ok());
        assert!(not_negative("-1").is_err() && not_negative("nan").is_err() && not_negative("0").is_ok());
    }

    #[test]
    fn a_depth_has_no_end_or_is_at_least_one() {
        assert_eq!((depth("-1"), depth("1"), depth("8")), (Ok(u32::MAX), Ok(1), Ok(8)));
        for text in ["0", "-2", "2.5", "", "all"] {
            assert!(depth(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_part_is_one_of_them_all() {
        assert_eq!(part("3/16"), Ok(Part { number: 3, of: 16 }));
        for text in ["", "3", "0/4", "5/4", "-1/4", "1/65537", "a/b", "1/2/3"] {
            assert!(part(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_definition_may_hold_further_equals_signs() {
        assert_eq!(definition("a=b=c"), Ok(("a".into(), "b=c".into())));
        assert!(definition("a").is_err() && definition("=b").is_err());
    }
}
