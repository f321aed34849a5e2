//! All files are written by the module whose tests make the disk fail.
use crate::imports::source;

/// Calls that create, change or rename a file.
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
    let mut found = Vec::new();
    for file in source().into_iter().filter(|file| !file.is_test()) {
        let code = file.code();
        found.extend(WRITES.iter().any(|write| code.contains(write)).then_some(file.name));
    }
    found.sort();
    let mut writers = WRITERS;
    writers.sort_unstable();
    assert_eq!(found, writers, "other code writes files, or these no longer do");
}

#[test]
fn exports_write_their_files_where_no_link_is_followed() {
    let mut with_door = Vec::new();
    for file in source().into_iter().filter(|file| file.name.starts_with("export/")) {
        let (text, name) = (file.code(), file.name);
        // The scene file itself is where the user says.
        let is_around = ["replace_by(", "create_dir"].iter().any(|write| text.contains(write));
        assert!(!is_around || name.contains("tests"), "{name} writes by itself");
        with_door.extend(text.contains("replace_below(").then_some(name));
    }
    assert_eq!(with_door, ["export/files.rs"]);
}
