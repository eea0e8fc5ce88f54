//! Arithmetic on one number, or on four at once.

use crate::num;
use core::ops::{Add, Mul};
use glam::Vec4;

/// One number, or several at once.
pub(super) trait Number:
    Copy + Add<Output = Self> + Mul<Output = Self> + Add<f32, Output = Self> + Mul<f32, Output = Self>
{
    /// `1 / x`.
    fn recip(self) -> Self;

    /// Square root of what is not negative.
    fn sqrt(self) -> Self;

    /// `yes` where the number is above 0, else `no`.
    fn if_positive(self, yes: Self, no: Self) -> Self;
}

impl Number for f32 {
    #[cfg_attr(not(feature = "small"), inline(always))]
    fn recip(self) -> Self {
        1.0 / self
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn sqrt(self) -> Self {
        num::sqrt(self)
    }

    #[cfg_attr(not(feature = "small"), inline(always))]
    fn if_positive(self, yes: Self, no: Self) -> Self {
        if self > 0.0 { yes } else { no }
    }
}

impl Number for Vec4 {
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
    fn if_positive(self, yes: Self, no: Self) -> Self {
        Self::select(self.cmpgt(Self::ZERO), yes, no)
    }
}
