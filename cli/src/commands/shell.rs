//! `halflight completions` and `halflight man`: the command line for shells and for `man`.

use crate::args::{CompletionsArgs, ManArgs, definition};
use crate::failure::{Exit, Failure, io_reason};
use crate::terminal;
use std::path::Path;

/// Prints a shell's completions.
pub(crate) fn completions(args: &CompletionsArgs) -> Result<Exit, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut definition(), "halflight", &mut script);
    terminal::result(&String::from_utf8_lossy(&script))?;
    Ok(Exit::Good)
}

/// Prints the manual page, or writes those of all commands.
pub(crate) fn man(args: &ManArgs) -> Result<Exit, Failure> {
    match &args.folder {
        Some(folder) => write(folder),
        None => {
            let mut page = Vec::new();
            let made = clap_mangen::Man::new(definition()).render(&mut page);
            made.map_err(|error| Failure::new(format!("the manual page: {}", io_reason(&error))))?;
            terminal::result(&String::from_utf8_lossy(&page))?;
            Ok(Exit::Good)
        }
    }
}

fn write(folder: &Path) -> Result<Exit, Failure> {
    clap_mangen::generate_to(definition(), folder)
        .map_err(|error| Failure::new(format!("{}: {}", folder.display(), io_reason(&error))))?;
    Ok(Exit::Good)
}
