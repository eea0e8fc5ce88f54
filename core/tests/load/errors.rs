//! What is wrong inside of one scene file.

use crate::{load_body, refusal, scene};
use halflight::load::{LoadOptions, load};

#[test]
fn an_unknown_plugin_is_named_with_its_place_and_the_nearest_known_one() {
    let message = refusal("difuse", "<shape type=\"sphere\">\n<bsdf type=\"difuse\"/></shape>");
    assert_eq!(
        message,
        "scene.xml:3: <bsdf type=\"difuse\">: unknown bsdf \"difuse\"; did you mean \"diffuse\"? \
         supported: diffuse, phong, principled, roughconductor, roughplastic, twosided"
    );
}

#[test]
fn unknown_elements_plugins_properties_and_attributes_are_refused() {
    for (body, part) in [
        ("<shap type=\"sphere\"/>", "did you mean \"shape\"?"),
        ("<shape type=\"spere\"/>", "did you mean \"sphere\"?"),
        ("<shape/>", "attribute \"type\" is missing"),
        ("<shape type=\"sphere\"><float name=\"radis\" value=\"1\"/></shape>", "did you mean \"radius\"?"),
        (
            "<shape type=\"sphere\"><float nam=\"radius\" value=\"1\"/></shape>",
            "attribute \"name\" is missing",
        ),
        ("<shape type=\"sphere\"><float name=\"radius\" val=\"1\"/></shape>", "did you mean \"value\"?"),
        ("<shape type=\"sphere\"><string name=\"radius\" value=\"1\"/></shape>", "must be a <float>"),
        ("<shape type=\"sphere\" tpye=\"x\"/>", "unknown attribute \"tpye\""),
        ("<shape type=\"sphere\"><medium type=\"homogeneous\"/></shape>", "unknown element \"medium\""),
        ("<integrator type=\"volpath\"/>", "supported: direct, path"),
        ("<sensor type=\"thinlens\"/>", "supported: perspective, orthographic"),
        ("<sensor type=\"perspective\"><film type=\"ldrfilm\"/></sensor>", "did you mean \"hdrfilm\"?"),
        ("<sensor type=\"perspective\"><sampler type=\"halton\"/></sensor>", "independent, stratified"),
        (
            "<sensor type=\"perspective\"><sampler type=\"independent\"><integer name=\"samples\" value=\"1\"/>\
             </sampler></sensor>",
            "supported: sample_count, seed, jitter",
        ),
        (
            "<sensor type=\"perspective\"><film type=\"hdrfilm\"><rfilter type=\"mitchell\"/></film></sensor>",
            "supported: box, tent, gaussian",
        ),
        ("<bsdf type=\"roughconductor\" id=\"a\"/>", "unknown distribution \"beckmann\""),
        ("<bsdf type=\"roughplastic\" id=\"a\"/>", "unknown distribution \"beckmann\""),
        ("<shape type=\"sphere\"><transform name=\"to_world\"><skew x=\"1\"/></transform></shape>", "skew"),
        ("<shape type=\"sphere\">text</shape>", "text between elements"),
    ] {
        let message = refusal("unknown", body);
        assert!(message.starts_with("scene.xml:2") && message.contains(part), "{body}\n{message}");
    }
}

#[test]
fn what_mitsuba_has_and_halflight_does_not_says_what_to_write_instead() {
    for (body, part) in [
        ("<emitter type=\"envmap\"/>", "the property \"filename\" is missing"),
        ("<emitter type=\"area\"/>", "put it into the <shape>"),
        (
            "<bsdf type=\"phong\" id=\"a\"><texture type=\"bitmap\" name=\"exponent\"/></bsdf>",
            "a texture is not supported; give the property one value",
        ),
        (
            "<bsdf type=\"diffuse\" id=\"a\"><spectrum name=\"reflectance\" value=\"400:1, 700:0\"/></bsdf>",
            "several wavelengths",
        ),
        (
            "<sensor type=\"perspective\"><film type=\"hdrfilm\"><integer name=\"crop_width\" value=\"2\"/>\
             </film></sensor>",
            "use --crop",
        ),
        (
            "<sensor type=\"perspective\"><float name=\"principal_point_offset_x\" value=\"0.1\"/></sensor>",
            "set it to 0",
        ),
    ] {
        let message = refusal("unsupported", body);
        assert!(message.contains(part), "{body}\n{message}");
    }
}

#[test]
fn numbers_that_are_none_are_refused_with_attribute_and_text() {
    for text in ["nan", "inf", "-inf", "", "1e999", "1e39", "1.0.0", "zwei", "1 2"] {
        let body = format!("<shape type=\"sphere\"><float name=\"radius\" value=\"{text}\"/></shape>");
        let message = refusal("numbers", &body);
        assert_eq!(
            message,
            format!(
                "scene.xml:2: <float name=\"radius\">: value=\"{text}\" cannot be read; it must be one finite number"
            )
        );
    }
}

#[test]
fn other_values_that_cannot_be_read_are_refused() {
    for (element, part) in [
        ("<point name=\"center\" value=\"1 2\"/>", "three finite numbers"),
        ("<point name=\"center\" x=\"1\" y=\"2\"/>", "attribute \"z\" is missing"),
        ("<boolean name=\"flip_normals\" value=\"yes\"/>", "true or false"),
        ("<transform name=\"to_world\"><matrix value=\"1 2 3\"/></transform>", "16 or 9"),
        ("<transform name=\"to_world\"><rotate angle=\"5\"/></transform>", "the axis"),
        (
            "<transform name=\"to_world\"><rotate x=\"1\" y=\"1\" angle=\"5\"/></transform>",
            "axis of length 1",
        ),
        ("<transform name=\"to_world\"><rotate x=\"1\"/></transform>", "\"angle\" is missing"),
        ("<transform name=\"to_world\"><scale value=\"1 nan 1\"/></transform>", "one finite number or three"),
        (
            "<emitter type=\"area\"><rgb name=\"radiance\" value=\"#ff8000\"/></emitter>",
            "one finite number, or three of them",
        ),
        ("<emitter type=\"area\"><rgb name=\"radiance\" value=\"1, inf, 1\"/></emitter>", "finite"),
        (
            "<float name=\"radius\" value=\"1\"/><float name=\"radius\" value=\"2\"/>",
            "property \"radius\" is given twice; the first one is at",
        ),
    ] {
        let message = refusal("values", &format!("<shape type=\"sphere\">{element}</shape>"));
        assert!(message.contains(part), "{element}\n{message}");
    }
}

#[test]
fn quantities_that_nature_does_not_have_are_refused() {
    let negative = "<emitter type=\"TYPE\"><rgb name=\"NAME\" value=\"1, -1, 1\"/></emitter>";
    let area = negative.replace("TYPE", "area").replace("NAME", "radiance");
    let message = refusal("negative", &format!("<shape type=\"sphere\">{area}</shape>"));
    assert!(message.contains("<emitter type=\"area\">: the emission (1, -1, 1) is negative"), "{message}");
    for (kind, name) in [("point", "intensity"), ("spot", "intensity"), ("constant", "radiance")] {
        let message = refusal("negative", &negative.replace("TYPE", kind).replace("NAME", name));
        assert!(message.contains("is negative"), "{kind}: {message}");
    }
    for (body, part) in [
        ("<bsdf type=\"diffuse\" id=\"a\"><rgb name=\"reflectance\" value=\"2\"/></bsdf>", "between 0 and 1"),
        ("<shape type=\"sphere\"><float name=\"radius\" value=\"0\"/></shape>", "radius in m is 0"),
        (
            "<emitter type=\"spot\"><float name=\"cutoff_angle\" value=\"10\"/>\
             <float name=\"beam_width\" value=\"20\"/></emitter>",
            "angles must satisfy",
        ),
        (
            "<sensor type=\"perspective\"><float name=\"fov\" value=\"180\"/></sensor>",
            "the field of view is 180°",
        ),
        (
            "<sensor type=\"perspective\"><float name=\"near_clip\" value=\"5\"/>\
             <float name=\"far_clip\" value=\"2\"/></sensor>",
            "clipping distances",
        ),
    ] {
        let message = refusal("nature", body);
        assert!(message.starts_with("scene.xml:2") && message.contains(part), "{body}\n{message}");
    }
}

#[test]
fn films_without_pixels_are_refused() {
    for (name, value) in [("width", "0"), ("height", "0"), ("width", "100000")] {
        let film = format!("<film type=\"hdrfilm\"><integer name=\"{name}\" value=\"{value}\"/></film>");
        let message = refusal("film", &format!("<sensor type=\"perspective\">{film}</sensor>"));
        assert!(message.contains("<film type=\"hdrfilm\">: the film is"), "{message}");
    }
    let film = "<film type=\"hdrfilm\"><integer name=\"width\" value=\"-4\"/></film>";
    let message = refusal("film", &format!("<sensor type=\"perspective\">{film}</sensor>"));
    assert!(message.contains("value=\"-4\" cannot be read"), "{message}");
}

#[test]
fn degenerate_transforms_are_refused() {
    for kind in ["rectangle", "disk", "sphere", "cylinder", "cube"] {
        let body = format!(
            "<shape type=\"{kind}\">\n<transform name=\"to_world\"><scale x=\"0\"/></transform></shape>"
        );
        let message = refusal("degenerate", &body);
        assert!(message.contains("must have an inverse"), "{kind}: {message}");
    }
    let body = "<sensor type=\"perspective\"><transform name=\"to_world\">\
                <lookat origin=\"1 2 3\" target=\"1 2 3\" up=\"0 1 0\"/></transform></sensor>";
    assert!(refusal("degenerate", body).contains("have different origin and target"));
    let overflow = "<shape type=\"sphere\"><transform name=\"to_world\"><scale value=\"1e30\"/>\
                    <scale value=\"1e30\"/></transform></shape>";
    assert!(refusal("degenerate", overflow).starts_with("scene.xml:2: <shape type=\"sphere\">"));
}

#[test]
fn transforms_that_a_shape_cannot_follow_are_refused() {
    for (kind, step) in [("sphere", "<scale x=\"2\"/>"), ("cylinder", "<scale x=\"2\"/>")] {
        let body =
            format!("<shape type=\"{kind}\">\n<transform name=\"to_world\">{step}</transform></shape>");
        let message = refusal("bent", &body);
        assert!(message.starts_with("scene.xml:3: <transform") && message.contains("alike"), "{message}");
    }
    let scaled =
        "<sensor type=\"perspective\"><transform name=\"to_world\"><scale value=\"2\"/></transform></sensor>";
    assert!(refusal("bent", scaled).contains("not scale a perspective camera"));
    let projective = "<shape type=\"rectangle\"><transform name=\"to_world\">\
                      <matrix value=\"1 0 0 0 0 1 0 0 0 0 1 0 0 0 1 1\"/></transform></shape>";
    assert!(refusal("bent", projective).contains("end with the row 0 0 0 1"));
}

#[test]
fn references_go_to_what_exists_and_is_a_material() {
    let message = refusal(
        "ref",
        "<bsdf type=\"diffuse\" id=\"gold\"/><shape type=\"sphere\"><ref id=\"gild\"/></shape>",
    );
    assert!(message.contains("<ref id=\"gild\">: unknown id \"gild\"; did you mean \"gold\"?"), "{message}");
    let message =
        refusal("ref", "<shape type=\"disk\" id=\"d\"/><shape type=\"sphere\"><ref id=\"d\"/></shape>");
    assert!(message.contains("refer to a <bsdf>"), "{message}");
    let message = refusal("ref", "<shape type=\"disk\" id=\"d\"/>\n<shape type=\"disk\" id=\"d\"/>");
    assert!(message.contains("the id \"d\" is used twice; the first one is at scene.xml:2"), "{message}");
    let cycle =
        "<alias id=\"a\" as=\"b\"/><alias id=\"b\" as=\"a\"/><shape type=\"disk\"><ref id=\"a\"/></shape>";
    assert!(refusal("ref", cycle).contains("unknown id \"a\""));
}

#[test]
fn what_may_be_there_once_is_refused_twice() {
    for body in [
        "<emitter type=\"constant\"/>\n<emitter type=\"constant\"/>",
        "<integrator type=\"direct\"/>\n<integrator type=\"path\"/>",
        "<shape type=\"disk\">\n<bsdf type=\"diffuse\"/><bsdf type=\"diffuse\"/></shape>",
        "<shape type=\"disk\">\n<emitter type=\"area\"/><emitter type=\"area\"/></shape>",
    ] {
        let message = refusal("twice", body);
        assert!(message.starts_with("scene.xml:3: ") && message.contains("the first one is at"), "{message}");
    }
}

#[test]
fn an_empty_scene_is_refused_unless_a_light_surrounds_it() {
    assert!(refusal("empty", "").contains("the scene is empty"));
    assert!(refusal("empty", "<emitter type=\"point\"/>").contains("the scene is empty"));
    assert_eq!(scene("empty", "<emitter type=\"constant\"/>").lights.len(), 1);
}

#[test]
fn lenient_leaves_out_what_is_unknown_and_says_so() {
    let body = "<shape type=\"sphere\" id=\"ball\"><bsdf type=\"plastic\"/><float name=\"shine\" value=\"1\"/></shape>\n\
                <shape type=\"teapot\"/>\n<emitter type=\"sunsky\"/>";
    assert!(load_body("lenient", body).is_err());
    let path = crate::folder("lenient").join("s.xml");
    let write = |body: &str| std::fs::write(&path, format!("<scene version=\"3.0.0\">\n{body}</scene>"));
    write(body).unwrap();
    let options = LoadOptions { lenient: true, ..LoadOptions::default() };
    let loaded = load(&path, &options).unwrap();
    assert_eq!(loaded.description.objects.len(), 1);
    let places: Vec<_> = loaded.warnings.iter().filter_map(|w| w.at.as_ref()).map(|p| p.line).collect();
    // Two about the sphere, then the teapot and the sky; the missing sensor is about the scene.
    assert_eq!(places, [2, 2, 3, 4, 1]);
    assert!(loaded.warnings[2].to_string().contains("<shape type=\"teapot\">"), "{}", loaded.warnings[2]);
    // What is wrong, rather than unknown, is still an error.
    write("<shape type=\"sphere\"><float name=\"radius\" value=\"x\"/></shape>").unwrap();
    assert!(load(&path, &options).is_err());
}
