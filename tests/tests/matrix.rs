//! Each cell of the conformance matrix as a test of its own.

use halflight_tests::matrix::{Cell, Measured};
use libtest_mimic::{Arguments, Failed, Trial};

fn main() {
    let mut arguments = Arguments::from_args();
    // Thousands of lines would hide the one that matters; those who ask for some cells see them.
    arguments.quiet |= arguments.filter.is_none() && !arguments.list;
    let trials = Cell::all().map(|cell| Trial::test(cell.name(), move || examine(cell))).collect();
    libtest_mimic::run(&arguments, trials).exit();
}

fn examine(cell: Cell) -> Result<(), Failed> {
    let failures = Measured::of(cell).failures;
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n").into()) }
}
