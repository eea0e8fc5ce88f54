//! Several sectors at once.

use super::arc::{atan_ratio, atan_ratio_and_slope};
use crate::num::lanes::{Lane, Number};

/// One side each of some sectors, as in [`super::meridian::Meridian`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Ends {
    pub(super) outer: [Lane; 3],
    pub(super) rise: Lane,
}

/// The cosines of the outer arcs, and the projected solid angles (sr) where these are not wide.
///
/// It is [`super::sector::Sector::area_to`] of the whole, where both outer ends are unit vectors.
#[cfg_attr(not(feature = "small"), inline(always))]
pub(super) fn areas(first: &Ends, last: &Ends, pole: [Lane; 3], to_zenith: bool) -> (Lane, Lane) {
    let ([ax, ay, az], [bx, by, bz]) = (first.outer, last.outer);
    let across = ax * bx + ay * by;
    let cos = across + az * bz;
    let sin2 = pole[0] * pole[0] + pole[1] * pole[1] + pole[2] * pole[2];
    let k = cos + 1.0;
    let x = sin2 / (k * k);
    if to_zenith {
        return (cos, pole[2] * atan_ratio(x) / k);
    }
    let (da, db) = (first.rise, last.rise);
    let (sa, sb) = (az + az + da, bz + bz + db);
    let (qa, qb) = (da * sa, db * sb);
    let mixed = da * sb + db * sa;
    let inner_sin2 = (bx * bx + by * by) * qa + (ax * ax + ay * ay) * qb - across * mixed;
    let square = qa + qb + qa * qb;
    let length = Number::sqrt(square + 1.0);
    let k_rise = mixed * 0.5 + square / (length + 1.0);
    let k_inner = k + k_rise;
    let per_k = 1.0 / k_inner;
    let x_fall = (x * k_rise * (k_inner + k) - inner_sin2) * per_k * per_k;
    let (h, slope) = atan_ratio_and_slope(x, (x - x_fall).larger(Lane::of(0.0)));
    (cos, pole[2] * per_k * (k_rise * h / k + slope * x_fall))
}
