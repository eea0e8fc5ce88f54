//! The help is kept as files, so that a change of the command line shows in review.

use crate::support::Folder;
use std::fs;
use std::path::Path;

/// Compares what is printed with `help/NAME.txt`, or writes it there when HALFLIGHT_ACCEPT_HELP is set.
fn check(name: &str, line: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("help").join(name).with_extension("txt");
    let printed = Folder::new().good(line);
    if std::env::var_os("HALFLIGHT_ACCEPT_HELP").is_some() {
        fs::write(&path, &printed).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        printed == kept,
        "`halflight {line}` differs from {}; if that is meant, run the tests with HALFLIGHT_ACCEPT_HELP=1\n{printed}",
        path.display()
    );
}

#[test]
fn help_is_as_it_is_kept() {
    check("halflight", "--help");
    for command in ["render", "scenes", "export", "inspect", "compare", "serve", "tradeoff"] {
        check(command, &format!("{command} --help"));
    }
}

#[test]
fn no_line_of_help_is_wider_than_a_terminal() {
    for command in ["", "render", "scenes", "export", "inspect", "compare", "serve", "tradeoff"] {
        let help = Folder::new().good(&format!("{command} --help"));
        for line in help.lines() {
            assert!(line.chars().count() <= 100, "{command}: {line}");
        }
    }
}
