//! The header is kept as a file, so that programs need no generator, and a change of it shows in review.

use cbindgen::{Builder, Config, EnumConfig, Language, RenameRule};
use std::fs;
use std::path::Path;

/// What cbindgen makes of the source.
fn generated(folder: &Path) -> String {
    let config = Config {
        language: Language::C,
        include_guard: Some("HALFLIGHT_H".into()),
        header: Some("/* halflight from C. Written by cbindgen from ffi/src: do not edit. */".into()),
        documentation: true,
        cpp_compat: true,
        usize_is_size_t: true,
        enumeration: EnumConfig {
            rename_variants: RenameRule::QualifiedScreamingSnakeCase,
            ..EnumConfig::default()
        },
        ..Config::default()
    };
    let files = ["lib.rs", "status.rs", "ask.rs"].map(|file| folder.join("src").join(file));
    let builder = Builder::new().with_config(config);
    let header = files.iter().fold(builder, Builder::with_src).generate().expect("a header");
    let mut text = Vec::new();
    header.write(&mut text);
    String::from_utf8(text).expect("text")
}

#[test]
fn is_as_the_source_has_it() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (path, text) = (folder.join("include/halflight.h"), generated(folder));
    if std::env::var_os("HALFLIGHT_ACCEPT_HEADER").is_some() {
        fs::write(&path, &text).expect("the header can be written");
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(kept == text, "differs: if that is meant, run the tests with HALFLIGHT_ACCEPT_HEADER=1\n{text}");
}
