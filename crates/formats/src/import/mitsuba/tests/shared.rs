//! Mitsuba's own render tests, if they lie beside the repository.
use std::{
    fs,
    path::{Path, PathBuf},
};

use crate::import::{ImportOptions, read};
use noisefall_base::declare::check;

fn scenes(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            scenes(&path, found);
        } else if path.file_name().is_some_and(|name| name.to_string_lossy().starts_with("test_"))
            && path.extension().is_some_and(|extension| extension == "xml")
        {
            found.push(path);
        }
    }
}

#[test]
fn mitsubas_own_tests_are_read_and_those_with_media_are_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/mitsuba-tests");
    let mut found = Vec::new();
    scenes(&folder, &mut found);
    if found.is_empty() {
        println!("skipped: there is no folder {}", folder.display());
        return;
    }
    for path in found {
        let name = path.display();
        match read(&path, &ImportOptions::default()) {
            Err(error) => {
                let report = error.report();
                assert!(report.contains("participating medium") && name.to_string().contains("media"), "{name}: {report}");
            }
            Ok(imported) => {
                assert!(!name.to_string().contains("participating_media"), "{name} is read");
                let problems = check(&mut imported.description.clone());
                assert!(problems.is_empty(), "{name}: {problems:?}");
                let (objects, punctual_lights) = (imported.description.objects.len(), imported.description.punctual_lights.len());
                println!("{name}: {objects} objects, {punctual_lights} lights");
                imported.remarks.lines(20).iter().for_each(|line| println!("    {line}"));
            }
        }
    }
}
