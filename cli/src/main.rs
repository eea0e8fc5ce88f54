//! The command line of halflight: arguments, threads, files, progress, reports.
//!
//! What light does is the business of the `halflight` library; nothing here computes it.

mod args;
mod commands;
mod driver;
mod failure;
mod fingerprint;
mod goal;
mod interrupt;
mod keep;
mod measure;
mod memory;
mod number;
mod output;
mod picture;
mod plan;
mod plot;
mod preview;
mod progress;
mod report;
mod save;
mod scene;
mod terminal;
mod tiles;

use args::{Command, RenderArgs};
use commands::{batch, compare, export, inspect, merge, render, scenes, serve, shell, tradeoff, watch};
use std::process::ExitCode;

fn main() -> ExitCode {
    let result = match args::parse() {
        None => render::run(&RenderArgs::default()),
        Some(Command::Render(args)) if args.watch => watch::run(&args),
        Some(Command::Render(args)) if batch::is_asked(&args) => batch::run(&args),
        Some(Command::Render(args)) => render::run(&args),
        Some(Command::Merge(args)) => merge::run(&args),
        Some(Command::Scenes(args)) => scenes::run(&args),
        Some(Command::Export(args)) => export::run(&args),
        Some(Command::Inspect(args)) => inspect::run(&args),
        Some(Command::Compare(args)) => compare::run(&args),
        Some(Command::Tradeoff(args)) => tradeoff::run(&args),
        Some(Command::Serve(args)) => serve::run(&args),
        Some(Command::Completions(args)) => shell::completions(&args),
        Some(Command::Man(args)) => shell::man(&args),
    };
    match result {
        Ok(exit) => exit.into(),
        Err(failure) => failure.report(),
    }
}
