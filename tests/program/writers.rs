//! All files are written by the module whose tests make the disk fail.
use std::{fs, path::Path};

use crate::imports::{code, source, source_files};

/// What creates, changes or renames a file.
const WRITES: [&str; 11] = [
    "fs::write(",
    "fs::rename(",
    "fs::copy(",
    "File::create",
    "File::options",
    "OpenOptions",
    ".persist(",
    "NamedTempFile",
    "tempfile_in(",
    "tempfile()",
    "tempfile::Builder",
];
/// The modules that replace files and save new ones, faults for tests, and those that lock an empty file: studies and recovery files.
const WRITERS: [&str; 5] =
    ["file/target/mod.rs", "file/elsewhere.rs", "file/faults.rs", "study/store.rs", "viewer/background/recovery_files.rs"];

#[test]
fn every_file_is_replaced_whole_by_the_same_module() {
    let source = source();
    let is_test = |path: &Path| path.iter().any(|part| part == "tests" || part == "tests.rs");
    let mut found = Vec::new();
    for path in source_files(&source).into_iter().filter(|path| !is_test(path)) {
        let text = code(&fs::read_to_string(&path).expect("source is text"));
        if WRITES.iter().any(|write| text.contains(write)) {
            found.push(path.strip_prefix(&source).expect("it lies in the source").display().to_string());
        }
    }
    found.sort();
    let mut writers = WRITERS;
    writers.sort_unstable();
    assert_eq!(found, writers, "other code writes files, or these no longer do");
}

#[test]
fn exports_write_their_files_where_no_link_is_followed() {
    let source = source();
    let mut with_door = Vec::new();
    for path in source_files(&source.join("export")) {
        let name = path.strip_prefix(&source).expect("it lies in the source").display().to_string();
        let text = code(&fs::read_to_string(&path).expect("source is text"));
        // The scene file itself is where the user says.
        let is_around = ["replace_by(", "create_dir"].iter().any(|write| text.contains(write));
        assert!(!is_around || name.contains("tests"), "{name} writes by itself");
        with_door.extend(text.contains("replace_below(").then_some(name));
    }
    assert_eq!(with_door, ["export/files.rs"]);
}
