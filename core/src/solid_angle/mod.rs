//! Regions of directions and uniform sampling over them: the geometry behind the lights' views.

mod slab;

pub(crate) use slab::{FromEnd, Span, Sweep};
