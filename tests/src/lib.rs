//! The harness of the conformance suite: fixtures, oracles in double precision, and checks that
//! return what they found instead of panicking, so that their own sensitivity can be tested.

pub mod bsdfs;
pub mod environments;
pub mod histogram;
pub mod lights;
pub mod matrix;
pub mod oracle;
pub mod oracle_extremes;
pub mod quadrature;
pub mod random;
pub mod scenes;
pub mod shapes;
pub mod soak;
pub mod statistics;

use std::fmt;

/// What a check found: nothing wrong, or what.
pub type Verdict = Result<(), Failure>;

/// What is wrong, in words and numbers.
pub struct Failure(pub String);

impl fmt::Debug for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Fails with a message unless the condition holds.
#[macro_export]
macro_rules! ensure {
    ($condition:expr, $($message:tt)+) => {
        if !$condition {
            return Err($crate::Failure(format!($($message)+)));
        }
    };
}

/// The README's code, compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
