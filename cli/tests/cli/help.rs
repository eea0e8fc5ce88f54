//! The help is kept as files, so that a change of the command line shows in review.

use crate::support::Folder;
use std::fs;
use std::path::Path;

const COMMANDS: [&str; 10] =
    ["render", "merge", "scenes", "export", "inspect", "compare", "serve", "tradeoff", "completions", "man"];

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
    for command in COMMANDS {
        check(command, &format!("{command} --help"));
    }
}

#[test]
fn no_line_of_help_is_wider_than_a_terminal() {
    for command in [""].into_iter().chain(COMMANDS) {
        let help = Folder::new().good(&format!("{command} --help"));
        for line in help.lines() {
            assert!(line.chars().count() <= 100, "{command}: {line}");
        }
    }
}

#[test]
fn completions_know_commands_and_options() {
    for shell in ["bash", "zsh", "fish", "powershell", "elvish"] {
        let script = Folder::new().good(&format!("completions {shell}"));
        for word in ["render", "tradeoff", "max-spp"] {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
}

#[test]
fn manual_pages_are_those_of_all_commands() {
    let folder = Folder::new();
    let page = folder.good("man");
    assert!(page.contains(".TH") && page.contains("halflight"), "{page}");
    folder.good("man .");
    for command in COMMANDS {
        let page = fs::read_to_string(folder.path(&format!("halflight-{command}.1"))).unwrap();
        assert!(page.contains(".SH SYNOPSIS"), "{command}");
    }
    let error = folder.refused("man nowhere");
    assert!(error.contains("nowhere"), "{error}");
}
