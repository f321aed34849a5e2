//! Whole scenes.
mod clouds_and_grids;
mod curves;
mod emitters;
mod files;
mod hostile;
mod legacy;
mod materials;
mod media;
mod sensors;
mod shapes;
mod shared;

use std::{fs, path::Path};

use crate::import::{ImportOptions, Imported, read};
use noisefall_base::declare::check;
use noisefall_scene::scene::{
    Estimator, SceneError,
    description::{MaterialDescription, ObjectDescription},
};

/// Reads a scene with files beside it.
fn read_with(files: &[(&str, &str)], text: &str, options: &ImportOptions) -> Result<Imported, SceneError> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.xml");
    for (name, content) in files.iter().chain([&("scene.xml", text)]) {
        let file = folder.path().join(name);
        fs::create_dir_all(file.parent().unwrap_or(Path::new("."))).expect("a folder");
        fs::write(file, content).expect("it is written");
    }
    read(&path, options)
}

/// The scene of the elements within `<scene>`.
fn scene(within: &str) -> Imported {
    let text = format!("<scene version=\"3.0.0\">{within}</scene>");
    let imported = read_with(&[], &text, &ImportOptions::default()).unwrap_or_else(|error| panic!("{}", error.report()));
    let problems = check(&mut imported.description.clone());
    assert!(problems.is_empty(), "{problems:?}");
    imported
}

/// The error of a scene.
fn refused(within: &str) -> String {
    let text = format!("<scene version=\"3.0.0\">{within}</scene>");
    match read_with(&[], &text, &ImportOptions::default()) {
        Ok(_) => panic!("{within} is read"),
        Err(error) => error.report(),
    }
}

/// The material of a BSDF on a sphere.
fn material(bsdf: &str) -> (MaterialDescription, Imported) {
    let imported = scene(&format!("{SENSOR}<shape type=\"sphere\">{bsdf}</shape>"));
    let name = imported.description.objects[0].material.clone().expect("it has a material");
    (imported.description.materials[&name].clone(), imported)
}

/// The object of a shape.
fn object(shape: &str) -> ObjectDescription {
    scene(&format!("{SENSOR}{shape}")).description.objects.remove(0)
}

/// Returns the texts of the remarks, without places.
fn remarks(imported: &Imported) -> Vec<String> {
    imported.remarks.iter().map(|counted| format!("{} → {}", counted.remark.found, counted.remark.used)).collect()
}

const SENSOR: &str = "<sensor type=\"perspective\"><film type=\"hdrfilm\"><rfilter type=\"box\"/></film></sensor>";

#[test]
fn parameters_have_defaults_and_values_of_the_command_line() {
    let text = "<scene version=\"3.0.0\"><default name=\"spp\" value=\"16\"/><default name=\"kind\" value=\"independent\"/>\
        <sensor type=\"perspective\"><sampler type=\"$kind\"><integer name=\"sample_count\" value=\"$spp\"/></sampler></sensor></scene>";
    let spp = |defines: &[(&str, &str)]| {
        let defines = defines.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
        let options = ImportOptions { defines, ..ImportOptions::default() };
        read_with(&[], text, &options).expect("it is valid").description.render.spp
    };
    assert_eq!((spp(&[]), spp(&[("spp", "4")])), (Some(16), Some(4)));
    assert!(refused("<shape type=\"$shape\"/>").contains("-D shape=VALUE"));
}

#[test]
fn included_files_and_references_are_in_place() {
    let part = "<scene version=\"3.0.0\"><default name=\"x\" value=\"7\"/><bsdf type=\"dielectric\" id=\"glass\"/></scene>";
    let text = format!(
        "<scene version=\"3.0.0\">{SENSOR}<shape type=\"sphere\"><ref id=\"clear\"/><float name=\"radius\" value=\"$x\"/></shape>\
         </scene>"
    );
    // Parameters count from where they are defined, and ids everywhere.
    let text = text.replace(SENSOR, &format!("<include filename=\"parts/a.xml\"/><alias id=\"glass\" as=\"clear\"/>{SENSOR}"));
    let imported = read_with(&[("parts/a.xml", part)], &text, &ImportOptions::default()).expect("it is valid");
    assert_eq!(imported.description.objects[0].material.as_deref(), Some("glass"));
    assert!(imported.remarks.is_empty(), "{:?}", remarks(&imported));
}

#[test]
fn names_of_old_versions_are_understood() {
    let text = "<scene version=\"0.6.0\"><sensor type=\"perspective\"><string name=\"fovAxis\" value=\"y\"/><float name=\"fov\" \
        value=\"30\"/><transform name=\"toWorld\"><lookAt origin=\"0,0,5\" target=\"0,0,0\" up=\"0,1,0\"/></transform></sensor>\
        <shape type=\"sphere\"><bsdf type=\"diffuse\"><srgb name=\"diffuseReflectance\" value=\"#ff0000\"/></bsdf></shape></scene>";
    let description = read_with(&[], text, &ImportOptions::default()).expect("it is valid").description;
    assert!(description.camera.fov.is_some_and(|fov| fov > 30.0) && description.camera.eye.z == 5.0);
    let material = description.materials.values().next().expect("there is one");
    assert!(format!("{material:?}").contains("[1.0, 0.0, 0.0]"), "{material:?}");
}

#[test]
fn ignored_elements_are_reported_with_their_places() {
    let imported = scene(&format!(
        "{SENSOR}\n  <shape type=\"sphere\"><float name=\"foo\" value=\"1\"/></shape><bsdf type=\"null\" id=\"n\"/>"
    ));
    let lines = imported.remarks.lines(9);
    assert!(lines.len() == 1 && lines[0].contains("scene.xml:2:24: `<float name=\"foo\" value=\"1\">` → nothing"), "{lines:?}");
}

#[test]
fn the_depth_of_paths_counts_edges() {
    let bounces = |integrator: &str| scene(&format!("{integrator}{SENSOR}")).description.render.settings.max_bounces;
    let path = |depth: i32| format!("<integrator type=\"path\"><integer name=\"max_depth\" value=\"{depth}\"/></integrator>");
    assert_eq!([path(-1), path(1), path(2), path(9)].map(|text| bounces(&text)), [None, Some(0), Some(1), Some(8)]);
    assert_eq!(bounces("<integrator type=\"direct\"/>"), Some(1));
    assert_eq!(bounces(&format!("<integrator type=\"moment\">{}</integrator>", path(3))), Some(2));
    assert_eq!(bounces("<integrator type=\"path\"/>"), None);
    let estimator = |kind: &str| scene(&format!("<integrator type=\"{kind}\"/>{SENSOR}")).description.render.settings.estimator;
    assert_eq!(["path", "bdpt"].map(estimator), [Estimator::Mis, Estimator::Bidirectional]);
}

#[test]
fn photons_become_merged_vertices_and_mutations_bidirectional_paths() {
    let settings = |kind: &str| {
        let found =
            scene(&format!("<integrator type=\"{kind}\"><integer name=\"photonCount\" value=\"9\"/></integrator>{SENSOR}"));
        assert!(found.remarks.is_empty(), "{:?}", remarks(&found));
        (found.description.render.settings.estimator, found.description.render.settings.merging)
    };
    for kind in ["photonmapper", "ppm", "sppm"] {
        assert_eq!(settings(kind), (Estimator::Bidirectional, true), "{kind}");
    }
    for kind in ["mlt", "pssmlt", "erpt"] {
        assert_eq!(settings(kind), (Estimator::Bidirectional, false), "{kind}");
    }
}
