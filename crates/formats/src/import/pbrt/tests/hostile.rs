//! Files that are broken, or made to do harm.
use super::{SceneFolder, error, imported};
use noisefall_scene::model::Model;

#[test]
fn unbalanced_ends_are_refused() {
    for (text, reason) in [
        ("WorldBegin\nAttributeEnd", "no beginning"),
        ("WorldBegin\nAttributeBegin\nTransformEnd", "does not end what began in line 2"),
        ("WorldBegin\nAttributeBegin", "its End is missing"),
        ("WorldBegin\nObjectBegin \"a\"\nObjectBegin \"b\"", "within another"),
        ("WorldBegin\nObjectBegin \"a\"\nObjectInstance \"a\"", "within a definition"),
        ("WorldBegin\nObjectInstance \"a\"", "not an object"),
        ("WorldBegin\nWorldBegin", "comes twice"),
    ] {
        assert!(error(text).contains(reason), "{text}: {}", error(text));
    }
}

#[test]
fn deep_nesting_is_refused_without_recursion() {
    let deep = |pairs: usize| "WorldBegin\n".to_owned() + &"AttributeBegin\n".repeat(pairs) + &"AttributeEnd\n".repeat(pairs);
    imported(&deep(10_000));
    assert!(error(&deep(20_000)).contains("nested more than"));
}

#[test]
fn circles_are_refused() {
    let files = SceneFolder::new(&[("a.pbrt", "Include \"b.pbrt\""), ("b.pbrt", "Include \"a.pbrt\"")]);
    assert!(files.read().is_err_and(|error| error.to_string().contains("includes itself")));
    let texture = "Texture \"t\" \"float\" \"scale\" \"texture tex\" \"t\"\nShape \"sphere\" \"texture alpha\" \"t\"";
    assert!(error(&format!("WorldBegin\n{texture}")).contains("contains itself"));
    let mix = "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string materials\" [\"m\" \"m\"]\nNamedMaterial \"m\"\nShape \"sphere\"";
    assert!(error(&format!("WorldBegin\n{mix}")).contains("contains itself"));
}

#[test]
fn files_that_multiply_are_refused() {
    let names: Vec<String> = (0..40).map(|i| format!("{i}.pbrt")).collect();
    let texts: Vec<String> = (0..40).map(|i| format!("Include \"{}.pbrt\"\n", i + 1).repeat(2)).collect();
    let mut files: Vec<(&str, &str)> = names.iter().zip(&texts).map(|(name, text)| (name.as_str(), text.as_str())).collect();
    files.extend([("40.pbrt", ""), ("a.pbrt", "Include \"0.pbrt\"")]);
    assert!(SceneFolder::new(&files).read().is_err_and(|error| error.to_string().contains("too many times")));
}

#[test]
fn objects_that_multiply_are_refused() {
    let shapes = "Shape \"sphere\"\n".repeat(1000);
    let uses = "ObjectInstance \"a\"\n".repeat(2000);
    assert!(error(&format!("WorldBegin\nObjectBegin \"a\"\n{shapes}ObjectEnd\n{uses}")).contains("more than"));
}

#[test]
fn flat_objects_that_multiply_are_refused() {
    let shapes = "Shape \"sphere\"\n".repeat(1000);
    let uses = "ObjectInstance \"a\"\n".repeat(2000);
    let flat = format!("WorldBegin\nObjectBegin \"a\"\n{shapes}ObjectEnd\nScale 1 1 0\n{uses}");
    assert!(error(&flat).contains("more than"));
}

#[test]
fn parts_of_quadrics_take_little_memory_each() {
    let found = imported(&format!("WorldBegin\n{}", "Shape \"sphere\" \"float phimax\" 90\n".repeat(1000)));
    let meshes = found.assets.paths().filter_map(|path| found.assets.get::<Model>(path));
    assert!(meshes.map(|mesh| mesh.bytes()).sum::<u64>() < 160 << 20);
}

#[test]
fn attributes_have_few_values() {
    let numbers = "1 ".repeat(5000);
    assert!(error(&format!("Attribute \"shape\" \"float a\" [{numbers}]\nWorldBegin")).contains("attributes"));
}

#[test]
fn a_spectrum_file_is_read_once() {
    let spectrum: String = (0..60_000).map(|i| format!("{} 1\n", 300.0 + f64::from(i) / 100.0)).collect();
    let lights = "LightSource \"point\" \"spectrum I\" \"a.spd\"\n".repeat(2000);
    let scene = format!("WorldBegin\n{lights}");
    let found = SceneFolder::new(&[("a.pbrt", &scene), ("a.spd", &spectrum)]).read().expect("it is read");
    assert_eq!(found.description.punctual_lights.len(), 2000);
}

#[test]
fn numbers_are_finite() {
    for number in ["nan", "inf", "-infinity", "1e999", "1.2.3", "0x10", "\"1\"", "true"] {
        let text = format!("WorldBegin\nShape \"sphere\" \"float radius\" {number}");
        assert!(error(&text).contains("number"), "{number}");
    }
    assert!(error("Translate 1 2 nan").contains("finite"));
    assert!(error("Scale 1 2").contains("not complete"));
    assert!(error("Transform [1 2 3]").contains("not a number"));
    assert!(error("Rotate 30 0 0 0").contains("axis"));
}

#[test]
fn truncated_texts_have_errors_and_no_panic() {
    let text = "LookAt 0 0 5 0 0 0 0 1 0\nFilm \"rgb\" \"string filename\" [\"a.png\"]\nCamera \"perspective\" \"float fov\" [ 30 ]\n\
                WorldBegin\nAttributeBegin\nMaterial \"conductor\" \"float roughness\" .1\nAttribute \"shape\" \"float alpha\" .5\n\
                Shape \"sphere\" \"float radius\" [ 2 ]\nAttributeEnd\nOption \"float x\" 3\n";
    imported(text);
    for end in 0..text.len() {
        let _ = SceneFolder::new(&[("a.pbrt", &text[..end])]).read();
    }
}

#[test]
fn media_are_refused_where_they_matter() {
    let fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [1 1 1]\n";
    imported(&format!("WorldBegin\n{fog}Shape \"sphere\""));
    let message = error(&format!("WorldBegin\n{fog}MediumInterface \"fog\" \"\"\nShape \"sphere\""));
    assert!(message.contains("participating medium `fog` is not rendered"), "{message}");
    let clear = "MakeNamedMedium \"air\" \"string type\" \"homogeneous\" \"float scale\" 0\nMediumInterface \"air\" \"air\"\n";
    imported(&format!("WorldBegin\n{clear}Shape \"sphere\""));
    let dark = "MakeNamedMedium \"ink\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [1 2 3] \"rgb sigma_s\" [0 0 0]\n";
    let around = error(&format!("{dark}MediumInterface \"\" \"ink\"\nCamera \"perspective\"\nWorldBegin"));
    assert!(around.contains("`ink` is rendered within surfaces only"), "{around}");
}

#[test]
fn all_missing_files_are_named_at_once() {
    let image = |name: &str, file: &str| format!("Texture \"{name}\" \"spectrum\" \"imagemap\" \"string filename\" \"{file}\"\n");
    let text = format!(
        "WorldBegin\nInclude \"1.pbrt\"\n{}{}Material \"coateddiffuse\" \"texture reflectance\" \"t\" \"texture roughness\" \"t\"\n\
         Shape \"plymesh\" \"string filename\" \"2.ply\"\nLightSource \"infinite\" \"string filename\" \"3.exr\"\n\
         Material \"diffuse\" \"texture reflectance\" \"u\" \"string normalmap\" \"5.png\"\nShape \"sphere\"\n\
         Material \"diffuse\" \"spectrum reflectance\" \"6.spd\"\nShape \"sphere\"\nShape \"plymesh\" \"string filename\" \"2.ply\"\n",
        image("t", "4.png"),
        image("u", "7.png"),
    );
    let message = error(&text);
    for name in ["1.pbrt", "2.ply", "3.exr", "4.png", "5.png", "6.spd", "7.png"] {
        assert_eq!(message.matches(&format!("`{name}`: there is no such file")).count(), 1, "{name} is not in {message}");
    }
    assert!(!message.contains("there is no texture"), "{message}");
    // Other errors count again once all files are there.
    let files = ["1.pbrt", "2.ply", "3.exr", "4.png", "5.png", "6.spd", "7.png"].map(|name| (name, ""));
    let error = SceneFolder::new(&[&[("a.pbrt", text.as_str())], &files[..]].concat()).read().err().expect("files are empty");
    assert!(!error.report().contains("no such file"), "{}", error.report());
}

#[test]
fn shapes_without_extent_are_left_out() {
    let found = imported("WorldBegin\nScale 0 1 1\nShape \"sphere\"");
    assert!(found.description.objects.is_empty() && !found.remarks.is_empty());
}
