//! What is wrong with, or between, files.

use crate::{folder, load_files, message, refusal};
use halflight::load::{LoadError, LoadOptions, load};
use std::path::Path;

const SPHERE: &str = "<shape type=\"sphere\"/>";

fn wrap(body: &str) -> String {
    format!("<scene version=\"3.0.0\">\n{body}\n</scene>\n")
}

fn refused(name: &str, files: &[(&str, &str)], defines: &[(&str, &str)]) -> String {
    match load_files(name, files, &options(defines)) {
        Ok(loaded) => panic!("this must be refused: {:#?}", loaded.description),
        Err(error) => message(name, &error),
    }
}

fn options(defines: &[(&str, &str)]) -> LoadOptions {
    let defines = defines.iter().map(|(n, v)| ((*n).into(), (*v).into())).collect();
    LoadOptions { defines, lenient: false }
}

#[test]
fn a_missing_file_and_a_folder_are_named() {
    for path in [folder("missing").join("none.xml"), folder("missing.xml")] {
        let error = load(&path, &LoadOptions::default()).unwrap_err();
        assert!(matches!(error, LoadError::Unreadable { .. }));
        assert!(error.to_string().starts_with(&path.display().to_string()), "{error}");
    }
}

#[test]
fn other_formats_are_refused_with_what_is_read() {
    for name in ["a.fbx", "a", "a.xml.gz"] {
        let error = load(Path::new(name), &LoadOptions::default()).unwrap_err();
        assert!(error.to_string().contains("glTF 2.0 (.gltf, .glb)"), "{error}");
    }
}

#[test]
fn xml_that_is_not_well_formed_is_refused_where_it_breaks() {
    let whole = wrap("<shape type=\"sphere\"><float name=\"radius\" value=\"1\"/></shape>");
    // Cut off anywhere before the last tag is complete, it must be refused, never panic.
    for end in 0..whole.trim_end().len() {
        let message = refused("cut", &[("s.xml", &whole[..end])], &[]);
        assert!(message.starts_with("s.xml:") && message.contains("not well-formed"), "{end}: {message}");
    }
    let message = refused("cut", &[("s.xml", &wrap("<shape type=\"sphere\">"))], &[]);
    assert!(message.starts_with("s.xml:3:"), "{message}");
    let bomb = "<!DOCTYPE scene [<!ENTITY a \"x\">]><scene version=\"3.0.0\">&a;</scene>";
    assert!(refused("cut", &[("s.xml", bomb)], &[]).contains("not well-formed"));
}

#[test]
fn text_that_is_not_utf8_is_refused_where_it_starts() {
    let path = folder("latin").join("s.xml");
    std::fs::write(&path, b"<scene version=\"3.0.0\">\n<!-- \xe9 -->\n</scene>").unwrap();
    let error = load(&path, &LoadOptions::default()).unwrap_err();
    assert!(message("latin", &error).starts_with("s.xml:2:6: "), "{error}");
}

#[test]
fn roots_other_than_a_scene_of_this_age_are_refused() {
    let message = refused("root", &[("s.xml", "<scen version=\"3.0.0\"/>")], &[]);
    assert!(message.contains("did you mean \"scene\"?"), "{message}");
    let message = refused("root", &[("s.xml", "<scene version=\"0.6.0\"/>")], &[]);
    assert!(message.contains("convert older scenes"), "{message}");
    assert!(refused("root", &[("s.xml", "<scene/>")], &[]).contains("\"version\" is missing"));
}

#[test]
fn nesting_beyond_reason_is_refused_before_the_stack_ends() {
    let deep = wrap(&("<a>".repeat(100_000) + &"</a>".repeat(100_000)));
    let message = refused("deep", &[("s.xml", &deep)], &[]);
    assert!(message.contains("nested elements: more than 64"), "{message}");
}

#[test]
fn includes_that_lead_back_are_refused() {
    let own = wrap("<include filename=\"s.xml\"/>");
    assert!(
        refused("cycle", &[("s.xml", &own)], &[]).starts_with("s.xml:2: <include>: s.xml includes itself")
    );
    let files = [
        ("s.xml", &*wrap("<include filename=\"sub/t.xml\"/>")),
        ("sub/t.xml", &*wrap("\n<include filename=\"../s.xml\"/>")),
    ];
    let message = refused("cycle", &files, &[]);
    assert!(
        message.starts_with("sub/t.xml:3: <include>: ") && message.contains("includes itself"),
        "{message}"
    );
}

#[test]
fn includes_too_deep_or_too_many_are_refused() {
    let texts: Vec<(String, String)> = (0..40)
        .map(|i| (format!("{i}.xml"), wrap(&format!("<include filename=\"{}.xml\"/>", i + 1))))
        .collect();
    let files: Vec<(&str, &str)> = texts.iter().map(|(n, t)| (n.as_str(), t.as_str())).collect();
    let message = refused("chain", &files, &[]);
    assert!(message.starts_with("32.xml:2: ") && message.contains("more than 32 files deep"), "{message}");
    // Each file includes the next one ten times: 10¹² shapes.
    let texts: Vec<(String, String)> = (0..12)
        .map(|i| (format!("{i}.xml"), wrap(&format!("<include filename=\"{}.xml\"/>", i + 1).repeat(10))))
        .chain([("12.xml".to_owned(), wrap(SPHERE))])
        .collect();
    let files: Vec<(&str, &str)> = texts.iter().map(|(n, t)| (n.as_str(), t.as_str())).collect();
    let message = refused("bomb", &files, &[]);
    assert!(message.contains("included files: more than 4096"), "{message}");
}

#[test]
fn a_missing_include_names_both_files() {
    let message = refused("noinclude", &[("s.xml", &wrap("<include filename=\"t.xml\"/>"))], &[]);
    assert!(message.starts_with("s.xml:2: <include>: t.xml: "), "{message}");
}

#[test]
fn parameters_must_be_known() {
    let body = wrap(
        "<default name=\"size\" value=\"1\"/>\n<shape type=\"sphere\"><float name=\"radius\" value=\"$siez\"/></shape>",
    );
    let message = refused("parameter", &[("s.xml", &body)], &[]);
    assert_eq!(
        message,
        "s.xml:3: <float name=\"radius\">: unknown parameter \"siez\"; did you mean \"size\"? supported: size"
    );
    let bad = body.replace("siez", "size");
    let message = refused("parameter", &[("s.xml", &bad)], &[("size", "big")]);
    assert!(message.contains("value=\"big\" cannot be read"), "{message}");
}

#[test]
fn parameters_from_outside_need_a_name() {
    let files = [("s.xml", &*wrap(SPHERE))];
    for name in ["", "a b", "a=b", "$a"] {
        assert!(refused("define", &files, &[(name, "1")]).contains("write -D name=value"), "{name}");
    }
    assert!(refused("define", &files, &[("a", "1"), ("a", "2")]).contains("given twice"));
}

#[test]
fn a_parameter_from_outside_that_is_not_used_is_a_warning() {
    let loaded = load_files("unused", &[("s.xml", &wrap(SPHERE))], &options(&[("spp", "4")])).unwrap();
    assert!(loaded.warnings.iter().any(|w| w.at.is_none() && w.text.contains("\"spp\" is not used")));
}

#[test]
fn meshes_that_are_missing_or_broken_are_named_with_the_shape_that_wants_them() {
    let shape = wrap("\n<shape type=\"ply\"><string name=\"filename\" value=\"m.ply\"/></shape>");
    let missing = refused("mesh", &[("s.xml", &shape)], &[]);
    assert!(missing.starts_with("s.xml:3: <shape type=\"ply\">: m.ply: "), "{missing}");
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                  element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (body, part) in [
        ("0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "face 0 refers to vertex 7, but there are 3 vertices"),
        ("0 0 0\n1 0 0\n", "cannot be read"),
        ("0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n", "no triangle has an area"),
    ] {
        let message = refused("mesh", &[("s.xml", &shape), ("m.ply", &(header.to_owned() + body))], &[]);
        assert!(message.starts_with("s.xml:3: <shape type=\"ply\">: m.ply: "), "{message}");
        assert!(message.contains(part), "{message}");
    }
    let huge = header.replace("vertex 3", "vertex 4000000000");
    let message = refused("mesh", &[("s.xml", &shape), ("m.ply", &huge)], &[]);
    assert!(message.contains("promises 4000000000 × vertex"), "{message}");
    let obj = shape.replace("ply", "obj");
    let message = refused("mesh", &[("s.xml", &obj), ("m.obj", "v 0 0 0\nf 1 2 3\n")], &[]);
    assert!(message.contains("m.obj: line 2: index 2 of a corner, where there are 1"), "{message}");
    assert!(refusal("mesh", "<shape type=\"ply\"/>").contains("property \"filename\" is missing"));
}
