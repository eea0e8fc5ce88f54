//! `halflight scenes`: which scenes are built in.

use crate::args::ScenesArgs;
use crate::failure::{Exit, Failure};
use crate::terminal;
use halflight::load::builtin::BUILTIN;
use serde_json::json;

/// Lists the built-in scenes.
pub(crate) fn run(args: &ScenesArgs) -> Result<Exit, Failure> {
    if args.json {
        let list: Vec<_> = BUILTIN.iter().map(|b| json!({ "name": b.name, "about": b.about })).collect();
        terminal::json(&list.into())?;
        return Ok(Exit::Good);
    }
    let widest = BUILTIN.iter().map(|b| b.name.len()).max().unwrap_or(0);
    let lines: Vec<_> = BUILTIN.iter().map(|b| format!("{:widest$}  {}", b.name, b.about)).collect();
    terminal::result(&lines.join("\n"))?;
    Ok(Exit::Good)
}
