//! Files that scenes name.
use super::{SENSOR, read_with};
use crate::import::ImportOptions;

#[test]
fn missing_files_are_named_all_at_once_with_their_places() {
    let bitmap = |name: &str, file: &str| {
        format!("<texture name=\"{name}\" type=\"bitmap\"><string name=\"filename\" value=\"{file}\"/></texture>")
    };
    let text = format!(
        "<scene version=\"3.0.0\">{SENSOR}\n<include filename=\"parts.xml\"/>\n\
         <bsdf type=\"diffuse\" id=\"unused\">{}</bsdf>\n\
         <shape type=\"ply\"><string name=\"filename\" value=\"a.ply\"/>\n\
         <bsdf type=\"roughplastic\">{}\n{}\n<spectrum name=\"specular_reflectance\" filename=\"s.spd\"/></bsdf></shape>\n\
         <shape type=\"ply\"><string name=\"filename\" value=\"a.ply\"/><ref id=\"of the parts\"/></shape>\n\
         <shape type=\"serialized\"><string name=\"filename\" value=\"b.serialized\"/></shape>\n\
         <shape type=\"sphere\"><bsdf type=\"bumpmap\">{}<bsdf type=\"diffuse\"/></bsdf></shape>\n\
         <emitter type=\"envmap\"><string name=\"filename\" value=\"sky.exr\"/></emitter></scene>",
        bitmap("reflectance", "unused.png"),
        bitmap("diffuse_reflectance", "wood.png"),
        bitmap("alpha", "there.png"),
        bitmap("", "bump.png"),
    );
    let error = read_with(&[("there.png", "")], &text, &ImportOptions::default()).err().expect("files are missing");
    let report = error.report();
    let missing = ["parts.xml", "a.ply", "wood.png", "s.spd", "b.serialized", "bump.png", "sky.exr"];
    for name in missing {
        assert!(report.contains(&format!("`{name}`: there is no such file")), "{name}: {report}");
    }
    assert!(error.count() == missing.len() && report.contains("scene.xml:11:"), "{report}");
    // With all of them, other errors count again.
    let text = text.replace("unused.png", "there.png");
    let all = missing.map(|name| (name, "")).into_iter().chain([("there.png", "")]).collect::<Vec<_>>();
    let error = read_with(&all, &text, &ImportOptions::default()).err().expect("the parts are empty");
    assert!(!error.report().contains("no such file"), "{}", error.report());
}
