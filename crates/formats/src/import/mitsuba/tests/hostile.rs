//! Files that are broken, or made to do harm.
use super::{SENSOR, read_with, refused};
use crate::import::ImportOptions;

fn error(files: &[(&str, &str)], text: &str) -> String {
    match read_with(files, text, &ImportOptions::default()) {
        Ok(_) => panic!("it is read"),
        Err(error) => error.report(),
    }
}

fn includes(name: &str) -> String {
    format!("<scene version=\"3.0.0\"><include filename=\"{name}\"/><include filename=\"{name}\"/></scene>")
}

#[test]
fn entities_and_document_types_are_refused() {
    let laughs =
        "<!DOCTYPE a [<!ENTITY a \"ha\"><!ENTITY b \"&a;&a;&a;\">]><scene version=\"3.0.0\"><string name=\"&b;\"/></scene>";
    assert!(error(&[], laughs).contains("not valid XML"));
    let file =
        "<!DOCTYPE a [<!ENTITY a SYSTEM \"file:///etc/hostname\">]><scene version=\"3.0.0\"><string name=\"&a;\"/></scene>";
    assert!(error(&[], file).contains("not valid XML"));
}

#[test]
fn defaults_that_double_each_other_are_refused() {
    let mut text = "<scene version=\"3.0.0\"><default name=\"a0\" value=\"hahahahaha\"/>".to_owned();
    for i in 1..40 {
        text += &format!(
            "<default name=\"a{i}x\" value=\"{}\"/>",
            format!("$a{}{}", i - 1, if i == 1 { "" } else { "x" }).repeat(10)
        );
    }
    assert!(error(&[], &(text + "</scene>")).contains("too long"));
}

#[test]
fn circles_of_includes_references_and_aliases_are_refused() {
    let itself = includes("scene.xml");
    assert!(error(&[], &itself).contains("circle"));
    assert!(error(&[("a.xml", &includes("b.xml")), ("b.xml", &includes("a.xml"))], &includes("a.xml")).contains("circle"));
    let bsdf = format!(
        "{SENSOR}<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf><bsdf type=\"twosided\" id=\"b\"><ref id=\"a\"/></bsdf>\
        <shape type=\"sphere\"><ref id=\"a\"/></shape>"
    );
    assert!(refused(&bsdf).contains("contains itself"));
    let groups = format!(
        "{SENSOR}<shape type=\"shapegroup\" id=\"g\"><shape type=\"instance\"><ref id=\"g\"/></shape></shape>\
        <shape type=\"instance\"><ref id=\"g\"/></shape>"
    );
    assert!(refused(&groups).contains("contains itself"));
    let spectra = format!(
        "{SENSOR}<texture type=\"uniform\" id=\"u\"><ref name=\"value\" id=\"u\"/></texture><shape type=\"sphere\"><bsdf type=\"diffuse\">\
        <ref name=\"reflectance\" id=\"u\"/></bsdf></shape>"
    );
    assert!(refused(&spectra).contains("itself"));
    let aliases =
        format!("{SENSOR}<alias id=\"a\" as=\"b\"/><alias id=\"b\" as=\"a\"/><shape type=\"sphere\"><ref id=\"a\"/></shape>");
    assert!(refused(&aliases).contains("nothing has the id"));
}

#[test]
fn deep_and_wide_files_are_refused() {
    let deep = "<bsdf type=\"twosided\">".repeat(100_000) + &"</bsdf>".repeat(100_000);
    assert!(refused(&deep).contains("nested"));
    let wide = format!("<shape {}/>", (0..2000).map(|i| format!("a{i}=\"\" ")).collect::<String>());
    assert!(refused(&wide).contains("attributes"));
    let spaces = (0..100).map(|i| format!("<a xmlns:a{i}=\"x\">")).collect::<String>();
    assert!(refused(&spaces).contains("namespaces"));
}

#[test]
fn instances_that_multiply_are_refused() {
    let shapes = "<shape type=\"sphere\"/>".repeat(1000);
    let instances = "<shape type=\"instance\"><ref id=\"g\"/></shape>".repeat(1000);
    assert!(refused(&format!("{SENSOR}<shape type=\"shapegroup\" id=\"g\">{shapes}</shape>{instances}")).contains("objects"));
}

#[test]
fn groups_without_shapes_that_double_are_refused() {
    let merge = |i: usize| format!("<shape type=\"merge\" id=\"m{i}\"><ref id=\"m{0}\"/><ref id=\"m{0}\"/></shape>", i + 1);
    let merges: String = (0..50).map(merge).collect();
    let last = "<shape type=\"merge\" id=\"m50\"/>";
    assert!(refused(&format!("{SENSOR}{merges}{last}")).contains("repeat"));
}

#[test]
fn parameters_and_search_folders_that_each_use_looks_through_are_few() {
    let defaults: String = (0..2000).map(|i| format!("<default name=\"a{i}\" value=\"\"/>")).collect();
    assert!(refused(&defaults).contains("parameters"));
    assert!(refused(&"<path value=\".\"/>".repeat(100)).contains("folders"));
}

#[test]
fn textures_that_hold_each_other_twice_do_not_multiply() {
    let texture = |i: usize| {
        let next = i + 1;
        format!(
            "<texture type=\"checkerboard\" id=\"t{i}\"><ref name=\"color0\" id=\"t{next}\"/><ref name=\"color1\" id=\"t{next}\"/></texture>"
        )
    };
    let textures: String = (0..40).map(texture).collect();
    let text = format!(
        "<scene version=\"3.0.0\">{SENSOR}{textures}<texture type=\"checkerboard\" id=\"t40\"/><shape type=\"sphere\"><bsdf \
         type=\"plastic\"><boolean name=\"nonlinear\" value=\"true\"/><ref name=\"diffuse_reflectance\" id=\"t0\"/></bsdf></shape></scene>"
    );
    let read = read_with(&[], &text, &ImportOptions::default());
    assert!(read.is_ok_and(|read| read.description.textures.len() < 200));
}

#[test]
fn search_folders_do_not_open_the_whole_disk() {
    assert!(refused("<path value=\"../../../../../etc\"/>").contains("above"));
    assert!(refused("<path value=\"..\"/>").contains("holds"));
}

#[test]
fn missing_and_wrong_values_have_a_place() {
    assert!(refused(&format!("{SENSOR}<shape type=\"sphere\"><ref id=\"gone\"/></shape>")).contains("\"gone\""));
    assert!(refused(&format!("{SENSOR}<shape type=\"obj\"/>")).contains("filename"));
    assert!(refused(&format!("{SENSOR}<bsdf type=\"null\" id=\"a\"/><bsdf type=\"null\" id=\"a\"/>")).contains("twice"));
    for number in ["NaN", "inf", "1e999", "x", ""] {
        let report = refused(&format!("{SENSOR}<shape type=\"sphere\"><float name=\"radius\" value=\"{number}\"/></shape>"));
        assert!(report.contains("finite number") && report.contains("scene.xml:1"), "{report}");
    }
    for wrong in ["", "<scene", "<scene version=\"3.0.0\">", "<shape type=\"sphere\"/>", "\u{0}", "plain text"] {
        assert!(!error(&[], wrong).is_empty());
    }
}

#[test]
fn files_outside_the_folder_are_refused() {
    for path in ["../secret.png", "/etc/hostname", "../../x"] {
        let texture = format!(
            "{SENSOR}<shape type=\"sphere\"><bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"bitmap\">\
             <string name=\"filename\" value=\"{path}\"/></texture></bsdf></shape>"
        );
        let report = refused(&texture);
        assert!(report.contains("allow-outside") || report.contains("no such file"), "{report}");
        assert!(!refused(&format!("<include filename=\"{path}\"/>")).is_empty());
    }
    assert!(refused("<path value=\"/\"/>").contains("absolute"));
}

#[test]
fn cut_and_altered_scenes_do_not_panic() {
    let text = format!(
        "<scene version=\"3.0.0\"><default name=\"r\" value=\"2\"/>{SENSOR}<bsdf type=\"roughplastic\" id=\"b\"><rgb \
         name=\"diffuse_reflectance\" value=\"0.1 0.2 0.3\"/></bsdf><shape type=\"sphere\"><float name=\"radius\" value=\"$r\"/><ref \
         id=\"b\"/><transform name=\"to_world\"><rotate y=\"1\" angle=\"30\"/></transform><emitter type=\"area\"/></shape></scene>"
    );
    for end in (0..text.len()).filter(|end| text.is_char_boundary(*end)) {
        let _ = read_with(&[], &text[..end], &ImportOptions::default());
    }
    for at in (0..text.len()).step_by(3) {
        for letter in ["0", "-", "<", "\"", "$", "é"] {
            let altered = format!("{}{letter}{}", &text[..at], &text[at + 1..]);
            let _ = read_with(&[], &altered, &ImportOptions::default());
        }
    }
}
