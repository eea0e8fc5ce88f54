//! Arithmetic on one number, or on four at once.

use core::ops::{Add, Div, Mul, Neg, Sub};
use glam::Vec4;

/// What the code for four numbers works on: all of them, or with feature `small` one after the other, by
/// code a quarter as long. Each operation rounds each number for itself, so that the bits are the same.
#[cfg(not(feature = "small"))]
pub(crate) type Lane = Vec4;
#[cfg(feature = "small")]
pub(crate) type Lane = f32;

/// How many numbers that is.
pub(crate) const LANES: usize = size_of::<Lane>() / size_of::<f32>();

/// One number, or several at once.
pub(crate) trait Number:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f32, Output = Self>
    + Sub<f32, Output = Self>
    + Mul<f32, Output = Self>
{
    /// The same number everywhere.
    fn of(x: f32) -> Self;

    /// `1 / x`.
    fn recip(self) -> Self;

    /// Square root of what is not negative.
    fn sqrt(self) -> Self;

    /// Square root; 0 of what is negative or NaN.
    fn root(self) -> Self;

    /// The larger of two; the second when one is NaN.
    fn larger(self, other: Self) -> Self;

    /// The smaller of two; the second when one is NaN.
    fn smaller(self, other: Self) -> Self;

    /// `yes` where the number is above 0, else `no`.
    fn if_positive(self, yes: Self, no: Self) -> Self;

    /// The numbers from index `i` on, 0 beyond the end.
    fn load(values: &[f32], i: usize) -> Self;

    /// Stores them from index `i` on; what is beyond the end is dropped.
    fn store(self, values: &mut [f32], i: usize);

    /// The least of them.
    fn least(self) -> f32;

    /// A bit for each number that is not above the other.
    fn not_above(self, other: Self) -> u32;
}

impl Number for f32 {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn of(x: f32) -> Self {
        x
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn recip(self) -> Self {
        1.0 / self
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sqrt(self) -> Self {
        super::sqrt(self)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn root(self) -> Self {
        super::sqrt(self)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn larger(self, other: Self) -> Self {
        super::larger(self, other)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn smaller(self, other: Self) -> Self {
        if self < other { self } else { other }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn if_positive(self, yes: Self, no: Self) -> Self {
        if self > 0.0 { yes } else { no }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn load(values: &[f32], i: usize) -> Self {
        values.get(i).copied().unwrap_or(0.0)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn store(self, values: &mut [f32], i: usize) {
        if let Some(value) = values.get_mut(i) {
            *value = self;
        }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn least(self) -> f32 {
        self
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn not_above(self, other: Self) -> u32 {
        u32::from(self <= other)
    }
}

impl Number for Vec4 {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn of(x: f32) -> Self {
        Self::splat(x)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn recip(self) -> Self {
        1.0 / self
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sqrt(self) -> Self {
        // The method of the type, which rounds correctly too.
        Self::sqrt(self)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn root(self) -> Self {
        super::sqrt_of_four(self)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn larger(self, other: Self) -> Self {
        self.max(other)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn smaller(self, other: Self) -> Self {
        self.min(other)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn if_positive(self, yes: Self, no: Self) -> Self {
        Self::select(self.cmpgt(Self::ZERO), yes, no)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn load(values: &[f32], i: usize) -> Self {
        match values.get(i..i + 4) {
            Some(four) => Self::from_slice(four),
            None => rest(values, i),
        }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn store(self, values: &mut [f32], i: usize) {
        let four = self.to_array();
        match values.get_mut(i..i + 4) {
            Some(all) => all.copy_from_slice(&four),
            None => values.iter_mut().skip(i).zip(four).for_each(|(value, x)| *value = x),
        }
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn least(self) -> f32 {
        self.min_element()
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn not_above(self, other: Self) -> u32 {
        self.cmple(other).bitmask()
    }
}

#[cold]
fn rest(values: &[f32], i: usize) -> Vec4 {
    core::array::from_fn(|k| values.get(i + k).copied().unwrap_or(0.0)).into()
}

/// What a function makes of each of four numbers.
#[cfg_attr(not(feature = "small"), inline(always))]
pub(crate) fn map(four: Vec4, function: impl Fn(Lane) -> Lane) -> Vec4 {
    let mut all = four.to_array();
    for i in (0..4).step_by(LANES) {
        function(Lane::load(&all, i)).store(&mut all, i);
    }
    all.into()
}
