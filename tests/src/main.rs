//! Prints the conformance matrix.

use clap::Parser;
use halflight_tests::matrix::{Cell, DENSITIES, Light, Measured, Table};
use std::process::ExitCode;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

/// Holds every light, by every density, against the truth: from touching to a million sizes away,
/// from facing to behind, from a micrometre to a thousand kilometres, from round to a needle.
///
/// The exit code is 1 when a cell fails.
#[derive(Debug, Parser)]
#[command(name = "conformance")]
struct Arguments {
    /// Only this kind of light
    #[arg(long, value_parser = Light::ALL.map(Light::name))]
    light: Option<String>,
    /// Only this density
    #[arg(long, value_parser = DENSITIES.map(|(_, name)| name))]
    density: Option<String>,
    /// Only cells whose name holds this
    #[arg(long)]
    filter: Option<String>,
    /// How many of the cells that fail are listed
    #[arg(long, default_value_t = 20)]
    list: usize,
    /// Print a table for a README
    #[arg(long)]
    markdown: bool,
}

impl Arguments {
    fn wants(&self, cell: &Cell) -> bool {
        let is = |wanted: &Option<String>, name: &str| wanted.as_deref().is_none_or(|w| w == name);
        is(&self.light, cell.light.name())
            && is(&self.density, DENSITIES[cell.density].1)
            && self.filter.as_deref().is_none_or(|part| cell.name().contains(part))
    }
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let cells: Vec<Cell> = Cell::all().filter(|cell| arguments.wants(cell)).collect();
    let table = examine(&cells);
    let text = if arguments.markdown { table.markdown() } else { table.plain(arguments.list) };
    println!("{text}");
    ExitCode::from(u8::from(!table.is_clean()))
}

/// Examines cells on every processor; the table does not depend on their number.
fn examine(cells: &[Cell]) -> Table {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::with_capacity(cells.len()));
    let work = || {
        while let Some(&cell) = cells.get(next.fetch_add(1, Ordering::Relaxed)) {
            let measured = Measured::of(cell);
            done.lock().unwrap_or_else(PoisonError::into_inner).push((cell, measured));
        }
    };
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(work);
        }
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    let place = |cell: &Cell| cells.iter().position(|c| c == cell);
    done.sort_by_cached_key(|(cell, _)| place(cell));
    let mut table = Table::default();
    done.iter().for_each(|(cell, measured)| table.take(cell, measured));
    table
}
